//! A symmetric sheet on a symmetric profile moves symmetrically, as far as that is stable.

use std::path::Path;

use foldmotion_pattern::{FacetModel, Frame, Sheet};
use glam::{DVec2, DVec3};

use crate::report::Mirror;
use crate::{SceneSource, Study};

/// Frames of the test motions.
const FRAMES: usize = 120;
/// Distances of mirrored vertices agree to this share of h.
const SYMMETRIC: f64 = 1e-9;

const E: &str = "case = \"E\"";
const T: &str = "case = \"T\"";
const S: &str = "case = \"S\"";
const SII: &str = "case = \"SII\"\nlambda = 0.7";

/// The shelter, which is its own mirror image along and across its profile.
fn folded(sheet: &str, material: &str, motion: &str) -> (Study, Vec<Frame>) {
    let model = if material.contains("facet_model") { "" } else { "facet_model = \"symmetric\"\n" };
    let scene = format!(
        "[profile]\nmodel = \"shelter\"\n[sheet]\n{sheet}\n[material]\n{model}{material}\n[motion]\nframes = {FRAMES}\n{motion}\n"
    );
    let study = Study::resolve(&SceneSource::new(Path::new("a.toml"), scene)).unwrap();
    let frames = study.fold(&[], foldmotion_solver::Budget::Standard, &|_| true).unwrap().frames;
    (study, frames)
}

/// The mirror images of every vertex, across the width and along the rows.
fn mirrors(sheet: &Sheet) -> [Vec<usize>; 2] {
    let low = sheet.vertices.iter().copied().reduce(DVec2::min).unwrap();
    let high = sheet.vertices.iter().copied().reduce(DVec2::max).unwrap();
    let at = |image: DVec2| {
        let near = |v: &DVec2| v.distance(image) < 1e-7 * sheet.unit_length;
        sheet.vertices.iter().position(near).unwrap()
    };
    let across = |v: &DVec2| at(DVec2::new(v.x, low.y + high.y - v.y));
    let along = |v: &DVec2| at(DVec2::new(low.x + high.x - v.x, v.y));
    [sheet.vertices.iter().map(across).collect(), sheet.vertices.iter().map(along).collect()]
}

/// By how much the distance of two vertices differs from that of their mirror images at most.
fn asymmetry(positions: &[DVec3], mirror: &[usize]) -> f64 {
    let mut worst: f64 = 0.0;
    for i in 0..positions.len() {
        for j in 0..i {
            let distance = positions[i].distance(positions[j]);
            let image = positions[mirror[i]].distance(positions[mirror[j]]);
            worst = worst.max((distance - image).abs());
        }
    }
    worst
}

/// The largest asymmetry of the frames before motion time `end`, in units of h.
fn largest(study: &Study, frames: &[Frame], end: f64) -> f64 {
    let sheet = study.subject.sheet();
    let mirrors = mirrors(sheet);
    let frames = frames.iter().filter(|frame| frame.time < end);
    let of = |frame: &Frame| mirrors.each_ref().map(|m| asymmetry(&frame.positions, m));
    frames.flat_map(of).fold(0.0, f64::max) / sheet.unit_length
}

#[test]
fn without_contact_symmetric_sheets_move_symmetrically() {
    for sheet in [E, T, S, SII] {
        for material in ["", "preset = \"near-rigid\""] {
            if sheet == T && !material.is_empty() {
                continue;
            }
            let (study, frames) = folded(sheet, material, "contact = false");
            let worst = largest(&study, &frames, 3.0);
            assert!(worst < SYMMETRIC, "{sheet} {material}: {worst:e}");
        }
    }
}

#[test]
fn with_contact_symmetric_sheets_move_symmetrically_until_the_stack_buckles() {
    // From there on the second derivative of the energy at the symmetric equilibrium is negative in some direction, or
    // layers touch in so many places that forces, and so the way through the last load step, are not unique.
    for (sheet, buckles) in [(E, 1.99), (T, 1.99), (S, 1.99), (SII, 1.99)] {
        let (study, frames) = folded(sheet, "", "contact = true");
        let worst = largest(&study, &frames, buckles);
        // Equilibrium in contact is found to 1e-6 of a step.
        assert!(worst < 10.0 * SYMMETRIC, "{sheet}: {worst:e}");
    }
}

#[test]
fn a_near_rigid_sheet_of_case_t_buckles_and_is_symmetric_until_then() {
    let (study, frames) = folded(T, "preset = \"near-rigid\"", "contact = false");
    assert!(largest(&study, &frames, 1.28) < SYMMETRIC);
    assert!(largest(&study, &frames, 3.0) > 0.1);
}

#[test]
fn facets_cut_by_one_diagonal_move_unsymmetrically() {
    let one_diagonal = "facet_model = \"one-diagonal\"";
    for (sheet, least) in [(T, 0.05), (S, 0.2), (SII, 0.3)] {
        let (study, frames) = folded(sheet, one_diagonal, "contact = false");
        let worst = largest(&study, &frames, 3.0);
        assert!(worst > least, "{sheet}: {worst:e}");
    }
}

#[test]
fn a_sheet_with_narrow_pads_has_one_diagonal_by_default() {
    let model = |width: f64, keys: &str| {
        let scene = format!(
            "[profile]\nmodel = \"shelter\"\nlength = 7.0\n[sheet]\n{S}\ncolumns = 2\nwidth = {width}\n[material]\n{keys}\n"
        );
        let study = Study::resolve(&SceneSource::new(Path::new("a.toml"), scene)).unwrap();
        study.subject.units().unwrap().units.facet_model()
    };
    // Side pads of 0.11 h, and of 0.09 h.
    assert_eq!(model(2.44, ""), FacetModel::Symmetric);
    assert_eq!(model(2.36, ""), FacetModel::OneDiagonal);
    let symmetric = "facet_model = \"symmetric\"";
    assert_eq!(model(2.36, symmetric), FacetModel::Symmetric);
}

#[test]
fn the_dynamic_engine_keeps_the_symmetry() {
    let (study, frames) = folded(S, "", "engine = \"dynamic\"");
    let worst = largest(&study, &frames, 3.0);
    assert!(worst < SYMMETRIC, "{worst:e}");
}

#[test]
fn the_report_says_where_a_sheet_stops_being_symmetric() {
    let report = |sheet: &str, material: &str| {
        let (study, _) = folded(sheet, material, "contact = false");
        study.report_of(&study.compute(&|_, _| true).unwrap())
    };
    let flat = report(S, "");
    let mirrors: Vec<_> = flat.symmetry.iter().map(|s| s.mirror).collect();
    assert_eq!(mirrors, [Mirror::Across, Mirror::Along]);
    for symmetry in &flat.symmetry {
        assert!(symmetry.largest < SYMMETRIC, "{symmetry:?}");
        assert_eq!(symmetry.broken_t, None);
    }
    let buckled = report(T, "preset = \"near-rigid\"");
    let broken = buckled.symmetry.iter().filter_map(|s| s.broken_t);
    let first = broken.fold(f64::INFINITY, f64::min);
    assert!((1.25..1.4).contains(&first), "{:?}", buckled.symmetry);
    assert!(buckled.table().contains("where the sheet buckles"));
    let unsymmetric = report(S, "facet_model = \"one-diagonal\"");
    assert!(unsymmetric.symmetry.is_empty());
}
