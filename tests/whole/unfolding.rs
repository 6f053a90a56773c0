//! Stage `unfold`: uniform if that is proved clear, by energy if the profile would cross itself.

use std::path::Path;

use foldmotion_solver::Stage;
use foldmotion_study::{Report, SceneSource, Study, Unfolding, UnitStudy, models};

/// The spiral without contact and files: each engine state is the path's own.
const BARE: [&str; 3] = ["motion.contact=false", "motion.frames=40", "record.outputs=[]"];

fn resolved(scene: &str, set: &[&str]) -> Study {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../scenes/{scene}.toml"));
    let mut source = SceneSource::read(&path).unwrap();
    for assignment in set {
        source.set(assignment).unwrap();
    }
    Study::resolve(&source).unwrap()
}

fn unfolding(scene: &str, set: &[&str]) -> Unfolding {
    resolved(scene, set).subject.units().unwrap().unfolding.clone()
}

fn run(scene: &str, set: &[&str]) -> Report {
    let folder = tempfile::tempdir().unwrap();
    let study = resolved(scene, set);
    study.run(folder.path(), &|_, _| true).unwrap()
}

#[test]
fn a_fermat_spiral_unfolded_uniformly_penetrates_and_by_energy_does_not() {
    let uniform = run("spiral-energy", &[&BARE[..], &["motion.unfold=uniform"]].concat());
    let of_uniform = uniform.unfold.unwrap();
    assert_eq!(of_uniform.method.name(), "uniform");
    assert!(!of_uniform.certified && of_uniform.steps.is_none());
    let first = uniform.collision.first.unwrap();
    assert_eq!((uniform.collision.verdict.name(), first.stage.name()), ("penetrating", "unfold"));
    // Straight paths between 20 frames a stage stray a little from the motion.
    let crosses_at = of_uniform.crosses_at.unwrap();
    assert!((first.t - crosses_at).abs() < 0.01, "{} {crosses_at}", first.t);

    let auto = run("spiral-energy", &BARE);
    let of_auto = auto.unfold.as_ref().unwrap();
    assert_eq!((of_auto.method.name(), of_auto.asked.name()), ("energy", "auto"));
    assert!(of_auto.certified && of_auto.steps.unwrap() > 10);
    assert_eq!(of_auto.crosses_at, Some(crosses_at));
    assert_eq!(auto.collision.verdict.name(), "touching", "{:?}", auto.collision.first);
    assert!(auto.stages.iter().all(|s| s.converged));
    // The creases follow the path: the sheet stays as it is but for its folds.
    assert!(auto.stages[0].peak_strain < 1e-9, "{}", auto.stages[0].peak_strain);
    assert!(auto.compact.rms_to_exact.unwrap() < 1e-9);
}

#[test]
fn a_shelter_unfolds_uniformly_unless_energy_is_requested() {
    for (asked, method) in [("auto", "uniform"), ("uniform", "uniform"), ("energy", "energy")] {
        let unfolding = unfolding("shelter-e", &[&format!("motion.unfold={asked}")]);
        assert_eq!((unfolding.method().name(), unfolding.requested.name()), (method, asked));
        assert!(unfolding.certified && unfolding.crosses_at.is_none(), "{asked}");
    }
    let [uniform, energy] = ["uniform", "energy"].map(|asked| {
        let study = resolved("shelter-e", &[&format!("motion.unfold={asked}")]);
        let at = |s| (0..study.schedule.hinge_count()).map(move |h| (h, s));
        let target = |(hinge, s)| study.schedule.target(Stage::Unfold, hinge, s);
        [0.0, 0.4, 1.0].map(|s| at(s).map(target).collect::<Vec<f64>>())
    });
    assert_eq!(uniform[0], energy[0]);
    assert_eq!(uniform[2], energy[2]);
    let report = run("shelter-e", &[&BARE[..], &["motion.unfold=energy"]].concat());
    assert_eq!(
        (report.unfold.as_ref().unwrap().method.name(), report.collision.verdict.name()),
        ("energy", "touching")
    );
}

#[test]
fn every_built_in_profile_unfolds_on_a_path_proved_clear() {
    for model in models() {
        let name = format!("profile.model={}", model.name);
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/spiral-energy.toml");
        let mut source = SceneSource::read(&path).unwrap();
        for set in [&name, &format!("sheet.rows={}", model.rows)] {
            source.set(set).unwrap();
        }
        let study = UnitStudy::resolve(&source).unwrap();
        assert!(study.unfolding.certified, "{}", model.name);
        // Of the nine only the spiral crosses itself when all angles are scaled together.
        let crosses = model.name == "fermat-spiral";
        assert_eq!(study.unfolding.crosses_at.is_some(), crosses, "{}", model.name);
        assert_eq!(study.unfolding.path.is_some(), crosses, "{}", model.name);
    }
}

#[test]
fn rows_that_unfold_in_turn_are_uniform_and_nothing_is_proved_of_them() {
    let step = "motion.step=[{stage=\"unfold\", rows=[0, 20], to=0.5}]";
    let auto = unfolding("spiral-energy", &[step]);
    assert_eq!((auto.method().name(), auto.certified), ("uniform", false));
    assert!(auto.crosses_at.is_some());
    let energy = unfolding("spiral-energy", &[step, "motion.unfold=energy"]);
    assert_eq!((energy.method().name(), energy.certified), ("energy", false));
    let all = "motion.step=[{stage=\"unfold\", creases=\"rows\", ease=\"smooth\"}]";
    assert!(unfolding("spiral-energy", &[all]).certified);
}
