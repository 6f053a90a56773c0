//! The passes on the GPU against their twins on the CPU, and the shader by itself.
//!
//! Tests that need a GPU are ignored unless FOLDMOTION_GPU_TESTS=yes is set when they are built; Mesa's software Vulkan
//! will do.

use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{Case, Unit, UnitSheet};
use glam::DVec3;
use wgpu::naga;

use super::control::{Control, NAMES, WORDS};
use super::device::{PASSES, SOURCE};
use super::state::{BINDINGS, GROUP};
use super::tables::Tables;
use super::{Gpu, GpuDrive, GpuState};
use crate::dynamic::{Device, DynamicOptions, Run, StageOutcome, State, run};
use crate::{Material, Model, Schedule, SolverError, Stage};

/// What f32 may leave of forces from bars of stiffness 40 a unit length: 20 units in the last place of it. Some 1e-5
/// was seen.
const FORCE_TOLERANCE: f64 = 1e-4;

fn module() -> naga::Module {
    naga::front::wgsl::parse_str(SOURCE).unwrap_or_else(|e| panic!("{}", e.emit_to_string(SOURCE)))
}

#[test]
fn the_shader_is_valid_and_has_every_pass() {
    let module = module();
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    validator.validate(&module).unwrap();
    let passes: Vec<&str> = module.entry_points.iter().map(|e| e.name.as_str()).collect();
    assert_eq!(passes, PASSES);
    let grouped = module.entry_points.iter().all(|e| e.workgroup_size == [GROUP, 1, 1]);
    assert!(grouped, "every pass has groups of {GROUP}");
}

#[test]
fn the_control_has_the_layout_of_the_shader() {
    let module = module();
    let (_, control) =
        module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some("Control")).unwrap();
    let naga::TypeInner::Struct { members, span } = &control.inner else {
        panic!("Control is a struct");
    };
    let names: Vec<&str> = members.iter().filter_map(|m| m.name.as_deref()).collect();
    assert_eq!(names, NAMES);
    let offsets: Vec<u32> = members.iter().map(|m| m.offset).collect();
    assert!(offsets.into_iter().eq((0..WORDS as u32).map(|i| 4 * i)));
    assert_eq!(*span as usize, 4 * WORDS);
}

#[test]
fn the_control_reads_back_as_written() {
    let words: [u32; WORDS] = std::array::from_fn(|i| (1.5 + i as f32).to_bits());
    assert_eq!(Control::from_words(&words).to_words(), words);
}

/// A bent and strained sheet with its targets and speeds, the same on the CPU and on the GPU.
struct Shaken {
    model: Model,
    positions: Vec<DVec3>,
    velocities: Vec<DVec3>,
    targets: Vec<f64>,
}

fn wave(count: usize, size: f64) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let phase = i as f64;
        DVec3::new((1.1 * phase).sin(), (1.7 * phase).cos(), (2.3 * phase).sin()) * size
    })
}

fn shaken(case: Case, rows: usize, columns: usize, face_angle_stiffness: f64) -> Shaken {
    let unit = match case {
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None),
        Case::T => Unit::new(case, 0.7, 1.0, None, None),
        _ => Unit::new(Case::E, 1.0, 1.0, None, None),
    };
    let units = UnitSheet::new(unit.unwrap(), rows, columns).unwrap();
    let material = Material { face_angle_stiffness, ..Material::default() };
    let model = Model::new(&units.sheet, &material).unwrap();
    let flat = model.to_model(&units.sheet.planar());
    let count = flat.len();
    Shaken {
        positions: flat.iter().zip(wave(count, 0.04)).map(|(&p, w)| p + w).collect(),
        velocities: wave(count, 0.1).collect(),
        targets: vec![0.4; model.hinges.len()],
        model,
    }
}

impl Shaken {
    fn on_cpu(&self) -> State<'_> {
        let mut state = State::at_rest(&self.model, &self.positions);
        state.set_targets(&self.targets);
        state.set_velocities(&self.velocities);
        state
    }

    fn on_gpu<'a>(&'a self, gpu: &'a Gpu) -> GpuState<'a> {
        let mut state = GpuState::at_rest(gpu, &self.model, &self.positions).unwrap();
        state.set_targets(&self.targets);
        state.set_velocities(&self.velocities);
        state
    }
}

fn largest_difference(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
}

