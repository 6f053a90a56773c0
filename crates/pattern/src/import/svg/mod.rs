//! SVG as a crease pattern, by the colours of Origami Simulator (Ghassaei, Demaine, Gershenfeld 2018).

mod elements;
mod path;
mod shape;
mod stroke;
mod style;
mod values;
mod viewport;

use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};

use super::drawn::{Drawn, imported};
use super::encoding;
use super::entities::check_entities;
use super::warning::Warnings;
use super::{ImportError, ImportOptions, ImportedPattern, MOST_NODES, Source, check_size};
use elements::ElementReader;

/// Reads a crease pattern from SVG.
///
/// Strokes, in any notation of these colours: #000 border, of holes too · #f00 mountain, #00f valley, folding by 180°
/// times the opacity · #0f0 cut, opened · #ff0 facet line · #f0f free hinge. Other colours are read as the one of
/// these whose hue is near; grey and hues between them are auxiliary lines and are left out. `opacity` (of groups too),
/// `stroke-opacity` and the alpha of the colour multiply; 0 is an angle of 0. Widths and dashes mean nothing.
///
/// Read are `path`, `line`, `rect`, `polyline`, `polygon`, `circle` and `ellipse` in groups, links, nested `svg` and
/// `use` with transforms; styles by attribute, `style` and rules of `<style>` for elements, classes and ids. The last
/// segment of a closed path is a line as the others. Curves become chords ([`ImportOptions::curve_tolerance`]).
/// [`ImportOptions::unknown`] says what becomes of what cannot be read. If no line is border, closed outlines that are
/// filled and have no stroke are. Text, pictures and other elements without a stroke are left out with a warning.
///
/// Where `width` or `height` are in mm, cm, in, pt or pc, the sheet is in mm and has that size; otherwise it is in user
/// units without a physical length.
///
/// # Errors
/// [`ImportError`]; texts name elements by id and line.
pub fn import_svg(bytes: &[u8], options: &ImportOptions) -> Result<ImportedPattern, ImportError> {
    check_size(bytes)?;
    let text = encoding::text(bytes)?;
    check_entities(&text)?;
    let parsing = ParsingOptions {
        nodes_limit: MOST_NODES,
        // Drawing programs name a document type and entities in it.
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(&text, parsing)
        .map_err(|e| ImportError::Xml { message: e.to_string() })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(ImportError::NotSvg {
            found: root.tag_name().name().chars().take(40).collect(),
        });
    }
    let numbering = LineNumbers::new(&text);
    let mut warnings = Warnings::default();
    let viewport = viewport::outer(root, &numbering)?;
    // The sheet's y runs upwards.
    let upright = DAffine2::from_scale(DVec2::new(1.0, -1.0));
    let mut reader = ElementReader::new(root, &numbering, options.unknown, &mut warnings)?;
    reader.element(root, upright * viewport.transform)?;
    let (strokes, unread) = reader.finish();
    unread.settle(options.unknown, &mut warnings)?;
    let title = root.children().find(|c| c.has_tag_name("title") || is_svg(*c, "title"));
    let drawn = Drawn {
        title: title.and_then(|t| t.text()).map(str::to_owned),
        unit: viewport.unit,
        scale: viewport.scale,
        page: viewport.page.map(|corners| corners.map(|p| upright.transform_point2(p))),
        strokes,
    };
    imported(drawn, options, warnings)
}

fn is_svg(node: Node<'_, '_>, name: &str) -> bool {
    node.tag_name().name() == name
}

/// The lines on which elements begin.
struct LineNumbers {
    /// The byte at which each line begins.
    starts: Vec<usize>,
}

impl LineNumbers {
    fn new(text: &str) -> Self {
        let breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self { starts: std::iter::once(0).chain(breaks.map(|(at, _)| at + 1)).collect() }
    }

    fn source(&self, node: Node<'_, '_>) -> Source {
        let at = node.range().start;
        let line = self.starts.partition_point(|&start| start <= at);
        let column = at + 1 - self.starts[line - 1];
        Source::svg(node.tag_name().name(), node.attribute("id"), [line as u32, column as u32])
    }
}
