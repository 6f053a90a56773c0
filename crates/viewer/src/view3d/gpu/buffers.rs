//! The sheet in GPU memory. Vertex positions and layer offsets are tables in textures, which every device can read in a
//! vertex shader.

use eframe::egui_wgpu::wgpu;

/// Cells in a row of a table, as in the shader.
const ROW: u32 = 512;

/// A buffer of instance records that grows as needed.
#[derive(Debug)]
pub(super) struct Buffer {
    label: &'static str,
    usage: wgpu::BufferUsages,
    held: Option<wgpu::Buffer>,
    /// Number of records written.
    pub(super) count: u32,
}

impl Buffer {
    pub(super) fn instances(label: &'static str) -> Self {
        Self { label, usage: wgpu::BufferUsages::VERTEX, held: None, count: 0 }
    }

    /// Replaces the contents by `records`.
    pub(super) fn write<T: bytemuck::NoUninit>(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        records: &[T],
    ) {
        let bytes: &[u8] = bytemuck::cast_slice(records);
        self.count = records.len() as u32;
        if bytes.is_empty() {
            return;
        }
        let size = bytes.len() as u64;
        let buffer = match self.held.take() {
            Some(buffer) if buffer.size() >= size => buffer,
            _ => device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(self.label),
                size: size.next_power_of_two(),
                usage: self.usage | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
        };
        queue.write_buffer(&buffer, 0, bytes);
        self.held = Some(buffer);
    }

    /// The buffer; `None` if it is empty.
    pub(super) fn written(&self) -> Option<&wgpu::Buffer> {
        self.held.as_ref().filter(|_| self.count > 0)
    }
}

/// A table that vertex shaders look up.
#[derive(Debug)]
pub(super) struct DataTexture {
    texture: wgpu::Texture,
    /// Floats per cell.
    width: u32,
}

impl DataTexture {
    /// A table of `count` cells with two or four floats each.
    pub(super) fn new(device: &wgpu::Device, count: usize, width: u32) -> Self {
        let format = match width {
            2 => wgpu::TextureFormat::Rg32Float,
            _ => wgpu::TextureFormat::Rgba32Float,
        };
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("table"),
            size: wgpu::Extent3d {
                width: ROW,
                height: (count as u32).div_ceil(ROW).max(1),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        Self { texture, width }
    }

    pub(super) fn view(&self) -> wgpu::TextureView {
        let default = wgpu::TextureViewDescriptor::default();
        self.texture.create_view(&default)
    }

    /// Replaces the contents by `floats`.
    pub(super) fn write(&self, queue: &wgpu::Queue, mut floats: Vec<f32>) {
        let size = self.texture.size();
        let cells = (size.width * size.height * self.width) as usize;
        floats.resize(cells, 0.0);
        queue.write_texture(
            self.texture.as_image_copy(),
            bytemuck::cast_slice(&floats),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * ROW * self.width),
                rows_per_image: None,
            },
            size,
        );
    }

    /// The largest number of cells on a device with these limits.
    pub(super) fn most(limits: &wgpu::Limits) -> usize {
        (limits.max_texture_dimension_2d * ROW) as usize
    }
}
