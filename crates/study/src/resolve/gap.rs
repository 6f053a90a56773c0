//! The contact gap between layers.

use foldmotion_geometry::Number;
use foldmotion_solver::quasi_static::Contact;

use super::input::Input;
use super::motion::engine;
use super::subject::Subject;
use crate::StudyError;
use crate::scene::EngineChoice;

/// The smallest gap, in units of h.
const SMALLEST_GAP: f64 = 1e-6;
/// The smallest final gap over the extent of the sheet, of which f64 resolves 2⁻⁵³.
const RESOLVED: f64 = 1e-9;

/// Contact, in units of the sheet's unit length; `None` without.
pub(crate) fn contact(input: &Input<'_>, subject: &Subject) -> Result<Option<Contact>, StudyError> {
    let motion = &input.scene.motion;
    let is_dynamic = engine(input) == EngineChoice::Dynamic;
    if is_dynamic && motion.contact == Some(true) {
        let message =
            "the dynamic engine has no contact; use engine = \"quasi-static\" or contact = false";
        return Err(input.error("motion.contact", message));
    }
    if is_dynamic || motion.contact == Some(false) {
        return no_gap(input, subject).map(|()| None);
    }
    let gap = gap(input, subject)?;
    Ok(Some(Contact { gap, final_gap: final_gap(input, subject, gap)? }))
}

/// Refuses keys that say how close layers may come, where they may pass through each other.
fn no_gap(input: &Input<'_>, subject: &Subject) -> Result<(), StudyError> {
    let is_map = subject.units().is_some_and(|s| s.units.map_layers().is_some());
    let motion = &input.scene.motion;
    let given = [
        ("motion.gap", motion.gap),
        ("motion.final_gap", motion.final_gap),
        // For a map, the thickness also determines the height of the stack.
        ("material.thickness", input.scene.material.thickness.filter(|_| !is_map)),
    ];
    match given.into_iter().find(|(_, value)| value.is_some()) {
        Some((key, _)) => Err(input.error(key, "keeps layers apart, but contact is off; omit it")),
        None => Ok(()),
    }
}

fn gap(input: &Input<'_>, subject: &Subject) -> Result<f64, StudyError> {
    let height = subject.sheet().unit_length;
    let (thinnest, layers) = subject.thinnest_part();
    let limit = thinnest / height / layers as f64;
    let (key, gap) = match (input.scene.motion.gap, input.scene.material.thickness) {
        (Some(_), Some(_)) => {
            let message = "the gap follows from material.thickness; omit one of the two";
            return Err(input.error("motion.gap", message));
        }
        (_, Some(thickness)) => ("material.thickness", thickness / height),
        (Some(gap), None) => ("motion.gap", gap),
        (None, None) => return Ok(default_gap(subject, limit)),
    };
    let smallest = smallest_gap(subject, limit);
    if gap >= smallest && gap <= limit {
        return Ok(gap);
    }
    let scale = if key == "material.thickness" { height } else { 1.0 };
    let message = format!(
        "must be between {} and {:.6}, so that {layers} layers fit next to the thinnest part of the {}",
        Number(smallest * scale),
        Number(limit * scale),
        if subject.units().is_some() { "unit" } else { "pattern" }
    );
    Err(input.error(key, message))
}

/// The smallest gap that a scene may ask for: in a pattern with a part thinner than that, what fits.
fn smallest_gap(subject: &Subject, limit: f64) -> f64 {
    match subject {
        Subject::Units(_) => SMALLEST_GAP,
        Subject::Imported(_) => SMALLEST_GAP.min(limit),
    }
}

/// What `gap` shrinks to: a thickness does not.
fn final_gap(input: &Input<'_>, subject: &Subject, gap: f64) -> Result<f64, StudyError> {
    let is_thick = input.scene.material.thickness.is_some();
    let Some(final_gap) = input.scene.motion.final_gap else {
        return Ok(if is_thick { gap } else { gap.min(Contact::default().final_gap) });
    };
    if is_thick {
        let message = "a sheet with material.thickness keeps it; omit one of the two";
        return Err(input.error("motion.final_gap", message));
    }
    let smallest = (RESOLVED * subject.size()).min(gap);
    if final_gap >= smallest && final_gap <= gap {
        return Ok(final_gap);
    }
    let message = format!(
        "must be between {:.2}, below which rounding blurs it in a sheet of this size, and the gap of {}",
        Number(smallest),
        Number(gap)
    );
    Err(input.error("motion.final_gap", message))
}

/// The default gap: a pattern with a thin part takes the largest that fits.
fn default_gap(subject: &Subject, limit: f64) -> f64 {
    let standard = Contact::default().gap;
    match subject {
        Subject::Units(_) => standard,
        Subject::Imported(_) => standard.min(limit),
    }
}

/// Says that the default gap was lowered; `None` if it was not.
pub(super) fn lowered(
    input: &Input<'_>,
    subject: &Subject,
    contact: Option<&Contact>,
) -> Option<String> {
    let motion = &input.scene.motion;
    let gap = contact?.gap;
    let is_default = motion.gap.is_none() && input.scene.material.thickness.is_none();
    let standard = Contact::default().gap;
    if !is_default || gap >= standard {
        return None;
    }
    let (thinnest, layers) = subject.thinnest_part();
    Some(format!(
        "motion.gap is {:.2} mean edges instead of {}, so that {layers} layers fit next to the thinnest part of the \
         pattern, {:.2} wide",
        Number(gap),
        Number(standard),
        Number(thinnest)
    ))
}
