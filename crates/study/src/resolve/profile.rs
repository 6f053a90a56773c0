//! From `[profile]` and `[division]` to the curve Γ and its segments.

use foldmotion_geometry::{
    Closure, Division, DivisionMethod, DivisionOptions, Fit, GeometryError, Profile, divide,
    divide_to_length, simplify, simplify_to_length,
};
use foldmotion_pattern::{Outline, ProfileModel, find_model, models};
use glam::DVec2;

use super::input::Input;
use crate::StudyError;
use crate::scene::{Closed, ProfileScene, UnequalChoice};

/// Rows count as equal if they differ by at most this part of their mean height.
pub(crate) const EQUAL_ROWS: f64 = 1e-9;

/// The curve Γ with its segments.
pub(crate) struct DividedProfile {
    pub(crate) profile: Profile,
    pub(crate) division: Division,
    pub(crate) method: DivisionMethod,
    pub(crate) fit: Fit,
}

/// The curve Γ with its origin.
pub(crate) struct Curve {
    pub(crate) model: Option<&'static ProfileModel>,
    pub(crate) profile: Profile,
    pub(crate) source: String,
}

/// The curve of `[profile]`.
pub(crate) fn curve(input: &Input<'_>) -> Result<Curve, StudyError> {
    let scene = &input.scene.profile;
    check_shape_keys(input, scene)?;
    if let Some(name) = &scene.model {
        return built_in(input, name);
    }
    let own = |profile: Result<Profile, GeometryError>, key: &str, source: &str| {
        Ok(Curve {
            model: None,
            profile: profile.map_err(|e| curve_error(input, &e, key))?,
            source: source.to_owned(),
        })
    };
    let list =
        |points: &[[f64; 2]]| -> Vec<DVec2> { points.iter().copied().map(DVec2::from).collect() };
    let closure = closure(scene.closed);
    match (&scene.control_points, &scene.points, &scene.file) {
        (Some(points), _, _) => {
            let profile = match &scene.knots {
                Some(knots) => Profile::with_knots(&list(points), knots, closure),
                None => Profile::new(&list(points), closure),
            };
            own(profile, "profile.control_points", "control points of the scene")
        }
        (_, Some(points), _) => {
            let profile = Profile::through(&list(points), closure);
            own(profile, "profile.points", "points of the scene")
        }
        (_, _, Some(file)) => {
            let outline = outline(input, file)?;
            let closure = match scene.closed {
                None if outline.closed => Closure::Corner,
                _ => closure,
            };
            let profile = Profile::through(&outline.points, closure);
            own(profile, "profile.file", &format!("points of {file}"))
        }
        _ => {
            let message = "is missing: set profile.model (see `foldmotion models`), profile.control_points, profile.points or profile.file";
            Err(input.error("profile", message))
        }
    }
}

/// Refuses a second key that gives the curve, and keys that do not apply to the first.
fn check_shape_keys(input: &Input<'_>, scene: &ProfileScene) -> Result<(), StudyError> {
    let shapes = [
        ("profile.model", scene.model.is_some()),
        ("profile.control_points", scene.control_points.is_some()),
        ("profile.points", scene.points.is_some()),
        ("profile.file", scene.file.is_some()),
    ];
    let mut given = shapes.into_iter().filter(|&(_, given)| given);
    let (first, second) = (given.next(), given.next());
    if let (Some((first, _)), Some((key, _))) = (first, second) {
        let message = format!("{first} already gives the curve; omit one of the two");
        return Err(input.error(key, message));
    }
    if scene.knots.is_some() && scene.control_points.is_none() {
        let message = "applies only to profile.control_points; omit it";
        return Err(input.error("profile.knots", message));
    }
    if scene.closed.is_some() && scene.model.is_some() {
        let message = "does not apply to a built-in profile; omit this key or profile.model";
        return Err(input.error("profile.closed", message));
    }
    Ok(())
}

fn built_in(input: &Input<'_>, name: &str) -> Result<Curve, StudyError> {
    let Some(model) = find_model(name) else {
        let names: Vec<&str> = models().iter().map(|m| m.name).collect();
        let message = format!("is not a built-in profile; there are: {}", names.join(", "));
        return Err(input.error("profile.model", message));
    };
    Ok(Curve {
        model: Some(model),
        profile: model.profile().map_err(|e| curve_error(input, &e, "profile.model"))?,
        source: format!("{}: {}", model.name, model.source),
    })
}

fn outline(input: &Input<'_>, file: &str) -> Result<Outline, StudyError> {
    let path = input.source.resolve_path(file);
    Outline::read(&path)
        .map_err(|e| input.error("profile.file", format!("{}: {e}", path.display())))
}

/// Divides the curve into the segments of the rows.
pub(crate) fn division(input: &Input<'_>, curve: &Curve) -> Result<DividedProfile, StudyError> {
    let method = input.scene.division.method.unwrap_or(DivisionMethod::EqualLength);
    let length = match (input.scene.profile.length, curve.model) {
        (Some(length), _) => Some(input.length("profile.length", length)?),
        (None, model) => model.map(ProfileModel::length),
    };
    let is_split = method == DivisionMethod::DouglasPeucker;
    let tolerance = input.scene.division.tolerance.filter(|_| is_split);
    let (profile, division) = match tolerance {
        Some(tolerance) => simplified(input, curve, tolerance, length)?,
        None => divided(input, curve, method, length)?,
    };
    let divided = DividedProfile { fit: division.fit(&profile), profile, division, method };
    check_equal(input, &divided)?;
    Ok(divided)
}

