//! ImportedPattern patterns, folded.

use std::f64::consts::FRAC_PI_2;

use foldmotion_pattern::{Assignment, ImportOptions, ImportedPattern, import_fold, import_svg};
use foldmotion_solver::quasi_static::{QuasiStaticOptions, run_quasi_static};
use foldmotion_solver::{HingeKind, Material, Model, Schedule, Stage};
use glam::DVec3;

/// Folds an import from flat to its targets; the fold angles it ends with.
fn folded(imported: &ImportedPattern, material: &Material) -> Vec<Option<f64>> {
    let sheet = &imported.sheet;
    let flat = vec![0.0; sheet.edges.len()];
    let schedule = Schedule::uniform(sheet, &flat, &imported.angles_at(1.0).unwrap()).unwrap();
    let model = Model::new(sheet, material).unwrap();
    let options = QuasiStaticOptions {
        stages: vec![Stage::Fold],
        frames: 8,
        ..QuasiStaticOptions::default()
    };
    let run = run_quasi_static(&model, &schedule, &sheet.planar(), &options, &|_| true).unwrap();
    assert!(run.is_complete(), "{:?}", run.stages);
    sheet.fold_angles(&run.frames.last().unwrap().positions)
}

#[test]
fn a_drawn_crease_folds_to_its_opacity() {
    let text = "<svg><rect width=\"30\" height=\"10\" stroke=\"#000\"/><path d=\"M10 0V10\" stroke=\"#f00\" \
                opacity=\"0.5\"/><path d=\"M20 0V10\" stroke=\"#00f\" opacity=\"0.25\"/></svg>";
    let imported = import_svg(text.as_bytes(), &ImportOptions::default()).unwrap();
    let angles = folded(&imported, &Material::PAPER);
    for (edge, angle) in imported.sheet.edges.iter().zip(angles) {
        let expected = match edge.assignment {
            Assignment::Mountain => -FRAC_PI_2,
            Assignment::Valley => FRAC_PI_2 / 2.0,
            _ => continue,
        };
        assert!((angle.unwrap() - expected).abs() < 1e-6);
    }
}

/// A square in four triangles around its middle: three creases and one `letter` hinge.
fn four_triangles(letter: &str) -> ImportedPattern {
    let file = serde_json::json!({
        "vertices_coords": [[0, 0], [2, 0], [2, 2], [0, 2], [1, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 4], [2, 4], [3, 4]],
        "edges_assignment": ["B", "B", "B", "B", "V", "M", "V", letter],
        "edges_foldAngle": [null, null, null, null, 20, -20, 20, null],
        "faces_vertices": [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    });
    import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap()
}

/// A square whose diagonal from the first corner to the third is `letter`.
fn two_triangles(letter: &str) -> ImportedPattern {
    let file = serde_json::json!({
        "vertices_coords": [[0, 0], [1, 0], [1, 1], [0, 1]],
        "edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]],
        "edges_assignment": ["B", "B", "B", "B", letter],
    });
    import_fold(file.to_string().as_bytes(), &ImportOptions::default()).unwrap()
}

#[test]
fn a_free_hinge_has_no_stiffness() {
    let free = four_triangles("U");
    let model = Model::new(&free.sheet, &Material::PAPER).unwrap();
    let hinge = model.hinges.iter().find(|h| h.kind == HingeKind::Free).unwrap();
    assert_eq!(hinge.stiffness, 0.0);
    assert_eq!(free.free_hinges().collect::<Vec<_>>(), [hinge.edge]);
    assert!(folded(&free, &Material::PAPER).iter().flatten().all(|a| a.is_finite()));
    // The corner beyond the hinge turned about it: nothing is strained, and only a hinge that is held resists.
    let energy = |letter: &str| {
        let imported = two_triangles(letter);
        let model = Model::new(&imported.sheet, &Material::PAPER).unwrap();
        let mut positions = imported.sheet.planar();
        positions[3] = DVec3::new(0.5, 0.5, 0.5f64.sqrt());
        let positions = model.to_model(&positions);
        let mut angles = vec![0.0; model.hinges.len()];
        model.follow_angles(&positions, &mut angles);
        let targets = vec![0.0; angles.len()];
        model.energy_by_kind(&positions, &angles, &targets).total()
    };
    assert!(energy("U") < 1e-25 && energy("F") > 0.1);
}
