//! Which facets are marked in a film, and when.

use foldmotion_pattern::Sheet;

/// Triangles whose facets are painted in the colour of [`crate::Style::mark`], each in a span of motion time.
///
/// What is marked is the caller's to say; foldmotion marks facets that penetrate each other.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Marks {
    spans: Vec<([f64; 2], u32)>,
}

impl Marks {
    /// Marks the facet of triangle `face` from motion time `from` to `to`, both included.
    pub fn insert(&mut self, face: u32, from: f64, to: f64) {
        self.spans.push(([from, to], face));
    }

    /// Whether nothing is marked at any time.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty()
    }

    /// Every span of motion time, with its triangle.
    pub(crate) fn spans(&self) -> impl Iterator<Item = ([f64; 2], u32)> + '_ {
        self.spans.iter().copied()
    }

    /// For each triangle of `sheet` whether it is marked in the shot that shows motion time `time` and stands for
    /// the times after `previous`: so a mark shorter than the time between two shots is seen in one.
    pub(crate) fn at(&self, sheet: &Sheet, previous: f64, time: f64) -> Vec<bool> {
        let mut facets = vec![false; sheet.facets.len()];
        let shown = |&&([from, to], face): &&([f64; 2], u32)| {
            from <= time && (to >= time || to > previous) && (face as usize) < sheet.faces.len()
        };
        for (_, face) in self.spans.iter().filter(shown) {
            facets[sheet.face_facets[*face as usize] as usize] = true;
        }
        let of_face = |&facet: &u32| facets[facet as usize];
        sheet.face_facets.iter().map(of_face).collect()
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    #[test]
    fn a_mark_covers_its_facet_in_its_span_and_shows_in_a_shot_however_short() {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let sheet = UnitSheet::new(unit, 2, 1).unwrap().sheet;
        // A face of a facet of two triangles.
        let pair = |f: &u32| {
            let facet = sheet.face_facets[*f as usize];
            sheet.face_facets.iter().filter(|&&g| g == facet).count() == 2
        };
        let face = (0..sheet.faces.len() as u32).find(pair).unwrap();
        let mut marks = Marks::default();
        assert!(marks.is_empty());
        marks.insert(face, 1.001, 1.002);
        let count = |marks: &Marks, previous, time| {
            let marked = marks.at(&sheet, previous, time);
            marked.iter().filter(|&&is_marked| is_marked).count()
        };
        assert_eq!(count(&marks, 1.0, 1.001), 2, "as it begins");
        assert_eq!(count(&marks, 0.9, 1.1), 2, "within one step of the film");
        assert_eq!(
            [(0.9, 1.0), (1.1, 1.2), (1.002, 1.1)].map(|(from, to)| count(&marks, from, to)),
            [0; 3]
        );
        marks.insert(u32::MAX, 0.0, 2.0);
        assert_eq!(
            count(&marks, 1.1, 1.2),
            0,
            "a face the sheet has not is passed over"
        );
    }
}
