//! Crease patterns of Orihime (`.orh`), in UTF-8 or Shift JIS.
//!
//! A line of the drawing is a number (番号), a colour (色: 0 black, border; 1 red, mountain; 2 blue, valley; others are
//! auxiliary lines) and its ends (座標: x1, y1, x2, y2, y downwards), each on a line of text. Auxiliary lines (補助…),
//! circles and the settings of the window are passed over. Source: Meguro's Orihime, as Oriedita writes it.

use glam::DVec2;

use super::colour::Meaning;
use super::drawing::Role;
use super::entries::{Entries, number, wrong_line};
use super::names::Names;
use super::stroke::Piece;
use super::{ImportError, ImportOptions, ImportedPattern, LengthUnit, Source};

/// A keyword in UTF-8 and in Shift JIS.
type Keyword = [&'static [u8]; 2];

const LINES: Keyword = ["<線分集合>".as_bytes(), b"<\x90\xfc\x95\xaa\x8f\x57\x8d\x87>"];
const COLOUR: Keyword = ["色,".as_bytes(), b"\x90\x46,"];
const ENDS: Keyword = ["座標,".as_bytes(), b"\x8d\xc0\x95\x57,"];

/// Whether the bytes are those of an Orihime file.
pub(super) fn is_orh(bytes: &[u8]) -> bool {
    LINES.iter().any(|keyword| bytes.windows(keyword.len()).any(|window| window == *keyword))
}

/// Reads `.orh`.
pub(super) fn import_orh(
    bytes: &[u8],
    options: &ImportOptions,
) -> Result<ImportedPattern, ImportError> {
    let mut entries = Entries::new(options);
    let mut colour = 0.0;
    let mut is_of_lines = false;
    for (index, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
        let line = line.trim_ascii();
        let wrong = |need| wrong_line(index + 1, &String::from_utf8_lossy(line), need);
        if is_keyword(line, LINES).is_some() {
            is_of_lines = true;
        } else if line.starts_with(b"<") && !line.starts_with(b"<tpp") {
            // Another part of the file; `<tpp…>` are settings of a line.
            is_of_lines = false;
        } else if let Some([value]) = is_keyword(line, COLOUR).and_then(numbers) {
            colour = value;
        } else if let Some(rest) = is_keyword(line, ENDS).filter(|_| is_of_lines) {
            let need = "the ends of a line are four finite numbers: x1, y1, x2, y2";
            let [x1, y1, x2, y2] = numbers(rest).ok_or_else(|| wrong(need))?;
            let ends = [DVec2::new(x1, -y1), DVec2::new(x2, -y2)];
            let what = format!("colour {colour}");
            let source = Source::entry(&what, index + 1);
            let pieces = vec![Piece::Line(ends)];
            entries.add(source, Names::default(), (meaning(colour), &what), pieces);
        }
    }
    entries.finish(None, LengthUnit::Unit)
}

fn meaning(colour: f64) -> Meaning {
    match colour {
        0.0 => Meaning::Exact(Role::Border),
        1.0 => Meaning::Exact(Role::Mountain),
        2.0 => Meaning::Exact(Role::Valley),
        _ => Meaning::Auxiliary,
    }
}

/// What follows a keyword at the start of a line.
fn is_keyword(line: &[u8], keyword: Keyword) -> Option<&[u8]> {
    keyword.iter().find_map(|start| line.strip_prefix(*start))
}

fn numbers<const N: usize>(text: &[u8]) -> Option<[f64; N]> {
    let text = std::str::from_utf8(text).ok()?;
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    numbers?.try_into().ok()
}
