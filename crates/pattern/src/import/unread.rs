//! Elements that cannot be read.

use std::collections::BTreeSet;

use super::warning::{WarningKind, Warnings};
use super::{ImportError, Source, UnknownElements};

/// Elements that cannot be read, with the reasons.
#[derive(Debug, Default)]
pub(super) struct UnreadElements {
    elements: Vec<Source>,
    reasons: BTreeSet<String>,
}

impl UnreadElements {
    pub(super) fn add(&mut self, element: Source, reason: String) {
        self.elements.push(element);
        self.reasons.insert(reason);
    }

    /// Warns of the elements or refuses the file.
    ///
    /// # Errors
    /// [`ImportError::Unknown`].
    pub(super) fn settle(
        self,
        unknown: UnknownElements,
        warnings: &mut Warnings,
    ) -> Result<(), ImportError> {
        if self.elements.is_empty() {
            return Ok(());
        }
        match unknown {
            UnknownElements::Refuse | UnknownElements::Auxiliary => Err(ImportError::Unknown {
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
