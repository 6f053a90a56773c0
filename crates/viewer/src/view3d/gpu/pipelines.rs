//! The shader and its pipelines.

use eframe::egui_wgpu::wgpu;

pub(in super::super) const SOURCE: &str = include_str!("../../../../../shaders/sheet.wgsl");

pub(super) const SAMPLES: u32 = 4;

/// The format of the depth buffer.
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Attributes of the vertex buffers, which have one record per instance.
pub(in super::super) const CORNERS: [wgpu::VertexAttribute; 1] =
    wgpu::vertex_attr_array![0 => Uint32x3];
pub(in super::super) const PAINTS: [wgpu::VertexAttribute; 1] =
    wgpu::vertex_attr_array![1 => Uint32];
pub(in super::super) const CREASES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Uint32x2, 1 => Uint32x2, 2 => Uint32x2, 3 => Uint32];
pub(in super::super) const SEGMENTS: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4, 3 => Float32x2];

#[derive(Debug)]
pub(super) struct Pipelines {
    pub(super) bindings: wgpu::BindGroupLayout,
    pub(super) faces: wgpu::RenderPipeline,
    pub(super) creases: wgpu::RenderPipeline,
    pub(super) overlays: wgpu::RenderPipeline,
    /// Overlays where the sheet hides them.
    pub(super) hidden: wgpu::RenderPipeline,
}

/// What a pipeline draws and how it uses the depth buffer.
struct Pass<'a> {
    vertex: &'a str,
    fragment: &'a str,
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    compare: wgpu::CompareFunction,
    /// Triangles write depth and cover what is behind them; lines do neither.
    is_solid: bool,
}

impl Pipelines {
    /// Pipelines for pictures of `format`.
    pub(super) fn new(device: &wgpu::Device, format: wgpu::TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("sheet"),
            source: wgpu::ShaderSource::Wgsl(SOURCE.into()),
        });
        let bindings = bindings(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("sheet"),
            bind_group_layouts: &[Some(&bindings)],
            immediate_size: 0,
        });
        let pipeline = |pass: &Pass<'_>| pipeline(device, &module, &layout, format, pass);
        let segments = [Some(buffer(&SEGMENTS))];
        let line = Pass {
            vertex: "overlay_vertex",
            fragment: "line_fragment",
            buffers: &segments,
            compare: wgpu::CompareFunction::GreaterEqual,
            is_solid: false,
        };
        Self {
            faces: pipeline(&Pass {
                vertex: "face_vertex",
                fragment: "face_fragment",
                buffers: &[Some(buffer(&CORNERS)), Some(buffer(&PAINTS))],
                // Of two triangles at the same depth the first is in front, as in films.
                compare: wgpu::CompareFunction::Greater,
                is_solid: true,
            }),
            creases: pipeline(&Pass {
                vertex: "crease_vertex",
                buffers: &[Some(buffer(&CREASES))],
                ..line
            }),
            overlays: pipeline(&line),
            hidden: pipeline(&Pass {
                vertex: "hidden_vertex",
                compare: wgpu::CompareFunction::Less,
                ..line
            }),
            bindings,
        }
    }
}

fn buffer(attributes: &[wgpu::VertexAttribute]) -> wgpu::VertexBufferLayout<'_> {
    wgpu::VertexBufferLayout {
        array_stride: attributes.iter().map(|a| a.format.size()).sum(),
        step_mode: wgpu::VertexStepMode::Instance,
        attributes,
    }
}

fn bindings(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty,
        count: None,
    };
    let table = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let numbers = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("sheet"),
        entries: &[entry(0, numbers), entry(1, table), entry(2, table)],
    })
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    format: wgpu::TextureFormat,
    pass: &Pass<'_>,
) -> wgpu::RenderPipeline {
    let blend = (!pass.is_solid).then_some(wgpu::BlendState::ALPHA_BLENDING);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.vertex),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(pass.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: pass.buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(pass.is_solid),
            depth_compare: Some(pass.compare),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: SAMPLES, ..wgpu::MultisampleState::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(pass.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend,
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
