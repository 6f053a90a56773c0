//! `[check]`.

use foldmotion_check::CollisionOptions;
use foldmotion_geometry::Number;
use foldmotion_geometry::collide::Limits;
use foldmotion_solver::quasi_static::Contact;
use glam::DVec3;

use super::input::Input;
use super::subject::Subject;
use crate::StudyError;

/// The tolerance, where it follows from the gap, in parts of the gap between layers in the last state.
const OF_GAP: f64 = 0.1;

pub(crate) fn collision(
    input: &Input<'_>,
    subject: &Subject,
    contact: Option<&Contact>,
) -> Result<CollisionOptions, StudyError> {
    let mut options = CollisionOptions::default();
    let motion = &input.scene.motion;
    let is_default = motion.gap.is_none() && motion.final_gap.is_none();
    if let (Subject::Imported(_), Some(contact), true) = (subject, contact, is_default) {
        // Layers at their gap stay apart.
        let of_gap = (OF_GAP * contact.final_gap).max(least_tolerance(subject));
        options.touch_tolerance = options.touch_tolerance.min(of_gap);
    }
    if let Some(tolerance) = input.scene.check.touch_tolerance {
        if !(tolerance > 0.0 && tolerance <= 1e-2) {
            return Err(input.error(
                "check.touch_tolerance",
                "must be above 0 and at most 0.01 (units of h, or of the mean edge)",
            ));
        }
        options.touch_tolerance = tolerance;
    }
    let (tolerance, least) = (options.touch_tolerance, least_tolerance(subject));
    if tolerance < least {
        let message = format!(
            "{} is too small for a sheet of this size: rounding needs {:.2} of its unit; set a larger tolerance, or use \
             fewer or less slender units",
            Number(tolerance),
            Number(least)
        );
        return Err(input.error("check.touch_tolerance", message));
    }
    if let Some(stop_at) = input.scene.check.stop_at {
        options.stop_at = usize::try_from(stop_at).map_err(|_| {
            input.error("check.stop_at", "must be a number of pairs, or 0 for no limit")
        })?;
    }
    Ok(options)
}

/// Says that the default tolerance was lowered; `None` if it was not.
pub(super) fn lowered(input: &Input<'_>, options: &CollisionOptions) -> Option<String> {
    let standard = CollisionOptions::default().touch_tolerance;
    let is_lower = options.touch_tolerance < standard;
    (input.scene.check.touch_tolerance.is_none() && is_lower).then(|| {
        format!(
            "check.touch_tolerance is {:.2} mean edges instead of {}, a tenth of the gap between layers at the end",
            Number(options.touch_tolerance),
            Number(standard)
        )
    })
}

/// The smallest tolerance, in units of the sheet's unit of length, that the check can distinguish from rounding.
fn least_tolerance(subject: &Subject) -> f64 {
    /// The tolerance in units of the rounding margin; the check needs a hundred.
    const MARGINS: f64 = 128.0;
    let start = subject.start();
    let Some(&first) = start.first() else {
        return 0.0;
    };
    let planar = subject.sheet().planar();
    let spread = |positions: &[DVec3]| {
        let origin = positions.first().copied().unwrap_or(first);
        let distances = positions.iter().map(|p| p.distance(origin));
        distances.fold(0.0, f64::max)
    };
    let extent = spread(&start).max(spread(&planar));
    MARGINS * Limits::margin_for(extent) / subject.sheet().unit_length
}
