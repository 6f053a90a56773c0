//! How fast the engines and the check are on this machine, beside what the machine allows.
//!
//! `cargo bench -p foldmotion-study --bench speed` prints Markdown tables: docs/src/speed.md is such an output. A harness of its
//! own, since the figures are rates beside ceilings measured in the same run, and fits over sizes.
//!
//! Words in the command choose tables: machine, step, compact, check; all where none is given. `large` adds the sheet of
//! a million nodes.

#![expect(clippy::print_stdout, reason = "a bench prints its tables")]

mod check;
mod compact;
mod machine;
mod sample;
mod sheets;
mod step;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    // cargo adds `--bench`.
    let words: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let is_large = words.iter().any(|word| word == "large");
    let tables: Vec<&str> = words.iter().map(String::as_str).filter(|w| *w != "large").collect();
    let asked = |table: &str| tables.is_empty() || tables.contains(&table);
    let ceilings = machine::measure()?;
    if asked("machine") {
        machine::print(&ceilings);
    }
    if asked("step") {
        step::print(&ceilings, is_large)?;
    }
    if asked("compact") {
        compact::print()?;
    }
    if asked("check") {
        check::print()?;
    }
    Ok(())
}
