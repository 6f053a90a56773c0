//! Crease patterns in OBJ: lines (`l`) between vertices, or faces with their creases in comments.
//!
//! `#e a b kind` gives the edge of two vertices, counted from 1, the kind 0 border, 1 facet line, 2 valley or 3
//! mountain, as Freeform Origami does and Origami Simulator writes; a folded sheet is then flattened by its texture
//! coordinates. Otherwise a line means what its group (`g`, `o`) or its material (`usemtl`) is called. Sides of one
//! face are border; other sides without a line are facet lines if there are lines, and free hinges if there are none.
//! Sources: Wavefront, *OBJ*; Origami Simulator (MIT).

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};

use super::colour::Meaning;
use super::drawing::Role;
use super::entries::{Entries, number, wrong_line};
use super::layer_names::named_meaning;
use super::names::Names;
use super::stroke::Piece;
use super::{ImportError, ImportOptions, ImportedPattern, LengthUnit, MOST_VERTICES, Source};

/// The largest height of a flat pattern, in parts of its diagonal.
const FLAT: f64 = 1e-6;

/// A line between two vertices.
struct ObjLine {
    line: usize,
    ends: [usize; 2],
    names: Names,
    meaning: Meaning,
    shown: &'static str,
}

/// What the file lists.
#[derive(Default)]
struct Lists {
    vertices: Vec<DVec3>,
    /// The line of the file of each vertex.
    vertex_lines: Vec<usize>,
    texture: Vec<DVec2>,
    lines: Vec<ObjLine>,
    /// The sides of faces, with the line of the file and how many faces have them.
    sides: BTreeMap<[usize; 2], (usize, u32)>,
    has_crease_kinds: bool,
    group: String,
    material: String,
}

