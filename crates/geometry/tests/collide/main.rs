//! The collision kernels on motions whose answer is known.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod certify;
mod closest_approach;
#[path = "../oracle/random.rs"]
mod random;
mod touch_or_through;

use glam::DVec3;

fn triangle(random: &mut random::Random) -> [DVec3; 3] {
    [(); 3].map(|()| random.vector())
}
