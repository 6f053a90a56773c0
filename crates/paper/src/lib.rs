//! Reproduces the tables and figures of the paper, and compares its numbers with those of foldmotion.
//!
//! [`paper`] computes the requested [`PaperPart`]s in order and stores each when it is finished, so that an interrupted run can
//! be continued and a second run reuses everything. After each part, [`PaperRecord`] (`paper.json`) and the page (`index.html`)
//! are written from all finished parts.
//!
//! ```
//! use foldmotion_paper::{PaperPart, paper};
//!
//! let folder = std::env::temp_dir().join(format!("foldmotion-paper-{}", std::process::id()));
//! let run = paper(&folder, &[PaperPart::Table2], &|_, _| true)?;
//! assert_eq!(run.record.table2.len(), 9);
//! std::fs::remove_dir_all(&folder).ok();
//! # Ok::<(), foldmotion_paper::PaperError>(())
//! ```

mod error;
mod figures;
mod motions;
mod page;
mod part;
mod printed;
mod record;
mod store;
mod tables;
mod targets;
mod unfoldings;

use std::sync::atomic::{AtomicUsize, Ordering};

use foldmotion_pattern::{Case, models};
use rayon::prelude::*;

use self::figures::Figure;
use self::motions::{CERTIFIED, StoredMotion, finished, folding};
use self::store::Store;
use self::targets::CASES;
use foldmotion_study::Destination;
use foldmotion_study::VERSION;

pub use self::error::PaperError;
pub use self::part::PaperPart;
pub use self::record::{
    CaseRow, CountRow, DivisionRow, FigureRow, MotionRow, PaperRecord, PrintedCounts,
    PrintedDivision, UnfoldingRow,
};

/// A function that is called with a part and the share of it that is done, from 0 to 1; returns whether to continue.
pub type PaperProgress<'a> = &'a (dyn Fn(PaperPart, f64) -> bool + Sync);

/// The result of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperRun {
    /// The content of `paper.json`.
    pub record: PaperRecord,
    /// The number of tables, figures and motions that were computed.
    pub computed: usize,
    /// The number of those that were reused.
    pub reused: usize,
}

/// Reproduces `parts` in `destination`: figures as SVG and PNG, `paper.json`, `index.html`.
///
/// Tables 1 and 2 and the boxes without simulation take less than a second and are always computed. Everything else is stored
/// in `parts/` and reused while version and inputs are the same. The record and the page contain all parts that are finished
/// in the folder, requested now or before.
///
/// # Errors
/// [`PaperError`] of the step that failed; finished parts are kept.
pub fn paper<'a>(
    destination: impl Into<Destination<'a>>,
    parts: &[PaperPart],
    progress: PaperProgress<'_>,
) -> Result<PaperRun, PaperError> {
    let destination = destination.into();
    let folder = destination.folder();
    if !destination.replaces_all() {
        store::require_clear(folder)?;
    }
    let store = Store::open(folder)?;
    let mut record = PaperRecord {
        version: VERSION.to_owned(),
        table1: tables::table1()?,
        table2: tables::table2(),
        cases: tables::cases()?,
        unfoldings: Vec::new(),
        figures: Vec::new(),
    };
    publish(&store, &mut record)?;
    for &part in parts {
        report_progress(progress, part, 0.0)?;
        make(&store, part, progress)?;
        publish(&store, &mut record)?;
        report_progress(progress, part, 1.0)?;
    }
    let [computed, reused] = store.counts();
    Ok(PaperRun { record, computed, reused })
}

fn report_progress(
    progress: PaperProgress<'_>,
    part: PaperPart,
    done: f64,
) -> Result<(), PaperError> {
    if progress(part, done) { Ok(()) } else { Err(PaperError::INTERRUPTED) }
}

/// Computes what is missing of a part.
fn make(store: &Store, part: PaperPart, progress: PaperProgress<'_>) -> Result<(), PaperError> {
    let all: Vec<&str> = models().iter().map(|model| model.name).collect();
    match part {
        PaperPart::Table1 | PaperPart::Table2 => {}
        PaperPart::Figure(_) => figures::draw(store, part, &|done| progress(part, done))?,
        PaperPart::Unfoldings => each(&all, part, progress, |model, done| {
            unfoldings::unfolding(store, model, done).map(drop)
        })?,
        PaperPart::Cases => each(&pairs(&all), part, progress, |&(model, case), done| {
            folding(store, model, case, false, done).map(drop)
        })?,
        PaperPart::Certificates | PaperPart::FigureA1 => {
            each(&pairs(&CERTIFIED), part, progress, |&(model, case), done| {
                folding(store, model, case, true, done).map(drop)
            })?;
            if part == PaperPart::FigureA1 {
                figures::draw(store, part, &|done| progress(part, done))?;
            }
        }
    }
    Ok(())
}

/// The models in all cases, the longest motions first, so that all cores finish at about the same time.
fn pairs<'a>(models: &[&'a str]) -> Vec<(&'a str, Case)> {
    let rows = |name: &str| foldmotion_pattern::find_model(name).map_or(0, |model| model.rows);
    let mut models = models.to_vec();
    models.sort_by_key(|name| std::cmp::Reverse(rows(name)));
    let cases = |model: &&'a str| CASES.map(|case| (*model, case));
    models.iter().flat_map(cases).collect()
}

/// Computes all items in parallel; progress counts the finished ones.
fn each<T: Sync>(
    items: &[T],
    part: PaperPart,
    progress: PaperProgress<'_>,
    make: impl Fn(&T, motions::PartProgress<'_>) -> Result<(), PaperError> + Sync,
) -> Result<(), PaperError> {
    let finished = AtomicUsize::new(0);
    let whole = || finished.load(Ordering::Relaxed) as f64;
    items.par_iter().try_for_each(|item| {
        make(item, &|_| progress(part, whole() / items.len() as f64))?;
        finished.fetch_add(1, Ordering::Relaxed);
        Ok(())
    })
}

/// Writes `paper.json` and `index.html` from all finished parts.
fn publish(store: &Store, record: &mut PaperRecord) -> Result<(), PaperError> {
    for row in &mut record.cases {
        let case = CASES.into_iter().find(|case| case.name() == row.case);
        let found =
            |contact| finished(store, &row.model, case?, contact).map(|f: StoredMotion| f.row);
        let [motion, certificate] = [false, true].map(found);
        row.simulated = motion.as_ref().map(|motion| motion.compact);
        row.simulated_error = motion.as_ref().map(|motion| motion.error);
        let checked = certificate.as_ref().or(motion.as_ref());
        row.verdict = checked.map(|motion| motion.verdict);
        (row.motion, row.certificate) = (motion, certificate);
    }
    let unfolded =
        |model: &foldmotion_pattern::ProfileModel| unfoldings::finished(store, model.name);
    let found = models().iter().filter_map(unfolded);
    record.unfoldings = found.flatten().collect();
    let drawn: Vec<Figure> = figures::finished(store);
    record.figures = drawn.iter().map(|figure| figure.row.clone()).collect();
    store.write_file(store::RECORD, record.to_json().as_bytes())?;
    store.write_file(store::PAGE, page::page(record, &drawn).as_bytes())
}

/// The JSON schema of `paper.json`.
pub fn paper_schema() -> String {
    foldmotion_study::schema_text::<PaperRecord>()
}
