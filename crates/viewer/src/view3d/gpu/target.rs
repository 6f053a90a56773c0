//! The textures that are drawn into, and the picture as egui shows it.

use std::sync::Arc;

use eframe::egui::TextureId;
use eframe::egui::mutex::RwLock;
use eframe::egui_wgpu::{RenderState, Renderer, wgpu};

use super::pipelines::{DEPTH, SAMPLES};

/// The format in which egui reads pictures: sRGB values without conversion.
const SHOWN: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The format in which pictures are drawn. Samples are averaged in linear light if the device supports views of one
/// texture in two formats.
pub(super) fn drawn_format(state: &RenderState) -> wgpu::TextureFormat {
    let flags = state.adapter.get_downlevel_capabilities().flags;
    if flags.contains(wgpu::DownlevelFlags::VIEW_FORMATS) {
        wgpu::TextureFormat::Rgba8UnormSrgb
    } else {
        SHOWN
    }
}

/// The textures for one size of the picture.
pub(super) struct Target {
    pub(super) size: [u32; 2],
    samples: wgpu::TextureView,
    depth: wgpu::TextureView,
    picture: wgpu::Texture,
    resolved: wgpu::TextureView,
}

impl Target {
    pub(super) fn new(device: &wgpu::Device, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let texture = |label, format, sample_count, usage, view_formats| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats,
            })
        };
        let view =
            |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let shown =
            attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let picture = texture("picture", format, 1, shown, &[SHOWN]);
        Self {
            size,
            samples: view(&texture("samples", format, SAMPLES, attachment, &[])),
            depth: view(&texture("depth", DEPTH, SAMPLES, attachment, &[])),
            resolved: view(&picture),
            picture,
        }
    }

    /// The view of the picture that egui shows.
    pub(super) fn shown(&self) -> wgpu::TextureView {
        self.picture.create_view(&wgpu::TextureViewDescriptor {
            format: Some(SHOWN),
            ..wgpu::TextureViewDescriptor::default()
        })
    }

    /// The picture that was drawn.
    #[cfg(test)]
    pub(super) fn picture(&self) -> &wgpu::Texture {
        &self.picture
    }

    /// Begins a render pass over `background`.
    pub(super) fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        background: wgpu::Color,
    ) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("sheet"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.samples,
                depth_slice: None,
                resolve_target: Some(&self.resolved),
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(background),
                    store: wgpu::StoreOp::Discard,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }
}

/// A texture registered with egui, which is released when this is dropped.
pub(super) struct EguiTexture {
    renderer: Arc<RwLock<Renderer>>,
    id: Option<TextureId>,
}

impl EguiTexture {
    pub(super) fn new(state: &RenderState) -> Self {
        Self { renderer: Arc::clone(&state.renderer), id: None }
    }

    /// Makes egui show `view`.
    pub(super) fn put(&mut self, device: &wgpu::Device, view: &wgpu::TextureView) {
        let mut renderer = self.renderer.write();
        let filter = wgpu::FilterMode::Linear;
        match self.id {
            Some(id) => renderer.update_egui_texture_from_wgpu_texture(device, view, filter, id),
            None => self.id = Some(renderer.register_native_texture(device, view, filter)),
        }
    }

    pub(super) fn id(&self) -> Option<TextureId> {
        self.id
    }
}

impl Drop for EguiTexture {
    fn drop(&mut self) {
        if let Some(id) = self.id {
            self.renderer.write().free_texture(&id);
        }
    }
}
