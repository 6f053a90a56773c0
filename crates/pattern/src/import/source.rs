//! Where an edge comes from.

use std::fmt;

/// The most bytes of an id that are kept.
const LONGEST_ID: usize = 60;

/// The element of the file that an edge or a warning comes from.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Source {
    /// An entry of `edges_vertices`.
    FoldEdge(u32),
    /// An entry of `faces_vertices`.
    FoldFace(u32),
    /// An entry of `vertices_coords`.
    FoldVertex(u32),
    /// The key frame of a FOLD file.
    KeyFrame,
    /// An element of `file_frames`.
    FoldFrame(u32),
    /// The outline of all lines, for a drawing without a border.
    Outline,
    /// A line or an entity of a file that is neither FOLD nor SVG.
    Entry {
        /// What it is, such as `line` or `ARC on layer "valley"`.
        what: String,
        /// The line of the file on which it starts, counted from 1.
        line: u32,
    },
    /// An element of an SVG.
    Svg {
        /// Its name: `path`, `line` …
        tag: String,
        /// The attribute `id` of the element.
        id: Option<String>,
        /// The line on which it starts, counted from 1.
        line: u32,
        /// The byte of that line at which it starts, counted from 1.
        column: u32,
    },
}

impl Source {
    pub(super) fn entry(what: &str, line: usize) -> Self {
        Self::Entry { what: what.chars().take(LONGEST_ID).collect(), line: line as u32 }
    }

    pub(super) fn svg(tag: &str, id: Option<&str>, [line, column]: [u32; 2]) -> Self {
        let short = |text: &str| text.chars().take(LONGEST_ID).collect();
        Self::Svg { tag: short(tag), id: id.map(short), line, column }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FoldEdge(index) => write!(f, "edge {index}"),
            Self::FoldFace(index) => write!(f, "face {index}"),
            Self::FoldVertex(index) => write!(f, "vertex {index}"),
            Self::KeyFrame => write!(f, "the key frame"),
            Self::FoldFrame(index) => write!(f, "file_frames[{index}]"),
            Self::Outline => f.write_str("the outline of the lines"),
            Self::Entry { what, line } => write!(f, "{what} (line {line})"),
            Self::Svg { tag, id, line, column } => match id {
                Some(id) => write!(f, "<{tag} id={id:?}> (line {line})"),
                None => write!(f, "<{tag}> (line {line}, column {column})"),
            },
        }
    }
}

/// A list of sources in a sentence: the first few and how many more.
pub(super) fn listed(sources: &[Source]) -> String {
    const SHOWN: usize = 5;
    let shown: Vec<String> = sources.iter().take(SHOWN).map(Source::to_string).collect();
    let more = sources.len().saturating_sub(SHOWN);
    match more {
        0 => shown.join(", "),
        _ => format!("{} and {more} more", shown.join(", ")),
    }
}
