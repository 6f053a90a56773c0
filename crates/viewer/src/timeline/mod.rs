//! The timeline: stages, scrubbing, playing, and curves on the same axis.

mod axis;
mod bar;
mod curves;
mod playback;
mod strip;

pub(crate) use self::bar::{Marks, Timeline};
pub(crate) use self::curves::{Curve, Curves, Panel};
pub(crate) use self::playback::{Playback, Repeat};
pub(crate) use self::strip::number;
