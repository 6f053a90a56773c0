//! Buffers of the GPU: made, filled and read.

use bytemuck::{NoUninit, Pod};
use wgpu::util::{BufferInitDescriptor, DeviceExt as _};

use super::device::Gpu;
use crate::SolverError;

impl Gpu {
    /// A storage buffer with `records`; `what` names them in errors.
    pub(super) fn buffer<T: NoUninit>(
        &self,
        what: &'static str,
        records: &[T],
        usage: wgpu::BufferUsages,
    ) -> Result<wgpu::Buffer, SolverError> {
        let bytes = size_of_val(records) as u64;
        let limits = self.device.limits();
        let limit = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        if bytes > limit {
            return Err(SolverError::GpuTooSmall { what, bytes, limit });
        }
        Ok(self.device.create_buffer_init(&BufferInitDescriptor {
            label: Some(what),
            contents: bytemuck::cast_slice(records),
            usage: wgpu::BufferUsages::STORAGE
                | wgpu::BufferUsages::COPY_SRC
                | wgpu::BufferUsages::COPY_DST
                | usage,
        }))
    }

    /// The content of a buffer after all submitted work.
    pub(super) fn read<T: Pod>(&self, buffer: &wgpu::Buffer) -> Result<Vec<T>, SolverError> {
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("staging"),
            size: buffer.size(),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder =
            self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        // What goes wrong with the mapping is said where it is read.
        staging.map_async(wgpu::MapMode::Read, .., |_mapped| {});
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| self.lost(e))?;
        self.check()?;
        let view = staging.get_mapped_range(..).map_err(|e| self.lost(e))?;
        Ok(bytemuck::pod_collect_to_vec(&view))
    }
}
