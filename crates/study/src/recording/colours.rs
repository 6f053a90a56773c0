//! Strain and bending as values of the triangles.

use foldmotion_pattern::{Assignment, Motion, Sheet};
use foldmotion_record::{Legend, Values};
use glam::DVec3;
use rayon::prelude::*;

use crate::scene::ColourChoice;

/// The smallest range of a colour scale; smaller values are noise.
const LEAST_RANGE: f64 = 1e-3;

/// A quantity that colours can show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// The largest |l / l₀ − 1| of a triangle's edges in percent, with l₀ the length in the crease pattern.
    Strain,
    /// The largest |fold angle| of a triangle's edges inside its facet, in degrees.
    Bending,
}

impl Quantity {
    /// The quantity that `colour` shows; `None` if it shows the paper.
    pub fn of(colour: ColourChoice) -> Option<Self> {
        match colour {
            ColourChoice::Paper | ColourChoice::Grey => None,
            ColourChoice::Strain => Some(Self::Strain),
            ColourChoice::Bending => Some(Self::Bending),
        }
    }

    /// The name of the quantity with its unit.
    pub fn title(self) -> &'static str {
        match self {
            Self::Strain => "largest bar strain, %",
            Self::Bending => "facet bending, degrees",
        }
    }

    /// The value of each triangle of `sheet` with its vertices at `positions`.
    pub fn values(self, sheet: &Sheet, positions: &[DVec3]) -> Vec<f64> {
        let mut values = vec![0.0_f64; sheet.faces.len()];
        let angles = match self {
            Self::Strain => Vec::new(),
            Self::Bending => sheet.fold_angles(positions),
        };
        for (index, edge) in sheet.edges.iter().enumerate() {
            let value = match self {
                Self::Strain => {
                    let [i, j] = edge.vertices.map(|v| v as usize);
                    let rest = sheet.vertices[i].distance(sheet.vertices[j]);
                    100.0 * (positions[i].distance(positions[j]) / rest - 1.0).abs()
                }
                Self::Bending if edge.assignment == Assignment::Facet => {
                    angles[index].map_or(0.0, |angle| angle.to_degrees().abs())
                }
                Self::Bending => 0.0,
            };
            for face in edge.faces.into_iter().flatten() {
                let known = &mut values[face as usize];
                *known = known.max(value);
            }
        }
        values
    }

    /// The values of each frame, on a scale from 0 to a round number.
    pub fn of_motion(self, motion: &Motion) -> Values {
        let frames = motion.frames.par_iter();
        let frames: Vec<Vec<f64>> =
            frames.map(|frame| self.values(&motion.sheet, &frame.positions)).collect();
        let peak = frames.iter().flatten().copied().fold(0.0, f64::max);
        Values { title: self.title().to_owned(), range: [0.0, rounded_up(peak)], frames }
    }
}

/// The colour scale of `values`, for figures.
pub(crate) fn legend(values: &Values) -> Legend {
    Legend { title: values.title.clone(), range: values.range }
}

/// `value` rounded up to 1, 2 or 5 times a power of ten.
fn rounded_up(value: f64) -> f64 {
    if !(value > LEAST_RANGE && value.is_finite()) {
        return LEAST_RANGE;
    }
    let decade = 10.0_f64.powf(value.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * decade);
    steps.into_iter().find(|&s| s >= value).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Frame, Unit, UnitSheet};

    use super::*;

    #[test]
    fn values_peak_where_the_check_finds_its_peaks() {
        let unit = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None).unwrap();
        let units = UnitSheet::new(unit, 2, 2).unwrap();
        let bent = |p: DVec3| DVec3::new(1.02 * p.x, p.y, 0.1 * (7.0 * p.x).sin() * p.y);
        let positions: Vec<DVec3> = units.sheet.planar().into_iter().map(bent).collect();
        let sheet = &units.sheet;
        let peak = |quantity: Quantity| {
            let values = quantity.values(sheet, &positions);
            assert_eq!(values.len(), sheet.faces.len());
            values.into_iter().fold(0.0, f64::max)
        };
        let strain = foldmotion_check::bar_strain(sheet, &positions);
        assert!(strain.peak > 0.01 && (peak(Quantity::Strain) - 100.0 * strain.peak).abs() < 1e-12);
        let bending = foldmotion_check::facet_bending(sheet, &positions);
        assert!(bending.peak_deg() > 1.0);
        assert!((peak(Quantity::Bending) - bending.peak_deg()).abs() < 1e-12);
        let motion = Motion {
            frames: vec![Frame { time: 0.0, positions: positions.clone() }],
            compact_order: units.compact_order(),
            sheet: units.sheet.clone(),
        };
        let [low, high] = Quantity::Bending.of_motion(&motion).range;
        assert!(low == 0.0 && high >= bending.peak_deg() && high < 10.0 * bending.peak_deg());
    }

    #[test]
    fn ranges_end_at_round_numbers() {
        let cases = [0.0, 1e-9, 0.011, 0.4, 1.0, 1.2, 73.0, f64::INFINITY];
        let expected = [1e-3, 1e-3, 0.02, 0.5, 1.0, 2.0, 100.0, 1e-3];
        for (value, expected) in cases.into_iter().zip(expected) {
            assert!((rounded_up(value) / expected - 1.0).abs() < 1e-12, "{value}");
        }
    }
}
