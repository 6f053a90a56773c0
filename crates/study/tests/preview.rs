//! A preview has the motion of a run without contact.

use std::path::Path;

use foldmotion_check::fitted_box;
use foldmotion_study::{Preview, SceneSource, Study, StudyError};

#[test]
fn a_preview_of_a_scene_with_contact_reaches_the_exact_compact_state() {
    let scene = "[profile]\nmodel = \"shelter\"\n[sheet]\ncase = \"SII\"\nlambda = 0.7\n";
    let source = SceneSource::new(Path::new("a.toml"), scene.to_owned());
    let study = Study::resolve(&source).unwrap();
    assert!(study.contact.is_some());
    let Preview { motion, series, boxes } = study.preview(&|_, _| true).unwrap();
    assert_eq!(series.len(), motion.frames.len());
    assert_eq!(boxes.len(), motion.frames.len());
    assert!(series.iter().all(|f| f.separation.is_nan()));
    let last = motion.frames.last().unwrap();
    assert_eq!(last.time, 2.0);
    let exact = study.subject.units().unwrap().units.compact();
    let rms = fitted_box(&last.positions, &exact).rms_to_exact.unwrap();
    assert!(rms < 1e-6, "{rms}");
    let closed_form = study.subject.closed_form().unwrap();
    let reached = boxes.last().unwrap();
    assert!((reached.volume / closed_form.volume - 1.0).abs() < 1e-5);
    let flat = motion.frames.iter().position(|f| f.time == 1.0).unwrap();
    assert!(boxes[flat].volume < 1e-9 * boxes[0].volume);
    assert!(matches!(study.preview(&|_, _| false), Err(StudyError::Interrupted)));
}
