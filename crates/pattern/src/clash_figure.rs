//! A drawing of rows whose creases need not meet (figure 10 of the paper).

use std::fmt::Write as _;

use crate::{Assignment, PatternError, Unit, UnitSheet, clashes};

/// Size of the longer side of the drawing, in pixels.
const SIZE: f64 = 600.0;
/// White around the drawing, in pixels; which holds the names of the rows.
const MARGIN: f64 = 60.0;

/// One column as SVG, row 0 on top: each row with its own creases (mountains solid red, valleys dashed blue) and the
/// name of its case; boundaries on which two rows clash are thick, with a dot at every crease that ends without a
/// partner, above the boundary for the upper row, below it for the lower one.
///
/// # Errors
/// As [`UnitSheet::new`] for each row.
pub fn clash_figure(units: &[Unit]) -> Result<String, PatternError> {
    let width = units.iter().map(|unit| unit.width).fold(0.0, f64::max);
    let height: f64 = units.iter().map(|unit| unit.height).sum();
    let scale = SIZE / width.max(height);
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0}\" height=\"{:.0}\" font-family=\"sans-serif\" font-size=\"14\">",
        width * scale + 2.0 * MARGIN,
        height * scale + 2.0 * MARGIN
    );
    let _ = writeln!(out, "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>");
    let mut tops = vec![MARGIN];
    for (row, unit) in units.iter().enumerate() {
        draw_row(&mut out, row, unit, tops[row], scale)?;
        tops.push(tops[row] + unit.height * scale);
    }
    for clash in clashes(units) {
        let at = tops[clash.row + 1];
        let _ = writeln!(
            out,
            "<g class=\"clash\"><title>{}</title><line x1=\"{MARGIN}\" y1=\"{at:.3}\" x2=\"{:.3}\" y2=\"{at:.3}\" stroke=\"orange\" stroke-width=\"5\" stroke-opacity=\"0.6\"/>",
            clash.name(),
            MARGIN + width * scale
        );
        for (ends, shift) in clash.ends.iter().zip([-4.0, 4.0]) {
            for y in ends {
                let _ = writeln!(
                    out,
                    "<circle cx=\"{:.3}\" cy=\"{:.3}\" r=\"4\" fill=\"black\"/>",
                    MARGIN + y * scale,
                    at + shift
                );
            }
        }
        let _ = writeln!(out, "</g>");
    }
    let _ = writeln!(out, "</svg>");
    Ok(out)
}

fn draw_row(
    out: &mut String,
    row: usize,
    unit: &Unit,
    top: f64,
    scale: f64,
) -> Result<(), PatternError> {
    // Rows alternate between two kinds: of two equal rows the second is drawn for an odd one.
    let odd = row % 2;
    let pair = UnitSheet::new(*unit, 2, 1)?.sheet;
    let is_own = |face: &Option<u32>| {
        face.is_some_and(|f| pair.facets[pair.face_facets[f as usize] as usize].row as usize == odd)
    };
    for edge in pair.edges.iter().filter(|e| e.faces.iter().any(is_own)) {
        let (colour, dash) = match edge.assignment {
            Assignment::Facet | Assignment::Free => continue,
            Assignment::Border => ("black", ""),
            Assignment::Mountain => ("red", ""),
            Assignment::Valley => ("blue", " stroke-dasharray=\"6 4\""),
        };
        let [from, to] = edge.vertices.map(|v| {
            let v = pair.vertices[v as usize];
            let down = -v.x - odd as f64 * unit.height;
            [MARGIN + v.y * scale, top + down * scale]
        });
        let _ = writeln!(
            out,
            "<line x1=\"{:.3}\" y1=\"{:.3}\" x2=\"{:.3}\" y2=\"{:.3}\" stroke=\"{colour}\"{dash}/>",
            from[0], from[1], to[0], to[1]
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.0}\" y=\"{:.3}\" text-anchor=\"end\">{}</text>",
        MARGIN - 10.0,
        top + unit.height * scale / 2.0,
        unit.case.name()
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{common_flap, own_cases};

    #[test]
    fn the_drawing_of_figure_10_marks_the_boundary_of_the_short_row_and_its_loose_ends() {
        let svg = clash_figure(&own_cases(1.0, &[1.0, 1.4, 0.6]).unwrap()).unwrap();
        assert_eq!(svg.matches("class=\"clash\"").count(), 1);
        assert!(svg.contains("<title>T against S</title>"));
        assert_eq!(svg.matches("<circle").count(), 4);
        // Below the rows of height 1 and 1.4, drawn 200 pixels to the unit.
        assert!(svg.contains("y1=\"540.000\""), "{svg}");
        for case in ["E", "T", "S"] {
            assert!(svg.contains(&format!(">{case}</text>")));
        }
    }

    #[test]
    fn a_column_with_one_flap_width_is_drawn_without_a_mark() {
        let rows = common_flap(1.0, &[1.0, 1.4, 0.6], 0.9, None).unwrap();
        let svg = clash_figure(&rows).unwrap();
        assert!(!svg.contains("clash") && svg.contains("stroke=\"blue\""));
    }
}
