//! Figures 3, 4 and 5: the units of cases T, S and SII and what they fold to.

use foldmotion_pattern::{Case, Unit};
use foldmotion_record::{Anchor, Drawing, View};
use glam::DVec2;

use super::panel::{Cell, SheetState, common_scale};
use super::pattern::{WORDS, caption, draw_unit};
use super::{Composed, page};
use crate::PaperError;
use crate::targets::{LAMBDA, sheet, unit_study};
use foldmotion_study::UnitStudy;

/// The profile on which the units are shown.
const MODEL: &str = "shelter";
/// The width of the sheet, in units of h.
const WIDTH: f64 = 5.0;

/// The width of the page.
const PAGE: f64 = 1000.0;
/// The height of a line of units with their deployed and compact states.
const LINE: f64 = 290.0;

/// The height of the line of units with d = 0.
const D_ZERO: f64 = 200.0;

/// Figure 3: tall units.
pub(super) fn figure3() -> Result<Composed, PaperError> {
    let mut drawing = page(PAGE, 2.0 * LINE)?;
    let plain = plain(7)?;
    let tall = sheet(MODEL, Case::T)?;
    line(&mut drawing, 0.0, ["a", "b", "c", "d"], "plain", &plain)?;
    line(&mut drawing, LINE, ["e", "f", "g", "h"], "case T", &tall)?;
    Ok((
        drawing,
        "Figure 3. Tall units (w < h) on the shelter. Unmodified they fold flat to a curved outline; with the middle \
         vertices split (case T) to a slim rectangle.",
    ))
}

/// Figure 4: short units.
pub(super) fn figure4() -> Result<Composed, PaperError> {
    let mut drawing = page(PAGE, 2.0 * LINE)?;
    let plain = plain(3)?;
    let short = sheet(MODEL, Case::S)?;
    line(&mut drawing, 0.0, ["a", "b", "c", "d"], "plain", &plain)?;
    line(&mut drawing, LINE, ["e", "f", "g", "h"], "case S", &short)?;
    Ok((
        drawing,
        "Figure 4. Short units (w > h) on the shelter. Unmodified, the state in which every crease is folded by 180° passes \
         through itself: the ends of a unit's middle line change places; with pads (case S) the sheet folds compactly.",
    ))
}

/// Figure 5: units of case SII.
pub(super) fn figure5() -> Result<Composed, PaperError> {
    let mut drawing = page(PAGE, LINE + D_ZERO)?;
    let width = WIDTH / 3.0;
    let failed = |e| PaperError::pattern("figure 5", e);
    let unit = Unit::new(Case::SII, width, 1.0, Some(LAMBDA), Some(0.0)).map_err(failed)?;
    two_units(&mut drawing, 0.0, ["a", "b"], "d = 0", &unit, D_ZERO - 20.0)?;
    let study = sheet(MODEL, Case::SII)?;
    line(&mut drawing, D_ZERO, ["c", "d", "e", "f"], "case SII", &study)?;
    Ok((
        drawing,
        "Figure 5. Case SII with λ = 0.7: split middle vertices without centre pad (d = 0), and with one (d = w_1'/2); the \
         compact state has facets on both skin planes.",
    ))
}

/// The shelter with unmodified rectangles.
fn plain(columns: usize) -> Result<UnitStudy, PaperError> {
    unit_study(format!(
        "[profile]\nmodel = \"{MODEL}\"\n[sheet]\ncase = \"plain\"\ncolumns = {columns}\nwidth = {WIDTH}\n"
    ))
}

/// Draws the two units of a case side by side.
fn two_units(
    drawing: &mut Drawing,
    top: f64,
    letters: [&str; 2],
    name: &str,
    unit: &Unit,
    caption_top: f64,
) -> Result<(), PaperError> {
    let scale = 140.0 / unit.width.max(unit.height);
    for (row, letter) in (0..).zip(letters) {
        let left = 45.0 + 215.0 * f64::from(row);
        let at = DVec2::new(left + 0.5 * (140.0 - scale * unit.width), top + 30.0);
        draw_unit(drawing, unit, row, at, scale)?;
        let kind = if row == 0 { "U^O" } else { "U^E" };
        caption(
            drawing,
            DVec2::new(left + 70.0, top + caption_top),
            format!("({letter}) {kind}, {name}"),
        );
    }
    Ok(())
}

/// Draws the two units of a sheet, and its deployed and compact states at one scale.
fn line(
    drawing: &mut Drawing,
    top: f64,
    letters: [&str; 4],
    name: &str,
    study: &UnitStudy,
) -> Result<(), PaperError> {
    two_units(drawing, top, [letters[0], letters[1]], name, &study.units.unit, LINE - 22.0)?;
    let is_flat = study.units.unit.side_pad == 0.0;
    let states = [SheetState::deployed(study), SheetState::compact(study)];
    let view = if is_flat { View::Front } else { View::Iso };
    let cell = DVec2::new(250.0, LINE - 50.0);
    let scale =
        common_scale(&states[..1], View::Iso, cell).min(common_scale(&states[1..], view, cell));
    let words = ["deployed", "folded"];
    for (k, state) in states.iter().enumerate() {
        let x = 460.0 + 270.0 * k as f64;
        let cell = Cell::new(x, top + 10.0, cell.x, cell.y);
        let view = if k == 0 { View::Iso } else { view };
        state.show(drawing, view, cell, scale)?;
        let below = DVec2::new(x + 125.0, top + LINE - 22.0);
        let words = format!("({}) {}", letters[2 + k], words[k]);
        drawing.words(below, words, WORDS, Anchor::Middle);
    }
    Ok(())
}
