//! SVG as a crease pattern, by the colours of Origami Simulator (Ghassaei, Demaine, Gershenfeld 2018).

mod elements;
mod shape;
mod stroke;
mod style;
mod values;
mod viewport;

use glam::{DAffine2, DVec2};
use roxmltree::{Document, Node, ParsingOptions};

use super::assemble::{Assembled, assemble};
use super::drawing::{Drawing, Line};
use super::warning::{WarningKind, Warnings};
use super::{
    Curves, ImportError, ImportOptions, ImportedPattern, MOST_LINES, MOST_NODES, MergeTolerance,
    Source, UnknownElements, check_size, plan_of,
};
use elements::ElementReader;
use shape::{Piece, Stroke};

/// Reads a crease pattern from SVG.
///
/// Strokes, in any notation of these colours: #000 border, of holes too · #f00 mountain, #00f valley, folding by 180°
/// times the opacity · #0f0 cut, opened · #ff0 facet line · #f0f free hinge. `opacity` (of groups too),
/// `stroke-opacity` and the alpha of the colour multiply; 0 is an angle of 0. Widths, dashes and fills mean nothing.
///
/// Read are `path`, `line`, `rect`, `polyline` and `polygon` in groups, links and nested `svg` with transforms; styles
/// by attribute, `style` and rules of `<style>` for elements, classes and ids. The last segment of a closed path is a
/// line as the others. Bézier curves are flattened if the options say so. Elliptical arcs, circles, ellipses, rounded
/// rectangles and `use` are not read, nor are other colours: [`ImportOptions::unknown`] says what becomes of them.
/// Text, pictures and elements without a stroke are left out with a warning.
///
/// Where `width` or `height` are in mm, cm, in, pt or pc, the sheet is in mm and has that size; otherwise it is in user
/// units without a physical length.
///
/// # Errors
/// [`ImportError`]; texts name elements by id and line.
pub fn import_svg(bytes: &[u8], options: &ImportOptions) -> Result<ImportedPattern, ImportError> {
    check_size(bytes)?;
    let text =
        std::str::from_utf8(bytes).map_err(|e| ImportError::NotUtf8 { byte: e.valid_up_to() })?;
    let parsing = ParsingOptions {
        nodes_limit: MOST_NODES,
        // Drawing programs name a document type; one that defines entities could grow without bound.
        allow_dtd: !text.contains("<!ENTITY"),
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, parsing)
        .map_err(|e| ImportError::Xml { message: e.to_string() })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(ImportError::NotSvg {
            found: root.tag_name().name().chars().take(40).collect(),
        });
    }
    let numbering = LineNumbers::new(text);
    let mut warnings = Warnings::default();
    let viewport = viewport::outer(root, &numbering)?;
    let mut reader = ElementReader::new(root, &numbering, options, &mut warnings)?;
    reader.element(root, viewport.transform)?;
    let (strokes, unknown) = reader.finish();
    unknown.settle(options.unknown, &mut warnings)?;
    let drawing = drawing(&strokes, options.curves)?;
    let merge = options.merge.unwrap_or(MergeTolerance::DRAWING);
    let plan = plan_of(drawing, merge, viewport.scale, true, &mut warnings)?;
    let Assembled { sheet, targets, edge_lines, vertex_points } = assemble(&plan, &mut warnings)?;
    let lines = edge_lines.into_iter();
    let title = root.children().find(|c| c.has_tag_name("title") || is_svg(*c, "title"));
    Ok(ImportedPattern {
        title: title.and_then(|t| t.text()).map(str::to_owned),
        sheet,
        unit: viewport.unit,
        targets,
        stages: Vec::new(),
        fixed_facets: Vec::new(),
        edge_sources: lines.map(|l| Some(plan.lines[l? as usize].source)).collect(),
        sources: plan.sources,
        mending: plan.mending,
        vertex_sources: vec![None; vertex_points.len()],
        shape: None,
        warnings: warnings.finish(),
        keys: serde_json::Map::new(),
        face_orders: Vec::new(),
        listed: [0; 3],
    })
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

/// Elements that cannot be read.
#[derive(Default)]
struct UnreadElement {
    elements: Vec<Source>,
    reasons: std::collections::BTreeSet<String>,
}

impl UnreadElement {
    fn add(&mut self, element: Source, reason: String) {
        self.elements.push(element);
        self.reasons.insert(reason);
    }

    fn settle(self, unknown: UnknownElements, warnings: &mut Warnings) -> Result<(), ImportError> {
        if self.elements.is_empty() {
            return Ok(());
        }
        match unknown {
            UnknownElements::Refuse => Err(ImportError::Unknown {
                elements: self.elements,
                reasons: self.reasons.into_iter().take(20).collect(),
            }),
            UnknownElements::Ignore => {
                for element in &self.elements {
                    warnings.add(WarningKind::Ignored, element);
                }
                Ok(())
            }
        }
    }
}

/// The drawing of strokes, y upwards, curves as chords.
fn drawing(strokes: &[Stroke], curves: Curves) -> Result<Drawing, ImportError> {
    let ends = strokes.iter().flat_map(|s| s.pieces.iter().flat_map(Piece::points));
    let all: Vec<DVec2> = ends.copied().collect();
    let [low, high] = super::drawing::bounds(&all).ok_or(ImportError::Empty)?;
    let tolerance = match curves {
        Curves::Refuse => 0.1,
        Curves::Flatten(tolerance) => tolerance,
    };
    if !(1e-6..=0.1).contains(&tolerance) {
        return Err(ImportError::CurveTolerance { value: tolerance });
    }
    let mirrored = DAffine2::from_scale(DVec2::new(1.0, -1.0));
    let mut drawing = Drawing::default();
    for (stroke, index) in strokes.iter().zip(0..) {
        drawing.sources.push(stroke.source.clone());
        for piece in &stroke.pieces {
            let chords = piece.chords(tolerance * low.distance(high));
            for ends in chords.windows(2) {
                let first = drawing.points.len() as u32;
                drawing.points.extend([ends[0], ends[1]].map(|p| mirrored.transform_point2(p)));
                drawing.lines.push(Line {
                    ends: [first, first + 1],
                    role: stroke.role,
                    target: stroke.target,
                    source: index,
                });
            }
            if drawing.lines.len() > MOST_LINES {
                return Err(ImportError::TooMany {
                    what: "lines",
                    found: drawing.lines.len(),
                    limit: MOST_LINES,
                });
            }
        }
    }
    Ok(drawing)
}
