//! The moving sheet: momentum, energy, oscillators, the bound on the time step.

use std::f64::consts::{PI, TAU};

use crate::sheets::{folded_hinge, hinge, shaken, units};
use foldmotion_pattern::{Assignment, Case};
use foldmotion_solver::dynamic::State;
use foldmotion_solver::{Material, Model};
use glam::DVec3;

fn undamped() -> Material {
    Material { face_angle_stiffness: 0.2, damping_ratio: 0.0, ..Material::default() }
}

fn momentum(state: &State<'_>) -> DVec3 {
    state.velocities().iter().sum()
}

fn angular_momentum(state: &State<'_>) -> DVec3 {
    state.positions().iter().zip(&state.velocities()).map(|(x, v)| x.cross(*v)).sum()
}

fn shaken_state(model: &Model, case: Case) -> State<'_> {
    let mut state = State::at_rest(model, &shaken(&units(case, 2, 2).sheet.planar(), 0.1));
    state.set_targets(&vec![0.2; model.hinges.len()]);
    let speeds = shaken(&vec![DVec3::ZERO; model.node_count()], 0.1);
    state.set_velocities(&speeds);
    state
}

#[test]
fn linear_momentum_is_conserved_with_damping() {
    let model = Model::new(&units(Case::SII, 2, 2).sheet, &Material::default()).unwrap();
    let mut state = shaken_state(&model, Case::SII);
    let before = momentum(&state);
    let dt = 0.9 * state.stable_time_step();
    for _ in 0..2_000 {
        state.step(dt).unwrap();
    }
    assert!(momentum(&state).distance(before) < 1e-12, "{before} {}", momentum(&state));
}

#[test]
fn angular_momentum_is_conserved_without_damping_and_lost_with_it() {
    let mut drift = [0.0; 2];
    for (drift, damping_ratio) in drift.iter_mut().zip([0.0, 0.45]) {
        let material = Material { damping_ratio, ..undamped() };
        let model = Model::new(&units(Case::S, 2, 2).sheet, &material).unwrap();
        let mut state = shaken_state(&model, Case::S);
        let before = angular_momentum(&state);
        let dt = 0.5 * state.stable_time_step();
        for _ in 0..2_000 {
            state.step(dt).unwrap();
        }
        *drift = angular_momentum(&state).distance(before) / before.length();
    }
    // The dampers act on whole relative velocities, as Origami Simulator's do, and resist rotation.
    assert!(drift[0] < 1e-11 && drift[1] > 0.1, "{drift:?}");
}

/// The largest deviation of the total energy from its start in 40 units of time at steps of `dt`, over that energy.
fn energy_drift(model: &Model, dt: f64) -> f64 {
    let mut state = shaken_state(model, Case::E);
    let mut start = None;
    let mut worst = 0.0f64;
    let mut time = 0.0;
    while time < 40.0 {
        time += dt;
        state.evaluate_forces();
        let elastic = model.energy_by_kind(&state.positions(), &state.angles(), &state.targets());
        let energy = elastic.total() + state.kinetic_energy();
        worst = worst.max((energy / *start.get_or_insert(energy) - 1.0).abs());
        state.step(dt).unwrap();
    }
    worst
}

#[test]
fn energy_swings_by_a_share_of_the_first_order_in_the_step_and_does_not_drift() {
    let model = Model::new(&units(Case::E, 2, 2).sheet, &undamped()).unwrap();
    let drifts = [0.02, 0.01, 0.005].map(|dt| energy_drift(&model, dt));
    for pair in drifts.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 1.0).abs() < 0.15, "order {order}, {drifts:?}");
    }
    assert!(drifts[2] < 0.05, "{drifts:?}");
}

