//! Crease patterns of ORIPA and Oriedita: `.cp`, a line of text for each line, and `.opx`, ORIPA's own XML.
//!
//! In both a line has a type: 0 auxiliary, 1 border, 2 mountain, 3 valley, 4 unassigned; y runs downwards. Sources:
//! Mitani's ORIPA; Oriedita.

use glam::DVec2;
use roxmltree::{Document, Node, ParsingOptions};

use super::colour::Meaning;
use super::drawing::Role;
use super::entities::check_entities;
use super::entries::{Entries, number, wrong_line};
use super::names::Names;
use super::stroke::Piece;
use super::{ImportError, ImportOptions, ImportedPattern, LengthUnit, MOST_NODES, Source};

/// What a type of line means.
fn meaning(kind: f64) -> Meaning {
    match kind {
        1.0 => Meaning::Exact(Role::Border),
        2.0 => Meaning::Exact(Role::Mountain),
        3.0 => Meaning::Exact(Role::Valley),
        4.0 => Meaning::Exact(Role::Free),
        _ => Meaning::Auxiliary,
    }
}

fn add(entries: &mut Entries<'_>, line: usize, kind: f64, [x1, y1, x2, y2]: [f64; 4]) {
    let what = format!("type {kind}");
    let ends = [DVec2::new(x1, -y1), DVec2::new(x2, -y2)];
    let source = Source::entry(&what, line);
    entries.add(source, Names::default(), (meaning(kind), &what), vec![Piece::Line(ends)]);
}

/// The numbers of a line of `.cp`: type, x1, y1, x2, y2.
pub(super) fn cp_numbers(line: &str) -> Option<[f64; 5]> {
    let parts = line.split(|c: char| c.is_whitespace() || c == ',').filter(|part| !part.is_empty());
    let numbers: Option<Vec<f64>> = parts.map(number).collect();
    let numbers: [f64; 5] = numbers?.try_into().ok()?;
    (numbers[0] >= 0.0 && numbers[0].fract() == 0.0).then_some(numbers)
}

/// Reads `.cp`.
pub(super) fn import_cp(
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    let mut entries = Entries::new(options);
    for (index, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let need = "a line of a .cp file is its type and its ends: type x1 y1 x2 y2";
        let [kind, ends @ ..] =
            cp_numbers(line).ok_or_else(|| wrong_line(index + 1, line, need))?;
        add(&mut entries, index + 1, kind, ends);
    }
    entries.finish(None, LengthUnit::Unit)
}

/// Reads `.opx`: the objects that `java.beans.XMLEncoder` writes, which omits properties that are 0.
pub(super) fn import_opx(
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    check_entities(text)?;
    // A line takes some thirty nodes.
    let parsing = ParsingOptions {
        nodes_limit: 10 * MOST_NODES,
        allow_dtd: true,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, parsing)
        .map_err(|e| ImportError::Xml { message: e.to_string() })?;
    let mut entries = Entries::new(options);
    let is_line = |node: &Node<'_, '_>| {
        let class = node.attribute("class").unwrap_or_default();
        node.has_tag_name("object") && class.ends_with("OriLineProxy")
    };
    let mut line_at = LineCounter { text, at: 0, line: 1 };
    for node in document.descendants().filter(is_line) {
        let line = line_at.line_of(node.range().start);
        let mut numbers = [0.0; 5];
        for (name, value) in ["type", "x0", "y0", "x1", "y1"].iter().zip(&mut numbers) {
            let Some(text) = property(node, name) else { continue };
            let need = "types and coordinates of lines must be finite numbers";
            *value = number(text).ok_or_else(|| wrong_line(line, text, need))?;
        }
        let [kind, ends @ ..] = numbers;
        add(&mut entries, line, kind, ends);
    }
    let data = document
        .descendants()
        .find(|node| node.attribute("class").is_some_and(|class| class.ends_with("DataSet")));
    let title = data.and_then(|data| property(data, "title")).filter(|title| !title.is_empty());
    entries.finish(title.map(str::to_owned), LengthUnit::Unit)
}

/// The text of a property of an object.
fn property<'a>(object: Node<'a, 'a>, name: &str) -> Option<&'a str> {
    let mut properties = object.children();
    let found = properties.find(|child| child.attribute("property") == Some(name))?;
    found.first_element_child()?.text()
}

/// Counts lines up to bytes that only grow.
struct LineCounter<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl LineCounter<'_> {
    fn line_of(&mut self, byte: usize) -> usize {
        self.line += self.text.get(self.at..byte).unwrap_or_default().matches('\n').count();
        self.at = byte.max(self.at);
        self.line
    }
}
