//! The timeline: stages, scrubbing, playback, and plots on the same axis.

mod axis;
mod bar;
mod playback;
mod plot;
mod plot_view;

pub(crate) use self::bar::{Marks, Timeline};
pub(crate) use self::playback::{Playback, Repeat};
pub(crate) use self::plot::{Curve, Plot, Plots};
pub(crate) use self::plot_view::number;
