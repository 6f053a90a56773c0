//! The order of layers followed from a motion is the exact nested order of the compact state.

use std::fs::File;
use std::path::Path;

use foldmotion_check::{Checker, CollisionOptions};
use foldmotion_pattern::{Case, FoldError, FoldFile, LayerOrder, Unit, UnitSheet};
use foldmotion_study::{SceneSource, Study};

/// The order of the last frame of a motion file, from the coordinates alone.
fn followed(path: &Path) -> LayerOrder {
    let file = FoldFile::read(File::open(path).unwrap()).unwrap();
    let mut checker: Option<Checker<'_>> = None;
    file.frames::<FoldError>(File::open(path).unwrap(), &mut |frame, _| {
        if let Some(checker) = &mut checker {
            checker.advance(&frame).unwrap();
        } else {
            let options = CollisionOptions::default();
            checker = Some(Checker::new(&file.sheet, &frame, &options).unwrap());
        }
        Ok(())
    })
    .unwrap();
    checker.unwrap().layer_order()
}

#[test]
fn the_order_followed_from_a_motion_is_the_exact_order_of_the_compact_state() {
    for (scene, case, lambda) in [
        ("shelter-e", Case::E, None),
        ("shelter-t", Case::T, None),
        ("shelter-s", Case::S, None),
        ("shelter-sii", Case::SII, Some(0.7)),
    ] {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let mut source = SceneSource::read(&scenes.join(format!("{scene}.toml"))).unwrap();
        for assignment in ["motion.contact=false", "motion.frames=20", "record.outputs=[\"fold\"]"]
        {
            source.set(assignment).unwrap();
        }
        let home = tempfile::tempdir().unwrap();
        let study = Study::resolve(&source).unwrap();
        let report = study.run(home.path(), &|_, _| true).unwrap();
        let of_unit = report.unit.unwrap();
        let unit = Unit::new(case, of_unit.width, of_unit.height, lambda, None).unwrap();
        let exact = UnitSheet::new(unit, report.rows.unwrap(), report.columns.unwrap())
            .unwrap()
            .with_facet_model(study.subject.units().unwrap().units.facet_model());
        let (exact, order) = (exact.compact_order(), followed(&home.path().join("motion.fold")));
        assert!(!exact.is_empty());
        assert_eq!(order, exact, "{scene}: {} of {} orders", order.len(), exact.len());
    }
}
