//! The moving sheet on a GPU.

use glam::DVec3;

use super::control::{Control, WORDS};
use super::device::{Gpu, PASSES};
use super::tables::Tables;
use crate::{Model, SolverError};

/// Invocations of a group, as the shader has them.
pub(super) const GROUP: u32 = 128;

/// The numbers of the bindings each pass uses; a test compares them with the shader.
pub(super) const BINDINGS: [&[u32]; 4] = [
    &[0, 1, 2, 3, 4, 5, 6, 7, 8],
    &[0, 4, 8, 9, 10, 11],
    &[0, 4, 5, 8, 11, 12, 13, 14, 16],
    &[15, 16],
];

/// The most steps submitted at once, so that a driver's watchdog sees progress.
const STEPS_A_SUBMISSION: usize = 64;

/// Sums over the nodes at the last step, as the CPU's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GpuTotals {
    /// The largest force on a node over the fold stiffness.
    pub residual: f64,
    /// Σ v·(F before − F now).
    pub work: f64,
    /// Σ m |v|², before the step.
    pub path: f64,
    /// The largest |v| after the step.
    pub largest_speed: f64,
    /// Δt and c of the next step.
    pub pace: [f64; 2],
}

/// Positions and velocities of a sheet on a GPU. Lengths in unit lengths.
#[derive(Debug)]
pub struct GpuState<'a> {
    gpu: &'a Gpu,
    model: &'a Model,
    tables: Tables,
    control: Control,
    buffers: Buffers,
    groups: [wgpu::BindGroup; 4],
}

#[derive(Debug)]
struct Buffers {
    control: wgpu::Buffer,
    displacements: wgpu::Buffer,
    velocities: wgpu::Buffer,
    angles: wgpu::Buffer,
    targets: wgpu::Buffer,
    loads: wgpu::Buffer,
    corner_forces: wgpu::Buffer,
    forces_and_masses: wgpu::Buffer,
}

impl<'a> GpuState<'a> {
    /// The sheet of `model` at rest at `positions` (unit lengths), with every target at the angle it has there.
    ///
    /// Precondition: one position a node.
    ///
    /// # Errors
    /// [`SolverError::GpuTooSmall`], [`SolverError::GpuLost`].
    pub fn at_rest(
        gpu: &'a Gpu,
        model: &'a Model,
        positions: &[DVec3],
    ) -> Result<Self, SolverError> {
        let tables = Tables::new(model);
        let mut angles = vec![0.0; model.hinges.len()];
        model.follow_angles(positions, &mut angles);
        let angles = tables.by_edge(&angles);
        let nodes = model.node_count();
        let count = |records: usize| (records as u32).div_ceil(GROUP);
        let control = Control {
            face_angle_stiffness: model.material.face_angle_stiffness as f32,
            nodes: nodes as u32,
            edges: tables.edge_vertices.len() as u32,
            faces: tables.face_records.len() as u32,
            groups: count(nodes),
            age: -1.0,
            damping: 1.0,
            ..Control::default()
        };
        let none = wgpu::BufferUsages::empty();
        let zeros = |records: usize| vec![[0.0f32; 4]; records];
        let masses = vec![[0.0f32, 0.0, 0.0, 1.0]; nodes];
        let buffers = Buffers {
            control: gpu.buffer("control", &control.to_words(), wgpu::BufferUsages::UNIFORM)?,
            displacements: gpu.buffer("displacements", &displacements(model, positions), none)?,
            velocities: gpu.buffer("velocities", &zeros(nodes), none)?,
            angles: gpu.buffer("angles", &angles, none)?,
            targets: gpu.buffer("targets", &angles, none)?,
            loads: gpu.buffer("loads of edges", &zeros(angles.len()), none)?,
            corner_forces: gpu.buffer("forces on corners", &zeros(3 * model.faces.len()), none)?,
            forces_and_masses: gpu.buffer("forces and masses", &masses, none)?,
        };
        let constants = [
            (1, gpu.buffer("edges", &tables.edge_vertices, none)?),
            (2, gpu.buffer("constants of edges", &tables.edge_constants, none)?),
            (3, gpu.buffer("edges at rest", tables.edge_rest.as_flattened(), none)?),
            (9, gpu.buffer("triangles", tables.face_records.as_flattened(), none)?),
            (10, gpu.buffer("triangles at rest", tables.face_rest.as_flattened(), none)?),
            (12, gpu.buffer("starts", &tables.starts, none)?),
            (13, gpu.buffer("slots", &tables.slots, none)?),
            (16, gpu.buffer("partial sums", &zeros(2 * count(nodes) as usize), none)?),
        ];
        let groups = bind(gpu, &buffers, &constants);
        gpu.check()?;
        Ok(Self { gpu, model, tables, control, buffers, groups })
    }

