//! How close the recorded frames follow the computed motion.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The recorded path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PathReport {
    /// Frames recorded.
    pub frames: usize,
    /// Motion time of the last one.
    pub end_t: f64,
    /// How often the engine ran again because the verdict was open between frames.
    pub refinements: usize,
    /// Frames asked for between the first ones by these runs.
    pub added_frames: usize,
    /// How far a straight path between frames strays from the computed motion at most, in units of h: estimated from
    /// second differences of the frames; null where a stage has too few of them.
    pub straying: Option<f64>,
    /// Motion time of the frame after which it strays furthest.
    pub straying_t: Option<f64>,
}
