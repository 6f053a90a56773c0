//! The collision kernels on motions whose answer is known.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod certify;
mod closest_approach;
mod touch_or_through;
