//! The whole paper: its tables and figures rebuilt, its numbers beside ours.
//!
//! A [`PaperPart`] is what can be asked for; [`paper`] makes the parts in order and keeps each as soon as it is finished, so
//! that an interrupted run goes on where it was and a second one finds everything. After each part [`PaperRecord`]
//! (`paper.json`) and the page (`index.html`) are written anew from all that is there.

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
use self::motions::{CERTIFIED, Folding, finished, folding};
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

/// Told which part is at work and how much of it is done, from 0 to 1; answers whether to go on.
pub type PaperProgress<'a> = &'a (dyn Fn(PaperPart, f64) -> bool + Sync);

/// What a run left.
#[derive(Debug, Clone, PartialEq)]
pub struct PaperRun {
    /// `paper.json`.
    pub record: PaperRecord,
    /// How many pieces were computed.
    pub made: usize,
    /// How many were found finished.
    pub reused: usize,
}

/// Makes `parts` in `folder`: figures as SVG and PNG, `paper.json`, `index.html`.
///
/// Tables 1 and 2 and the boxes that need no simulation cost less than a second and are always there; table 1 is
/// measured anew each time. Everything else is kept in `parts/` and reused while version and inputs are the same. The
/// record and the page hold all that is finished in the folder, asked for now or before.
///
/// # Errors
/// [`PaperError`] of the step that failed; finished parts stay.
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
        go_on(progress, part, 0.0)?;
        make(&store, part, progress)?;
        publish(&store, &mut record)?;
        go_on(progress, part, 1.0)?;
    }
    let [made, reused] = store.counts();
    Ok(PaperRun {
        record,
        made,
        reused,
    })
}

fn go_on(progress: PaperProgress<'_>, part: PaperPart, done: f64) -> Result<(), PaperError> {
    if progress(part, done) {
        Ok(())
    } else {
        Err(PaperError::INTERRUPTED)
    }
}

/// Makes what a part needs and has not been made.
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
            each(
                &pairs(&CERTIFIED),
                part,
                progress,
                |&(model, case), done| folding(store, model, case, true, done).map(drop),
            )?;
            if part == PaperPart::FigureA1 {
                figures::draw(store, part, &|done| progress(part, done))?;
            }
        }
    }
    Ok(())
}

/// The models in all cases, the longest motions first, so that no core waits for the last one.
fn pairs<'a>(models: &[&'a str]) -> Vec<(&'a str, Case)> {
    let rows = |name: &str| foldmotion_pattern::find_model(name).map_or(0, |model| model.rows);
    let mut models = models.to_vec();
    models.sort_by_key(|name| std::cmp::Reverse(rows(name)));
    let cases = |model: &&'a str| CASES.map(|case| (*model, case));
    models.iter().flat_map(cases).collect()
}

/// Makes every item, on all cores; progress counts the finished ones.
fn each<T: Sync>(
    items: &[T],
    part: PaperPart,
    progress: PaperProgress<'_>,
    make: impl Fn(&T, motions::Done<'_>) -> Result<(), PaperError> + Sync,
) -> Result<(), PaperError> {
    let finished = AtomicUsize::new(0);
    let whole = || finished.load(Ordering::Relaxed) as f64;
    items.par_iter().try_for_each(|item| {
        make(item, &|_| progress(part, whole() / items.len() as f64))?;
        finished.fetch_add(1, Ordering::Relaxed);
        Ok(())
    })
}

/// Writes `paper.json` and `index.html` with all that is finished.
fn publish(store: &Store, record: &mut PaperRecord) -> Result<(), PaperError> {
    for row in &mut record.cases {
        let case = CASES.into_iter().find(|case| case.name() == row.case);
        let found = |contact| finished(store, &row.model, case?, contact).map(|f: Folding| f.row);
        let [motion, certificate] = [false, true].map(found);
        row.simulated = motion.as_ref().map(|motion| motion.compact);
        row.simulated_error = motion.as_ref().map(|motion| motion.error);
        let judged = certificate.as_ref().or(motion.as_ref());
        row.verdict = judged.map(|motion| motion.verdict);
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