    /// `count` steps of length `dt` with the fraction `damping` of the bars' dampers and a viscous force −c m v.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn step(
        &mut self,
        count: usize,
        dt: f64,
        damping: f64,
        viscosity: f64,
    ) -> Result<(), SolverError> {
        self.control.dt = dt as f32;
        self.control.damping = damping as f32;
        self.control.viscosity = viscosity as f32;
        self.control.age = -1.0;
        self.run(count)
    }

    /// Begins a dynamic relaxation with `count` steps: no dampers, the viscosity critical for the mode that moves, no
    /// node further than `longest_way` in a step of at most `dt`.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn relax(&mut self, count: usize, dt: f64, longest_way: f64) -> Result<(), SolverError> {
        self.control.dt = dt as f32;
        self.control.longest_dt = dt as f32;
        self.control.longest_way = longest_way as f32;
        self.control.damping = 0.0;
        self.control.viscosity = 0.0;
        self.control.age = 0.0;
        self.run(count)
    }

    /// Nodes, edges and triangles.
    pub(super) fn counts(&self) -> [u64; 3] {
        [self.control.nodes, self.control.edges, self.control.faces].map(u64::from)
    }

    pub(super) fn has_face_angles(&self) -> bool {
        self.control.face_angle_stiffness > 0.0
    }

    fn run(&self, count: usize) -> Result<(), SolverError> {
        self.write(&self.buffers.control, &self.control.to_words());
        self.go_on(count)
    }

    /// `count` more steps like the last ones.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn go_on(&self, count: usize) -> Result<(), SolverError> {
        let mut left = count;
        while left > 0 {
            let steps = left.min(STEPS_A_SUBMISSION);
            let mut encoder =
                self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
                for _step in 0..steps {
                    for (index, groups) in self.dispatches().into_iter().enumerate() {
                        pass.set_pipeline(&self.gpu.pipelines[index]);
                        pass.set_bind_group(0, &self.groups[index], &[]);
                        pass.dispatch_workgroups(groups, 1, 1);
                    }
                }
            }
            self.gpu.queue.submit([encoder.finish()]);
            left -= steps;
        }
        self.gpu.check()
    }

    /// Groups of each pass.
    fn dispatches(&self) -> [u32; PASSES.len()] {
        let Control { nodes, edges, faces, .. } = self.control;
        [edges.div_ceil(GROUP), faces.div_ceil(GROUP), nodes.div_ceil(GROUP), 1]
    }

    fn write<T: bytemuck::NoUninit>(&self, buffer: &wgpu::Buffer, records: &[T]) {
        self.gpu.queue.write_buffer(buffer, 0, bytemuck::cast_slice(records));
    }

    /// Sets the target of every hinge, radians.
    pub fn set_targets(&mut self, targets: &[f64]) {
        self.write(&self.buffers.targets, &self.tables.by_edge(targets));
    }

    /// Sets the followed fold angle of every hinge, radians: the next ones are those nearest to them.
    pub fn set_angles(&mut self, angles: &[f64]) {
        self.write(&self.buffers.angles, &self.tables.by_edge(angles));
    }

    /// Sets the positions, one a node, in unit lengths.
    pub fn set_positions(&mut self, positions: &[DVec3]) {
        self.write(&self.buffers.displacements, &displacements(self.model, positions));
    }

    /// Sets the velocities, one a node.
    pub fn set_velocities(&mut self, velocities: &[DVec3]) {
        let quad = |&node: &u32| {
            let [x, y, z] = velocities[node as usize].as_vec3().to_array();
            [x, y, z, 0.0]
        };
        let quads: Vec<[f32; 4]> = self.model.locality.iter().map(quad).collect();
        self.write(&self.buffers.velocities, &quads);
    }

    /// Sets the mass of every node.
    pub fn set_masses(&mut self, masses: &[f64]) {
        let quad = |&node: &u32| [0.0, 0.0, 0.0, masses[node as usize] as f32];
        let quads: Vec<[f32; 4]> = self.model.locality.iter().map(quad).collect();
        self.write(&self.buffers.forces_and_masses, &quads);
    }

    /// The sums of the last step.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn totals(&self) -> Result<GpuTotals, SolverError> {
        let words: Vec<u32> = self.gpu.read(&self.buffers.control)?;
        let words: [u32; WORDS] =
            words.try_into().map_err(|_words| self.gpu.lost("its control has another size"))?;
        let control = Control::from_words(&words);
        Ok(GpuTotals {
            residual: f64::from(control.squared_force).sqrt() / self.model.material.fold_stiffness,
            work: f64::from(control.work),
            path: f64::from(control.path),
            largest_speed: f64::from(control.largest_squared_speed).sqrt(),
            pace: [control.dt, control.viscosity].map(f64::from),
        })
    }

    /// Positions in the order of the model.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn positions(&self) -> Result<Vec<DVec3>, SolverError> {
        let moved = self.by_node(&self.buffers.displacements)?;
        let flat = self.model.pattern.iter();
        Ok(flat.zip(moved).map(|(&p, d)| p.extend(0.0) + d).collect())
    }

    /// Velocities in the order of the model.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn velocities(&self) -> Result<Vec<DVec3>, SolverError> {
        self.by_node(&self.buffers.velocities)
    }

    /// The force on every node at the last step.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn forces(&self) -> Result<Vec<DVec3>, SolverError> {
        self.by_node(&self.buffers.forces_and_masses)
    }

    /// The followed fold angle of every hinge at the last step, radians.
    ///
    /// # Errors
    /// [`SolverError::GpuLost`].
    pub fn angles(&self) -> Result<Vec<f64>, SolverError> {
        let angles: Vec<f32> = self.gpu.read(&self.buffers.angles)?;
        let mut by_hinge = vec![0.0; self.model.hinges.len()];
        for (angle, hinge) in angles.into_iter().zip(&self.tables.hinges) {
            if let Some(hinge) = hinge {
                by_hinge[*hinge as usize] = f64::from(angle);
            }
        }
        Ok(by_hinge)
    }

    fn by_node(&self, buffer: &wgpu::Buffer) -> Result<Vec<DVec3>, SolverError> {
        let quads: Vec<[f32; 4]> = self.gpu.read(buffer)?;
        let mut vectors = vec![DVec3::ZERO; quads.len()];
        for (&node, [x, y, z, _]) in self.model.locality.iter().zip(quads) {
            vectors[node as usize] = DVec3::new(f64::from(x), f64::from(y), f64::from(z));
        }
        Ok(vectors)
    }
}

