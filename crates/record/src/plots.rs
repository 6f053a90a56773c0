//! Plots of figures over motion time as SVG: panels one above the other on a shared axis.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::RecordError;

/// Width of the picture and height of a panel, pixels.
const SIZE: (u32, u32) = (760, 190);
/// Room for the axis below the last panel, pixels.
const AXIS: u32 = 34;
/// Room for the title above a panel, pixels.
const TITLE: i32 = 22;
/// Where the panels begin, with their title, pixels.
const PLOT_LEFT: i32 = 72;
/// Room to the right of the panels, pixels.
const MARGIN_RIGHT: i32 = 14;
/// Room for a name in the legend, pixels.
const LEGEND_STEP: u32 = 92;
/// Colours that stay apart for the colour-blind and in grey (Okabe and Ito 2008), darkest first.
const COLOURS: [RGBColor; 4] = [
    RGBColor(0, 0, 0),
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
];

/// One curve of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Its name in the legend.
    pub name: &'static str,
    /// (t, value), in order of t; values that are not finite are left out.
    pub points: Vec<(f64, f64)>,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// What it shows, with the unit.
    pub title: &'static str,
    /// Whether the values stand on a logarithmic axis; values of 0 are then left out.
    pub is_logarithmic: bool,
    /// At most four.
    pub curves: Vec<Curve>,
}

/// Draws the panels over t as an SVG document. Empty panels show their axes.
///
/// # Errors
/// [`RecordError::Plot`] where the drawing library refuses.
pub fn plots(panels: &[Panel]) -> Result<String, RecordError> {
    let mut svg = String::new();
    {
        let count = panels.len().max(1);
        let size = (SIZE.0, SIZE.1 * count as u32 + AXIS);
        let root = SVGBackend::with_string(&mut svg, size).into_drawing_area();
        root.fill(&WHITE).map_err(failed)?;
        let (upper, _) = root.split_vertically(size.1 - AXIS);
        let times = times(panels);
        for (index, (panel, area)) in panels
            .iter()
            .zip(upper.split_evenly((count, 1)))
            .enumerate()
        {
            let is_last = index + 1 == panels.len();
            draw(panel, &area, times.clone(), is_last)?;
        }
        root.present().map_err(failed)?;
    }
    Ok(svg)
}

/// Where the time axis of [`plots`] begins and ends: the part of the width from the left, and the motion time there.
pub(crate) fn time_axis(panels: &[Panel]) -> [(f64, f64); 2] {
    let times = times(panels);
    let place = |x: i32| f64::from(x) / f64::from(SIZE.0);
    [
        (place(PLOT_LEFT), times.start),
        (place(SIZE.0.cast_signed() - MARGIN_RIGHT), times.end),
    ]
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

fn draw(
    panel: &Panel,
    area: &Area<'_>,
    times: Range<f64>,
    is_last: bool,
) -> Result<(), RecordError> {
    let values = values(panel);
    let mut builder = ChartBuilder::on(area);
    builder
        .margin_top(TITLE)
        .margin_left(8)
        .margin_right(MARGIN_RIGHT)
        .x_label_area_size(if is_last { 30 } else { 8 })
        .y_label_area_size(PLOT_LEFT - 8);
    let x_labels = if is_last { 9 } else { 0 };
    // The two axes have different types, so the branches cannot share a variable.
    if panel.is_logarithmic {
        let mut chart = builder
            .build_cartesian_2d(times, values.log_scale())
            .map_err(failed)?;
        let mut mesh = chart.configure_mesh();
        mesh.x_labels(x_labels)
            .y_labels(5)
            .light_line_style(WHITE)
            .y_label_formatter(&|v| format!("{v:.0e}"));
        mesh.x_desc(if is_last { "t" } else { "" })
            .draw()
            .map_err(failed)?;
        for (curve, colour) in panel.curves.iter().zip(COLOURS) {
            for part in drawn_parts(curve, true) {
                chart
                    .draw_series(LineSeries::new(part, colour.stroke_width(2)))
                    .map_err(failed)?;
            }
        }
    } else {
        let mut chart = builder.build_cartesian_2d(times, values).map_err(failed)?;
        let mut mesh = chart.configure_mesh();
        mesh.x_labels(x_labels).y_labels(5).light_line_style(WHITE);
        mesh.x_desc(if is_last { "t" } else { "" })
            .draw()
            .map_err(failed)?;
        for (curve, colour) in panel.curves.iter().zip(COLOURS) {
            for part in drawn_parts(curve, false) {
                chart
                    .draw_series(LineSeries::new(part, colour.stroke_width(2)))
                    .map_err(failed)?;
            }
        }
    }
    area.draw(&Text::new(panel.title, (PLOT_LEFT, 4), ("sans-serif", 14)))
        .map_err(failed)?;
    legend(panel, area)
}

/// Names of the curves beside short strokes of their colours, at the top right.
fn legend(panel: &Panel, area: &Area<'_>) -> Result<(), RecordError> {
    if panel.curves.len() < 2 {
        return Ok(());
    }
    // From the right, so that names end where the panel ends.
    let first = SIZE.0 - MARGIN_RIGHT.cast_unsigned() - LEGEND_STEP * COLOURS.len() as u32;
    for (x, (curve, colour)) in (first.cast_signed()..)
        .step_by(LEGEND_STEP as usize)
        .zip(panel.curves.iter().zip(COLOURS))
    {
        area.draw(&PathElement::new(
            [(x, 12), (x + 18, 12)],
            colour.stroke_width(3),
        ))
        .map_err(failed)?;
        area.draw(&Text::new(curve.name, (x + 23, 6), ("sans-serif", 12)))
            .map_err(failed)?;
    }
    Ok(())
}

/// The curve cut where a value cannot be drawn.
fn drawn_parts(curve: &Curve, is_logarithmic: bool) -> Vec<Vec<(f64, f64)>> {
    let is_drawn =
        |&(t, v): &(f64, f64)| t.is_finite() && v.is_finite() && (!is_logarithmic || v > 0.0);
    let parts = curve.points.split(|point| !is_drawn(point));
    parts
        .filter(|part| !part.is_empty())
        .map(<[_]>::to_vec)
        .collect()
}

fn times(panels: &[Panel]) -> Range<f64> {
    let all = panels
        .iter()
        .flat_map(|p| &p.curves)
        .flat_map(|c| &c.points)
        .map(|p| p.0);
    let (low, high) = bounds(all).unwrap_or((0.0, 2.0));
    if high > low {
        low..high
    } else {
        low..low + 1.0
    }
}

fn values(panel: &Panel) -> Range<f64> {
    let all = panel
        .curves
        .iter()
        .flat_map(|c| drawn_parts(c, panel.is_logarithmic))
        .flatten()
        .map(|p| p.1);
    match (bounds(all), panel.is_logarithmic) {
        (Some((low, high)), true) => low / 1.5..high * 1.5,
        (Some((low, high)), false) if high > low => low.min(0.0)..high + 0.05 * (high - low),
        (Some((_, high)), false) if high > 0.0 => 0.0..high * 1.1,
        (_, true) => 0.1..1.0,
        (_, false) => 0.0..1.0,
    }
}

fn bounds(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|v| v.is_finite())
        .fold(None, |bounds, v| match bounds {
            None => Some((v, v)),
            Some((low, high)) => Some((v.min(low), v.max(high))),
        })
}

