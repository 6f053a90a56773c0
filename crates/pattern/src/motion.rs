//! Frames, motions and layer order.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::Sheet;

/// The sheet at one motion time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Motion time t: 0 deployed, 1 planar, 2 compact; settling after the schedule ends lies above 2.
    pub time: f64,
    /// One position for each vertex.
    pub positions: Vec<DVec3>,
}

/// A sheet and its frames in order of time. Between frames every vertex moves on a straight line.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// The sheet that moves.
    pub sheet: Sheet,
    /// At least one; times increase strictly.
    pub frames: Vec<Frame>,
    /// The order of the facets that coincide in the last frame.
    pub compact_order: LayerOrder,
}

/// The order of coincident triangles: pairs (f, g) with FOLD's sign.
///
/// +1: f lies above g, on the side of g's front normal; −1: below.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LayerOrder {
    above: BTreeMap<(u32, u32), i8>,
}

impl LayerOrder {
    /// Records that triangle `f` lies above (`sign` = 1) or below (−1) triangle `g`, on g's front side.
    pub fn insert(&mut self, f: u32, g: u32, sign: i8) {
        self.above.insert((f, g), sign);
    }

    /// +1 where `f` is known to lie above `g` (on g's front side), −1 below, `None` if the order is unknown.
    ///
    /// Only the recorded direction (f, g) is looked up; built-in sheets record both.
    pub fn sign(&self, f: u32, g: u32) -> Option<i8> {
        self.above.get(&(f, g)).copied()
    }

    /// Every recorded (f, g, sign), ordered.
    pub fn iter(&self) -> impl Iterator<Item = (u32, u32, i8)> + '_ {
        self.above.iter().map(|(&(f, g), &sign)| (f, g, sign))
    }

    /// The number of recorded pairs.
    pub fn len(&self) -> usize {
        self.above.len()
    }

    /// Whether no pair is recorded.
    pub fn is_empty(&self) -> bool {
        self.above.is_empty()
    }
}
