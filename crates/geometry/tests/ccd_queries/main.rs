//! The collision kernels on recorded queries: a share of the hand-made scenes of a public benchmark.
//!
//! `cargo run --release -p foldmotion-verify --example ccd_queries FOLDER` does the same for a folder of such files.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

#[expect(dead_code, reason = "shared with the tests on its own queries, which use more of it")]
#[path = "../oracle/mod.rs"]
mod oracle;
mod recorded;

use std::path::Path;

use oracle::trial::{Tally, kernel};
use recorded::file::{QueryFile, Recorded, read_folder};

/// False positives of the kernels on the committed queries.
const FALSE_POSITIVES: u64 = 25;

fn committed() -> Vec<QueryFile> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/ccd-queries");
    read_folder(&folder).unwrap()
}

#[test]
fn recorded_queries_are_f64_values_and_their_truth_is_that_of_the_oracle() {
    let mut meets = 0;
    for file in committed() {
        for recorded in &file.queries {
            let at = format!("{}:{}", file.name, recorded.line);
            assert!(!recorded.is_rounded, "{at}");
            assert_eq!(recorded.query.meets(), recorded.meets, "{at}");
            meets += u32::from(recorded.meets);
        }
    }
    assert!(meets > 50, "{meets}");
}

#[test]
fn no_recorded_meeting_is_missed_by_the_kernels() {
    let mut all = Tally::default();
    for file in committed() {
        let queries = file.queries.iter().map(|recorded| &recorded.query);
        let tally = queries.fold(Tally::default(), |t, q| t.count(q, kernel));
        println!("{:<45}{tally}", file.name);
        all = all.plus(tally);
    }
    assert_eq!(all.false_negatives, 0, "{all}");
    assert!(all.false_positives <= FALSE_POSITIVES, "{all}");
}

#[test]
fn a_kernel_that_sees_nothing_misses_every_recorded_meeting() {
    let files = committed();
    let all = files.iter().flat_map(|file| &file.queries);
    let blind = |tally: Tally, recorded: &Recorded| tally.count(&recorded.query, |_| false);
    let tally = all.fold(Tally::default(), blind);
    assert_eq!([tally.false_negatives, tally.false_positives], [tally.meets, 0]);
    assert_eq!(tally.meets, 225);
}
