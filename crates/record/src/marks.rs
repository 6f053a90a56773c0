//! Which facets and which point are marked in a film, and when.

use foldmotion_pattern::{Motion, Sheet};
use glam::DVec3;

use crate::positions_at;

/// A point of the sheet that takes a ring from a motion time on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// The motion time from which it is shown.
    pub from: f64,
    /// The triangle it lies on.
    pub face: u32,
    /// Its barycentric coordinates: the weights of the corners, 0 or more, of sum 1.
    pub weights: [f64; 3],
}

impl Spot {
    /// The point of triangle `face` that is the nearest to `point` at motion time `time`, from `from` on; `None` if the
    /// sheet has no such triangle.
    ///
    /// Precondition: the times of the motion increase.
    pub fn on(motion: &Motion, face: u32, point: DVec3, time: f64, from: f64) -> Option<Self> {
        let corners = motion.sheet.faces.get(face as usize)?;
        let positions = positions_at(motion, time);
        let [a, b, c] = corners.map(|v| positions.get(v as usize).copied().unwrap_or_default());
        let normal = (b - a).cross(c - a);
        let part = |p: DVec3, q: DVec3| normal.dot((p - point).cross(q - point)).max(0.0);
        let parts = [part(b, c), part(c, a), part(a, b)];
        let sum: f64 = parts.iter().sum();
        let weights = if sum > 0.0 { parts.map(|part| part / sum) } else { [1.0 / 3.0; 3] };
        Some(Self { from, face, weights })
    }

    /// Its position while the vertices are at `positions`.
    fn position(&self, sheet: &Sheet, positions: &[DVec3]) -> Option<DVec3> {
        let corners = sheet.faces.get(self.face as usize)?;
        let [a, b, c] = corners.map(|v| positions.get(v as usize).copied());
        let [u, v, w] = self.weights;
        Some(u * a? + v * b? + w * c?)
    }
}

/// Triangles whose facets are painted in the colour of [`crate::Style::mark`], each in a span of motion time.
///
/// What is marked is the caller's to say; foldmotion marks the two facets that are the first to penetrate each other,
/// while they do, and where they begin to.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Marks {
    spans: Vec<([f64; 2], u32)>,
    spot: Option<Spot>,
}

impl Marks {
    /// Marks the facet of triangle `face` from motion time `from` to `to`, both included.
    pub fn insert(&mut self, face: u32, from: f64, to: f64) {
        self.spans.push(([from, to], face));
    }

    /// Marks a point by a ring, replacing an earlier one.
    pub fn point_out(&mut self, spot: Spot) {
        self.spot = Some(spot);
    }

    /// Whether nothing is marked at any time.
    pub fn is_empty(&self) -> bool {
        self.spans.is_empty() && self.spot.is_none()
    }

    /// The centre of the ring at motion time `time`, with the vertices at `positions`.
    pub fn spot_at(&self, sheet: &Sheet, positions: &[DVec3], time: f64) -> Option<DVec3> {
        let spot = self.spot.filter(|spot| spot.from <= time)?;
        spot.position(sheet, positions)
    }

    /// Every span of motion time, with its triangle.
    pub(crate) fn spans(&self) -> impl Iterator<Item = ([f64; 2], u32)> + '_ {
        self.spans.iter().copied()
    }

    /// For each triangle of `sheet` whether it is marked in the shot that shows motion time `time` and represents
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
    use foldmotion_pattern::{Case, Frame, Unit, UnitSheet};

    use super::*;

    #[test]
    fn a_spot_stays_with_its_triangle_and_shows_from_its_time_on() {
        let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
        let units = UnitSheet::new(unit, 2, 1).unwrap();
        let frame = |time: f64, positions| Frame { time, positions };
        let motion = Motion {
            frames: vec![frame(1.0, units.sheet.planar()), frame(2.0, units.compact())],
            compact_order: units.compact_order(),
            sheet: units.sheet,
        };
        let sheet = &motion.sheet;
        let inside = |positions: &[DVec3]| {
            let [a, b, c] = sheet.faces[4].map(|v| positions[v as usize]);
            0.5 * a + 0.3 * b + 0.2 * c
        };
        let (at, end) = (positions_at(&motion, 1.25), &motion.frames[1].positions);
        let off = (at[1] - at[0]).any_orthonormal_vector() * 1e-9;
        let spot = Spot::on(&motion, 4, inside(&at) + off, 1.25, 1.2).unwrap();
        let mut marks = Marks::default();
        marks.point_out(spot);
        assert!(!marks.is_empty());
        let found = marks.spot_at(sheet, end, 2.0).unwrap();
        assert!((found - inside(end)).length() < 1e-8, "{found}");
        assert!(marks.spot_at(sheet, &at, 1.1).is_none(), "before its time");
        // A point beyond the triangle is brought onto it; a triangle that is not there has none.
        let beyond = Spot::on(&motion, 4, inside(&at) + 9.0, 1.25, 1.2).unwrap();
        assert!(beyond.weights.iter().all(|w| (0.0..=1.0).contains(w)));
        assert!(Spot::on(&motion, u32::MAX, DVec3::ZERO, 1.0, 1.0).is_none());
    }

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
        assert_eq!(count(&marks, 1.1, 1.2), 0, "a face the sheet has not is passed over");
    }
}
