//! Drawings as SVG.

use std::fmt::Write as _;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::DVec2;

use super::label::runs;
use super::png::png;
use super::provenance::escaped;
use super::{Anchor, Drawing, Item, PIXELS_A_UNIT, Stroke, WORDS};
use crate::RecordError;

impl Drawing {
    /// The drawing as an SVG document; pictures are PNGs inside it.
    ///
    /// # Errors
    /// [`RecordError::Png`].
    pub fn svg(&self) -> Result<String, RecordError> {
        let mut svg = self.head();
        for item in &self.items {
            match item {
                Item::Area { outline, color } => {
                    let (path, color) = (path(outline, true), hex(*color));
                    let _ = writeln!(svg, "<path d=\"{path}\" fill=\"{color}\"/>");
                }
                Item::Shape { rings, color, bleed } => svg.push_str(&shape(rings, *color, *bleed)),
                Item::Line { points, stroke } => svg.push_str(&line(&path(points, false), stroke)),
                Item::Lines { parts, stroke } => {
                    let path: String = parts.iter().map(|part| short_path(part, false)).collect();
                    svg.push_str(&line(&path, stroke));
                }
                Item::Words { at, text, size, anchor } => {
                    svg.push_str(&words(*at, text, *size, *anchor));
                }
                Item::Picture { at, image } => {
                    let [x, y] = [at.x, at.y].map(number);
                    let [w, h] = [image.width, image.height]
                        .map(|side| number(f64::from(side) / f64::from(PIXELS_A_UNIT)));
                    let data = STANDARD.encode(png(image)?);
                    let _ = writeln!(
                        svg,
                        "<image x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" \
                         href=\"data:image/png;base64,{data}\"/>"
                    );
                }
            }
        }
        svg.push_str("</svg>\n");
        Ok(svg)
    }

    /// The page: its size, what it says of itself, its background.
    fn head(&self) -> String {
        let [width, height] = self.size;
        let [across, down] = self.size.map(|side| match self.unit {
            Some(unit) => format!("{}mm", number(f64::from(side) * unit)),
            None => side.to_string(),
        });
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{across}\" height=\"{down}\" \
             viewBox=\"0 0 {width} {height}\">\n"
        );
        if let Some(provenance) = &self.provenance {
            let (title, rdf) = (escaped(&provenance.title), provenance.rdf());
            let _ = writeln!(svg, "<title>{title}</title>\n<metadata>\n{rdf}</metadata>");
        }
        if let Some(background) = self.background {
            let color = hex(background);
            let _ = writeln!(svg, "<rect width=\"{width}\" height=\"{height}\" fill=\"{color}\"/>");
        }
        svg
    }
}

fn shape(rings: &[Vec<DVec2>], color: [u8; 3], bleed: f64) -> String {
    let path: String = rings.iter().map(|ring| short_path(ring, true)).collect();
    let color = hex(color);
    let outline = if bleed > 0.0 {
        let width = number(bleed);
        format!(" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"")
    } else {
        String::new()
    };
    format!("<path d=\"{path}\" fill=\"{color}\"{outline}/>\n")
}

fn line(path: &str, stroke: &Stroke) -> String {
    let dash = match stroke.dash {
        Some([dash, gap, second, last]) if [dash, gap] == [second, last] => {
            format!(" stroke-dasharray=\"{} {}\"", number(dash), number(gap))
        }
        Some(lengths) => {
            let lengths = lengths.map(number).join(" ");
            format!(" stroke-dasharray=\"{lengths}\"")
        }
        None => String::new(),
    };
    format!(
        "<path d=\"{path}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" \
         stroke-linejoin=\"round\"{dash}/>\n",
        hex(stroke.color),
        number(stroke.width),
    )
}

fn words(at: DVec2, text: &str, size: f64, anchor: Anchor) -> String {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let mut svg = format!(
        "<text x=\"{}\" y=\"{}\" font-family=\"Ubuntu, 'Segoe UI', 'DejaVu Sans', sans-serif\" \
         font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\">",
        number(at.x),
        number(at.y),
        number(size),
        hex(WORDS),
    );
    let mut height = 0.0;
    for run in runs(text) {
        let letters = escaped(&run.text);
        if run.rise == height && run.scale == 1.0 {
            svg.push_str(&letters);
            continue;
        }
        // dy counts from the letters before.
        let (dy, font) = ((height - run.rise) * size, run.scale * size);
        height = run.rise;
        let _ = write!(
            svg,
            "<tspan dy=\"{}\" font-size=\"{}\">{letters}</tspan>",
            number(dy),
            number(font)
        );
    }
    svg.push_str("</text>\n");
    svg
}

fn path(points: &[DVec2], closed: bool) -> String {
    let mut path = String::new();
    for (letter, point) in std::iter::once('M').chain(std::iter::repeat('L')).zip(points) {
        let _ = write!(path, "{letter}{} {}", number(point.x), number(point.y));
    }
    if closed {
        path.push('Z');
    }
    path
}

/// [`path`] to a hundredth of a unit and without the letters that go without saying: shapes have many corners.
fn short_path(points: &[DVec2], closed: bool) -> String {
    let mut path = String::new();
    for (k, point) in points.iter().enumerate() {
        let [x, y] = point.to_array().map(|value| trimmed(&format!("{value:.2}")));
        let _ = write!(path, "{}{x} {y}", if k == 0 { 'M' } else { ' ' });
    }
    if closed {
        path.push('Z');
    }
    path
}

/// To a thousandth of a unit.
fn number(value: f64) -> String {
    trimmed(&format!("{value:.3}"))
}

fn trimmed(decimals: &str) -> String {
    let text = decimals.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0" } else { text }.to_owned()
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