impl Tables {
    /// One number an edge, from one a hinge.
    fn by_edge(&self, numbers: &[f64]) -> Vec<f32> {
        let number =
            |hinge: &Option<u32>| hinge.map_or(0.0, |hinge| numbers[hinge as usize] as f32);
        self.hinges.iter().map(number).collect()
    }
}

fn displacements(model: &Model, positions: &[DVec3]) -> Vec<[f32; 4]> {
    let quad = |&node: &u32| {
        let moved = positions[node as usize] - model.pattern[node as usize].extend(0.0);
        let [x, y, z] = moved.as_vec3().to_array();
        [x, y, z, 0.0]
    };
    model.locality.iter().map(quad).collect()
}

/// The buffers of each pass, by the numbers of the shader's bindings.
fn bind(gpu: &Gpu, buffers: &Buffers, constants: &[(u32, wgpu::Buffer)]) -> [wgpu::BindGroup; 4] {
    let moving = [
        (0, &buffers.control),
        (4, &buffers.displacements),
        (5, &buffers.velocities),
        (6, &buffers.angles),
        (7, &buffers.targets),
        (8, &buffers.loads),
        (11, &buffers.corner_forces),
        (14, &buffers.forces_and_masses),
        (15, &buffers.control),
    ];
    let all: Vec<(u32, &wgpu::Buffer)> = moving
        .into_iter()
        .chain(constants.iter().map(|(number, buffer)| (*number, buffer)))
        .collect();
    std::array::from_fn(|pass| {
        let entries: Vec<wgpu::BindGroupEntry<'_>> = all
            .iter()
            .filter(|(number, _)| BINDINGS[pass].contains(number))
            .map(|&(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(PASSES[pass]),
            layout: &gpu.pipelines[pass].get_bind_group_layout(0),
            entries: &entries,
        })
    })
}