/// The worst force, angle, velocity and place after `steps` steps, GPU against CPU.
fn errors(gpu: &Gpu, sheet: &Shaken, steps: usize) -> [f64; 4] {
    let (mut cpu, mut other) = (sheet.on_cpu(), sheet.on_gpu(gpu));
    let dt = 0.5 * cpu.stable_time_step();
    for _ in 0..steps {
        cpu.step(dt).unwrap();
    }
    other.step(steps, dt, 1.0, 0.0).unwrap();
    let angles = cpu.angles().into_iter().zip(other.angles().unwrap());
    [
        largest_difference(&cpu.forces(), &other.forces().unwrap()),
        angles.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
        largest_difference(&cpu.velocities(), &other.velocities().unwrap()),
        largest_difference(&cpu.positions(), &other.positions().unwrap()),
    ]
}

/// E of one group, T and SII of several, with and without face angles.
fn sheets() -> [Shaken; 4] {
    [
        shaken(Case::E, 2, 2, 0.0),
        shaken(Case::E, 30, 30, 0.2),
        shaken(Case::T, 9, 7, 0.0),
        shaken(Case::SII, 8, 6, 0.2),
    ]
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn one_step_agrees_with_the_cpu_to_what_f32_leaves() {
    let gpu = Gpu::new().unwrap();
    for sheet in sheets() {
        let [force, angle, speed, place] = errors(&gpu, &sheet, 1);
        let found = format!("{} nodes: {force} {angle} {speed} {place}", sheet.model.node_count());
        assert!(force < FORCE_TOLERANCE, "{found}");
        assert!(angle < 1e-5 && speed < 1e-4 && place < 1e-4, "{found}");
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_hundred_steps_stay_with_the_cpu() {
    let gpu = Gpu::new().unwrap();
    for sheet in sheets() {
        let [force, angle, speed, place] = errors(&gpu, &sheet, 100);
        let found = format!("{} nodes: {force} {angle} {speed} {place}", sheet.model.node_count());
        assert!(place < 1e-3 && angle < 1e-2 && speed < 1e-2 && force < 0.1, "{found}");
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_wrong_shader_is_noticed() {
    for (right, wrong) in [
        ("ab * dc - ca * db", "ab * dc - ca * dc"),
        ("0.33333334", "0.33433334"),
        ("length - constants.y", "length - 1.001 * constants.y"),
        ("select(pull, -pull, slot % 2u == 1u)", "pull"),
    ] {
        assert!(SOURCE.contains(right), "{right}");
        let gpu = Gpu::with_shader(&SOURCE.replace(right, wrong)).unwrap();
        let [force, angle, ..] = errors(&gpu, &shaken(Case::SII, 3, 2, 0.0), 1);
        assert!(force > FORCE_TOLERANCE || angle > 1e-5, "{wrong} passes: {force} {angle}");
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_relaxation_goes_to_the_equilibrium_of_the_cpu() {
    let gpu = Gpu::new().unwrap();
    let sheet = shaken(Case::E, 4, 3, 0.0);
    let mut state = sheet.on_gpu(&gpu);
    state.set_velocities(&vec![DVec3::ZERO; sheet.model.node_count()]);
    let mut cpu = sheet.on_cpu();
    let dt = 0.9 * cpu.stable_time_step();
    state.relax(3_000, dt, 0.02).unwrap();
    let residual = state.totals().unwrap().residual;
    assert!(residual < 1e-4, "{residual}");
    // The CPU finds no more to do there than f32 leaves.
    let mut polished = State::at_rest(&sheet.model, &state.positions().unwrap());
    polished.set_targets(&sheet.targets);
    polished.evaluate_forces();
    assert!(polished.residual() < 1e-3, "{}", polished.residual());
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn two_runs_give_the_same_bits() {
    let gpu = Gpu::new().unwrap();
    let sheet = shaken(Case::SII, 8, 6, 0.2);
    let run = || {
        let mut state = sheet.on_gpu(&gpu);
        state.relax(200, 0.05, 0.02).unwrap();
        (state.positions().unwrap(), state.totals().unwrap())
    };
    assert_eq!(run(), run());
}

/// Flat to compact, both stages, on `device`.
fn fold(device: Device) -> (Run, Vec<DVec3>) {
    let units = UnitSheet::new(Unit::new(Case::E, 1.0, 1.0, None, None).unwrap(), 3, 2).unwrap();
    let model = Model::new(&units.sheet, &Material::default()).unwrap();
    let flat = vec![0.0; units.sheet.edges.len()];
    let schedule = Schedule::uniform(&units.sheet, &flat, units.compact_angles()).unwrap();
    let options = DynamicOptions {
        stages: vec![Stage::Fold],
        frames: 24,
        device,
        ..DynamicOptions::default()
    };
    let run = run(&model, &schedule, &units.sheet.planar(), &options, &|_| true).unwrap();
    (run, units.compact())
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_run_on_the_gpu_ends_in_the_exact_compact_state_and_names_its_device() {
    let (on_gpu, compact) = fold(Device::Gpu);
    let (on_cpu, _) = fold(Device::Cpu);
    assert!(on_gpu.stages.iter().all(StageOutcome::is_converged));
    let last = &on_gpu.frames.last().unwrap().positions;
    let motion = RigidMotion::best_fit(last, &compact);
    let placed: Vec<DVec3> = last.iter().map(|&p| motion.apply(p)).collect();
    let error = largest_difference(&placed, &compact);
    assert!(error < 1e-6, "{error}");
    assert_eq!(on_cpu.device, "cpu");
    assert_eq!(on_gpu.device, Gpu::new().unwrap().name());
    // The frames that both record at the same times are the same states.
    for frame in &on_gpu.frames {
        let Some(twin) = on_cpu.frames.iter().find(|f| f.time == frame.time) else {
            continue;
        };
        let motion = RigidMotion::best_fit(&frame.positions, &twin.positions);
        let placed: Vec<DVec3> = frame.positions.iter().map(|&p| motion.apply(p)).collect();
        let error = largest_difference(&placed, &twin.positions);
        assert!(error < 0.01, "t = {}: {error}", frame.time);
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_small_sheet_is_left_to_the_processor_where_the_choice_is_free() {
    assert_eq!(fold(Device::Auto).0.device, "cpu");
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn a_node_that_runs_away_on_the_gpu_is_reported_as_on_the_cpu() {
    let gpu = Gpu::new().unwrap();
    let sheet = shaken(Case::E, 3, 2, 0.0);
    for (speed, is_wild) in [(0.1, false), (1e6, true), (f64::NAN, true)] {
        let mut cpu = sheet.on_cpu();
        let mut velocities = vec![DVec3::ZERO; sheet.model.node_count()];
        velocities[4] = DVec3::splat(speed);
        cpu.set_velocities(&velocities);
        let dt = 0.5 * cpu.stable_time_step();
        let mut drive = GpuDrive::new(&gpu, &sheet.model, &sheet.positions).unwrap();
        drive.load(&cpu);
        drive.step(&sheet.targets, dt).unwrap();
        let stored = drive.store(&mut sheet.on_cpu(), dt, 1.5);
        assert_eq!(cpu.step(dt).is_err(), is_wild, "{speed}");
        let is_reported = matches!(stored, Err(SolverError::Diverged { time, .. }) if time == 1.5);
        assert_eq!(is_reported, is_wild, "{speed}: {stored:?}");
    }
}

#[test]
fn every_pass_binds_what_it_uses_and_at_most_eight_storage_buffers() {
    let module = module();
    let flags = naga::valid::ValidationFlags::all();
    let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
    let info = validator.validate(&module).unwrap();
    for (index, bound) in BINDINGS.iter().enumerate() {
        let uses = info.get_entry_point(index);
        let globals = module.global_variables.iter();
        let used = globals.filter(|(handle, _)| !uses[*handle].is_empty());
        let used: Vec<_> = used
            .filter_map(|(_, global)| Some((global.binding.as_ref()?.binding, global.space)))
            .collect();
        let numbers: Vec<u32> = used.iter().map(|(number, _)| *number).collect();
        assert_eq!(&numbers, bound, "{}", PASSES[index]);
        let storage = |space| matches!(space, naga::AddressSpace::Storage { .. });
        let count = used.iter().filter(|(_, space)| storage(*space)).count();
        assert!(count <= 8, "{}: {count}", PASSES[index]);
    }
}

#[test]
#[cfg_attr(not(gpu_tests), ignore = "needs a GPU and FOLDMOTION_GPU_TESTS=yes")]
fn the_bytes_held_are_those_of_the_records() {
    let gpu = Gpu::new().unwrap();
    for sheet in sheets() {
        let tables = Tables::new(&sheet.model);
        let constant = size_of_val(&*tables.edge_vertices)
            + size_of_val(&*tables.edge_constants)
            + size_of_val(&*tables.edge_rest)
            + size_of_val(&*tables.face_records)
            + size_of_val(&*tables.face_rest)
            + size_of_val(&*tables.starts)
            + size_of_val(&*tables.slots);
        // Places, speeds, forces; loads, angles, targets; three forces.
        let moving = 3 * 16 * sheet.model.node_count()
            + (16 + 4 + 4) * sheet.model.bars.len()
            + 3 * 16 * sheet.model.faces.len();
        let held = sheet.on_gpu(&gpu).memory_bytes();
        assert_eq!(held, (constant + moving) as u64);
    }
}
