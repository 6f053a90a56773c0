//! The elements of an SVG, read from the outermost inwards.

use std::collections::BTreeMap;
use std::str::FromStr as _;

use glam::{DAffine2, DVec2};
use roxmltree::{Node, NodeId};
use svgtypes::Transform;

use super::super::colour::Meaning;
use super::super::drawing::Role;
use super::super::names::Names;
use super::super::stroke::{Piece, Stroke};
use super::super::unread::UnreadElements;
use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, MOST_NESTED, MOST_NODES, Source, UnknownElements};
use super::shape::{is_closed, outline};
use super::stroke::{opacity, stroke_meaning, target};
use super::style::{Properties, Styles};
use super::values::{length, wrong};
use super::{LineNumbers, viewport};

/// The properties that an element inherits from those around it.
#[derive(Debug, Clone, Copy)]
struct Inherited<'a> {
    transform: DAffine2,
    color: &'a str,
    fill: &'a str,
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
    by_id: BTreeMap<&'a str, Node<'a, 'a>>,
    unknown: UnknownElements,
    warnings: &'b mut Warnings,
    strokes: Vec<Stroke>,
    /// Closed outlines that are filled but have no stroke.
    filled: Vec<Stroke>,
    unread: UnreadElements,
    /// The names of the element being read and of those around it.
    names: Names,
    /// The elements that `use` elements around this one draw.
    used: Vec<NodeId>,
    /// The number of elements read, each as often as it is drawn.
    drawn: usize,
}

impl<'a, 'b> ElementReader<'a, 'b> {
    pub(super) fn new(
        root: Node<'a, 'a>,
        numbering: &'b LineNumbers,
        unknown: UnknownElements,
        warnings: &'b mut Warnings,
    ) -> Result<Self, ImportError> {
        let mut by_id = BTreeMap::new();
        for node in root.descendants() {
            if let Some(id) = node.attribute("id") {
                by_id.entry(id).or_insert(node);
            }
        }
        Ok(Self {
            numbering,
            styles: Styles::read(root, numbering, warnings)?,
            by_id,
            unknown,
            warnings,
            strokes: Vec::new(),
            filled: Vec::new(),
            unread: UnreadElements::default(),
            names: Names::default(),
            used: Vec::new(),
            drawn: 0,
        })
    }

    /// The lines drawn so far, and the elements that cannot be read. If no line is border, filled outlines are.
    pub(super) fn finish(mut self) -> (Vec<Stroke>, UnreadElements) {
        let has_border = self.strokes.iter().any(|stroke| stroke.role == Role::Border);
        for outline in self.filled {
            if has_border {
                self.warnings.add(WarningKind::NotDrawn, &outline.source);
            } else {
                self.warnings.add(WarningKind::FilledBorder, &outline.source);
                self.strokes.push(outline);
            }
        }
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
            color: "black",
            fill: "black",
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
        check("elements in each other", depth, MOST_NESTED)?;
        self.drawn += 1;
        check("elements drawn, also by <use>", self.drawn, MOST_NODES as usize)?;
        let outer = [self.names.ids.len(), self.names.classes.len()];
        if let Some(id) = node.attribute("id") {
            self.names.add_id(id);
        }
        for class in node.attribute("class").unwrap_or_default().split_whitespace() {
            self.names.add_class(class);
        }
        let visited = self.visit_named(node, around, depth);
        self.names.ids.truncate(outer[0]);
        self.names.classes.truncate(outer[1]);
        visited
    }

