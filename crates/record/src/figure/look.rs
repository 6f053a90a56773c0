//! The look of lines, and colours for print in grey.

use foldmotion_pattern::Assignment;

use crate::{Stroke, Style};

/// Dashes of mountains and valleys and the gaps after them, in widths of the line. All ends are round: a gap looks a
/// width narrower.
const DASHES: [f64; 2] = [5.0, 2.5];
const GAP: f64 = 2.5;

/// By what dashes and gaps of short lines are made shorter.
const SHRINK: [f64; 3] = [1.0, 0.75, 0.55];

/// How mountains and valleys are distinguished.
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
    /// The stroke of a line `width` wide, with dashes made shorter by [`SHRINK`] of `step`.
    pub(super) fn stroke(
        self,
        assignment: Assignment,
        color: [u8; 3],
        width: f64,
        step: usize,
    ) -> Stroke {
        let stroke = Stroke::new(color, width);
        let unit = width * SHRINK[step.min(SHRINK.len() - 1)];
        match (self, assignment) {
            (Self::Dashed, Assignment::Mountain) => {
                stroke.dash_dotted(DASHES[0] * unit, GAP * unit)
            }
            (Self::Dashed, Assignment::Valley) => stroke.dashed(DASHES[1] * unit, GAP * unit),
            _ => stroke,
        }
    }

    /// How much shorter dashes have to be for a line of `length` to show its pattern twice, as far as they may be.
    pub(super) fn step(self, assignment: Assignment, width: f64, length: f64) -> usize {
        let period = match (self, assignment) {
            (Self::Dashed, Assignment::Mountain) => DASHES[0] + 2.0 * GAP,
            (Self::Dashed, Assignment::Valley) => DASHES[1] + GAP,
            _ => return 0,
        };
        let fits = |shrink: &f64| length >= 2.0 * period * width * shrink;
        SHRINK.iter().position(fits).unwrap_or(SHRINK.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_creases_keep_gaps_that_round_ends_leave_open() {
        let (style, width) = (LineStyle::Dashed, 0.15);
        for assignment in [Assignment::Mountain, Assignment::Valley] {
            let dash = |length: f64| {
                let step = style.step(assignment, width, length);
                style.stroke(assignment, [0; 3], width, step).dash.unwrap()
            };
            let (long, short) = (dash(10.0), dash(0.5));
            assert!(short[0] < long[0] && short[1] < long[1]);
            assert!(short[1] > 1.3 * width, "half a width of each end is ink");
            let period: f64 = short.iter().sum();
            assert!(period < 1.0, "{period} mm, where small units have a millimetre");
        }
        let solid = LineStyle::Solid.stroke(Assignment::Valley, [0; 3], width, 2);
        assert!(solid.dash.is_none());
    }
}
