//! The collision verdict and its second proof on recorded queries, each as the motion of two triangles: a share of the
//! hand-made scenes of a public benchmark.
//!
//! `cargo run --release -p foldmotion-verify --example ccd_queries FOLDER` does the same for a folder of such files.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]
#![expect(clippy::disallowed_methods, reason = "the tests compare the two proofs")]

mod completion;
#[path = "../../../geometry/tests/oracle/mod.rs"]
#[expect(dead_code, reason = "shared with the tests on its own queries, which use more of it")]
mod oracle;
#[path = "../../../geometry/tests/ccd_queries/recorded/mod.rs"]
mod recorded;
#[path = "../../../check/tests/collision/sheets.rs"]
#[expect(dead_code, reason = "shared with the tests of folded sheets, which use more of it")]
mod sheets;
mod trial;

use std::{collections::BTreeSet, path::Path};

use foldmotion_check::{CheckError, CollisionReport, Verdict};
use foldmotion_pattern::Motion;
use recorded::file::{QueryFile, read_folder};
use trial::{FailureKind, Judge, Tally, judge, try_completions, try_motions};

/// In how many ways each query is completed to triangles.
const COMPLETIONS: u64 = 8;
/// Queries on which the two proofs once disagreed in some of the first 100 completions, by file and first line.
const DIFFERED: [(&str, &[usize]); 4] = [
    ("erleben-spikes_edge-edge.csv", &[9, 33, 49, 57, 65, 121, 161]),
    ("erleben-spikes_vertex-face.csv", &[89, 97]),
    ("erleben-wedges_edge-edge.csv", &[113, 121, 129, 161]),
    ("erleben-wedges_vertex-face.csv", &[81]),
];

fn committed() -> Vec<QueryFile> {
    let data = "../geometry/tests/data/ccd-queries";
    read_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join(data)).unwrap()
}

fn try_committed(judge: Judge) -> Tally {
    let files = committed();
    let all = files.iter().map(|f| try_motions(f, COMPLETIONS, judge));
    all.fold(Tally::default(), Tally::plus)
}

/// Nothing may be wrong, and everything must be decided. Of these motions, which are grazes of slivers, the second
/// proof may leave one in a hundred open.
fn assert_no_failure(tally: &Tally) {
    let all = tally.free + tally.touching + tally.penetrating + tally.undecided;
    let is_open = |kind: FailureKind| kind == FailureKind::Unproved;
    let (open, wrong): (Vec<_>, Vec<_>) = tally.failures.iter().partition(|f| is_open(f.kind));
    let lines: Vec<_> = wrong.iter().map(ToString::to_string).collect();
    let count = lines.len();
    assert!(count == 0, "{count} of {all}:\n{}", lines.join("\n"));
    assert!(100 * open.len() <= all as usize, "{open:?}");
    assert_eq!([tally.undecided, tally.verified + open.len() as u32], [0, all]);
}

#[test]
fn recorded_meetings_are_never_free_and_the_second_proof_agrees() {
    let tally = try_committed(judge);
    assert_no_failure(&tally);
    assert!(tally.meets > 1000 && tally.free > 1000, "{tally}");
}

#[test]
fn both_proofs_agree_where_they_once_differed() {
    let mut tally = Tally::default();
    for file in committed() {
        let Some((_, lines)) = DIFFERED.iter().find(|(name, _)| *name == file.name) else {
            continue;
        };
        for line in *lines {
            let recorded = file.queries.iter().find(|r| r.line == *line).unwrap();
            tally = tally.plus(try_completions(&file.name, recorded, 100, judge));
        }
    }
    assert_no_failure(&tally);
    let count: usize = DIFFERED.iter().map(|(_, lines)| lines.len()).sum();
    let judged = tally.free + tally.touching + tally.penetrating;
    assert_eq!(judged as usize, 100 * count);
}

/// A judge whose reports hide every contact.
fn hide_contact(motion: &Motion) -> Result<CollisionReport, CheckError> {
    Ok(CollisionReport {
        verdict: Verdict::Free,
        first: None,
        penetrations: Vec::new(),
        undecided: Vec::new(),
        touching_pairs: 0,
        ..judge(motion)?
    })
}

#[test]
fn reports_that_hide_contact_are_counted_and_each_is_refuted() {
    let tally = try_committed(hide_contact);
    println!("{tally}");
    let of = |kind| {
        let failures = tally.failures.iter().filter(move |failure| failure.kind == kind);
        failures.map(|failure| (&failure.file, failure.line, failure.completion))
    };
    let refuted: BTreeSet<_> = of(FailureKind::Refuted).collect();
    let hidden: Vec<_> = of(FailureKind::FreeButMeeting).collect();
    assert_eq!(hidden.len(), tally.meets as usize);
    let believed = hidden.iter().find(|motion| !refuted.contains(motion));
    assert_eq!(believed, None);
}