/// Divides the curve by a tolerance, which determines the number of rows.
fn simplified(
    input: &Input<'_>,
    curve: &Curve,
    tolerance: f64,
    length: Option<f64>,
) -> Result<(Profile, Division), StudyError> {
    if input.scene.sheet.rows.is_some() {
        let message = "the rows follow from division.tolerance; omit one of the two";
        return Err(input.error("sheet.rows", message));
    }
    match length {
        Some(length) => simplify_to_length(&curve.profile, tolerance, length),
        None => {
            simplify(&curve.profile, tolerance).map(|division| (curve.profile.clone(), division))
        }
    }
    .map_err(|e| geometry_error(input, &e))
}

/// Divides the curve into a given number of rows.
fn divided(
    input: &Input<'_>,
    curve: &Curve,
    method: DivisionMethod,
    length: Option<f64>,
) -> Result<(Profile, Division), StudyError> {
    let rows = curve.model.map(|m| m.rows);
    let rows = input.count("sheet.rows", input.scene.sheet.rows, rows)?;
    let options = division_options(input, method)?;
    match length {
        Some(length) => divide_to_length(&curve.profile, rows, length, &options),
        None => {
            divide(&curve.profile, rows, &options).map(|division| (curve.profile.clone(), division))
        }
    }
    .map_err(|e| geometry_error(input, &e))
}

/// Refuses rows of unequal height unless `sheet.unequal` allows them.
fn check_equal(input: &Input<'_>, divided: &DividedProfile) -> Result<(), StudyError> {
    let division = &divided.division;
    let is_taken = matches!(
        input.scene.sheet.unequal,
        Some(UnequalChoice::OwnCase | UnequalChoice::CommonFlap)
    );
    if division.max_residual <= EQUAL_ROWS || is_taken {
        return Ok(());
    }
    let segments = division.points.len() - 1;
    if divided.method != DivisionMethod::EqualLength {
        let message = format!(
            "divides the profile into {segments} segments that differ by up to {:.3} of their mean (the curve is at most {:.6} and on average {:.6} away from them), but the rows of this sheet must be equal; use \"equal-length\", or set sheet.unequal = \"common-flap\"",
            division.max_residual, divided.fit.largest, divided.fit.mean
        );
        return Err(input.error("division.method", message));
    }
    Err(StudyError::Undivided {
        location: input.source.location_of("profile"),
        segments,
        residual: division.max_residual,
        iterations: division.iterations,
        remedy: if divided.profile.is_closed() {
            "the chains of equal chords from its start shrink into an acute corner at its seam or around a turn tighter than a segment: change the number of rows, round the corner, or raise division.max_iterations"
        } else {
            "its turns are too tight for segments of this length: change the number of rows, round the turns, or raise division.max_iterations"
        },
    })
}

fn division_options(
    input: &Input<'_>,
    method: DivisionMethod,
) -> Result<DivisionOptions, StudyError> {
    let scene = &input.scene.division;
    let mut options = DivisionOptions { method, ..DivisionOptions::default() };
    if let Some(tolerance) = scene.tolerance {
        if !(0.0..1.0).contains(&tolerance) {
            return Err(input.error("division.tolerance", "must be between 0 and 1"));
        }
        options.tolerance = tolerance;
    }
    if let Some(limit) = scene.max_iterations {
        options.max_iterations =
            usize::try_from(limit).ok().filter(|&n| (1..=1_000_000).contains(&n)).ok_or_else(
                || input.error("division.max_iterations", "must be between 1 and 1000000"),
            )?;
    }
    Ok(options)
}

/// An error in the curve, which is about `key` unless it is about a more specific one.
fn curve_error(input: &Input<'_>, error: &GeometryError, key: &str) -> StudyError {
    let key = match error {
        GeometryError::NotClosed { .. } | GeometryError::EndsApart { .. } => "profile.closed",
        GeometryError::KnotCount { .. }
        | GeometryError::KnotNotFinite { .. }
        | GeometryError::KnotsDecrease { .. }
        | GeometryError::KnotRange { .. }
        | GeometryError::KnotMultiplicity { .. }
        | GeometryError::KnotSpanTooNarrow { .. }
        | GeometryError::KnotsOfSmoothProfile => "profile.knots",
        _ => key,
    };
    input.error(key, error.to_string())
}

fn geometry_error(input: &Input<'_>, error: &GeometryError) -> StudyError {
    let scene = &input.scene.profile;
    let key = match error {
        GeometryError::Scale { .. } | GeometryError::Length { .. } => "profile.length",
        GeometryError::SegmentCount { .. }
        | GeometryError::SegmentTooShort { .. }
        | GeometryError::NothingToSplit { .. }
        | GeometryError::PolygonCrosses { .. } => "sheet.rows",
        GeometryError::Tolerance { .. }
        | GeometryError::SplitTolerance { .. }
        | GeometryError::TooCoarse { .. } => "division.tolerance",
        _ if scene.file.is_some() => "profile.file",
        _ if scene.points.is_some() => "profile.points",
        _ if scene.model.is_some() => "profile.model",
        _ => "profile.control_points",
    };
    input.error(key, error.to_string())
}

fn closure(closed: Option<Closed>) -> Closure {
    match closed {
        None => Closure::Open,
        Some(Closed::Corner) => Closure::Corner,
        Some(Closed::Smooth) => Closure::Smooth,
    }
}