/// A lone bar: the first edge of a hinge whose other bars and hinge hardly count.
fn oscillation(damping_ratio: f64, dt: f64) -> (f64, f64) {
    let tiny = Material::MIN_STIFFNESS;
    let material = Material {
        axial_stiffness: 20.0,
        fold_stiffness: tiny,
        facet_stiffness: tiny,
        damping_ratio,
        ..Material::default()
    };
    let mut model = Model::new(&hinge(Assignment::Valley, 1.0, 1.0, 1.0), &material).unwrap();
    for bar in &mut model.bars[1..] {
        bar.stiffness = 0.0;
    }
    let mut positions = hinge(Assignment::Valley, 1.0, 1.0, 1.0).planar();
    positions[1].x += 1e-3;
    let mut state = State::at_rest(&model, &positions);
    // Times and sizes of the maxima of the elongation, between steps by the parabola through three.
    let elongation = |state: &State<'_>| model.bars[0].length(&state.positions()) - 1.0;
    let mut past = [elongation(&state); 2];
    let mut maxima = Vec::new();
    let mut time = 0.0;
    while time < 8.0 {
        state.step(dt).unwrap();
        time += dt;
        let [a, b, c] = [past[0], past[1], elongation(&state)];
        if b > a && b >= c {
            let shift = 0.5 * (a - c) / (a - 2.0 * b + c);
            maxima.push((time + shift * dt, b - 0.25 * (a - c) * shift));
        }
        past = [b, c];
    }
    let (first, last) = (maxima[0], maxima[maxima.len() - 1]);
    let periods = (maxima.len() - 1) as f64;
    let period = (last.0 - first.0) / periods;
    (TAU / period, (first.1 / last.1).ln() / periods)
}

#[test]
fn a_single_bar_swings_at_its_frequency_and_decays_at_its_damping_ratio() {
    let omega = (2.0f64 * 20.0).sqrt();
    let (free, decrement) = oscillation(0.0, 1e-4);
    assert!((free / omega - 1.0).abs() < 1e-5, "{free} {omega}");
    assert!(decrement.abs() < 1e-3, "{decrement}");
    // d = 2 ζ √k on the relative velocity of two unit masses: ratio of the mode ζ' = 2 d / (2 ω) = √2 ζ.
    let ratio = 0.05 * 2.0f64.sqrt();
    let (damped, decrement) = oscillation(0.05, 1e-4);
    let expected = TAU * ratio / (1.0 - ratio * ratio).sqrt();
    assert!((decrement / expected - 1.0).abs() < 2e-3, "{decrement} {expected}");
    assert!((damped / (omega * (1.0 - ratio * ratio).sqrt()) - 1.0).abs() < 1e-4, "{damped}");
}

#[test]
fn a_single_hinge_settles_at_its_target_even_beyond_half_a_turn() {
    let sheet = hinge(Assignment::Valley, 1.0, 0.9, 0.7);
    let model = Model::new(&sheet, &Material::default()).unwrap();
    for target in [1.0, -2.0, PI, 1.1 * PI, -1.2 * PI] {
        let mut state = State::at_rest(&model, &sheet.planar());
        let dt = 0.9 * state.stable_time_step();
        let ramp = 400;
        for step in 1..=8_000 {
            state.set_targets(&[target * (f64::from(step) / f64::from(ramp)).min(1.0)]);
            state.step(dt).unwrap();
        }
        let worst = model.strains(&state.positions()).into_iter().map(f64::abs).fold(0.0, f64::max);
        assert!((state.angles()[0] - target).abs() < 1e-6, "{} {target}", state.angles()[0]);
        assert!(worst < 1e-6, "{worst}");
        let exact = folded_hinge(&sheet, target);
        let apart = |p: &[DVec3]| p[2].distance(p[3]);
        assert!((apart(&state.positions()) - apart(&exact)).abs() < 1e-6);
    }
}

