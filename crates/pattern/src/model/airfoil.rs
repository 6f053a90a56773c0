//! Sections of the NACA four-digit family.
//!
//! Source: Jacobs, Ward and Pinkerton 1933, NACA report 460; Abbott and von Doenhoff 1959, *Theory of Wing Sections*,
//! section 6.4. The last coefficient of the thickness is −0.1036, which closes the trailing edge, for their −0.1015.

use foldmotion_geometry::Closure;
use glam::DVec2;

use super::{CaseColumns, ProfileModel, Shape};

/// Points around the section at which the curve is held to the formula.
const POINTS: usize = 60;

/// NACA 4415: from the trailing edge over the upper side to the nose and back along the lower one; a corner at the
/// trailing edge.
pub(super) const AIRFOIL: ProfileModel = ProfileModel {
    name: "airfoil",
    title: "airfoil, section NACA 4415",
    shape: Shape::Naca(NacaSection { camber: 0.04, camber_at: 0.4, thickness: 0.15 }),
    closure: Closure::Corner,
    rows: 26,
    columns: CaseColumns { e: 7, t: 10, s: 5, ours: true },
    source: "NACA 4415 by its formula (NACA report 460) with a closed trailing edge; figure 6h of the paper names no section",
};

/// A four-digit section of unit chord.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NacaSection {
    /// The largest camber over the chord, the first digit / 100.
    pub camber: f64,
    /// Its position along the chord, the second digit / 10.
    pub camber_at: f64,
    /// The largest thickness over the chord, the last two digits / 100.
    pub thickness: f64,
}

impl NacaSection {
    /// The point at angle β ∈ [0, 2π]: x_c = (1 + cos β) / 2 along the chord, on the upper side up to β = π, then on
    /// the lower side.
    pub fn point(&self, beta: f64) -> DVec2 {
        let x = 0.5 * (1.0 + beta.cos());
        // |sin β| / 2 = √(x − x²), so the root of x is smooth around the nose: √x = |cos β/2|.
        let root = (0.5 * beta).cos();
        let polynomial = -0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1036));
        let half = 5.0 * self.thickness * (0.2969 * root.abs() + x * polynomial);
        let (m, p) = (self.camber, self.camber_at);
        let (line, slope) = if x < p {
            (m / (p * p) * x * (2.0 * p - x), 2.0 * m / (p * p) * (p - x))
        } else {
            let scale = m / ((1.0 - p) * (1.0 - p));
            (scale * (1.0 - 2.0 * p + x * (2.0 * p - x)), 2.0 * scale * (p - x))
        };
        let normal = DVec2::new(-slope, 1.0).normalize();
        let side = half.copysign(root);
        DVec2::new(x, line) + side * normal
    }

    /// Points around the section; the first, the trailing edge, is repeated as the last.
    pub(super) fn points(&self) -> Vec<DVec2> {
        let around =
            (0..POINTS).map(|k| self.point(std::f64::consts::TAU * k as f64 / POINTS as f64));
        around.chain([self.point(0.0)]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_section_is_as_thick_as_its_number_says_and_closed_at_the_trailing_edge() {
        // NACA 0012: half thickness 0.06 at x = 0.3 (Abbott and von Doenhoff, appendix I: 0.06002).
        let section = NacaSection { camber: 0.0, camber_at: 0.4, thickness: 0.12 };
        let beta = (2.0f64 * 0.3 - 1.0).acos();
        let upper = section.point(beta);
        assert!((upper - DVec2::new(0.3, 0.06002)).length() < 1e-4, "{upper}");
        let lower = section.point(std::f64::consts::TAU - beta);
        assert!((upper.y + lower.y).abs() < 1e-15);
        assert!(section.point(0.0).distance(DVec2::X) < 1e-15);
        assert!(section.point(std::f64::consts::PI).length() < 1e-15);
    }

    #[test]
    fn the_mean_line_reaches_its_camber_where_its_number_says() {
        let Shape::Naca(section) = AIRFOIL.shape else { panic!("{:?}", AIRFOIL.shape) };
        let beta = (2.0f64 * 0.4 - 1.0).acos();
        let (upper, lower) = (section.point(beta), section.point(std::f64::consts::TAU - beta));
        let middle = (upper + lower) / 2.0;
        assert!((middle - DVec2::new(0.4, 0.04)).length() < 1e-15, "{middle}");
    }
}
