//! What a step on a GPU moves, and what the GPU allows: what measured rates are held against.

use std::time::Instant;

use super::{Gpu, GpuState};
use crate::SolverError;

/// Bytes of a vec4.
const QUAD: u64 = 16;
/// Bytes of a number.
const WORD: u64 = 4;
/// Copies that are timed, after one that is not.
const COPIES: u64 = 8;

impl GpuState<'_> {
    /// Bytes a step reads and writes, each record once a pass that uses it: nodes gathered by several elements are
    /// taken to come out of a cache. Partial sums are left out.
    pub fn step_bytes(&self) -> u64 {
        let [nodes, edges, faces] = self.counts();
        let held = u64::from(self.has_face_angles()) * QUAD * faces;
        // Ends, constants, two rest vectors and the load; the angle is read and written, the target read.
        let edge_loads = edges * (5 * QUAD + 3 * WORD) + nodes * 2 * QUAD;
        // Corners, edges, sides and three forces.
        let face_loads = faces * 6 * QUAD + edges * QUAD + nodes * QUAD + held;
        // Place, speed and force with mass are read and written.
        let node_step =
            nodes * (6 * QUAD + 2 * WORD) + edges * (QUAD + 2 * WORD) + faces * 3 * (QUAD + WORD);
        edge_loads + face_loads + node_step
    }

    /// Bytes of the buffers, but for the partial sums.
    pub fn memory_bytes(&self) -> u64 {
        let [nodes, edges, faces] = self.counts();
        nodes * 3 * QUAD
            + (nodes + 1) * 2 * WORD
            + edges * (5 * QUAD + 2 * WORD + 2 * WORD)
            + faces * (7 * QUAD + 3 * WORD)
    }
}

impl Gpu {
    /// Bytes a second read and written by copying a buffer of `bytes` (a multiple of 4) to another, the median of 3.
    ///
    /// # Errors
    /// [`SolverError::GpuTooSmall`], [`SolverError::GpuLost`].
    pub fn copy_rate(&self, bytes: u64) -> Result<f64, SolverError> {
        let words = vec![1u32; (bytes / WORD) as usize];
        let none = wgpu::BufferUsages::empty();
        let from = self.buffer("copied", &words, none)?;
        let to = self.buffer("copy", &words, none)?;
        self.copy(&from, &to, 1)?;
        let mut rates = [0.0; 3];
        for rate in &mut rates {
            let start = Instant::now();
            self.copy(&from, &to, COPIES)?;
            *rate = (2 * COPIES * from.size()) as f64 / start.elapsed().as_secs_f64();
        }
        rates.sort_by(f64::total_cmp);
        Ok(rates[1])
    }

    fn copy(&self, from: &wgpu::Buffer, to: &wgpu::Buffer, times: u64) -> Result<(), SolverError> {
        let mut encoder =
            self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for _time in 0..times {
            encoder.copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
        self.queue.submit([encoder.finish()]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| self.lost(e))?;
        self.check()
    }
}
