//! The pattern check: is every interior vertex developable and flat-foldable, and which type is it?
//!
//! Developable: the sector angles sum to 2π. Flat-foldable (Kawasaki): an even number of creases with alternate
//! sector angles summing to π (section 2 of the paper). Types I, J and K are those of the paper's figure 1.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::unit_sheet::{VertexLocation, is_mid};
use crate::{Assignment, Folding, ImportedPattern, Sheet, UnitSheet};

/// Angle sums may differ from 2π and π by this much, radians.
pub const ANGLE_TOLERANCE: f64 = 1e-9;
/// How far, in mean edges, a vertex of an imported pattern that folds flat may bring the end of a crease from itself:
/// drawings have few digits.
pub(crate) const LARGEST_MISFIT: f64 = 5e-3;

/// The type of an interior vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum VertexType {
    /// The unsplit centre of a unit (figure 1b).
    I,
    /// On a row boundary where corner lines end: the diagonals lie in the row above (figure 1d).
    J,
    /// On a row boundary where corner lines begin: the diagonals lie in the row below (figure 1e).
    K,
    /// One of the two centres of a split unit.
    #[serde(rename = "split")]
    Split,
    /// At a pad.
    #[serde(rename = "pad")]
    Pad,
    /// On the lines between the units of a map.
    #[serde(rename = "grid")]
    Grid,
    /// A vertex of an imported pattern, which has no units.
    #[serde(rename = "imported")]
    Imported,
}

impl VertexType {
    /// The name in reports and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::I => "I",
            Self::J => "J",
            Self::K => "K",
            Self::Split => "split",
            Self::Pad => "pad",
            Self::Grid => "grid",
            Self::Imported => "imported",
        }
    }
}

/// The creases around one interior vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexCheck {
    /// The index of the vertex.
    pub vertex: u32,
    /// The type of the vertex in its unit.
    pub kind: VertexType,
    /// Sector angles between neighbouring creases, counter-clockwise, radians.
    pub sectors: Vec<f64>,
    /// Mountain creases minus valley creases (Maekawa: ±2 where the vertex folds flat).
    pub mountains_minus_valleys: i32,
    /// By how much alternate sums may differ from π where the vertex folds flat, radians.
    pub tolerance: f64,
}

impl VertexCheck {
    /// Σ sector angles, radians.
    pub fn angle_sum(&self) -> f64 {
        self.sectors.iter().sum()
    }

    /// The sums of every other sector angle, radians; `None` for an odd number of creases.
    pub fn alternate_sums(&self) -> Option<[f64; 2]> {
        let sum = |start: usize| self.sectors.iter().skip(start).step_by(2).sum();
        self.sectors.len().is_multiple_of(2).then(|| [sum(0), sum(1)])
    }

    /// Whether the sector angles sum to 2π.
    pub fn is_developable(&self) -> bool {
        (self.angle_sum() - TAU).abs() <= ANGLE_TOLERANCE
    }

    /// Whether alternate sector angles sum to π and mountains and valleys differ by two.
    pub fn is_flat_foldable(&self) -> bool {
        self.mountains_minus_valleys.abs() == 2
            && self
                .alternate_sums()
                .is_some_and(|s| s.iter().all(|s| (s - PI).abs() <= self.tolerance))
    }
}

/// Vertices of one type that have the same number of creases, the same signs and the same sums of sector angles.
#[derive(Debug, Clone, PartialEq)]
pub struct VertexGroup {
    /// The type of the vertices of the group.
    pub kind: VertexType,
    /// Creases that meet at each.
    pub degree: usize,
    /// The number of vertices of the group.
    pub count: usize,
    /// Whether all are developable.
    pub developable: bool,
    /// Whether all are flat-foldable.
    pub flat_foldable: bool,
    /// Mountain creases minus valley creases at each.
    pub mountains_minus_valleys: i32,
    /// Angle sum, radians.
    pub angle_sum: f64,
    /// Alternate sums, the smaller first; `None` for an odd number of creases.
    pub alternate_sums: Option<[f64; 2]>,
}

/// The creases in order around every interior vertex, and what they add up to.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternCheck {
    /// One an interior vertex at which creases meet.
    pub vertices: Vec<VertexCheck>,
}

impl PatternCheck {
    /// Whether every interior vertex is developable.
    pub fn is_developable(&self) -> bool {
        self.vertices.iter().all(VertexCheck::is_developable)
    }

    /// Whether every interior vertex is flat-foldable.
    pub fn is_flat_foldable(&self) -> bool {
        self.vertices.iter().all(VertexCheck::is_flat_foldable)
    }

