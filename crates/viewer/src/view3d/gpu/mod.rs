//! The sheet, drawn on the GPU when something has changed.

mod buffers;
mod errors;
mod pipelines;
mod target;
#[cfg(test)]
pub(super) mod tests;
mod view;

use eframe::egui::{Color32, Rgba, TextureId};
use eframe::egui_wgpu::{RenderState, wgpu};
use glam::DVec3;

use self::buffers::{Buffer, DataTexture};
pub(super) use self::errors::LossMonitor;
use self::errors::catch_errors;
use self::pipelines::Pipelines;
use self::target::{EguiTexture, Target, drawn_format};
pub(super) use self::view::FrameView;
use self::view::{VIEW_FLOATS, numbers};
use super::CreaseClasses;
use super::paints::{PaintKey, paints};
use super::picture::Picture;
use super::segments::{Segment, segments};

/// What the picture depends on; it is drawn again when this changes.
#[derive(Debug, PartialEq, Default)]
struct PictureKey {
    sheet_key: Option<u64>,
    state_key: Option<u64>,
    creases: Option<CreaseClasses>,
    paints: Option<PaintKey>,
    segments: Vec<Segment>,
    view: Vec<f32>,
    background: Color32,
    size: [u32; 2],
}

/// The sheet on one device.
pub(super) struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    format: wgpu::TextureFormat,
    pipelines: Pipelines,
    uniform: wgpu::Buffer,
    places: DataTexture,
    layers: DataTexture,
    bind_group: wgpu::BindGroup,
    corners: Buffer,
    paints: Buffer,
    creases: Buffer,
    segments: Buffer,
    target: Option<Target>,
    egui_texture: EguiTexture,
    origin: DVec3,
    drawn: PictureKey,
    /// The number of pictures drawn so far.
    pub(super) count: u64,
}

impl Gpu {
    /// # Errors
    /// The message of the driver or of wgpu.
    pub(super) fn new(state: &RenderState) -> Result<Self, String> {
        catch_errors(&state.device, || Self::open(state))
    }

    fn open(state: &RenderState) -> Self {
        let (device, queue) = (state.device.clone(), state.queue.clone());
        let format = drawn_format(state);
        let pipelines = Pipelines::new(&device, format);
        let uniform = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("view"),
            size: 4 * VIEW_FLOATS as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let (places, layers) = (DataTexture::new(&device, 1, 4), DataTexture::new(&device, 1, 2));
        let bind_group = bind(&device, &pipelines, &uniform, [&places, &layers]);
        Self {
            format,
            pipelines,
            uniform,
            places,
            layers,
            bind_group,
            corners: Buffer::instances("corners"),
            paints: Buffer::instances("paints"),
            creases: Buffer::instances("creases"),
            segments: Buffer::instances("segments"),
            target: None,
            egui_texture: EguiTexture::new(state),
            origin: DVec3::ZERO,
            drawn: PictureKey::default(),
            count: 0,
            device,
            queue,
        }
    }

    /// Shows the picture, which is drawn again if it has changed.
    ///
    /// # Errors
    /// The message of the driver or of wgpu, or that the sheet is too large for the device.
    pub(super) fn show(
        &mut self,
        picture: &Picture<'_>,
        view: &FrameView<'_>,
    ) -> Result<TextureId, String> {
        let limits = self.device.limits();
        let most = DataTexture::most(&limits);
        let largest = picture.positions.len().max(picture.sheet.faces.len());
        if largest > most {
            return Err(format!(
                "{largest} vertices or triangles are too many for the GPU (at most {most})"
            ));
        }
        let device = self.device.clone();
        catch_errors(&device, || self.follow(picture, view))?;
        self.egui_texture.id().ok_or_else(|| "no picture".to_owned())
    }

    fn follow(&mut self, picture: &Picture<'_>, view: &FrameView<'_>) {
        let mut is_new = self.take_sheet(picture);
        is_new |= self.take_state(picture, view);
        is_new |= self.take_paints(picture);
        is_new |= self.take_view(picture, view);
        is_new |= self.take_size(view.size);
        if is_new {
            self.draw();
        }
    }

    /// Updates the sheet and its creases; returns whether they have changed.
    fn take_sheet(&mut self, picture: &Picture<'_>) -> bool {
        let (key, sheet) = (Some(picture.sheet_key), picture.sheet);
        let is_other = self.drawn.sheet_key != key;
        if is_other {
            self.drawn.sheet_key = key;
            self.drawn.state_key = None;
            self.drawn.creases = None;
            self.drawn.paints = None;
            self.places = DataTexture::new(&self.device, sheet.vertices.len(), 4);
            self.layers = DataTexture::new(&self.device, sheet.faces.len(), 2);
            let tables = [&self.places, &self.layers];
            self.bind_group = bind(&self.device, &self.pipelines, &self.uniform, tables);
            self.corners.write(&self.device, &self.queue, &sheet.faces);
        }
        let is_drawn = self.drawn.creases == Some(picture.creases);
        if !is_drawn {
            self.drawn.creases = Some(picture.creases);
            let lines = picture.creases.lines(sheet);
            self.creases.write(&self.device, &self.queue, &lines);
        }
        is_other || !is_drawn
    }

