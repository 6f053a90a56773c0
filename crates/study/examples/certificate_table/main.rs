//! Computes the tables of docs/src/certificates.md: folds the shelter in many variants, checks each motion and verifies
//! each certificate.
//!
//! `cargo run --release -p foldmotion-study --no-default-features --example certificate_table` prints them as Markdown.
//! `--only WORDS` computes the rows that have all of WORDS, of their first columns and `contact` or `no-contact`, such as
//! `--only "S near-rigid no-contact"`.
//!
//! `--matrix` prints another table instead: every file of `scenes/` with contact, without, and moved by the dynamic
//! engine; `--only` then names scenes and columns. The exit status is 1 if a motion got no certificate, or
//! if the second proof did not confirm it; details are then on stderr.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "an example that prints its tables")]

mod checked;
mod matrix;
mod number;
mod shelter;

use std::{error::Error, process::ExitCode};

use checked::{Checked, Motion};

/// The options of the command line.
#[derive(Default)]
struct Options {
    matrix: bool,
    only: Vec<String>,
}

fn arguments() -> Result<Options, Box<dyn Error>> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--matrix" => options.matrix = true,
            "--only" => {
                let words = arguments.next().ok_or("--only needs words")?;
                options.only = words.split_whitespace().map(str::to_owned).collect();
            }
            other => return Err(format!("{other} is unknown").into()),
        }
    }
    Ok(options)
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let options = arguments()?;
    let mut tables = if options.matrix { vec![matrix::table()?] } else { shelter::tables() };
    for table in &mut tables {
        table.rows.retain(|row| options.only.iter().all(|word| row.has(word)));
    }
    if tables.iter().all(|table| table.rows.is_empty()) {
        return Err(format!("no row has all of {:?}", options.only).into());
    }
    let mut total = Total::default();
    for table in tables.iter().filter(|table| !table.rows.is_empty()) {
        table.print(&mut total);
    }
    println!("\n{}", total.sentence());
    Ok(ExitCode::from(u8::from(total.verified < total.motions)))
}

/// A table of motions.
struct Table {
    title: String,
    /// The columns that name a motion, and those of its results.
    columns: [&'static [&'static str]; 2],
    rows: Vec<Row>,
    /// The cells of the results, one for each column.
    cells: fn(&Checked) -> Vec<String>,
}

/// A motion to be checked, and the cells that name it.
struct Row {
    names: Vec<String>,
    motion: Motion,
}

impl Row {
    fn has(&self, word: &str) -> bool {
        let contact = ["no-contact", "contact"][usize::from(self.motion.has_contact)];
        contact == word
            || self.names.iter().any(|name| name.split([' ', ',']).any(|part| part == word))
    }
}

impl Table {
    fn print(&self, total: &mut Total) {
        let columns = self.columns.concat();
        println!("\n{}\n", self.title);
        println!("| {} |", columns.join(" | "));
        println!("|{}", "---|".repeat(columns.len()));
        for row in &self.rows {
            let cells = match row.motion.check() {
                Ok(checked) => {
                    total.add(&checked);
                    (self.cells)(&checked)
                }
                Err(error) => {
                    total.motions += 1;
                    let mut cells = vec!["-".to_owned(); self.columns[1].len()];
                    cells[0] = format!("not checked: {error}").replace(['|', '\n'], " ");
                    cells
                }
            };
            println!("| {} | {} |", row.names.join(" | "), cells.join(" | "));
        }
    }
}

/// The results of all motions.
#[derive(Default)]
struct Total {
    motions: usize,
    verified: usize,
    check_seconds: f64,
    verify_seconds: f64,
    computed_with: Option<String>,
}

impl Total {
    fn add(&mut self, checked: &Checked) {
        self.motions += 1;
        self.check_seconds += checked.report.seconds.check;
        self.verify_seconds += checked.verify_seconds;
        if checked.verified.verification.is_verified() {
            self.verified += 1;
        } else {
            eprintln!("{}: {}", checked.report.title, checked.verified.table());
        }
        let (report, engine) = (&checked.report, &checked.report.engine);
        self.computed_with =
            Some(format!("foldmotion {} on {}", report.version, engine.instruction_set));
    }

    fn sentence(&self) -> String {
        format!(
            "Computed with {}. The second proof confirms {} of {} certificates; checks took {:.1} s, second proofs {:.1} s.",
            self.computed_with.as_deref().unwrap_or("foldmotion"),
            self.verified,
            self.motions,
            self.check_seconds,
            self.verify_seconds
        )
    }
}
