//! Background work: resolving scenes, previews, runs, opening files, checks, recordings, moving the sheet by hand.
//!
//! Each worker owns a thread. Its results lie behind a lock that is only held for the time of a copy; then it requests
//! a repaint of the window. A panic of a worker becomes an error that is shown. A worker that is dropped is asked to
//! stop.

mod error;
mod interaction;
mod job;
mod latest_worker;
mod lock;
mod open;
mod preview;
mod record;
mod repaint;
mod resolver;
mod run;
mod state_feed;
mod threads;

pub(crate) use error::WorkError;
pub(crate) use interaction::Interaction;
pub(crate) use job::Job;
pub(crate) use open::{CheckedMotion, check_motion, open};
pub(crate) use preview::preview;
pub(crate) use record::{record, record_opened, write};
pub(crate) use repaint::RepaintSignal;
pub(crate) use resolver::{Resolved, Resolver};
pub(crate) use run::{FinishedRun, run};
pub(crate) use state_feed::{SheetState, StateFeed};
