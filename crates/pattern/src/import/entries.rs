//! The strokes of a file that lists them line by line.

use std::f64::consts::PI;

use super::colour::Meaning;
use super::drawing::Role;
use super::drawn::{Drawn, imported};
use super::names::Names;
use super::stroke::{Piece, Stroke};
use super::unread::UnreadElements;
use super::warning::{WarningKind, Warnings};
use super::{ImportError, ImportOptions, ImportedPattern, LengthUnit, Source, UnknownElements};

/// The most characters of a line that an error repeats.
const SHOWN: usize = 60;

/// Strokes in progress.
pub(super) struct Entries<'a> {
    options: &'a ImportOptions,
    pub(super) warnings: Warnings,
    pub(super) strokes: Vec<Stroke>,
    unread: UnreadElements,
}

impl<'a> Entries<'a> {
    pub(super) fn new(options: &'a ImportOptions) -> Self {
        Self {
            options,
            warnings: Warnings::default(),
            strokes: Vec::new(),
            unread: UnreadElements::default(),
        }
    }

    /// Adds a stroke that folds by 180°, or leaves an auxiliary line out; `shown`: how the file says what it means.
    pub(super) fn add(
        &mut self,
        source: Source,
        names: Names,
        (meaning, shown): (Meaning, &str),
        pieces: Vec<Piece>,
    ) {
        let role = match meaning {
            Meaning::Exact(role) => role,
            Meaning::Near(role) => {
                let read = format!("{shown} as {}", role.name());
                self.warnings.add_as(WarningKind::NearColour, &source, read);
                role
            }
            Meaning::Auxiliary if self.options.unknown == UnknownElements::Refuse => {
                self.unread.add(source, format!("{shown} is an auxiliary line"));
                return;
            }
            Meaning::Auxiliary => {
                self.warnings.add_as(WarningKind::Auxiliary, &source, shown.to_owned());
                return;
            }
        };
        let target = match role {
            Role::Mountain => -PI,
            Role::Valley => PI,
            _ => 0.0,
        };
        self.strokes.push(Stroke { source, names, role, target, pieces });
    }

    /// Adds an element that cannot be read.
    pub(super) fn unread(&mut self, source: Source, reason: String) {
        self.unread.add(source, reason);
    }

    /// The pattern of the strokes, y upwards.
    pub(super) fn finish(
        mut self,
        title: Option<String>,
        unit: LengthUnit,
    ) -> Result<ImportedPattern, ImportError> {
        self.unread.settle(self.options.unknown, &mut self.warnings)?;
        let drawn = Drawn { title, unit, scale: 1.0, page: None, strokes: self.strokes };
        imported(drawn, self.options, self.warnings)
    }
}

/// An error about a line of the file, counted from 1.
pub(super) fn wrong_line(line: usize, value: &str, need: &'static str) -> ImportError {
    ImportError::Line { line, value: value.trim().chars().take(SHOWN).collect(), need }
}

/// A finite number.
pub(super) fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|number: &f64| number.is_finite())
}