    fn visit_named(
        &mut self,
        node: Node<'a, 'a>,
        around: Inherited<'a>,
        depth: usize,
    ) -> Result<(), ImportError> {
        let name = node.tag_name().name();
        let is_container = is_drawn_container(name) || is_used_symbol(node, &self.used);
        if !is_container && !is_shape(name) && name != "use" {
            if matches!(name, "text" | "image" | "foreignObject") {
                self.warnings.add(WarningKind::Ignored, &self.numbering.source(node));
            }
            return Ok(());
        }
        let properties = self.styles.of(node);
        let mut own = self.inherit(node, around, &properties)?;
        if properties.display == Some("none") {
            own.is_visible = false;
            if !is_shape(name) {
                self.warnings.add(WarningKind::NotDrawn, &self.numbering.source(node));
                return Ok(());
            }
        }
        if name == "use" {
            return self.reuse(node, own, depth);
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

    /// Draws the element that a `use` names, shifted by its `x` and `y`.
    fn reuse(
        &mut self,
        node: Node<'a, 'a>,
        mut own: Inherited<'a>,
        depth: usize,
    ) -> Result<(), ImportError> {
        let named = node.attributes().find(|attribute| attribute.name() == "href");
        let href = named.map(|attribute| attribute.value().trim()).unwrap_or_default();
        let target = href.strip_prefix('#').and_then(|id| self.by_id.get(id)).copied();
        let Some(target) = target else {
            let shown: String = href.chars().take(40).collect();
            let reason = format!("<use> names {shown:?}, which is no element of the file");
            self.unread.add(self.numbering.source(node), reason);
            return Ok(());
        };
        if self.used.contains(&target.id()) || node.ancestors().any(|around| around == target) {
            let need = "an element must not use itself";
            return Err(wrong(node, self.numbering, "href", href, need));
        }
        if target.tag_name().name() == "symbol" && target.has_attribute("viewBox") {
            let reason = "a <symbol> with a viewBox is not read".to_owned();
            self.unread.add(self.numbering.source(node), reason);
            return Ok(());
        }
        let at = DVec2::new(length(node, self.numbering, "x")?, length(node, self.numbering, "y")?);
        own.transform *= DAffine2::from_translation(at);
        self.used.push(target.id());
        let drawn = self.visit(target, own, depth + 1);
        self.used.pop();
        drawn
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
        let given = |text: Option<&'a str>| text.filter(|t| *t != "inherit");
        own.color = given(properties.color).unwrap_or(own.color);
        own.fill = given(properties.fill).unwrap_or(own.fill);
        if let Some(stroke) = given(properties.stroke) {
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
            self.unstroked(node, own, source);
            return Ok(());
        };
        let pieces = self.placed(node, own.transform)?;
        let is_current = stroke.eq_ignore_ascii_case("currentcolor");
        let stroke = if is_current { own.color } else { stroke };
        let Some((role, alpha)) = self.role(stroke, &source) else {
            return Ok(());
        };
        if pieces.is_empty() {
            self.warnings.add(WarningKind::NotDrawn, &source);
            return Ok(());
        }
        self.strokes.push(Stroke {
            source,
            names: self.names.clone(),
            role,
            target: target(role, own.opacity * own.stroke_opacity * alpha),
            pieces,
        });
        Ok(())
    }

    /// The outline of an element where it is drawn.
    fn placed(&self, node: Node<'a, 'a>, transform: DAffine2) -> Result<Vec<Piece>, ImportError> {
        let pieces = outline(node, self.numbering)?.into_iter();
        let pieces: Vec<Piece> = pieces.map(|p| p.transformed(&transform)).collect();
        if pieces.iter().flat_map(Piece::points).all(|p| p.is_finite()) {
            return Ok(pieces);
        }
        let text = node.ancestors().find_map(|n| n.attribute("transform"));
        let need = "the element must stay within the numbers there are";
        Err(wrong(node, self.numbering, "transform", text.unwrap_or_default(), need))
    }

    /// The role of a stroke and the alpha of its colour; `None` if it is left out.
    fn role(&mut self, stroke: &str, source: &Source) -> Option<(Role, f64)> {
        let shown: String = stroke.chars().take(40).collect();
        match stroke_meaning(stroke) {
            Some((Meaning::Exact(role), alpha)) => Some((role, alpha)),
            Some((Meaning::Near(role), alpha)) => {
                let read = format!("{shown} as {}", role.name());
                self.warnings.add_as(WarningKind::NearColour, source, read);
                Some((role, alpha))
            }
            Some((Meaning::Auxiliary, _)) if self.unknown != UnknownElements::Refuse => {
                self.warnings.add_as(WarningKind::Auxiliary, source, shown);
                None
            }
            Some((Meaning::Auxiliary, _)) | None => {
                self.unread.add(source.clone(), format!("the stroke {shown:?} is unknown"));
                None
            }
        }
    }

    /// An element without a stroke: a filled one with a closed outline may be the border.
    fn unstroked(&mut self, node: Node<'a, 'a>, own: Inherited<'a>, source: Source) {
        let is_filled = own.is_visible && !matches!(own.fill, "none" | "transparent");
        let pieces = if is_filled && is_closed(node) {
            self.placed(node, own.transform).unwrap_or_default()
        } else {
            Vec::new()
        };
        if pieces.is_empty() {
            self.warnings.add(WarningKind::NotDrawn, &source);
            return;
        }
        let names = self.names.clone();
        self.filled.push(Stroke { source, names, role: Role::Border, target: 0.0, pieces });
    }
}

fn check(what: &'static str, found: usize, limit: usize) -> Result<(), ImportError> {
    if found <= limit {
        return Ok(());
    }
    Err(ImportError::TooMany { what, found, limit })
}

fn is_drawn_container(name: &str) -> bool {
    matches!(name, "svg" | "g" | "a" | "switch")
}

/// Whether an element is a `symbol` that a `use` draws.
fn is_used_symbol(node: Node<'_, '_>, used: &[NodeId]) -> bool {
    node.tag_name().name() == "symbol" && used.last() == Some(&node.id())
}

fn is_shape(name: &str) -> bool {
    matches!(name, "path" | "line" | "rect" | "polyline" | "polygon" | "circle" | "ellipse")
}
