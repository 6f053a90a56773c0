//! Whether the stated closest approach is attained when and where it is stated.

use foldmotion_pattern::Frame;

use crate::closest::{closest, on_triangle};
use crate::face_pair::FacePair;
use crate::moving_pair::MovingPair;
use crate::verifier::{POINT_ACCURACY, Verifier};
use foldmotion_check::Separation;

impl Verifier<'_> {
    /// Compares the stated closest approach with the motion, if its time lies between `start` and the last frame.
    pub(crate) fn meet_separation(&mut self, start: &Frame) {
        let Some(stated) = self.claim.min_separation.filter(|_| !self.is_separation_met) else {
            return;
        };
        let length = self.last.time - start.time;
        if !(stated.time >= start.time && stated.time <= self.last.time) {
            return;
        }
        let t = if length > 0.0 { (stated.time - start.time) / length } else { 0.0 };
        match self.separation_error(&stated, start, t) {
            None => self.is_separation_met = true,
            Some(mismatch) => self.separation_error = Some(mismatch),
        }
    }

    fn separation_error(&self, stated: &Separation, start: &Frame, t: f64) -> Option<String> {
        let unit = self.sheet.unit_length;
        let count = self.sheet.faces.len();
        if stated.faces[0] >= stated.faces[1] || stated.faces[1] as usize >= count {
            return Some(format!("triangles {:?} do not exist", stated.faces));
        }
        let pair = FacePair::new(self.sheet, stated.faces);
        if !pair.is_measured(self.sheet) {
            return Some("the facets share a vertex".to_owned());
        }
        let position = |v: u32| {
            let (p, q) = (start.positions[v as usize], self.last.positions[v as usize]);
            p + (q - p) * t
        };
        let (a, b) = (pair.a.map(position), pair.b.map(position));
        let far = a.iter().chain(&b).map(|p| p.length()).fold(0.0, f64::max);
        let slack = POINT_ACCURACY * unit + 64.0 * f64::EPSILON * far;
        for (point, triangle) in stated.points.iter().zip([&a, &b]) {
            let off = point.distance(on_triangle(*point, triangle));
            if off.is_nan() || off > slack {
                return Some(format!("a point is {:e} off its facet", off / unit));
            }
        }
        let apart = stated.points[0].distance(stated.points[1]);
        if (apart - stated.attained * unit).abs() > slack {
            return Some(format!("the points are {:e} apart", apart / unit));
        }
        let moving = MovingPair::new([a, b], [a, b], 0);
        let least = closest(&moving.at(0.0)).distance();
        let is_met =
            (least - stated.attained * unit).abs() <= slack.max(0.01 * self.limits.tolerance);
        (!is_met).then(|| format!("the triangles are {:e} apart there", least / unit))
    }
}