    /// Vertices by type, degree, sums and signs, in that order; sums that differ by less than 1e-6 are one.
    pub fn groups(&self) -> Vec<VertexGroup> {
        let mut groups: BTreeMap<_, VertexGroup> = BTreeMap::new();
        for vertex in &self.vertices {
            let alternate_sums = vertex.alternate_sums().map(|[a, b]| [a.min(b), a.max(b)]);
            let sums = alternate_sums.map_or(0.0, |[least, _]| least);
            let key = (
                vertex.kind,
                vertex.sectors.len(),
                (sums * 1e6).round() as i64,
                (vertex.angle_sum() * 1e6).round() as i64,
                vertex.mountains_minus_valleys,
            );
            let group = groups.entry(key).or_insert_with(|| VertexGroup {
                kind: vertex.kind,
                degree: vertex.sectors.len(),
                count: 0,
                developable: true,
                flat_foldable: true,
                mountains_minus_valleys: vertex.mountains_minus_valleys,
                angle_sum: vertex.angle_sum(),
                alternate_sums,
            });
            group.count += 1;
            group.developable &= vertex.is_developable();
            group.flat_foldable &= vertex.is_flat_foldable();
        }
        groups.into_values().collect()
    }
}

impl Sheet {
    /// Checks every interior vertex at which creases meet; `kind`: the type of each, `misfit`: how far its longest crease
    /// may be from itself where it folds flat.
    fn check_vertices(&self, kind: impl Fn(usize) -> VertexType, misfit: f64) -> PatternCheck {
        let vertex_check = |(vertex, creases): (usize, Option<Vec<(u32, Assignment)>>)| {
            let creases = creases.filter(|creases| !creases.is_empty())?;
            let at = self.vertices[vertex];
            let mut directions: Vec<f64> = creases
                .iter()
                .map(|&(other, _)| (self.vertices[other as usize] - at).to_angle())
                .collect();
            directions.sort_by(f64::total_cmp);
            let sectors = (0..directions.len())
                .map(|i| match directions.get(i + 1) {
                    Some(next) => next - directions[i],
                    None => directions[0] + TAU - directions[i],
                })
                .collect();
            let sign = |&(_, a): &(u32, Assignment)| if a == Assignment::Mountain { 1 } else { -1 };
            let length = |&(other, _): &(u32, _)| self.vertices[other as usize].distance(at);
            let longest = creases.iter().map(length).fold(0.0, f64::max);
            Some(VertexCheck {
                vertex: vertex as u32,
                kind: kind(vertex),
                sectors,
                mountains_minus_valleys: creases.iter().map(sign).sum(),
                // The reflections turn it by twice the difference.
                tolerance: ANGLE_TOLERANCE.max(misfit / (2.0 * longest)),
            })
        };
        let around = creases_around(self).into_iter().enumerate();
        PatternCheck { vertices: around.filter_map(vertex_check).collect() }
    }
}

impl ImportedPattern {
    /// Checks every interior vertex at which mountain and valley creases meet; free hinges do not count. Alternate sums
    /// may differ from π by what brings the longest crease 0.005 mean edges from itself.
    pub fn check(&self) -> PatternCheck {
        let misfit = LARGEST_MISFIT * self.sheet.unit_length;
        self.sheet.check_vertices(|_| VertexType::Imported, misfit)
    }
}

impl UnitSheet {
    /// Checks every interior vertex of the crease pattern.
    pub fn check(&self) -> PatternCheck {
        self.sheet.check_vertices(|vertex| self.vertex_type(vertex), 0.0)
    }

    fn vertex_type(&self, vertex: usize) -> VertexType {
        let (line, location) = self.locations[vertex];
        let unit = &self.unit;
        let at_pad = if self.lines[line as usize].family == crate::unit_sheet::Family::P {
            unit.side_pad > 0.0
        } else {
            unit.centre_pad > 0.0
        };
        match location {
            _ if self.folding == Folding::Map => VertexType::Grid,
            _ if at_pad => VertexType::Pad,
            VertexLocation::Mid { both: true, .. } => VertexType::I,
            VertexLocation::Mid { .. } => VertexType::Split,
            VertexLocation::Boundary { boundary } => {
                if is_mid(self.lines[line as usize].family, boundary) {
                    VertexType::J
                } else {
                    VertexType::K
                }
            }
        }
    }
}

