//! The quasi-static engine with contact: the gap is kept, the compact state is reached but for it, jams are named.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

use foldmotion_geometry::{RigidMotion, segment_segment, triangle_triangle};
use foldmotion_pattern::{Case, Facing, Frame, Unit, UnitSheet};
use foldmotion_solver::quasi_static::{
    Contact, QuasiStaticOptions, QuasiStaticRun, run_quasi_static,
};
use foldmotion_solver::{Material, Model, Schedule, SolverError, Stage};
use glam::{DVec2, DVec3};

struct Scene {
    sheet: UnitSheet,
    deployed: Vec<DVec3>,
    model: Model,
    schedule: Schedule,
}

fn scene(unit: Unit, rows: usize, columns: usize, axial_stiffness: f64, turn: f64) -> Scene {
    let sheet = UnitSheet::new(unit, rows, columns).unwrap();
    let mut polygon = vec![DVec2::ZERO];
    for row in 0..rows {
        polygon.push(polygon[row] + DVec2::from_angle(-turn * row as f64));
    }
    let deployed = sheet.deployed(&polygon, Facing::Left).unwrap();
    let angles = sheet.deployed_angles(&polygon, Facing::Left).unwrap();
    let schedule = Schedule::uniform(&sheet.sheet, &angles, sheet.compact_angles()).unwrap();
    let material = Material { axial_stiffness, ..Material::default() };
    let model = Model::new(&sheet.sheet, &material).unwrap();
    Scene { sheet, deployed, model, schedule }
}

fn unit(case: Case) -> Unit {
    match case {
        Case::T => Unit::new(case, 0.7, 1.0, None, None),
        Case::S => Unit::new(case, 1.6, 1.0, None, None),
        Case::SII => Unit::new(case, 1.6, 1.0, Some(0.7), None),
        Case::Plain => Unit::new(case, 2.5, 1.0, None, None),
        Case::E => Unit::new(case, 1.0, 1.0, None, None),
    }
    .unwrap()
}

fn with_gap(gap: f64, frames: usize) -> QuasiStaticOptions {
    QuasiStaticOptions {
        frames,
        contact: Some(Contact::constant(gap)),
        ..QuasiStaticOptions::default()
    }
}

fn run(scene: &Scene, options: &QuasiStaticOptions) -> QuasiStaticRun {
    run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, options, &|_| true).unwrap()
}

/// The smallest distance of primitives that share no vertex, by trying all: every vertex and facet, every two edges.
fn smallest_distance(scene: &Scene, positions: &[DVec3]) -> f64 {
    let at = |v: u32| positions[v as usize];
    let sheet = &scene.sheet.sheet;
    let mut least = f64::INFINITY;
    for face in &sheet.faces {
        for v in (0..positions.len() as u32).filter(|v| !face.contains(v)) {
            let point = [at(v); 3];
            least = least.min(triangle_triangle(&point, &face.map(at)).distance);
        }
    }
    for (i, a) in sheet.edges.iter().enumerate() {
        for b in &sheet.edges[..i] {
            if a.vertices.iter().all(|v| !b.vertices.contains(v)) {
                least = least.min(segment_segment(a.vertices.map(at), b.vertices.map(at)).distance);
            }
        }
    }
    least
}

/// The extents after the rigid motion that fits best onto the exact compact state.
fn extents(scene: &Scene, frame: &Frame) -> DVec3 {
    let motion = RigidMotion::best_fit(&frame.positions, &scene.sheet.compact());
    let fitted: Vec<DVec3> = frame.positions.iter().map(|&p| motion.apply(p)).collect();
    let max = fitted.iter().copied().reduce(DVec3::max).unwrap();
    max - fitted.iter().copied().reduce(DVec3::min).unwrap()
}

