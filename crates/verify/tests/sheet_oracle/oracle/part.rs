//! Parts of sheets: polygons that share corners, with dyadic coordinates.

use super::exact::{Convex, Point, UNIT, minus, plus};
use foldmotion_random::Random;

/// A part: corners and the polygons between them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Part {
    pub(crate) corners: Vec<Point>,
    /// The corners of each polygon in order; polygons that share an edge traverse it in opposite directions.
    pub(crate) polygons: Vec<Vec<usize>>,
    /// Convex polygons with the same union.
    pub(crate) convex: Vec<Vec<usize>>,
}

/// A share of the unit in sixteenths.
pub(crate) fn sixteenths(n: i64) -> i64 {
    n * (UNIT / 16)
}

/// A random integer below `count`.
pub(crate) fn below(random: &mut Random, count: u16) -> i64 {
    i64::try_from(random.index(usize::from(count))).expect("a small number")
}

/// A random integer between two, both included.
pub(crate) fn between(random: &mut Random, low: i64, high: i64) -> i64 {
    low + below(random, u16::try_from(high - low + 1).expect("a small range"))
}

impl Part {
    fn flat(outline: &[[i64; 2]], convex: Option<Vec<Vec<usize>>>) -> Self {
        let all: Vec<usize> = (0..outline.len()).collect();
        Self {
            corners: outline.iter().map(|&[x, y]| [x, y, 0].map(sixteenths)).collect(),
            convex: convex.unwrap_or_else(|| vec![all.clone()]),
            polygons: vec![all],
        }
    }

    pub(crate) fn square(random: &mut Random) -> Self {
        let [w, h] = [(); 2].map(|()| between(random, 10, 18));
        let skew = if random.index(3) == 0 { between(random, -4, 4) } else { 0 };
        let (w, h) = if skew == 0 && random.index(2) == 0 { (16, 16) } else { (w, h) };
        Self::flat(&[[-w, -h], [w, -h], [w + skew, h], [skew - w, h]], None)
    }

    pub(crate) fn triangle(random: &mut Random) -> Self {
        let [a, b, c] = [(); 3].map(|()| between(random, 8, 16));
        Self::flat(&[[-a, -b], [c, -b], [b - c, a]], None)
    }

    pub(crate) fn hexagon(random: &mut Random) -> Self {
        let [a, b] = [between(random, 5, 10), between(random, 10, 16)];
        Self::flat(&[[-a, -b], [a, -b], [16, 0], [a, b], [-a, b], [-16, 0]], None)
    }

    pub(crate) fn ell(random: &mut Random) -> Self {
        let [a, b] = [(); 2].map(|()| between(random, -4, 4));
        let outline = [[-16, -16], [16, -16], [16, b], [a, b], [a, 16], [-16, 16]];
        Self::flat(&outline, Some(vec![vec![0, 1, 2, 3], vec![0, 3, 4, 5]]))
    }

    pub(crate) fn plate(random: &mut Random) -> Self {
        match random.index(5) {
            0 | 1 => Self::square(random),
            2 => Self::hexagon(random),
            3 => Self::ell(random),
            _ => Self::triangle(random),
        }
    }

    /// A profile in the x–z plane (in sixteenths), extruded along y.
    pub(crate) fn extruded(profile: &[[i64; 2]], is_closed: bool, [y0, y1]: [i64; 2]) -> Self {
        let count = profile.len();
        let corners = profile
            .iter()
            .flat_map(|&[x, z]| [y0, y1].map(|y| [x, y, z].map(sixteenths)))
            .collect();
        let panels = if is_closed { count } else { count - 1 };
        let panel = |i: usize| {
            let j = (i + 1) % count;
            vec![2 * i, 2 * j, 2 * j + 1, 2 * i + 1]
        };
        let polygons: Vec<_> = (0..panels).map(panel).collect();
        Self { corners, convex: polygons.clone(), polygons }
    }

    /// Two polygons at a dihedral angle.
    pub(crate) fn roof(random: &mut Random) -> Self {
        let [a, b] = [(); 2].map(|()| between(random, 8, 16));
        let rise = [-16, -8, -4, 4, 8, 16][random.index(6)];
        let other = [0, rise, rise][random.index(3)];
        let half = between(random, 10, 16);
        Self::extruded(&[[-a, -rise], [0, 0], [b, -other]], false, [-half, half])
    }

