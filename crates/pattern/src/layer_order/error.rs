//! Why a pattern has no flat state.

use foldmotion_geometry::Number;
use thiserror::Error;

/// Why a pattern cannot be folded flat by reflections, before any order of layers is asked for.
///
/// Lengths are in the unit of the pattern, angles in degrees.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum LayerError {
    /// The target of a crease is neither 0° nor ±180°.
    #[error("edge {edge} folds to {degrees:.3}°: a flat state needs 0° or ±180° at every crease")]
    TargetNotFlat {
        /// The index of the edge in the sheet.
        edge: u32,
        /// Its target fold angle.
        degrees: f64,
    },
    /// An odd number of creases meet at a vertex inside the sheet.
    #[error(
        "vertex {vertex} at ({:.6}, {:.6}) has {creases} {}: around a vertex that folds flat the number of creases is even",
        Number(position[0]), Number(position[1]), if *creases == 1 { "crease" } else { "creases" }
    )]
    OddCreases {
        /// The index of the vertex in the sheet.
        vertex: u32,
        /// Its position in the pattern.
        position: [f64; 2],
        /// The number of folded creases at it.
        creases: usize,
    },
    /// The angles around a vertex inside the sheet do not fold flat (Kawasaki's condition).
    #[error(
        "vertex {vertex} at ({:.6}, {:.6}) does not fold flat: every other angle between its creases sums to {:.6}° and {:.6}° \
         instead of 180°",
        Number(position[0]), Number(position[1]), Number(sums[0]), Number(sums[1])
    )]
    AngleSums {
        /// The index of the vertex in the sheet.
        vertex: u32,
        /// Its position in the pattern.
        position: [f64; 2],
        /// The two sums of every other angle.
        sums: [f64; 2],
    },
    /// Mountains and valleys at a vertex inside the sheet do not differ by two (Maekawa's condition).
    #[error(
        "vertex {vertex} at ({:.6}, {:.6}) has {mountains} mountain and {valleys} valley creases: around a vertex that folds flat \
         the numbers differ by two",
        Number(position[0]), Number(position[1])
    )]
    MountainsAndValleys {
        /// The index of the vertex in the sheet.
        vertex: u32,
        /// Its position in the pattern.
        position: [f64; 2],
        /// The number of mountain creases at it.
        mountains: usize,
        /// The number of valley creases at it.
        valleys: usize,
    },
    /// Reflections along different paths bring a vertex to different positions.
    #[error(
        "the reflections do not close: facets {} and {} bring vertex {vertex} to positions {:.6} apart; the limit is {:.6}",
        facets[0], facets[1], Number(*misfit), Number(*limit)
    )]
    NotClosed {
        /// The index of the vertex in the sheet.
        vertex: u32,
        /// Two facets that have it as a corner.
        facets: [u32; 2],
        /// The distance of the positions.
        misfit: f64,
        /// The largest distance that is accepted.
        limit: f64,
    },
    /// A closed path over the sheet, around a hole, crosses an odd number of creases.
    #[error(
        "around a hole of the sheet an odd number of creases fold: edge {edge} would have to turn a facet over and not turn it"
    )]
    OddLoop {
        /// The index of an edge where the sides do not agree.
        edge: u32,
    },
    /// More facets lie on each other than can be held in memory.
    #[error("the flat state has more than {limit} {what}: it is too large to be put in order")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// The largest number.
        limit: usize,
    },
    /// An order that the file gives contradicts a crease or an order given before it.
    #[error("faceOrders of the file put facet {} {} facet {}, but {instead}", facets[0], if *is_above { "above" } else { "below" }, facets[1])]
    GivenOrder {
        /// The two facets.
        facets: [u32; 2],
        /// Whether the file puts the first above the second, on the side of the second one's front.
        is_above: bool,
        /// What says otherwise.
        instead: &'static str,
    },
}

impl LayerError {
    /// Whether only the size of the pattern stands in the way, so that nothing is said about its flat state.
    pub fn is_of_size(&self) -> bool {
        matches!(self, Self::TooMany { .. })
    }
}
