//! The verdict and its second proof against the oracle for sheets.
//!
//! `cargo run --release -p foldmotion-check --example sheet_oracle` is the same on 100 000 sheets.
#![expect(clippy::expect_used, reason = "a test stops where a value is missing")]

mod oracle;
