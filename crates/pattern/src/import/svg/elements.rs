//! The elements of an SVG, read from the outermost inwards.

use std::str::FromStr as _;

use glam::DAffine2;
use roxmltree::Node;
use svgtypes::Transform;

use super::super::warning::{WarningKind, Warnings};
use super::super::{Curves, ImportError, ImportOptions, MOST_NESTED};
use super::shape::{Outline, Piece, Stroke, outline};
use super::stroke::{meaning, opacity, target};
use super::style::{Properties, Styles};
use super::values::wrong;
use super::{LineNumbers, UnreadElement, viewport};

/// The properties that an element inherits from those around it.
#[derive(Debug, Clone, Copy)]
struct Inherited<'a> {
    transform: DAffine2,
    stroke: Option<&'a str>,
    stroke_opacity: f64,
    /// The product of the opacities of the element and of all around it.
    opacity: f64,
    is_visible: bool,
}

/// Reads elements and collects their lines.
pub(super) struct ElementReader<'a, 'b> {
    numbering: &'b LineNumbers,
    styles: Styles<'a>,
    flattens: bool,
    warnings: &'b mut Warnings,
    strokes: Vec<Stroke>,
    unread: UnreadElement,
}

impl<'a, 'b> ElementReader<'a, 'b> {
    pub(super) fn new(
        root: Node<'a, 'a>,
        numbering: &'b LineNumbers,
        options: &ImportOptions,
        warnings: &'b mut Warnings,
    ) -> Result<Self, ImportError> {
        Ok(Self {
            numbering,
            styles: Styles::read(root, numbering, warnings)?,
            flattens: matches!(options.curves, Curves::Flatten(_)),
            warnings,
            strokes: Vec::new(),
            unread: UnreadElement::default(),
        })
    }

    /// The lines drawn so far, and the elements that cannot be read.
    pub(super) fn finish(self) -> (Vec<Stroke>, UnreadElement) {
        (self.strokes, self.unread)
    }

    /// Walks over the root element, whose user units `transform` scales.
    pub(super) fn element(
        &mut self,
        root: Node<'a, 'a>,
        transform: DAffine2,
    ) -> Result<(), ImportError> {
        let around = Inherited {
            transform,
            stroke: None,
            stroke_opacity: 1.0,
            opacity: 1.0,
            is_visible: true,
        };
        self.visit(root, around, 0)
    }

    fn visit(
        &mut self,
        node: Node<'a, 'a>,
        around: Inherited<'a>,
        depth: usize,
    ) -> Result<(), ImportError> {
        if depth > MOST_NESTED {
            return Err(ImportError::TooMany {
                what: "elements in each other",
                found: depth,
                limit: MOST_NESTED,
            });
        }
        let name = node.tag_name().name();
        if !is_drawn_container(name) && !is_shape(name) {
            if matches!(name, "text" | "image" | "foreignObject") {
                self.warnings.add(WarningKind::Ignored, &self.numbering.source(node));
            }
            return Ok(());
        }
        let properties = self.styles.of(node);
        let mut own = self.inherit(node, around, &properties)?;
        if properties.display == Some("none") {
            own.is_visible = false;
            if is_drawn_container(name) {
                self.warnings.add(WarningKind::NotDrawn, &self.numbering.source(node));
                return Ok(());
            }
        }
        if is_shape(name) {
            return self.shape(node, own);
        }
        if name == "svg" && depth > 0 {
            own.transform *= viewport::nested(node, self.numbering)?;
        }
        for child in node.children().filter(Node::is_element) {
            self.visit(child, own, depth + 1)?;
        }
        Ok(())
    }

    fn inherit(
        &self,
        node: Node<'a, 'a>,
        around: Inherited<'a>,
        properties: &Properties<'a>,
    ) -> Result<Inherited<'a>, ImportError> {
        let mut own = around;
        let parsed = |name, text: Option<&str>| match text.filter(|t| *t != "inherit") {
            None => Ok(None),
            Some(text) => opacity(text).map(Some).ok_or_else(|| {
                wrong(node, self.numbering, name, text, "a finite number is needed")
            }),
        };
        if let Some(stroke) = properties.stroke.filter(|s| *s != "inherit") {
            own.stroke = Some(stroke);
        }
        if let Some(opacity) = parsed("stroke-opacity", properties.stroke_opacity)? {
            own.stroke_opacity = opacity;
        }
        own.opacity *= parsed("opacity", properties.opacity)?.unwrap_or(1.0);
        match properties.visibility {
            Some("hidden" | "collapse") => own.is_visible = false,
            Some("visible") => own.is_visible = true,
            _ => {}
        }
        if let Some(text) = properties.transform.filter(|t| !t.is_empty() && *t != "none") {
            let need = "a list of SVG 1.1 transforms with finite numbers is needed";
            let parsed = Transform::from_str(text).ok();
            let finite = parsed.map(|t| [t.a, t.b, t.c, t.d, t.e, t.f]);
            let finite = finite.filter(|t| t.iter().all(|n| n.is_finite()));
            let list =
                finite.ok_or_else(|| wrong(node, self.numbering, "transform", text, need))?;
            own.transform *= DAffine2::from_cols_array(&list);
        }
        Ok(own)
    }

    fn shape(&mut self, node: Node<'a, 'a>, own: Inherited<'a>) -> Result<(), ImportError> {
        let source = self.numbering.source(node);
        let stroke = own.stroke.filter(|s| *s != "none" && *s != "transparent");
        let Some(stroke) = stroke.filter(|_| own.is_visible) else {
            self.warnings.add(WarningKind::NotDrawn, &source);
            return Ok(());
        };
        let pieces = match outline(node, self.numbering)? {
            Outline::Pieces(pieces) => pieces,
            Outline::UnreadElement(reason) => {
                self.unread.add(source, reason);
                return Ok(());
            }
            Outline::None => return Ok(()),
        };
        let Ok((role, alpha)) = meaning(stroke) else {
            let shown: String = stroke.chars().take(40).collect();
            self.unread.add(source, format!("the stroke {shown:?} is unknown"));
            return Ok(());
        };
        let has_curves = pieces.iter().any(|p| matches!(p, Piece::Curve(_)));
        if has_curves && !self.flattens {
            let reason =
                "curves (C, S, Q, T) of paths are not read unless they are to be flattened";
            self.unread.add(source, reason.to_owned());
            return Ok(());
        }
        if pieces.is_empty() {
            self.warnings.add(WarningKind::NotDrawn, &source);
            return Ok(());
        }
        let pieces = pieces.into_iter();
        let pieces: Vec<Piece> = pieces.map(|p| p.transformed(&own.transform)).collect();
        let is_finite = pieces.iter().flat_map(Piece::points).all(|p| p.is_finite());
        if !is_finite {
            let text = node.ancestors().find_map(|n| n.attribute("transform"));
            let need = "the element must stay within the numbers there are";
            return Err(wrong(node, self.numbering, "transform", text.unwrap_or_default(), need));
        }
        self.strokes.push(Stroke {
            source,
            role,
            target: target(role, own.opacity * own.stroke_opacity * alpha),
            pieces,
        });
        Ok(())
    }
}

fn is_drawn_container(name: &str) -> bool {
    matches!(name, "svg" | "g" | "a" | "switch")
}

fn is_shape(name: &str) -> bool {
    matches!(name, "path" | "line" | "rect" | "polyline" | "polygon" | "circle" | "ellipse" | "use")
}
