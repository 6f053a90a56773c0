//! The marks in films, figures and pages: the first penetration of a motion.

use foldmotion_check::{CollisionReport, penetration_spans};
use foldmotion_pattern::Motion;
use foldmotion_record::{Marks, Spot};

/// Marks the two facets of the first penetration while they penetrate, and the point at which that begins. Later penetrations
/// are not marked, since they would hide the first. `shown` converts a time of `motion` into the displayed motion time.
pub(super) fn marks(
    motion: &Motion,
    collision: &CollisionReport,
    shown: impl Fn(f64) -> f64,
) -> Marks {
    let mut marks = Marks::default();
    let Some(first) = &collision.first else {
        return marks;
    };
    let [face, _] = first.faces;
    let spot = Spot::on(motion, face, first.point, first.passed, shown(first.time));
    if let Some(spot) = spot {
        marks.point_out(spot);
    }
    for span in penetration_spans(motion, collision) {
        if span.faces == first.faces {
            for face in span.faces {
                marks.insert(face, shown(span.from), shown(span.to));
            }
        }
    }
    marks
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use foldmotion_record::FigureState;

    use super::*;
    use crate::{SceneSource, Study};

    #[test]
    fn only_the_first_penetration_of_many_is_marked_and_its_point_is_shown() {
        let scene = include_str!("../../../../scenes/shelter-short-plain.toml");
        let mut scene: toml::Table = scene.parse().unwrap();
        let motion: toml::Table = "contact = false\nframes = 48".parse().unwrap();
        scene.insert("motion".to_owned(), motion.into());
        let source = SceneSource::new(Path::new("scene.toml"), scene.to_string());
        let study = Study::resolve(&source).unwrap();
        let folded = study.compute(&|_, _| true).unwrap();
        let (motion, collision) = (&folded.motion, &folded.findings.collision);
        let first = collision.first.as_ref().unwrap();
        assert!(collision.penetrations.len() > 4, "it crosses in many places");
        let marks = marks(motion, collision, |time| time);
        let facets = |time: f64| {
            let marked = FigureState::at(motion, &marks, time).marked;
            let faces = (0..marked.len()).filter(|&face| marked[face]);
            let mut facets: Vec<u32> = faces.map(|f| motion.sheet.face_facets[f]).collect();
            facets.sort_unstable();
            facets.dedup();
            facets
        };
        let mut pair = first.faces.map(|f| motion.sheet.face_facets[f as usize]);
        pair.sort_unstable();
        assert_eq!(facets(first.passed), pair);
        for frame in &motion.frames {
            assert!(facets(frame.time).iter().all(|facet| pair.contains(facet)));
        }
        let spot = |time| FigureState::at(motion, &marks, time).spot;
        let point = spot(first.passed).unwrap();
        let apart = point.distance(first.point) / motion.sheet.unit_length;
        assert!(apart < 10.0 * collision.tolerance, "{apart} h");
        assert!(spot(2.0).is_some() && spot(first.time - 1e-6).is_none());
    }
}