/// Reads OBJ.
pub(super) fn import_obj(
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    let mut lists = Lists::default();
    for (index, line) in text.lines().enumerate() {
        lists.read(index + 1, line)?;
    }
    let points = lists.flat()?;
    let mut entries = Entries::new(options);
    let mut drawn: BTreeSet<[usize; 2]> = BTreeSet::new();
    let piece = |[a, b]: [usize; 2]| vec![Piece::Line([points[a], points[b]])];
    let has_lines = !lists.lines.is_empty();
    for line in lists.lines {
        drawn.insert(sorted(line.ends));
        let source = Source::entry(line.shown, line.line);
        entries.add(source, line.names, (line.meaning, line.shown), piece(line.ends));
    }
    for (ends, (line, faces)) in lists.sides {
        let role = match (faces, has_lines) {
            (1, _) => Role::Border,
            (_, true) => Role::Facet,
            (_, false) => Role::Free,
        };
        if drawn.contains(&ends) {
            continue;
        }
        let source = Source::entry("side of a face", line);
        let meaning = (Meaning::Exact(role), "side of a face");
        entries.add(source, Names::default(), meaning, piece(ends));
    }
    entries.finish(None, LengthUnit::Unit)
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl Lists {
    fn read(&mut self, line: usize, text: &str) -> Result<(), ImportError> {
        let mut words = text.split_whitespace();
        let keyword = words.next().unwrap_or_default();
        let rest: Vec<&str> = words.collect();
        match keyword {
            "v" => self.vertex(line, text, &rest),
            "vt" => {
                let numbers: Option<Vec<f64>> = rest.iter().take(2).map(|t| number(t)).collect();
                if let Some([u, v]) = numbers.as_deref() {
                    self.texture.push(DVec2::new(*u, *v));
                }
                Ok(())
            }
            "g" | "o" => {
                self.group = rest.join(" ");
                Ok(())
            }
            "usemtl" => {
                self.material = rest.join(" ");
                Ok(())
            }
            "l" => {
                let corners = self.corners(line, text, &rest)?;
                for ends in corners.windows(2) {
                    self.line(line, [ends[0], ends[1]], None);
                }
                Ok(())
            }
            "#e" => self.crease(line, text, &rest),
            "f" => {
                let corners = self.corners(line, text, &rest)?;
                let next = corners.iter().cycle().skip(1);
                for (&a, &b) in corners.iter().zip(next) {
                    self.sides.entry(sorted([a, b])).or_insert((line, 0)).1 += 1;
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn vertex(&mut self, line: usize, text: &str, rest: &[&str]) -> Result<(), ImportError> {
        let numbers: Option<Vec<f64>> = rest.iter().take(3).map(|t| number(t)).collect();
        let Some([x, y, z]) = numbers.as_deref() else {
            return Err(wrong_line(line, text, "a vertex has three finite coordinates"));
        };
        if self.vertices.len() == MOST_VERTICES {
            let limit = MOST_VERTICES;
            return Err(ImportError::TooMany { what: "vertices", found: limit + 1, limit });
        }
        self.vertices.push(DVec3::new(*x, *y, *z));
        self.vertex_lines.push(line);
        Ok(())
    }

    /// `#e a b kind angle`; other comments that start so are passed over.
    fn crease(&mut self, line: usize, text: &str, rest: &[&str]) -> Result<(), ImportError> {
        let [a, b, kind, ..] = rest else { return Ok(()) };
        let role = match *kind {
            "0" => Role::Border,
            "1" => Role::Facet,
            "2" => Role::Valley,
            "3" => Role::Mountain,
            _ => return Ok(()),
        };
        let corners = self.corners(line, text, &[a, b])?;
        self.has_crease_kinds = true;
        if let [a, b] = corners.as_slice() {
            self.line(line, [*a, *b], Some(role));
        }
        Ok(())
    }

    fn line(&mut self, line: usize, ends: [usize; 2], role: Option<Role>) {
        let mut names = Names::default();
        names.add_id(&self.group);
        names.add_class(&self.material);
        let by_name = || named_meaning(&self.group).or_else(|| named_meaning(&self.material));
        let meaning = role.map(Meaning::Exact).or_else(by_name);
        let meaning = meaning.unwrap_or(Meaning::Exact(Role::Free));
        let shown = if role.is_some() { "#e" } else { "l" };
        self.lines.push(ObjLine { line, ends, names, meaning, shown });
    }

    /// Indices of vertices, which count from 1, or from the last one backwards if they are negative.
    fn corners(&self, line: usize, text: &str, rest: &[&str]) -> Result<Vec<usize>, ImportError> {
        let count = self.vertices.len();
        let index = |text: &&str| {
            let number: i64 = text.split('/').next()?.parse().ok()?;
            let from_start = usize::try_from(number).ok().and_then(|n| n.checked_sub(1));
            let from_end = usize::try_from(-number).ok().filter(|n| *n > 0);
            let index = from_start.or_else(|| count.checked_sub(from_end?))?;
            (index < count).then_some(index)
        };
        let corners: Option<Vec<usize>> = rest.iter().map(index).collect();
        let need = "it must name vertices listed above it, counted from 1";
        corners.ok_or_else(|| wrong_line(line, text, need))
    }

    /// The vertices in the plane: seen along an axis in which they do not differ, or by their texture coordinates.
    fn flat(&self) -> Result<Vec<DVec2>, ImportError> {
        let Some(first) = self.vertices.first() else { return Err(ImportError::Empty) };
        let (low, high) =
            self.vertices.iter().fold((*first, *first), |(l, h), v| (l.min(*v), h.max(*v)));
        let size = high - low;
        let limit = FLAT * size.length();
        let seen = |of: fn(&DVec3) -> DVec2| Ok(self.vertices.iter().map(of).collect());
        if size.z <= limit {
            return seen(|v| DVec2::new(v.x, v.y));
        }
        if size.y <= limit {
            return seen(|v| DVec2::new(v.x, -v.z));
        }
        if size.x <= limit {
            return seen(|v| DVec2::new(v.y, v.z));
        }
        if self.has_crease_kinds && self.texture.len() == self.vertices.len() {
            return Ok(self.texture.iter().map(|t| DVec2::new(t.x, -t.y)).collect());
        }
        let off = self.vertices.iter().position(|v| (v.z - first.z).abs() > limit);
        let line = off.and_then(|off| self.vertex_lines.get(off)).copied().unwrap_or(1);
        let need = "only a flat pattern is read: x, y or z must be the same for all vertices";
        Err(wrong_line(line, "a vertex", need))
    }
}
