//! How closely the recorded frames follow the computed motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The recorded path of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PathReport {
    /// The number of frames recorded.
    pub frames: usize,
    /// The motion time of the last frame.
    pub end_t: f64,
    /// How many times the engine ran again because the verdict was open between frames.
    pub refinements: usize,
    /// The number of frames that these runs added between the first ones.
    pub added_frames: usize,
    /// How far a straight path between frames strays from the computed motion at most, in units of h, estimated from
    /// second differences of the frames; null if a stage has too few of them.
    pub straying: Option<f64>,
    /// The motion time of the frame after which the path strays furthest.
    pub straying_t: Option<f64>,
}
