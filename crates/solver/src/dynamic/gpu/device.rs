//! The GPU and its pipelines.

use std::sync::{Arc, Mutex, PoisonError};

use crate::SolverError;

/// The source of the shader.
pub(super) const SOURCE: &str = include_str!("../../../../../shaders/solver.wgsl");

/// A GPU that can run the passes.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) pipelines: [wgpu::ComputePipeline; 4],
    name: String,
    is_software: bool,
    device_error: Arc<Mutex<Option<String>>>,
}

/// The passes in their order.
pub(super) const PASSES: [&str; 4] = ["edge_loads", "face_loads", "node_step", "sum_totals"];

impl Gpu {
    /// The GPU that is expected to be the fastest.
    ///
    /// # Errors
    /// [`SolverError::NoGpu`] if there is none, or its driver refuses.
    pub fn new() -> Result<Self, SolverError> {
        Self::with_shader(SOURCE)
    }

    /// With another source of the passes: for tests that must notice it.
    pub(super) fn with_shader(source: &str) -> Result<Self, SolverError> {
        pollster::block_on(Self::open(source)).map_err(|reason| SolverError::NoGpu { reason })
    }

    async fn open(source: &str) -> Result<Self, String> {
        let adapter = match adapter(wgpu::Backends::PRIMARY).await {
            Ok(adapter) => adapter,
            // OpenGL where there is nothing newer.
            Err(_reason) => adapter(wgpu::Backends::all()).await?,
        };
        let info = adapter.get_info();
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                required_limits: adapter.limits(),
                ..wgpu::DeviceDescriptor::default()
            })
            .await
            .map_err(|e| e.to_string())?;
        let device_error = Arc::new(Mutex::new(None));
        let seen = Arc::clone(&device_error);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let mut first = seen.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert_with(|| error.to_string());
        }));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("solver"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let pipelines = PASSES.map(|pass| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(pass),
                layout: None,
                module: &module,
                entry_point: Some(pass),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        let gpu = Self {
            device,
            queue,
            pipelines,
            name: format!("{} ({})", info.name, info.backend),
            is_software: info.device_type == wgpu::DeviceType::Cpu,
            device_error,
        };
        match gpu.device_error() {
            Some(reason) => Err(reason),
            None => Ok(gpu),
        }
    }

    /// The name of the adapter and of the interface to it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is a processor that plays a GPU.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// The first error the driver reported.
    fn device_error(&self) -> Option<String> {
        let device_error = self.device_error.lock().unwrap_or_else(PoisonError::into_inner);
        device_error.clone()
    }

    /// # Errors
    /// [`SolverError::GpuLost`] where the driver has reported an error.
    pub(super) fn check(&self) -> Result<(), SolverError> {
        match self.device_error() {
            Some(reason) => Err(self.lost(reason)),
            None => Ok(()),
        }
    }

    pub(super) fn lost(&self, reason: impl std::fmt::Display) -> SolverError {
        SolverError::GpuLost { gpu: self.name.clone(), reason: reason.to_string() }
    }
}

async fn adapter(backends: wgpu::Backends) -> Result<wgpu::Adapter, String> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let options = wgpu::RequestAdapterOptions {
        power_preference: wgpu::PowerPreference::HighPerformance,
        ..wgpu::RequestAdapterOptions::default()
    };
    let adapter = instance.request_adapter(&options).await;
    adapter.map_err(|e| e.to_string())
}