#[test]
fn the_gap_is_kept_in_every_equilibrium_and_half_of_it_between() {
    let (gap, frames) = (1e-3, 60);
    for (case, stiffness) in
        [(Case::S, 20.0), (Case::E, 2_000.0), (Case::SII, 20_000.0), (Case::T, 20.0)]
    {
        let scene = scene(unit(case), 3, 1, stiffness, 0.4);
        let run = run(&scene, &with_gap(gap, frames));
        assert!(run.is_complete(), "{case:?}: {:?} {:?}", run.stages, run.jam);
        assert!(run.figures.last().unwrap().contacts > 0, "{case:?}: layers meet");
        for pair in run.frames.windows(2) {
            let own = smallest_distance(&scene, &pair[0].positions);
            // Frames at other times are states on the way to an equilibrium.
            let steps = pair[0].time * f64::from(frames as u32);
            let is_equilibrium = (steps - steps.round()).abs() < 1e-6;
            let kept = if is_equilibrium { 1.0 - 1e-9 } else { 0.5 };
            assert!(own >= gap * kept, "{case:?} t = {}: {own}", pair[0].time);
            for share in [0.25, 0.5, 0.75] {
                let ends = pair[0].positions.iter().zip(&pair[1].positions);
                let between: Vec<DVec3> = ends.map(|(a, b)| a.lerp(*b, share)).collect();
                let own = smallest_distance(&scene, &between);
                assert!(own >= 0.49 * gap, "{case:?} after t = {}: {own}", pair[0].time);
            }
        }
    }
}

#[test]
fn a_gap_of_any_size_that_the_facets_can_close_to_is_kept() {
    let scene = scene(unit(Case::E), 1, 1, 20.0, 0.0);
    for gap in [1e-6, 1e-4, 1e-2, 4e-2] {
        let run = run(&scene, &with_gap(gap, 24));
        let last = run.frames.last().unwrap();
        let least = smallest_distance(&scene, &last.positions);
        assert!(last.time == 2.0 && least > 0.99 * gap, "{gap}: {least}");
    }
}

#[test]
fn layers_close_to_the_final_gap_and_the_closed_form() {
    for (case, stiffness) in [(Case::E, 20.0), (Case::S, 20.0), (Case::SII, 20_000.0)] {
        let scene = scene(unit(case), 3, 2, stiffness, 0.4);
        let options = QuasiStaticOptions {
            contact: Some(Contact { gap: 1e-3, final_gap: 1e-5 }),
            ..with_gap(1e-3, 60)
        };
        let run = run(&scene, &options);
        assert!(run.is_complete(), "{case:?}: {:?}", run.jam);
        assert!((run.gap_reached.unwrap() - 1e-5).abs() < 1e-12, "{case:?}");
        let last = run.frames.last().unwrap();
        let least = smallest_distance(&scene, &last.positions);
        assert!(least > 0.9e-5 && least < 2e-5, "{case:?}: {least}");
        let exact = scene.sheet.compact();
        let exact = exact.iter().copied().reduce(DVec3::max).unwrap()
            - exact.iter().copied().reduce(DVec3::min).unwrap();
        let error = (extents(&scene, last) - exact).abs().max_element();
        assert!(error < 1e-3, "{case:?}: {error}");
    }
}

#[test]
fn a_final_gap_that_is_none_or_above_the_gap_is_refused() {
    let scene = scene(unit(Case::S), 1, 1, 20.0, 0.0);
    for final_gap in [0.0, -1.0, 2e-3, f64::NAN] {
        let contact = Some(Contact { gap: 1e-3, final_gap });
        let options = QuasiStaticOptions { contact, ..with_gap(1e-3, 4) };
        let result =
            run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, &options, &|_| true);
        assert!(matches!(result, Err(SolverError::FinalGap { .. })), "{final_gap}");
    }
}

#[test]
fn without_contact_the_same_layers_come_closer_than_the_gap() {
    let scene = scene(unit(Case::S), 3, 1, 20.0, 0.4);
    let free = QuasiStaticOptions { contact: None, ..with_gap(1e-3, 60) };
    let run = run(&scene, &free);
    let last = run.frames.last().unwrap();
    assert!(smallest_distance(&scene, &last.positions) < 1e-9);
}

#[test]
fn the_compact_extents_fall_linearly_with_the_gap_to_the_closed_form() {
    for case in [Case::S, Case::SII] {
        let scene = scene(unit(case), 3, 2, 20.0, 0.4);
        let [wide, middle, narrow] = [4e-3, 2e-3, 1e-3].map(|gap| {
            let run = run(&scene, &with_gap(gap, 60));
            extents(&scene, run.frames.last().unwrap())
        });
        let exact = scene.sheet.compact();
        let exact = exact.iter().copied().reduce(DVec3::max).unwrap()
            - exact.iter().copied().reduce(DVec3::min).unwrap();
        // The straight line through the two narrow gaps meets the closed form, and the wide one lies near it.
        let limit = narrow * 2.0 - middle;
        assert!((limit - exact).abs().max_element() < 1e-3, "{case:?}: {limit} {exact}");
        let line = middle * 2.0 - narrow * 1.0 + (middle - narrow);
        assert!((wide - line).abs().max_element() < 5e-3, "{case:?}: {wide} {line}");
        assert!((narrow - exact).y > 1e-3, "{case:?}: layers have thickness");
    }
}

