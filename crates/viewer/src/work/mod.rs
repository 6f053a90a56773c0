//! Work in the background: drafts, runs, opened files, sheets held in the hand, recordings.
//!
//! Each worker owns a thread. What it has to say lies behind a lock that is held for a copy at most; after that it wakes
//! the window. A panic of a worker becomes an error to show. A worker that is dropped is told to stop.

mod drafts;
mod error;
mod hold;
mod job;
mod latest;
mod live;
mod lock;
mod open;
mod preview;
mod record;
mod run;
mod threads;
mod wake;

pub(crate) use drafts::{Drafts, Resolved};
pub(crate) use error::WorkError;
pub(crate) use hold::Hold;
pub(crate) use job::{Job, Stand};
pub(crate) use live::{Live, State};
pub(crate) use open::{Judged, judge, open};
pub(crate) use preview::preview;
pub(crate) use record::{record, record_opened, write};
pub(crate) use run::{Finished, Run};
pub(crate) use wake::Wake;
