//! Plots of figures over motion time as SVG: panels one above the other on a shared axis.

mod axis;

use std::ops::Range;

use glam::DVec2;

use self::axis::Axis;
use crate::drawing::words_width;
use crate::{Anchor, Drawing, RecordError, Stroke};

/// Width of the picture and height of a panel, pixels.
const SIZE: [u32; 2] = [760, 190];
/// Height of the strip below the last panel that has the labels of the time axis, pixels.
const TIME_AXIS: u32 = 40;
/// The curves' area lies this far from the left, top, right and bottom edge of its panel, pixels.
const LEFT: f64 = 72.0;
const TOP: f64 = 24.0;
const RIGHT: f64 = 14.0;
const BOTTOM: f64 = 10.0;
/// Heights of the letters of titles and of all others, pixels.
const TITLE: f64 = 14.0;
const LABEL: f64 = 12.0;
/// Length of the colour samples in a legend and the space between its entries, pixels.
const SAMPLE: f64 = 18.0;
const LEGEND_GAP: f64 = 18.0;
/// Room for a name in a legend as a multiple of its width in our font: viewers may have only a wider one.
const NAME_WIDTH: f64 = 1.15;
/// The most ticks on a vertical axis and on the time axis.
const VALUE_TICKS: usize = 5;
const TIME_TICKS: usize = 9;
/// Length of a tick, pixels.
const TICK: f64 = 4.0;

const FRAME: [u8; 3] = [90, 90, 96];
const GRID: [u8; 3] = [226, 226, 230];
/// Colours that stay apart for the colour-blind and in grey (Okabe and Ito 2008), darkest first.
const COLOURS: [[u8; 3]; 4] = [[0, 0, 0], [0, 114, 178], [213, 94, 0], [0, 158, 115]];

/// One curve of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// The name of the curve in the legend.
    pub name: &'static str,
    /// (t, value), in order of t; the curve is interrupted where a value is not finite.
    pub points: Vec<(f64, f64)>,
}

/// One panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The quantity that it shows, with the unit.
    pub title: &'static str,
    /// Whether the vertical axis is logarithmic; curves are then interrupted where a value is not positive.
    pub is_logarithmic: bool,
    /// The curves of the panel, at most four.
    pub curves: Vec<Curve>,
}

/// Draws the panels over t as an SVG document. Empty panels show their axes.
///
/// # Errors
/// [`RecordError::Size`] if there are too many panels for one picture, [`RecordError::Font`].
pub fn plots(panels: &[Panel]) -> Result<String, RecordError> {
    let count = panels.len().max(1) as u32;
    let mut drawing = Drawing::new([SIZE[0], SIZE[1].saturating_mul(count) + TIME_AXIS])?;
    let time = times(panels);
    for (index, panel) in panels.iter().enumerate() {
        let chart =
            Chart { top: f64::from(SIZE[1]) * index as f64, time: &time, value: values(panel) };
        chart.draw_axes(&mut drawing, index + 1 == panels.len());
        for (curve, color) in panel.curves.iter().zip(COLOURS) {
            for part in drawn_parts(curve, panel.is_logarithmic) {
                let points = part.iter().map(|&(t, v)| chart.point(t, v));
                drawing.line(points, Stroke::new(color, 2.0));
            }
        }
        let title = DVec2::new(LEFT, chart.top + TOP - 8.0);
        drawing.words(title, panel.title, TITLE, Anchor::Start);
        draw_legend(&mut drawing, panel, title.y)?;
    }
    drawing.svg()
}

/// The ends of the time axis of [`plots`]: the fraction of the picture's width from its left edge, and the motion time.
pub(crate) fn time_axis(panels: &[Panel]) -> [(f64, f64); 2] {
    let Range { start, end } = times(panels).range;
    let width = f64::from(SIZE[0]);
    [(LEFT / width, start), ((width - RIGHT) / width, end)]
}

/// The coordinates of one panel.
struct Chart<'a> {
    /// The upper edge of the panel in the picture, pixels.
    top: f64,
    time: &'a Axis,
    value: Axis,
}

impl Chart<'_> {
    /// The left upper and the right lower corner of the curves' area.
    fn corners(&self) -> [DVec2; 2] {
        let [width, height] = SIZE.map(f64::from);
        [DVec2::new(LEFT, self.top + TOP), DVec2::new(width - RIGHT, self.top + height - BOTTOM)]
    }

    fn point(&self, time: f64, value: f64) -> DVec2 {
        let [low, high] = self.corners();
        let across = self.time.fraction(time);
        let up = self.value.fraction(value);
        DVec2::new(low.x + across * (high.x - low.x), high.y - up * (high.y - low.y))
    }

    /// The frame, the grid and the labels; those of time only if `has_times`.
    fn draw_axes(&self, drawing: &mut Drawing, has_times: bool) {
        let [low, high] = self.corners();
        let (mut grid, mut marks) = (Vec::new(), Vec::new());
        for (time, label) in self.time.ticks(TIME_TICKS) {
            let x = self.point(time, self.value.range.start).x;
            let bottom = DVec2::new(x, high.y);
            grid.push([DVec2::new(x, low.y), bottom]);
            if has_times {
                let below = bottom + DVec2::new(0.0, TICK);
                marks.push([bottom, below]);
                drawing.words(below + DVec2::new(0.0, LABEL), label, LABEL, Anchor::Middle);
            }
        }
        for (value, label) in self.value.ticks(VALUE_TICKS) {
            let left = DVec2::new(low.x, self.point(self.time.range.start, value).y);
            grid.push([left, DVec2::new(high.x, left.y)]);
            let before = left - DVec2::new(TICK, 0.0);
            marks.push([before, left]);
            let beside = before + DVec2::new(-3.0, 0.35 * LABEL);
            drawing.words(beside, label, LABEL, Anchor::End);
        }
        if has_times {
            let below = DVec2::new(0.5 * (low.x + high.x), high.y + TICK + 2.5 * LABEL);
            drawing.words(below, "t", LABEL, Anchor::Middle);
        }
        drawing.lines(grid, Stroke::new(GRID, 1.0));
        let corner = DVec2::new(low.x, high.y);
        marks.extend([[low, corner], [corner, high]]);
        drawing.lines(marks, Stroke::new(FRAME, 1.0));
    }
}