#[test]
fn a_stiff_sheet_folds_up_with_strains_below_a_thousandth() {
    for case in [Case::E, Case::T, Case::S, Case::SII] {
        let scene = scene(unit(case), 3, 2, 40_000.0, 0.4);
        let run = run(&scene, &with_gap(1e-3, 120));
        assert!(run.is_complete(), "{case:?}: {:?} {:?}", run.stages, run.jam);
        let strains = run
            .frames
            .iter()
            .flat_map(|frame| scene.model.strains(&scene.model.to_model(&frame.positions)));
        let peak = strains.fold(0.0, |m: f64, s| m.max(s.abs()));
        assert!(peak < 1e-3, "{case:?}: {peak}");
    }
}

#[test]
fn a_short_plain_unit_stops_against_itself_and_says_so() {
    let scene = scene(unit(Case::Plain), 3, 2, 20.0, 0.4);
    let run_with = run(&scene, &with_gap(1e-3, 60));
    let jam = run_with.jam.as_ref().unwrap();
    assert!(!run_with.is_complete());
    assert!(jam.time > 1.0 && jam.time < 2.0, "{}", jam.time);
    assert!(jam.fold_angle_error > 0.1);
    assert!(!jam.blocking.is_empty() && jam.blocking.is_sorted_by(|a, b| a.1 >= b.1));
    for (faces, force) in &jam.blocking {
        assert!(
            faces.iter().all(|&f| (f as usize) < scene.sheet.sheet.faces.len()) && *force > 0.0
        );
    }
    let free = QuasiStaticOptions { contact: None, ..with_gap(1e-3, 60) };
    let through = run(&scene, &free);
    assert!(through.is_complete());
    assert!(through.figures.last().unwrap().fold_angle_error < 1e-9);
}

#[test]
fn the_seam_of_a_closed_profile_is_admitted_and_opens() {
    let turn = std::f64::consts::TAU / 8.0;
    let scene = scene(unit(Case::E), 8, 1, 20.0, turn);
    let options = QuasiStaticOptions { stages: vec![Stage::Unfold], ..with_gap(1e-3, 40) };
    let run = run(&scene, &options);
    assert!(run.is_complete(), "{:?}", run.stages);
    assert!(smallest_distance(&scene, &run.frames[0].positions) < 1e-9);
    let planar = run.frames.last().unwrap();
    assert!(smallest_distance(&scene, &planar.positions) > 1e-2);
}

#[test]
fn a_start_that_crosses_itself_is_refused_with_the_pair() {
    // Four rows that turn by 108° each: the last crosses the first.
    let scene = scene(unit(Case::E), 5, 1, 20.0, 144.0_f64.to_radians());
    let go = |options: &QuasiStaticOptions| {
        run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, options, &|_| false)
    };
    let error = go(&with_gap(1e-3, 4)).unwrap_err();
    let SolverError::StartCrosses { faces } = error else {
        panic!("{error}");
    };
    let rows = faces.map(|f| {
        let sheet = &scene.sheet.sheet;
        sheet.facets[sheet.face_facets[f as usize] as usize].row
    });
    assert!(rows[0].abs_diff(rows[1]) >= 2, "{rows:?}");
}

#[test]
fn a_gap_the_facets_cannot_close_to_is_refused() {
    let scene = scene(unit(Case::S), 1, 1, 20.0, 0.0);
    for gap in [0.5, 0.0, -1.0, f64::NAN] {
        let options = with_gap(gap, 4);
        let result =
            run_quasi_static(&scene.model, &scene.schedule, &scene.deployed, &options, &|_| true);
        assert!(matches!(result, Err(SolverError::GapTooLarge { .. })), "{gap}");
    }
}

#[test]
fn contact_gives_bitwise_the_same_result_on_any_number_of_threads() {
    let scene = scene(unit(Case::S), 3, 1, 20.0, 0.4);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&scene, &with_gap(1e-3, 40)))
    };
    assert_eq!(on(1), on(3));
}