    /// Panels in a row with flat or bent creases between them.
    pub(crate) fn strip(random: &mut Random) -> Self {
        let bend = [0, 0, 4, 8][random.index(4)];
        let half = between(random, 6, 16);
        let count = 3 + below(random, 3);
        let profile: Vec<_> = (0..count)
            .map(|i| [12 * i - 6 * (count - 1), if i % 2 == 0 { 0 } else { bend }])
            .collect();
        Self::extruded(&profile, false, [-half, half])
    }

    /// Two polygons folded nearly flat.
    pub(crate) fn taco(random: &mut Random) -> Self {
        let gap = between(random, 2, 4);
        let half = between(random, 8, 16);
        Self::extruded(&[[-14, 0], [8, 0], [-12, gap]], false, [-half, half])
    }

    /// The walls of a prism.
    pub(crate) fn tube(random: &mut Random) -> Self {
        let profile: &[[i64; 2]] = match random.index(3) {
            0 => &[[-12, -12], [12, -12], [12, 12], [-12, 12]],
            1 => &[[-12, -8], [12, -8], [0, 12]],
            _ => &[[-8, -12], [8, -12], [14, 0], [8, 12], [-8, 12], [-14, 0]],
        };
        let half = between(random, 10, 20);
        Self::extruded(profile, true, [-half, half])
    }

    /// Plates above each other.
    pub(crate) fn stack(random: &mut Random) -> Self {
        let mut all = Self::default();
        for level in 0..2 + below(random, 2) {
            let mut plate = Self::plate(random);
            for corner in &mut plate.corners {
                corner[2] += sixteenths(6 * level);
            }
            all.append(&plate);
        }
        all
    }

    /// A triangle thinner than τ, or a wedge of two with a thin end, pointing down along z.
    pub(crate) fn needle(random: &mut Random) -> Self {
        let width = [7, 20, 70, 700, 20_000][random.index(5)];
        let long = sixteenths(between(random, 8, 16));
        if random.index(2) == 0 {
            return Self {
                corners: vec![[0, 0, -long], [width, 0, long], [-width, 0, long]],
                polygons: vec![vec![0, 1, 2]],
                convex: vec![vec![0, 1, 2]],
            };
        }
        let polygons = vec![vec![0, 1, 2], vec![0, 3, 1]];
        Self {
            corners: vec![
                [0, 0, -long],
                [0, 0, long],
                [width, sixteenths(4), long],
                [-width, sixteenths(4), long],
            ],
            convex: polygons.clone(),
            polygons,
        }
    }

    pub(crate) fn any(random: &mut Random) -> Self {
        match random.index(9) {
            0 => Self::roof(random),
            1 => Self::strip(random),
            2 => Self::taco(random),
            3 => Self::tube(random),
            4 => Self::stack(random),
            _ => Self::plate(random),
        }
    }

    pub(crate) fn append(&mut self, other: &Self) {
        let first = self.corners.len();
        let moved = |all: &[Vec<usize>]| -> Vec<Vec<usize>> {
            let shifted = |polygon: &Vec<usize>| polygon.iter().map(|i| i + first).collect();
            all.iter().map(shifted).collect()
        };
        self.corners.extend(&other.corners);
        self.polygons.extend(moved(&other.polygons));
        self.convex.extend(moved(&other.convex));
    }

    /// The image under a linear map with the given columns, x ↦ Σ xᵢ cᵢ, displaced.
    pub(crate) fn mapped(&self, columns: [Point; 3], to: Point) -> Self {
        let image = |p: &Point| {
            let along = |i: usize| {
                let sum = (0..3).map(|k| i128::from(p[k]) * i128::from(columns[k][i]));
                (sum.sum::<i128>() / i128::from(UNIT)) as i64
            };
            plus([0, 1, 2].map(along), to)
        };
        Self { corners: self.corners.iter().map(image).collect(), ..self.clone() }
    }

    /// The part displaced so that `point` comes to the origin.
    pub(crate) fn centred_at(&self, point: Point) -> Self {
        Self { corners: self.corners.iter().map(|&p| minus(p, point)).collect(), ..self.clone() }
    }

    pub(crate) fn pieces(&self) -> Vec<Convex> {
        let piece = |of: &Vec<usize>| Convex::new(of.iter().map(|&i| self.corners[i]).collect());
        self.convex.iter().map(piece).collect()
    }
}