/// The names of the curves after samples of their colours, at the top right; nothing if there is only one curve.
fn draw_legend(drawing: &mut Drawing, panel: &Panel, base: f64) -> Result<(), RecordError> {
    if panel.curves.len() < 2 {
        return Ok(());
    }
    let mut right = f64::from(SIZE[0]) - RIGHT;
    let curves: Vec<_> = panel.curves.iter().zip(COLOURS).collect();
    for (curve, color) in curves.into_iter().rev() {
        right -= NAME_WIDTH * words_width(curve.name, LABEL)?;
        drawing.words(DVec2::new(right, base), curve.name, LABEL, Anchor::Start);
        let end = DVec2::new(right - 6.0, base - 0.35 * LABEL);
        let sample = [end - DVec2::new(SAMPLE, 0.0), end];
        drawing.line(sample, Stroke::new(color, 3.0));
        right = end.x - SAMPLE - LEGEND_GAP;
    }
    Ok(())
}

/// The parts of the curve between values that cannot be drawn.
fn drawn_parts(curve: &Curve, is_logarithmic: bool) -> Vec<Vec<(f64, f64)>> {
    let is_drawn =
        |&(t, v): &(f64, f64)| t.is_finite() && v.is_finite() && (!is_logarithmic || v > 0.0);
    let parts = curve.points.split(|point| !is_drawn(point));
    parts.filter(|part| !part.is_empty()).map(<[_]>::to_vec).collect()
}

/// The time axis of all panels.
fn times(panels: &[Panel]) -> Axis {
    let all = panels.iter().flat_map(|p| &p.curves).flat_map(|c| &c.points).map(|p| p.0);
    let (low, high) = bounds(all).unwrap_or((0.0, 2.0));
    Axis { range: low..if high > low { high } else { low + 1.0 }, is_logarithmic: false }
}

/// The vertical axis of a panel.
fn values(panel: &Panel) -> Axis {
    let all = panel
        .curves
        .iter()
        .flat_map(|c| drawn_parts(c, panel.is_logarithmic))
        .flatten()
        .map(|p| p.1);
    let range = match (bounds(all), panel.is_logarithmic) {
        (Some((low, high)), true) => low / 1.5..high * 1.5,
        (Some((low, high)), false) if high > low => low.min(0.0)..high + 0.05 * (high - low),
        (Some((_, high)), false) if high > 0.0 => 0.0..high * 1.1,
        (Some((low, _)), false) if low < 0.0 => low * 1.1..0.0,
        (_, true) => 0.1..1.0,
        (_, false) => 0.0..1.0,
    };
    Axis { range, is_logarithmic: panel.is_logarithmic }
}

fn bounds(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|v| v.is_finite()).fold(None, |bounds, v| match bounds {
        None => Some((v, v)),
        Some((low, high)) => Some((v.min(low), v.max(high))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(is_logarithmic: bool, points: Vec<(f64, f64)>) -> Panel {
        Panel { title: "strain, %", is_logarithmic, curves: vec![Curve { name: "peak", points }] }
    }

    #[test]
    fn a_curve_is_drawn_once_a_part_and_cut_where_it_has_no_value() {
        let whole = vec![(0.0, 1.0), (1.0, 2.0), (2.0, 1.5)];
        let broken = vec![(0.0, 1.0), (0.5, 2.0), (1.0, f64::NAN), (1.5, 0.5), (2.0, 1.5)];
        let lines = |points: Vec<(f64, f64)>| {
            let svg = plots(&[panel(false, points)]).unwrap();
            svg.matches("stroke-width=\"2\"").count()
        };
        assert_eq!((lines(whole), lines(broken)), (1, 2));
    }

    #[test]
    fn a_curve_on_a_logarithmic_axis_is_interrupted_at_zero() {
        let points = vec![(0.0, 1e-3), (1.0, 0.0), (2.0, 1e-6)];
        assert_eq!(drawn_parts(&panel(true, points.clone()).curves[0], true).len(), 2);
        assert_eq!(drawn_parts(&panel(false, points).curves[0], false).len(), 1);
    }

    #[test]
    fn empty_and_constant_panels_are_drawn_too() {
        for points in
            [vec![], vec![(0.0, 0.0), (2.0, 0.0)], vec![(1.0, 3.0)], vec![(0.0, -1.0), (2.0, -1.0)]]
        {
            for is_logarithmic in [false, true] {
                let svg = plots(&[panel(is_logarithmic, points.clone())]).unwrap();
                assert!(svg.contains("strain, %") && svg.trim_end().ends_with("</svg>"));
            }
        }
    }

    #[test]
    fn the_same_panels_give_the_same_text() {
        let panels =
            [panel(false, vec![(0.0, 1.0), (2.0, 2.0)]), panel(true, vec![(0.0, 1.0), (2.0, 2.0)])];
        assert_eq!(plots(&panels).unwrap(), plots(&panels).unwrap());
    }
}
