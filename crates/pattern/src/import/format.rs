//! The formats of crease patterns, known by their content.

use super::dxf::{import_dxf, is_dxf};
use super::fold::import_fold;
use super::obj::import_obj;
use super::orihime::{import_orh, is_orh};
use super::oripa::{cp_numbers, import_cp, import_opx};
use super::svg::import_svg;
use super::{ImportError, ImportOptions, ImportedPattern, check_size, encoding};

/// The lines of a file by which OBJ and `.cp` are known.
const LINES_LOOKED_AT: usize = 200;

/// A format of crease patterns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PatternFileFormat {
    /// FOLD 1.0 to 1.2.
    Fold,
    /// SVG.
    Svg,
    /// ORIPA's and Oriedita's lines of text.
    Cp,
    /// ORIPA's XML.
    Opx,
    /// Orihime's text.
    Orh,
    /// Wavefront OBJ with lines.
    Obj,
    /// ASCII DXF.
    Dxf,
}

impl PatternFileFormat {
    /// Every format.
    pub const ALL: [Self; 7] =
        [Self::Fold, Self::Svg, Self::Cp, Self::Opx, Self::Orh, Self::Obj, Self::Dxf];

    /// The extension of its files.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Svg => "svg",
            Self::Cp => "cp",
            Self::Opx => "opx",
            Self::Orh => "orh",
            Self::Obj => "obj",
            Self::Dxf => "dxf",
        }
    }

    /// The format whose files have this extension, in upper or lower case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// The format that a content looks like.
    pub fn of_content(bytes: &[u8]) -> Option<Self> {
        if is_orh(bytes) {
            return Some(Self::Orh);
        }
        let text = encoding::text(bytes).ok()?;
        let start = text.trim_start();
        match start.chars().next()? {
            '{' => Some(Self::Fold),
            '<' if start.contains("OriLineProxy") => Some(Self::Opx),
            '<' => start.contains("<svg").then_some(Self::Svg),
            _ if is_dxf(start) => Some(Self::Dxf),
            _ if is_cp(start) => Some(Self::Cp),
            _ => is_obj(start).then_some(Self::Obj),
        }
    }
}

/// Reads a crease pattern of any format: the one that its content looks like or, if it looks like none, the one of
/// the extension. UTF-16 and byte order marks are read in every format.
///
/// # Errors
/// [`ImportError`]; [`ImportError::Format`] names the formats that are read.
pub fn import_pattern(
    bytes: &[u8],
    extension: Option<&str>,
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    check_size(bytes)?;
    let by_extension = || PatternFileFormat::of_extension(extension?);
    let format = PatternFileFormat::of_content(bytes).or_else(by_extension);
    let text = || encoding::text(bytes);
    match format.ok_or(ImportError::Format)? {
        PatternFileFormat::Fold => match text() {
            Ok(text) => import_fold(text.as_bytes(), options),
            Err(_) => import_fold(bytes, options),
        },
        PatternFileFormat::Svg => import_svg(bytes, options),
        PatternFileFormat::Cp => import_cp(&text()?, options),
        PatternFileFormat::Opx => import_opx(&text()?, options),
        PatternFileFormat::Orh => import_orh(bytes, options),
        PatternFileFormat::Obj => import_obj(&text()?, options),
        PatternFileFormat::Dxf => import_dxf(&text()?, options),
    }
}

fn is_cp(text: &str) -> bool {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty()).take(LINES_LOOKED_AT);
    lines.all(|line| cp_numbers(line).is_some())
}

/// Whether there is a vertex, and every line begins as one of OBJ may.
fn is_obj(text: &str) -> bool {
    const KEYWORDS: [&str; 12] =
        ["v", "vt", "vn", "vp", "f", "l", "p", "g", "o", "s", "usemtl", "mtllib"];
    let lines = || text.lines().map(str::trim).take(LINES_LOOKED_AT);
    let is_vertex = |line: &str| {
        let mut words = line.split_whitespace();
        words.next() == Some("v") && words.filter(|word| word.parse::<f64>().is_ok()).count() >= 3
    };
    let is_known = |line: &str| {
        let keyword = line.split_whitespace().next().unwrap_or("#");
        keyword.starts_with('#') || KEYWORDS.contains(&keyword)
    };
    lines().any(is_vertex) && lines().all(is_known)
}