/// For every interior vertex the far ends of its creases; `None` for vertices on the border.
fn creases_around(sheet: &Sheet) -> Vec<Option<Vec<(u32, Assignment)>>> {
    let mut around = vec![Some(Vec::new()); sheet.vertices.len()];
    for edge in &sheet.edges {
        let [a, b] = edge.vertices;
        for (from, to) in [(a, b), (b, a)] {
            match edge.assignment {
                Assignment::Border => around[from as usize] = None,
                Assignment::Facet | Assignment::Free => {}
                _ => {
                    if let Some(creases) = &mut around[from as usize] {
                        creases.push((to, edge.assignment));
                    }
                }
            }
        }
    }
    around
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Case, Unit};

    fn check(
        case: Case,
        width: f64,
        lambda: Option<f64>,
        rows: usize,
        columns: usize,
    ) -> PatternCheck {
        let unit = Unit::new(case, width, 1.0, lambda, None).unwrap();
        UnitSheet::new(unit, rows, columns).unwrap().check()
    }

    #[test]
    fn e_has_six_crease_vertices_of_types_i_j_and_k_that_fold_flat() {
        let check = check(Case::E, 1.0, None, 3, 5);
        assert!(check.is_developable() && check.is_flat_foldable());
        let groups: Vec<_> = check.groups().iter().map(|g| (g.kind, g.degree, g.count)).collect();
        // Centres: 5 in even rows, 4 inside odd rows. Boundaries: P inside (4), Q (5): J and K swap each boundary.
        assert_eq!(groups, [(VertexType::I, 6, 14), (VertexType::J, 6, 9), (VertexType::K, 6, 9)]);
    }

    #[test]
    fn the_sector_angles_of_the_centre_are_those_of_figure_1b() {
        let check = check(Case::E, 1.0, None, 1, 1);
        let [centre] = check.vertices.as_slice() else { panic!("one interior vertex") };
        let mut sectors = centre.sectors.clone();
        sectors.sort_by(f64::total_cmp);
        let expected = [PI / 4.0, PI / 4.0, PI / 4.0, PI / 4.0, PI / 2.0, PI / 2.0];
        assert!(sectors.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{sectors:?}");
    }

    #[test]
    fn t_splits_its_centres_into_four_crease_vertices_and_still_folds_flat() {
        let check = check(Case::T, 0.7, None, 3, 3);
        assert!(check.is_developable() && check.is_flat_foldable());
        let split = check.groups().into_iter().find(|g| g.kind == VertexType::Split).unwrap();
        assert_eq!((split.degree, split.count), (4, 2 * (3 + 2 + 3)));
    }

    #[test]
    fn s_and_sii_are_developable_but_their_five_crease_vertices_do_not_fold_flat() {
        for (case, lambda) in [(Case::S, None), (Case::SII, Some(0.7))] {
            let check = check(case, 1.6, lambda, 3, 3);
            assert!(check.is_developable() && !check.is_flat_foldable());
            let bad: Vec<_> = check.groups().into_iter().filter(|g| !g.flat_foldable).collect();
            assert!(bad.iter().all(|g| g.kind == VertexType::Pad), "{bad:?}");
            assert!(bad.iter().any(|g| g.degree == 5 && g.alternate_sums.is_none()), "{bad:?}");
        }
    }

    #[test]
    fn the_unmodified_rectangle_satisfies_the_angle_conditions_whatever_its_shape() {
        for width in [0.7, 1.0, 2.5] {
            let check = check(Case::Plain, width, None, 3, 3);
            assert!(check.is_developable() && check.is_flat_foldable(), "w = {width}");
        }
    }

    #[test]
    fn a_vertex_whose_alternate_sums_differ_is_a_group_of_its_own() {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let mut sheet = UnitSheet::new(unit, 3, 3).unwrap();
        let before = sheet.check().groups().len();
        let centre = sheet.check().vertices[0].vertex as usize;
        sheet.sheet.vertices[centre].y += 0.01;
        let groups = sheet.check().groups();
        assert!(groups.len() > before);
        let sums = |g: &VertexGroup| g.alternate_sums.unwrap();
        for g in &groups {
            assert_eq!(g.flat_foldable, (sums(g)[0] - PI).abs() < 1e-6, "{g:?}");
        }
    }

    #[test]
    fn a_vertex_moved_by_hand_is_no_longer_flat_foldable() {
        let unit = Unit::new(Case::E, 1.0, 1.0, None, None).unwrap();
        let mut sheet = UnitSheet::new(unit, 2, 2).unwrap();
        let centre = sheet.check().vertices[0].vertex as usize;
        sheet.sheet.vertices[centre].y += 0.01;
        let check = sheet.check();
        assert!(check.is_developable() && !check.is_flat_foldable());
    }
}
