//! Figure A1: the motions of shelter, rolling paper and capital omega in four cases.

use foldmotion_record::{Anchor, View};
use glam::{DVec2, DVec3};

use super::panel::{Cell, SheetState, common_scale};
use super::pattern::{SMALL, WORDS};
use super::{Composed, page};
use crate::PaperError;
use crate::motions::{CERTIFIED, STRIP_TIMES, StoredMotion, finished};
use crate::store::Store;
use crate::targets::{CASES, sheet};
use foldmotion_study::UnitStudy;

/// The width and height of the cell of a state.
const CELL: DVec2 = DVec2::new(230.0, 150.0);
/// The width of the labels on the left.
const LEFT: f64 = 90.0;
/// The height of the title of a profile.
const TITLE: f64 = 40.0;

/// Figure A1: the motions with contact.
pub(super) fn figure_a1(store: &Store) -> Result<Composed, PaperError> {
    let block = TITLE + CASES.len() as f64 * (CELL.y + 6.0);
    let width = LEFT + STRIP_TIMES.len() as f64 * (CELL.x + 6.0);
    let mut drawing = page(width, block * CERTIFIED.len() as f64)?;
    for ((k, model), letter) in CERTIFIED.into_iter().enumerate().zip('a'..) {
        let top = block * k as f64;
        let title = format!("({letter}) {}", model.replace('-', " "));
        drawing.words(DVec2::new(10.0, top + 22.0), title, 1.2 * WORDS, Anchor::Start);
        let mut strips = Vec::new();
        for case in CASES {
            let folding = finished(store, model, case, true).ok_or(PaperError::INTERRUPTED)?;
            strips.push((sheet(model, case)?, folding));
        }
        let mut states = Vec::new();
        for (study, folding) in &strips {
            states.extend(folding.states.iter().map(|state| displayed(study, state)));
        }
        let scale = common_scale(&states, View::Iso, CELL);
        let times = STRIP_TIMES.len();
        for (index, state) in states.iter().enumerate() {
            let (row, column) = (index / times, index % times);
            let x = LEFT + (CELL.x + 6.0) * column as f64;
            let y = top + TITLE + (CELL.y + 6.0) * row as f64;
            state.show(&mut drawing, View::Iso, Cell::new(x, y, CELL.x, CELL.y), scale)?;
            let (study, folding) = &strips[row];
            if column == 0 {
                draw_labels(&mut drawing, DVec2::new(10.0, y + 0.5 * CELL.y), study, folding);
            }
            if row == 0 {
                let words = format!("t = {}", folding.states[column].0);
                let above = DVec2::new(x + 0.5 * CELL.x, y - 8.0);
                drawing.words(above, words, SMALL, Anchor::Middle);
            }
        }
    }
    Ok((
        drawing,
        "Figure A1. The motions computed here with contact, from the deployed state (t = 0) through the plane (t = 1) to the \
         compact state (t = 2); one camera, one scale a profile.",
    ))
}

fn draw_labels(
    drawing: &mut foldmotion_record::Drawing,
    at: DVec2,
    study: &UnitStudy,
    folding: &StoredMotion,
) {
    let case = format!("case {}", study.units.unit.case.name());
    drawing.words(at, case, WORDS, Anchor::Start);
    let below = at + DVec2::new(0.0, 16.0);
    let words = format!("verdict {}", folding.row.verdict);
    drawing.words(below, words, SMALL, Anchor::Start);
}

/// A state of a motion, turned as its stage is displayed: upright before it is flat, then like the compact state.
fn displayed<'a>(study: &'a UnitStudy, (time, positions): &(f64, Vec<DVec3>)) -> SheetState<'a> {
    let state = SheetState::new(study, study.turned(*time, positions));
    if *time > 1.0 { state.layered(study) } else { state }
}
