//! Tests the collision kernels and the certificate against exact arithmetic and prints the results by class.
//!
//! `cargo run --release -p foldmotion-geometry --example exact_oracle [QUERIES]`
//!
//! At least as many queries as requested (default: a million): two thirds on their own, one third as the fifteen
//! queries of triangle pairs. The exit status is 1 if an impact was missed.

#![expect(clippy::print_stdout, reason = "an example that prints its table")]

#[path = "../tests/oracle/mod.rs"]
mod oracle;

use std::{error::Error, process::ExitCode, time::Instant};

use oracle::{
    queries::Class,
    trial::{PairTally, Tally, kernel, try_pairs, try_queries},
};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let asked = std::env::args().nth(1).map(|a| a.parse::<u64>()).transpose()?;
    let share = asked.unwrap_or(1_000_000).div_ceil(Class::ALL.len() as u64);
    let (alone, pairs) = ((2 * share).div_ceil(3), share.div_ceil(3).div_ceil(15));
    let start = Instant::now();
    println!("class               queries     meets said meet  FN        FP     FP %");
    let (mut all, mut all_pairs) = (Tally::default(), PairTally::default());
    let mut lines = Vec::new();
    for class in Class::ALL {
        let (of_pairs, pairs) = try_pairs(class, pairs, kernel);
        let tally = try_queries(class, alone, kernel).plus(of_pairs);
        println!("{:<18}{tally}  {:.1} s", format!("{class:?}"), start.elapsed().as_secs_f64());
        (all, all_pairs) = (all.plus(tally), all_pairs.plus(pairs));
        lines.push(format!("{:<18}{pairs}", format!("{class:?}")));
    }
    println!("{:<18}{all}\n", "all");
    println!(
        "the certificate on the triangle pairs (M: meeting, but certified free; D: deep, but certified;"
    );
    println!("refused, undecided: never within 2 τ, but not certified free)");
    println!(
        "class               pairs   meets    free touching crossed undecided     M     D refused undecided"
    );
    for line in lines {
        println!("{line}");
    }
    println!("{:<18}{all_pairs}\n", "all");
    println!("{:.1} s", start.elapsed().as_secs_f64());
    let missed = all.false_negatives + all_pairs.free_but_meeting + all_pairs.passed_but_deep;
    Ok(ExitCode::from(u8::from(missed > 0)))
}