/// How much a small disturbance of the flat sheet grows in 3 000 steps of `share` of the bound.
fn growth(material: &Material, share: f64) -> f64 {
    let sheet = units(Case::T, 2, 2).sheet;
    let model = Model::new(&sheet, material).unwrap();
    let start = model.to_model(&sheet.planar());
    let mut state = State::at_rest(&model, &shaken(&start, 1e-7));
    state.set_targets(&vec![0.0; model.hinges.len()]);
    state.evaluate_forces();
    let dt = share * state.stable_time_step();
    for _ in 0..3_000 {
        if state.step(dt).is_err() {
            return f64::INFINITY;
        }
    }
    let positions = state.positions();
    let moved = positions.iter().zip(&start).map(|(p, q)| p.distance(*q));
    moved.fold(0.0, f64::max) / 1e-7
}

#[test]
fn the_time_step_is_stable_at_its_bound_and_unstable_at_a_multiple_of_it() {
    let bars = Material { damping_ratio: 0.0, ..Material::default() };
    let hinges =
        Material { axial_stiffness: 1e-3, fold_stiffness: 50.0, facet_stiffness: 50.0, ..bars };
    let dampers = Material { damping_ratio: 5.0, ..bars };
    let faces = Material { axial_stiffness: 1e-2, face_angle_stiffness: 50.0, ..bars };
    let kinds = [("bars", bars), ("hinges", hinges), ("dampers", dampers), ("face angles", faces)];
    for (name, material) in kinds {
        let at_the_bound = growth(&material, 1.0);
        assert!(at_the_bound < 1e3, "{name}: grew {at_the_bound} times at the bound");
        let beyond = growth(&material, 2.0);
        assert!(beyond > 1e5, "{name}: grew only {beyond} times at twice the bound");
    }
}

#[test]
fn the_bound_of_one_bar_is_that_of_a_damped_oscillator() {
    for ratio in [0.0f64, 0.3, 2.0] {
        let tiny = Material::MIN_STIFFNESS;
        let material = Material {
            fold_stiffness: tiny,
            facet_stiffness: tiny,
            damping_ratio: ratio,
            ..Material::default()
        };
        let sheet = hinge(Assignment::Valley, 1.0, 1.0, 1.0);
        let mut model = Model::new(&sheet, &material).unwrap();
        for bar in &mut model.bars[1..] {
            bar.stiffness = 0.0;
        }
        let mut state = State::at_rest(&model, &sheet.planar());
        let omega = (2.0f64 * 20.0).sqrt();
        let mode = 2.0f64.sqrt() * ratio;
        let expected = 2.0 * ((1.0 + mode * mode).sqrt() - mode) / omega;
        let found = state.stable_time_step();
        assert!((found / expected - 1.0).abs() < 1e-6, "ζ = {ratio}: {found} {expected}");
    }
}

/// The largest distance of the forces of the passes from the negative gradient of the energy.
fn force_error(material: &Material, rows: usize, columns: usize) -> f64 {
    let units = units(Case::SII, rows, columns);
    let model = Model::new(&units.sheet, material).unwrap();
    let positions = shaken(&model.to_model(&units.sheet.planar()), 0.1);
    let mut state = State::at_rest(&model, &positions);
    let targets = state.angles().iter().map(|a| 0.5 * a + 0.3).collect::<Vec<_>>();
    state.set_targets(&targets);
    state.evaluate_forces();
    let mut angles = vec![0.0; model.hinges.len()];
    model.follow_angles(&positions, &mut angles);
    let mut gradient = vec![DVec3::ZERO; model.node_count()];
    model.gradient(&positions, &angles, &targets, &mut gradient);
    let forces = state.forces();
    let sums = forces.iter().zip(&gradient).map(|(f, g)| (*f + *g).length());
    sums.fold(0.0, f64::max)
}

#[test]
fn the_passes_give_the_negative_gradient_of_the_energy() {
    for face_angle_stiffness in [0.0, 0.2] {
        let material = Material { face_angle_stiffness, ..Material::default() };
        // One block, and several with their borders.
        for (rows, columns) in [(1, 1), (3, 2), (20, 20)] {
            let error = force_error(&material, rows, columns);
            assert!(error < 1e-11, "{rows} x {columns}: {error}");
        }
    }
}
