//! Figure 10: a column whose rows have heights of their own, and the rows whose creases clash.

use foldmotion_pattern::{Case, Unit};
use foldmotion_record::{Anchor, Drawing, Stroke, Style};
use glam::DVec2;

use super::pattern::{PatternPlacement, SMALL, WORDS, caption, draw, one_column};
use super::{Composed, page};
use crate::PaperError;

/// The heights h_1 = w, h_2 > w, h_3 < w of the rows, in units of w.
const HEIGHTS: [f64; 3] = [1.0, 1.45, 0.6];
/// The size of the width w on the page.
const SCALE: f64 = 180.0;
/// Vertices closer than this, in units of w, meet.
const MEETING: f64 = 1e-9;

/// Figure 10: columns with rows of unequal height.
pub(super) fn figure10() -> Result<Composed, PaperError> {
    let mut drawing = page(760.0, 640.0)?;
    let plain = HEIGHTS.map(|height| Unit::new(Case::Plain, 1.0, height, None, None));
    let own = HEIGHTS.map(|height| {
        let case = Case::auto(1.0, height, None);
        Unit::new(case, 1.0, height, None, None)
    });
    let columns = [(plain, 90.0, "(a) unmodified"), (own, 450.0, "(b) each row by its own case")];
    for (units, x, words) in columns {
        let mut column = Vec::new();
        for unit in units {
            column.push(unit.map_err(|e| PaperError::pattern("figure 10", e))?);
        }
        draw_column(&mut drawing, &column, DVec2::new(x, 30.0))?;
        caption(&mut drawing, DVec2::new(x + 0.5 * SCALE, 620.0), words);
    }
    Ok((
        drawing,
        "Figure 10. A column whose segments have lengths of their own (h_1 = w, h_2 > w, h_3 < w). With every row modified by \
         its own case (E, T, S), the creases of the third row end beside those of the second: the circled vertices clash.",
    ))
}

fn draw_column(drawing: &mut Drawing, units: &[Unit], at: DVec2) -> Result<(), PaperError> {
    let mut top = at;
    let mut above: Option<Vec<f64>> = None;
    for (index, unit) in units.iter().enumerate() {
        let row = index as u32 % 2;
        let sheet = one_column(unit)?.sheet;
        let skip = f64::from(row) * unit.height;
        let placement = PatternPlacement { skip, ..PatternPlacement::new(top, SCALE, unit.width) };
        draw(drawing, &sheet, &placement, 1.4, |f| sheet.facets[f as usize].row == row);
        let ends = |depth: f64| -> Vec<f64> {
            let on_boundary = |v: &&DVec2| (v.x + skip + depth).abs() < MEETING;
            let mut ends: Vec<f64> =
                sheet.vertices.iter().filter(on_boundary).map(|v| v.y).collect();
            ends.sort_by(f64::total_cmp);
            ends
        };
        if let Some(above) = &above {
            let boundary = [top, top + DVec2::new(SCALE, 0.0)];
            drawing.line(boundary, Stroke::new(Style::default().mountain, 1.4));
            mark_clashes(drawing, above, &ends(0.0), &placement);
        }
        above = Some(ends(unit.height));
        let middle = top + DVec2::new(-14.0, 0.5 * SCALE * unit.height);
        let words = format!("h_{}", index + 1);
        drawing.words(middle, words, WORDS, Anchor::End);
        let right = top + DVec2::new(SCALE + 14.0, 0.5 * SCALE * unit.height);
        let case = match unit.case {
            Case::Plain => String::new(),
            case => format!("case {}", case.name()),
        };
        drawing.words(right, case, SMALL, Anchor::Start);
        top.y += SCALE * unit.height;
    }
    drawing.words(at + DVec2::new(0.5 * SCALE, -10.0), "w", WORDS, Anchor::Middle);
    Ok(())
}

/// Circles the vertices of each row that do not meet a vertex of the other.
fn mark_clashes(drawing: &mut Drawing, above: &[f64], below: &[f64], placement: &PatternPlacement) {
    let alone = |list: &[f64], others: &[f64]| -> Vec<f64> {
        let meets = |y: &f64| others.iter().any(|other| (other - y).abs() < MEETING);
        list.iter().copied().filter(|y| !meets(y)).collect()
    };
    for y in [alone(above, below), alone(below, above)].concat() {
        let centre = placement.at + DVec2::new(SCALE * (placement.width - y), 0.0);
        let corner = |k: i32| DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 24.0);
        let ring = (0..=24).map(|k| centre + 9.0 * corner(k));
        drawing.line(ring, Stroke::new([214, 120, 0], 2.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_third_row_clashes() {
        let caption = figure10().unwrap().1;
        assert!(caption.contains("clash"));
        let ends = |case, height: f64| -> Vec<f64> {
            let unit = Unit::new(case, 1.0, height, None, None).unwrap();
            let sheet = one_column(&unit).unwrap().sheet;
            let top = sheet.vertices.iter().filter(|v| v.x == 0.0);
            top.map(|v| v.y).collect()
        };
        assert_eq!(ends(Case::E, 1.0).len(), ends(Case::T, 1.45).len());
        assert_ne!(ends(Case::S, 0.6).len(), ends(Case::T, 1.45).len());
    }
}
