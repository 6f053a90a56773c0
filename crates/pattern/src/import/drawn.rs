//! From the strokes of a drawing to a pattern.

use glam::{DAffine2, DVec2};

use super::assemble::Assembled;
use super::drawing::{Drawing, Line, bounds};
use super::stroke::{Piece, Stroke};
use super::warning::{WarningKind, Warnings};
use super::{
    CURVE_TOLERANCE, CurvedFacets, ImportError, ImportOptions, ImportedPattern, LengthUnit,
    MOST_LINES, MergeTolerance, border, paper_grid, pieces, plan_of, rulings, tolerance,
};

/// A drawing farther from the origin than this, in its diagonals, is moved there, so that no digits are lost.
const FAR: f64 = 100.0;

/// What a file draws.
pub(super) struct Drawn {
    pub(super) title: Option<String>,
    pub(super) unit: LengthUnit,
    /// How long the drawing's own unit is in the units of its points.
    pub(super) scale: f64,
    /// Two opposite corners of the page, if it has one.
    pub(super) page: Option<[DVec2; 2]>,
    /// With y upwards.
    pub(super) strokes: Vec<Stroke>,
}

/// The pattern of a drawing.
pub(super) fn imported(
    mut drawn: Drawn,
    options: &ImportOptions,
    mut warnings: Warnings,
) -> Result<ImportedPattern, ImportError> {
    let [low, high] = drawn.bounds().ok_or(ImportError::Empty)?;
    let diagonal = low.distance(high);
    super::check_extent(low, high)?;
    if low.abs().max(high.abs()).max_element() > FAR * diagonal {
        drawn.shift(-low.midpoint(high));
    }
    let mut drawing = drawing(&mut drawn, options, diagonal, &mut warnings)?;
    let merge = options.merge.unwrap_or(MergeTolerance::DRAWING);
    if border::is_missing(&drawing) {
        let tolerance = tolerance::chosen(&drawing, merge, diagonal, drawn.scale)?;
        border::complete(&mut drawing, tolerance, drawn.page, &mut warnings)?;
    }
    let least = merge.length(diagonal, drawn.scale)?;
    paper_grid::find(&mut drawing, least, &mut warnings)?;
    let names = drawn.strokes.into_iter().map(|stroke| stroke.names);
    let mut names: Vec<_> = names.collect();
    names.resize_with(drawing.sources.len(), Default::default);
    let has_curves = drawing.lines.iter().any(|line| line.is_curved);
    let mut plan = plan_of(drawing, merge, drawn.scale, true, &mut warnings)?;
    plan = pieces::keep_creases_together(plan, &options.pieces, &mut warnings)?;
    if has_curves && options.curved_facets == CurvedFacets::Rulings {
        let tolerance = plan.mending.tolerance;
        rulings::end_on_borders(&mut plan, tolerance);
    }
    plan.has_rulings = options.curved_facets == CurvedFacets::Rulings;
    plan.mending.in_units_of_file(drawn.scale);
    let assembled = pieces::chosen(&plan, &options.pieces, &names, &mut warnings)?;
    let Assembled { sheet, targets, edge_lines, vertex_points } = assembled;
    let lines = edge_lines.into_iter();
    Ok(ImportedPattern {
        title: drawn.title,
        sheet,
        unit: drawn.unit,
        targets,
        stages: Vec::new(),
        fixed_facets: Vec::new(),
        edge_sources: lines.map(|l| Some(plan.lines[l? as usize].source)).collect(),
        names,
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

impl Drawn {
    /// The corners of the box around the ends and the control points of all pieces.
    fn bounds(&self) -> Option<[DVec2; 2]> {
        let pieces = self.strokes.iter().flat_map(|stroke| &stroke.pieces);
        let points: Vec<DVec2> = pieces.flat_map(Piece::points).copied().collect();
        bounds(&points)
    }

    fn shift(&mut self, by: DVec2) {
        let shift = DAffine2::from_translation(by);
        for piece in self.strokes.iter_mut().flat_map(|stroke| &mut stroke.pieces) {
            *piece = piece.transformed(&shift);
        }
        self.page = self.page.map(|corners| corners.map(|corner| corner + by));
    }
}

/// The lines of the strokes, curves as chords.
fn drawing(
    drawn: &mut Drawn,
    options: &ImportOptions,
    diagonal: f64,
    warnings: &mut Warnings,
) -> Result<Drawing, ImportError> {
    let tolerance = options.curve_tolerance.unwrap_or(CURVE_TOLERANCE);
    if !(1e-6..=0.1).contains(&tolerance) {
        return Err(ImportError::CurveTolerance { value: tolerance });
    }
    let mut drawing = Drawing::default();
    for (stroke, index) in drawn.strokes.iter().zip(0..) {
        drawing.sources.push(stroke.source.clone());
        for piece in &stroke.pieces {
            let is_curved = matches!(piece, Piece::Curve(_));
            if is_curved {
                warnings.add(WarningKind::Flattened, &stroke.source);
            }
            for ends in piece.chords(tolerance * diagonal).windows(2) {
                let first = drawing.points.len() as u32;
                drawing.points.extend_from_slice(ends);
                drawing.lines.push(Line {
                    ends: [first, first + 1],
                    role: stroke.role,
                    target: stroke.target,
                    source: index,
                    is_curved,
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
