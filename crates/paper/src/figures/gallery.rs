//! Figures 6 to 9: the profiles deployed and folded, the shelter with its cut patterns.

use foldmotion_pattern::{Case, models};
use foldmotion_record::{Anchor, Drawing, View};
use glam::DVec2;

use super::panel::{Cell, SheetState, common_scale};
use super::pattern::{PatternPlacement, WORDS, caption, draw};
use super::{Composed, page};
use crate::PaperError;
use crate::targets::{CASES, sheet};
use foldmotion_study::UnitStudy;

/// Figure 6: the nine profiles, deployed.
pub(super) fn figure6() -> Result<Composed, PaperError> {
    let cell = DVec2::new(310.0, 250.0);
    let mut drawing = page(3.0 * 320.0 + 10.0, 3.0 * 285.0 + 5.0)?;
    for ((k, model), letter) in models().iter().enumerate().zip('a'..) {
        let study = sheet(model.name, Case::E)?;
        let state = SheetState::deployed(&study);
        let (x, y) = (10.0 + 320.0 * (k % 3) as f64, 5.0 + 285.0 * (k / 3) as f64);
        let scale = common_scale(std::slice::from_ref(&state), View::Iso, cell);
        let target = Cell::new(x, y, cell.x, cell.y);
        state.show(&mut drawing, View::Iso, target, scale)?;
        let name = model.name.replace('-', " ");
        let words = format!("({letter}) {name}, {}", counts(&study));
        caption(&mut drawing, DVec2::new(x + 0.5 * cell.x, y + cell.y + 18.0), words);
    }
    Ok((
        drawing,
        "Figure 6. The nine profiles deployed with units of case E; N_r × N_c of table 1. One camera, each profile as large \
         as its panel.",
    ))
}

/// Figure 7: two open profiles in four cases.
pub(super) fn figure7() -> Result<Composed, PaperError> {
    let drawing = four_cases([("chair", "(a) chair"), ("omega", "(b) capital omega")])?;
    Ok((
        drawing,
        "Figure 7. Open profiles in cases E, T, S and SII, deployed above and folded below; one camera, one scale a profile.",
    ))
}

/// Figure 8: two closed profiles in four cases.
pub(super) fn figure8() -> Result<Composed, PaperError> {
    let drawing = four_cases([("mushroom", "(a) mushroom"), ("bunny", "(b) Stanford bunny")])?;
    Ok((
        drawing,
        "Figure 8. Closed profiles in cases E, T, S and SII, deployed above and folded below; one camera, one scale a profile.",
    ))
}

fn counts(study: &UnitStudy) -> String {
    format!("{} × {}", study.units.rows, study.units.columns)
}

fn four_cases(blocks: [(&str, &str); 2]) -> Result<Drawing, PaperError> {
    let cell = DVec2::new(270.0, 240.0);
    let folded = 150.0;
    let block = cell.y + folded + 60.0;
    let mut drawing = page(4.0 * 280.0 + 10.0, 2.0 * block)?;
    for (k, (model, title)) in blocks.into_iter().enumerate() {
        let top = block * k as f64;
        drawing.words(DVec2::new(10.0, top + 20.0), title, 1.2 * WORDS, Anchor::Start);
        let studies: Vec<UnitStudy> =
            CASES.iter().map(|&case| sheet(model, case)).collect::<Result<_, _>>()?;
        let deployed: Vec<SheetState<'_>> = studies.iter().map(SheetState::deployed).collect();
        let compact: Vec<SheetState<'_>> = studies.iter().map(SheetState::compact).collect();
        let scale = common_scale(&deployed, View::Iso, cell).min(common_scale(
            &compact,
            View::Iso,
            DVec2::new(cell.x, folded),
        ));
        for (column, study) in studies.iter().enumerate() {
            let x = 10.0 + 280.0 * column as f64;
            let upper = Cell::new(x, top + 25.0, cell.x, cell.y);
            deployed[column].show(&mut drawing, View::Iso, upper, scale)?;
            let lower = Cell::new(x, top + 25.0 + cell.y, cell.x, folded);
            compact[column].show(&mut drawing, View::Iso, lower, scale)?;
            let words = format!("case {}, {}", study.units.unit.case.name(), counts(study));
            caption(&mut drawing, DVec2::new(x + 0.5 * cell.x, top + block - 15.0), words);
        }
    }
    Ok(drawing)
}

/// Figure 9: the shelter in four cases, deployed, folded and as a pattern.
pub(super) fn figure9() -> Result<Composed, PaperError> {
    let line = 250.0;
    let mut drawing = page(1000.0, 4.0 * line + 30.0)?;
    for (x, words) in [(165.0, "deployed"), (480.0, "folded"), (810.0, "cut pattern")] {
        caption(&mut drawing, DVec2::new(x, 20.0), words);
    }
    for ((k, case), letter) in CASES.into_iter().enumerate().zip('a'..) {
        let study = sheet("shelter", case)?;
        let top = 30.0 + line * k as f64;
        let states = [SheetState::deployed(&study), SheetState::compact(&study)];
        for (state, x) in states.iter().zip([10.0, 325.0]) {
            let cell = Cell::new(x, top, 310.0, line);
            state.show(&mut drawing, View::Iso, cell, 31.0)?;
        }
        let words = format!("({letter}) case {}, {}", case.name(), counts(&study));
        drawing.words(DVec2::new(10.0, top + 20.0), words, WORDS, Anchor::Start);
        let (scale, width) = (31.0, study.units.unit.width * study.units.columns as f64);
        let left = 810.0 - 0.5 * scale * width;
        let placement = PatternPlacement::new(DVec2::new(left, top + 15.0), scale, width);
        draw(&mut drawing, &study.units.sheet, &placement, 1.0, |_| true);
    }
    Ok((
        drawing,
        "Figure 9. The shelter in cases E, T, S and SII: deployed and folded as rendered here in place of the paper's \
         photographs, and the pattern to cut (black), with mountains red and valleys blue; all at one scale.",
    ))
}
