//! The contact gap between layers.

use foldmotion_geometry::Number;
use foldmotion_solver::quasi_static::Contact;

use super::input::Input;
use super::motion::engine;
use super::subject::Subject;
use crate::StudyError;
use crate::scene::EngineChoice;

/// The smallest gap, in units of h; the barrier of a smaller one exceeds the precision of f64.
const SMALLEST_GAP: f64 = 1e-6;

/// The contact gap, in units of the sheet's unit length; `None` without contact.
pub(crate) fn contact_gap(input: &Input<'_>, subject: &Subject) -> Result<Option<f64>, StudyError> {
    let height = subject.sheet().unit_length;
    let is_map = subject.units().is_some_and(|s| s.units.map_layers().is_some());
    let motion = &input.scene.motion;
    let thickness = input.scene.material.thickness;
    let is_dynamic = engine(input) == EngineChoice::Dynamic;
    if is_dynamic && motion.contact == Some(true) {
        let message =
            "the dynamic engine has no contact; use engine = \"quasi-static\" or contact = false";
        return Err(input.error("motion.contact", message));
    }
    if is_dynamic || motion.contact == Some(false) {
        let given = [
            ("motion.gap", motion.gap),
            // For a map, the thickness also determines the height of the stack.
            ("material.thickness", thickness.filter(|_| !is_map)),
        ];
        return match given.into_iter().find(|(_, value)| value.is_some()) {
            Some((key, _)) => {
                Err(input.error(key, "keeps layers apart, but contact is off; omit it"))
            }
            None => Ok(None),
        };
    }
    let (thinnest, layers) = subject.thinnest_part();
    let limit = thinnest / height / layers as f64;
    let (key, gap) = match (motion.gap, thickness) {
        (Some(_), Some(_)) => {
            let message = "the gap follows from material.thickness; omit one of the two";
            return Err(input.error("motion.gap", message));
        }
        (_, Some(thickness)) => ("material.thickness", thickness / height),
        (Some(gap), None) => ("motion.gap", gap),
        (None, None) => ("motion.gap", default_gap(subject, limit)),
    };
    if gap >= SMALLEST_GAP && gap <= limit {
        return Ok(Some(gap));
    }
    let scale = if key == "material.thickness" { height } else { 1.0 };
    let message = format!(
        "must be between {} and {:.6}, so that {layers} layers fit next to the thinnest part of the {}",
        Number(SMALLEST_GAP * scale),
        Number(limit * scale),
        if subject.units().is_some() { "unit" } else { "pattern" }
    );
    Err(input.error(key, message))
}

/// The default gap: a pattern with small facets takes the largest that fits.
fn default_gap(subject: &Subject, limit: f64) -> f64 {
    let standard = Contact::default().gap;
    match subject {
        Subject::Units(_) => standard,
        Subject::Imported(_) => standard.min(limit),
    }
}
