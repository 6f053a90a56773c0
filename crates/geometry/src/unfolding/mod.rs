//! Unfolding a planar chain: from a divided profile to a straight line, without a crossing.
//!
//! A [`Chain`] is a polyline of segments of fixed length, described by its turns: the angles, in radians, by which the
//! heading changes from one segment to the next. Two motions straighten it:
//!
//! - *uniform*: all turns are scaled together from 1 to 0. The chain may cross itself; [`certify`] proves that it does
//!   not, or finds where it does.
//! - *energy*: [`straighten`] follows the descent of an energy that is infinite if the chain touches itself
//!   (Cantarella, Demaine, Iben and O'Brien 2004, "An energy-driven approach to linkage unfolding"). A chain that does
//!   not cross itself can always be straightened without a crossing (Connelly, Demaine and Rote 2003, "Straightening
//!   polygonal arcs and convexifying polygonal cycles"), and unless the chain is straight, the energy decreases along
//!   that motion.
//!
//! # The last part of the motion
//! Once all headings lie within less than half a turn, scaling the turns scales the differences of headings, so that at
//! every later instant some direction has a positive component along every segment: the chain is strictly monotone
//! along it and does not meet itself.

mod certificate;
mod chain;
mod descent;
mod energy;
mod opening;
mod path;
mod seam;

pub use certificate::{SweepVerdict, certify};
pub use chain::Chain;
pub use path::{TurnPath, straighten};
