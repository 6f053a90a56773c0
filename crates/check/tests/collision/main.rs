//! The collision verdict against motions whose verdict is known.

mod sheets;
mod verdicts;
