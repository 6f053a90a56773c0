//! Tests the collision kernels, the verdict and its second proof on recorded queries and prints the results by file.
//!
//! `cargo run --release -p foldmotion-verify --example ccd_queries [FOLDER [COMPLETIONS [OUT]]]`
//!
//! FOLDER contains files `*vertex-face.csv` and `*edge-edge.csv` in the format of the benchmark of Wang et al. 2021
//! (Tight-Inclusion). Default: the committed share of it. Each query is given to the kernels, and converted to the
//! motion of two triangles in COMPLETIONS ways (default: 1). Motions with an error are written into the folder OUT as
//! FOLD files for `foldmotion check`. The exit status is 1 if the kernels missed a meeting or a motion has an error.

#![expect(clippy::print_stdout, reason = "an example that prints its table")]
#![expect(clippy::disallowed_methods, reason = "the tests compare the two proofs")]

#[path = "../tests/ccd_queries/completion.rs"]
mod completion;
#[path = "../../geometry/tests/oracle/mod.rs"]
#[expect(dead_code, reason = "shared with the tests on its own queries, which use more of it")]
mod oracle;
#[path = "../../geometry/tests/ccd_queries/recorded/mod.rs"]
mod recorded;
#[path = "../../check/tests/collision/sheets.rs"]
#[expect(dead_code, reason = "shared with the tests of folded sheets, which use more of it")]
mod sheets;
#[path = "../tests/ccd_queries/trial.rs"]
mod trial;

use std::{
    env,
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Instant,
};

use foldmotion_pattern::{Frame, Motion};
use glam::DVec3;
use oracle::trial::{Tally as KernelTally, kernel};
use recorded::file::{QueryFile, read_folder};
use trial::{Failure, Tally, judge, try_motions};

const LEGEND: &str = "\
FN, FP: false negatives and positives of the kernels. As motions: meet, by exact arithmetic; the verdict; F! free but
meeting, P! penetrating but apart, T! touching but apart, S! nearer than stated; the second proof;
refused. rounded: queries rounded to f64; truth: queries whose truth in the file is not that of exact arithmetic.";
const COLUMNS: &str = "  queries     meets said meet   FN        FP     FP % |   meet    free  touch  penet undec   F!   P!   T!   \
S! verified refuted unproved refused | rounded truth";
const COMMITTED: &str = "../geometry/tests/data/ccd-queries";

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let committed = || Path::new(env!("CARGO_MANIFEST_DIR")).join(COMMITTED);
    let folder = arguments.next().map_or_else(committed, PathBuf::from);
    let completions = arguments.next().map_or(Ok(1), |n| n.parse())?;
    let out = arguments.next().map(PathBuf::from);
    let start = Instant::now();
    println!("{LEGEND}\n{:<40}{COLUMNS}", "file");
    let (mut kernels, mut motions, mut odd) = (KernelTally::default(), Tally::default(), [0; 2]);
    for file in read_folder(&folder)? {
        let queries = file.queries.iter().map(|recorded| &recorded.query);
        let by_kernels = queries.fold(KernelTally::default(), |t, q| t.count(q, kernel));
        let as_motions = try_motions(&file, completions, judge);
        let [rounded, untrue] = oddities(&file);
        println!("{:<40}{by_kernels} |{as_motions} | {rounded} {untrue}", file.name);
        if let Some(out) = &out {
            write_failures(&file, &as_motions.failures, out)?;
        }
        kernels = kernels.plus(by_kernels);
        motions = motions.plus(as_motions);
        odd = [odd[0] + rounded, odd[1] + untrue];
    }
    println!("{:<40}{kernels} |{motions} | {} {}\n", "all", odd[0], odd[1]);
    motions.failures.iter().for_each(|failure| println!("{failure}"));
    println!("{:.1} s", start.elapsed().as_secs_f64());
    let is_wrong = kernels.false_negatives > 0 || !motions.failures.is_empty();
    Ok(ExitCode::from(u8::from(is_wrong)))
}

/// The number of queries that were rounded, and of queries whose truth in the file differs from exact arithmetic.
fn oddities(file: &QueryFile) -> [usize; 2] {
    let rounded = file.queries.iter().filter(|r| r.is_rounded);
    let untrue = file.queries.iter().filter(|r| r.query.meets() != r.meets);
    [rounded.count(), untrue.count()]
}

fn write_failures(
    file: &QueryFile,
    failures: &[Failure],
    out: &Path,
) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(out)?;
    let stem = file.name.trim_end_matches(".csv");
    for failure in failures {
        let at = file.queries.iter().find(|r| r.line == failure.line);
        if let Some(recorded) = at {
            let motion = completion::as_motion(&recorded.query, failure.completion);
            let Failure { line, completion, kind, .. } = failure;
            let name = format!("{stem}_{line}_{completion}_{kind:?}.fold");
            fs::write(out.join(name), fold_text(&motion))?;
        }
    }
    Ok(())
}

/// The motion as FOLD, with its first frame as key frame; numbers are read back as the same f64.
fn fold_text(motion: &Motion) -> String {
    let coordinates = |frame: &Frame| {
        let positions = frame.positions.iter().map(DVec3::to_array);
        format!("{:?}", positions.collect::<Vec<_>>())
    };
    let frame = |frame: &Frame| {
        let inherit = "\"frame_inherit\": true, \"frame_parent\": 0";
        format!("{{{inherit}, \"vertices_coords\": {}}}", coordinates(frame))
    };
    let later: Vec<String> = motion.frames[1..].iter().map(frame).collect();
    format!(
        "{{\"file_spec\": 1.2, \"foldmotion:unitLength\": {:?}, \"vertices_coords\": {},\n\"faces_vertices\": {:?},\n\
         \"file_frames\": [{}]}}\n",
        motion.sheet.unit_length,
        coordinates(&motion.frames[0]),
        motion.sheet.faces,
        later.join(",\n")
    )
}