fn failed(error: impl std::fmt::Display) -> RecordError {
    RecordError::Plot {
        message: error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(is_logarithmic: bool, points: Vec<(f64, f64)>) -> Panel {
        Panel {
            title: "strain, %",
            is_logarithmic,
            curves: vec![Curve {
                name: "peak",
                points,
            }],
        }
    }

    #[test]
    fn a_curve_is_drawn_once_a_part_and_cut_where_it_has_no_value() {
        let whole = vec![(0.0, 1.0), (1.0, 2.0), (2.0, 1.5)];
        let broken = vec![
            (0.0, 1.0),
            (0.5, 2.0),
            (1.0, f64::NAN),
            (1.5, 0.5),
            (2.0, 1.5),
        ];
        let lines = |points: Vec<(f64, f64)>| {
            let svg = plots(&[panel(false, points)]).unwrap();
            svg.matches("stroke-width=\"2\"").count()
        };
        assert_eq!((lines(whole), lines(broken)), (1, 2));
    }

    #[test]
    fn zero_has_no_place_on_a_logarithmic_axis() {
        let points = vec![(0.0, 1e-3), (1.0, 0.0), (2.0, 1e-6)];
        assert_eq!(
            drawn_parts(&panel(true, points.clone()).curves[0], true).len(),
            2
        );
        assert_eq!(drawn_parts(&panel(false, points).curves[0], false).len(), 1);
    }

    #[test]
    fn empty_and_constant_panels_are_drawn_too() {
        for points in [
            vec![],
            vec![(0.0, 0.0), (2.0, 0.0)],
            vec![(1.0, 3.0)],
            vec![(0.0, -1.0), (2.0, -1.0)],
        ] {
            for is_logarithmic in [false, true] {
                let svg = plots(&[panel(is_logarithmic, points.clone())]).unwrap();
                assert!(svg.contains("strain, %") && svg.trim_end().ends_with("</svg>"));
            }
        }
    }

    #[test]
    fn the_same_panels_give_the_same_text() {
        let panels = [
            panel(false, vec![(0.0, 1.0), (2.0, 2.0)]),
            panel(true, vec![(0.0, 1.0), (2.0, 2.0)]),
        ];
        assert_eq!(plots(&panels).unwrap(), plots(&panels).unwrap());
    }
}
