//! A page as SVG.
//!
//! One user unit is one millimetre. Every line is a `<line>` with its own attributes, in a group for each class that
//! Inkscape shows as a layer; no style sheets, no transforms. Colours and opacity are those that Origami Simulator
//! reads: #000 border, #f00 mountain, #00f valley, #ff0 facet, #f0f free hinge, and a crease's opacity is its fold
//! angle over 180°.

use std::f64::consts::PI;
use std::fmt::Write as _;

use super::text::{number, xml};
use super::{CutLine, CutPage, LineClass};

/// The colour of marks and labels, which Origami Simulator passes over.
const MARK: &str = "#888";

impl CutPage<'_> {
    /// The page as SVG 1.1, lengths in mm.
    pub fn svg(&self) -> String {
        let options = &self.pattern.options;
        let [width, height] = self.size.to_array().map(number);
        let mut svg = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" \
             version=\"1.1\" width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 0 {width} {height}\">\n\
             <title>{}</title>\n<desc>{}</desc>\n",
            xml(&options.title),
            xml(&options.note)
        );
        for class in LineClass::ALL {
            if self.of(class).next().is_some() {
                self.group(class, &mut svg);
            }
        }
        if self.number.is_some() {
            self.mark_group(&mut svg);
        }
        svg.push_str("</svg>\n");
        svg
    }

    fn group(&self, class: LineClass, svg: &mut String) {
        let options = &self.pattern.options;
        let mut common = format!(
            "stroke=\"{}\" stroke-width=\"{}\" fill=\"none\"",
            colour(class),
            number(options.stroke(self.size.length()))
        );
        let dashes = options.dashes(class, self.pattern.row);
        if !dashes.is_empty() {
            let dashes: Vec<String> = dashes.into_iter().map(number).collect();
            let _ = write!(common, " stroke-dasharray=\"{}\"", dashes.join(" "));
        }
        open_layer(class.name(), svg);
        for line in self.of(class) {
            let [from, to] = line.ends;
            let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(number);
            let _ = writeln!(
                svg,
                "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" {common}{}/>",
                opacity(line)
            );
        }
        svg.push_str("</g>\n");
    }

    fn mark_group(&self, svg: &mut String) {
        open_layer("marks", svg);
        let stroke = number(self.pattern.options.stroke(self.size.length()));
        for [from, to] in &self.marks {
            let [x1, y1, x2, y2] = [from.x, from.y, to.x, to.y].map(number);
            let _ = writeln!(
                svg,
                "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" stroke=\"{MARK}\" stroke-width=\"{stroke}\" fill=\"none\"/>"
            );
        }
        if let Some(label) = self.label() {
            let (corner, height) = self.label_position();
            let [x, y, height] = [corner.x, corner.y, height].map(number);
            let _ = writeln!(
                svg,
                "<text x=\"{x}\" y=\"{y}\" font-size=\"{height}\" font-family=\"sans-serif\" fill=\"{MARK}\">{}</text>",
                xml(&label)
            );
        }
        svg.push_str("</g>\n");
    }
}

fn open_layer(name: &str, svg: &mut String) {
    let _ =
        writeln!(svg, "<g id=\"{name}\" inkscape:groupmode=\"layer\" inkscape:label=\"{name}\">");
}

fn colour(class: LineClass) -> &'static str {
    match class {
        LineClass::Mountain => "#f00",
        LineClass::Valley => "#00f",
        LineClass::Free => "#f0f",
        LineClass::Facet => "#ff0",
        LineClass::Cut => "#000",
    }
}

/// A crease's fold angle over 180° as an attribute; nothing for other lines.
fn opacity(line: &CutLine) -> String {
    match line.class {
        LineClass::Mountain | LineClass::Valley => {
            format!(" stroke-opacity=\"{}\"", number(line.fold_angle.abs() / PI))
        }
        LineClass::Free | LineClass::Facet | LineClass::Cut => String::new(),
    }
}
