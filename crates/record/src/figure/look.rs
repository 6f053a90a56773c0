//! The look of lines, and colours for print in grey.

use foldmotion_pattern::Assignment;

use crate::{Stroke, Style};

/// How mountains and valleys are told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LineStyle {
    /// By their colours.
    #[default]
    Solid,
    /// Mountains in dashes and dots, valleys in dashes (Yoshizawa; Robinson 2004, The Origami Bible), besides colours.
    Dashed,
}

impl Style {
    /// Greys: the front lighter than the back, lines nearly black. Mountains and valleys take [`LineStyle::Dashed`].
    pub fn grey() -> Self {
        Self {
            front: [250; 3],
            back: [186; 3],
            mountain: [20; 3],
            valley: [20; 3],
            border: [0; 3],
            mark: [96; 3],
            background: [255; 3],
            ..Self::default()
        }
    }

    /// The colour of a line.
    pub(super) fn line(&self, assignment: Assignment) -> [u8; 3] {
        match assignment {
            Assignment::Mountain => self.mountain,
            Assignment::Valley => self.valley,
            Assignment::Border | Assignment::Facet | Assignment::Free => self.border,
        }
    }
}

impl LineStyle {
    /// The stroke of a line `width` wide.
    pub(super) fn stroke(self, assignment: Assignment, color: [u8; 3], width: f64) -> Stroke {
        let stroke = Stroke::new(color, width);
        match (self, assignment) {
            (Self::Dashed, Assignment::Mountain) => stroke.dash_dotted(5.0 * width, 2.5 * width),
            (Self::Dashed, Assignment::Valley) => stroke.dashed(2.5 * width, 2.5 * width),
            _ => stroke,
        }
    }
}
