//! The paper's closed forms of the compact bounding box, equations 3 to 7.

use serde::{Deserialize, Serialize};

use crate::{Case, Folding, Unit, UnitSheet};

/// The compact bounding box.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct CompactBox {
    /// Along the growing direction, the width, and the flaps.
    pub extents: [f64; 3],
    /// A, the area projected on the x–z plane.
    pub area: f64,
    /// V; 0 where the compact state is flat.
    pub volume: f64,
}

impl CompactBox {
    /// Extents x = Nr·h − (Nr − 1)·a, y = Nc·(2s + 2d), z = a; A = x·z (equations 3, 4 and the A^S of 5);
    /// V = Nc·(2s + 2d)·A (equations 6 and 7). `None` for the unmodified rectangle, which has no closed form.
    pub fn closed_form(unit: &Unit, rows: usize, columns: usize) -> Option<Self> {
        if unit.case == Case::Plain {
            return None;
        }
        let (rows, columns) = (rows as f64, columns as f64);
        let x = rows * unit.height - (rows - 1.0) * unit.flap;
        let y = columns * unit.compact_width();
        let area = x * unit.flap;
        Some(Self { extents: [x, y, unit.flap], area, volume: area * y })
    }
}

impl UnitSheet {
    /// The compact bounding box in closed form: equations 3 to 7, and with rows of their own heights h_k
    /// x = Σ h_k − (Nr − 1)·a, the other extents as they are: each row lies a further on than the one before it ends,
    /// whatever its height. A folded map is as large as one unit and flat. `None` for the unmodified rectangle.
    pub fn closed_form(&self) -> Option<CompactBox> {
        match self.folding {
            Folding::Waterbomb => self.waterbomb_box(),
            Folding::Map => Some(self.map_box()),
        }
    }

    /// The box of the sheet folded unit by unit, also where it folds like a map.
    pub fn waterbomb_box(&self) -> Option<CompactBox> {
        let mut closed = CompactBox::closed_form(&self.unit, self.rows, self.columns)?;
        if !self.has_equal_rows() {
            let [x, y, z] = &mut closed.extents;
            *x = -self.boundaries[self.rows] - (self.rows as f64 - 1.0) * self.unit.flap;
            closed.area = *x * *z;
            closed.volume = closed.area * *y;
        }
        Some(closed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exact_compact_state_fills_the_box_of_equations_3_to_7() {
        for (case, w, lambda, offset) in [
            (Case::E, 1.0, None, None),
            (Case::T, 0.35, None, None),
            (Case::S, 1.6, None, None),
            (Case::SII, 1.6, Some(0.7), None),
            (Case::SII, 3.0, Some(0.2), Some(0.3)),
        ] {
            let unit = Unit::new(case, w, 1.0, lambda, offset).unwrap();
            for (rows, columns) in [(1, 1), (2, 3), (7, 5), (35, 4)] {
                let sheet = UnitSheet::new(unit, rows, columns).unwrap();
                let closed = CompactBox::closed_form(&unit, rows, columns).unwrap();
                let points = sheet.compact();
                let low = points.iter().copied().reduce(glam::DVec3::min).unwrap();
                let high = points.iter().copied().reduce(glam::DVec3::max).unwrap();
                let error = ((high - low) - glam::DVec3::from(closed.extents)).abs().max_element();
                assert!(error < 1e-13, "{case:?} {rows} x {columns}: {error}");
            }
        }
    }

    #[test]
    fn areas_and_volumes_are_the_papers_formulas() {
        let (nr, nc, h) = (7.0, 5.0, 1.0);
        let of = |case, w, lambda| {
            CompactBox::closed_form(&Unit::new(case, w, h, lambda, None).unwrap(), 7, 5).unwrap()
        };
        let e = of(Case::E, 1.0, None);
        assert!((e.area - (nr + 1.0) / 4.0 * h * h).abs() < 1e-14, "equation 3: {}", e.area);
        let w = 0.7;
        let t = of(Case::T, w, None);
        assert!(
            (t.area - (2.0 * nr * w * h - nr * w * w + w * w) / 4.0).abs() < 1e-14,
            "equation 4: {}",
            t.area
        );
        let w = 1.6;
        let s = of(Case::S, w, None);
        assert!(
            (s.volume - nc * (nr + 1.0) / 4.0 * (w - h) * h * h).abs() < 1e-13,
            "equation 6: {}",
            s.volume
        );
        let l = 0.7;
        let sii = of(Case::SII, w, Some(l));
        let volume = nc * (w - l * h) * (2.0 * nr - l * nr + l) / 4.0 * l * h * h;
        assert!((sii.volume - volume).abs() < 1e-13, "equation 7: {}", sii.volume);
    }

    #[test]
    fn one_square_unit_folds_to_half_its_width_times_its_height() {
        let unit = Unit::new(Case::E, 2.0, 2.0, None, None).unwrap();
        assert_eq!(CompactBox::closed_form(&unit, 1, 1).unwrap().area, 2.0);
    }
}