    fn take_state(&mut self, picture: &Picture<'_>, view: &FrameView<'_>) -> bool {
        let key = Some(picture.state_key);
        if self.drawn.state_key == key {
            return false;
        }
        self.drawn.state_key = key;
        self.origin = view.prepared.sphere.middle;
        let place = |p: &DVec3| {
            let [x, y, z] = (*p - self.origin).as_vec3().to_array();
            [x, y, z, 0.0]
        };
        let places = picture.positions.iter().flat_map(place).collect();
        self.places.write(&self.queue, places);
        self.layers.write(&self.queue, view.prepared.before.concat());
        true
    }

    fn take_paints(&mut self, picture: &Picture<'_>) -> bool {
        let wanted = PaintKey::of(picture);
        if self.drawn.paints.as_ref() == Some(&wanted) {
            return false;
        }
        self.drawn.paints = Some(wanted);
        self.paints.write(&self.device, &self.queue, &paints(picture));
        true
    }

    fn take_view(&mut self, picture: &Picture<'_>, view: &FrameView<'_>) -> bool {
        let segments = segments(picture);
        let numbers = numbers(picture, view, self.origin, !self.format.is_srgb());
        let is_same = self.drawn.segments == segments
            && self.drawn.view == numbers
            && self.drawn.background == picture.background;
        if is_same {
            return false;
        }
        let floats = |s: &Segment| s.floats(self.origin, view.pixels_per_point);
        let records: Vec<[f32; Segment::FLOATS]> = segments.iter().map(floats).collect();
        self.segments.write(&self.device, &self.queue, &records);
        let bytes = bytemuck::cast_slice(&numbers);
        self.queue.write_buffer(&self.uniform, 0, bytes);
        self.drawn.segments = segments;
        self.drawn.view = numbers;
        self.drawn.background = picture.background;
        true
    }

    fn take_size(&mut self, size: [u32; 2]) -> bool {
        if self.target.as_ref().is_some_and(|target| target.size == size) {
            return false;
        }
        let target = Target::new(&self.device, size, self.format);
        self.egui_texture.put(&self.device, &target.shown());
        self.target = Some(target);
        true
    }

    fn draw(&mut self) {
        let Some(target) = &self.target else { return };
        let default = wgpu::CommandEncoderDescriptor::default();
        let mut encoder = self.device.create_command_encoder(&default);
        let mut pass = target.begin(&mut encoder, self.background());
        pass.set_bind_group(0, &self.bind_group, &[]);
        if let (Some(corners), Some(paints)) = (self.corners.written(), self.paints.written()) {
            pass.set_pipeline(&self.pipelines.faces);
            pass.set_vertex_buffer(0, corners.slice(..));
            pass.set_vertex_buffer(1, paints.slice(..));
            pass.draw(0..3, 0..self.corners.count);
        }
        let lines = [
            (&self.pipelines.creases, &self.creases, 12),
            (&self.pipelines.hidden, &self.segments, 6),
            (&self.pipelines.overlays, &self.segments, 6),
        ];
        for (pipeline, buffer, vertices) in lines {
            if let Some(instances) = buffer.written() {
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, instances.slice(..));
                pass.draw(0..vertices, 0..buffer.count);
            }
        }
        drop(pass);
        self.queue.submit([encoder.finish()]);
        self.count += 1;
    }

    fn background(&self) -> wgpu::Color {
        let colour = self.drawn.background;
        let [r, g, b] = if self.format.is_srgb() {
            let [r, g, b, _] = Rgba::from(colour.to_opaque()).to_array();
            [r, g, b]
        } else {
            [colour.r(), colour.g(), colour.b()].map(|byte| f32::from(byte) / 255.0)
        };
        let [r, g, b] = [r, g, b].map(f64::from);
        wgpu::Color { r, g, b, a: 1.0 }
    }
}

fn bind(
    device: &wgpu::Device,
    pipelines: &Pipelines,
    uniform: &wgpu::Buffer,
    tables: [&DataTexture; 2],
) -> wgpu::BindGroup {
    let [places, layers] = tables.map(DataTexture::view);
    let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("sheet"),
        layout: &pipelines.bindings,
        entries: &[
            entry(0, uniform.as_entire_binding()),
            entry(1, wgpu::BindingResource::TextureView(&places)),
            entry(2, wgpu::BindingResource::TextureView(&layers)),
        ],
    })
}
