//! The profile curve Γ as the scene defines it, and conversions between the kinds of definition.

use foldmotion_geometry::{Closure, Nurbs, Profile};
use foldmotion_pattern::{Case, Shape, find_model};
use foldmotion_study::scene::{CaseChoice, Closed, ProfileScene};
use foldmotion_study::{ProfileModel, Scene};
use glam::DVec2;

use super::knots::{clamped, inserted, removed};

/// Number of segments between the interpolation points that are taken from another curve.
const INTERPOLATION_POINTS: usize = 24;
/// Number of samples in the search for the point of a curve nearest to a position.
const SAMPLES: usize = 2048;

/// Which key of the scene defines the curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProfileKind {
    Model,
    ControlPoints,
    Points,
    File,
}

impl ProfileKind {
    /// The kind that a scene uses. A scene without a curve counts as one that names a model.
    pub(super) fn of(scene: &ProfileScene) -> Self {
        match scene {
            ProfileScene { control_points: Some(_), .. } => Self::ControlPoints,
            ProfileScene { points: Some(_), .. } => Self::Points,
            ProfileScene { file: Some(_), .. } => Self::File,
            _ => Self::Model,
        }
    }
}

/// The built-in model that the scene names.
pub(super) fn model(scene: &Scene) -> Option<&'static ProfileModel> {
    find_model(scene.profile.model.as_deref()?)
}

/// The curve in the units of the scene, before it is scaled to `profile.length`. `None` for a file and for points that
/// do not define a curve.
pub(super) fn own_profile(scene: &ProfileScene) -> Option<Profile> {
    let closure = match scene.closed {
        None => Closure::Open,
        Some(Closed::Corner) => Closure::Corner,
        Some(Closed::Smooth) => Closure::Smooth,
    };
    if let Some(points) = &scene.control_points {
        return match &scene.knots {
            Some(knots) => Profile::with_knots(&vectors(points), knots, closure),
            None => Profile::new(&vectors(points), closure),
        }
        .ok();
    }
    if let Some(points) = &scene.points {
        return Profile::through(&vectors(points), closure).ok();
    }
    find_model(scene.model.as_deref()?)?.profile().ok()
}

/// The points that can be dragged: control points or interpolation points.
pub(super) fn handles(scene: &ProfileScene) -> Option<&Vec<[f64; 2]>> {
    scene.control_points.as_ref().or(scene.points.as_ref())
}

pub(super) fn handles_mut(scene: &mut ProfileScene) -> Option<&mut Vec<[f64; 2]>> {
    scene.control_points.as_mut().or(scene.points.as_mut())
}

pub(super) fn fewest_handles(scene: &ProfileScene) -> usize {
    match (&scene.control_points, scene.closed) {
        (Some(_), _) => 4,
        (None, Some(_)) => 3,
        (None, None) => 2,
    }
}

/// Replaces the definition by control points of the same curve, with knots unless they are clamped and uniform.
/// `profile` is the curve to convert if the scene alone does not define it, as with a file.
pub(super) fn into_control_points(scene: &mut Scene, profile: Option<&Profile>) -> bool {
    let Some(profile) = own_profile(&scene.profile).or_else(|| profile.cloned()) else {
        return false;
    };
    write_model_size(scene);
    let shape = model(scene).map(|model| model.shape);
    let (points, knots, closure) = if let Some(Shape::ControlPoints(points)) = shape {
        (points.to_vec(), None, profile.closure())
    } else {
        written(&profile)
    };
    scene.profile = ProfileScene {
        control_points: Some(points),
        knots,
        closed: closed(closure),
        length: scene.profile.length,
        unit: scene.profile.unit,
        ..ProfileScene::default()
    };
    true
}

/// Control points, knots and closure of an interpolated curve. A smoothly closed curve, which has periodic knots,
/// becomes one closed at a corner without a kink.
fn written(profile: &Profile) -> (Vec<[f64; 2]>, Option<Vec<f64>>, Closure) {
    let curve = profile.curve();
    let mut points = curve.control_points().to_vec();
    let mut knots = curve.knots().to_vec();
    let mut closure = profile.closure();
    if closure == Closure::Smooth {
        closure = Closure::Corner;
        if let Some(spline) = clamped(&points, &knots) {
            (points, knots) = spline;
        }
    }
    if closure == Closure::Corner
        && let Some(last) = points.len().checked_sub(1)
    {
        points[last] = points[0];
    }
    let is_uniform = Nurbs::clamped(points.clone()).is_ok_and(|plain| plain.knots() == knots);
    let points = points.into_iter().map(<[f64; 2]>::from).collect();
    (points, (!is_uniform).then_some(knots), closure)
}

/// Replaces the definition by interpolation points: those of the model if it has them, otherwise points along the
/// curve, which changes it slightly.
pub(super) fn into_points(scene: &mut Scene, profile: Option<&Profile>) -> bool {
    let Some(profile) = own_profile(&scene.profile).or_else(|| profile.cloned()) else {
        return false;
    };
    write_model_size(scene);
    let shape = model(scene).map(|model| model.shape);
    let points = if let Some(Shape::Points(points)) = shape {
        points.to_vec()
    } else {
        let at = |k: usize| profile.position(k as f64 / INTERPOLATION_POINTS as f64);
        let last = INTERPOLATION_POINTS - usize::from(profile.is_closed());
        let size = profile.magnitude();
        (0..=last).map(|k| rounded(at(k), size).into()).collect()
    };
    scene.profile = ProfileScene {
        points: Some(points),
        closed: closed(profile.closure()),
        length: scene.profile.length,
        unit: scene.profile.unit,
        ..ProfileScene::default()
    };
    true
}

/// Replaces the definition by the name of a built-in model.
pub(super) fn into_model(scene: &mut Scene, name: &str) {
    scene.profile = ProfileScene {
        model: Some(name.to_owned()),
        length: scene.profile.length,
        unit: scene.profile.unit,
        ..ProfileScene::default()
    };
}

/// Replaces the definition by a file of points.
pub(super) fn into_file(scene: &mut Scene, file: String) {
    write_model_size(scene);
    scene.profile = ProfileScene {
        file: Some(file),
        length: scene.profile.length,
        unit: scene.profile.unit,
        closed: scene.profile.closed,
        ..ProfileScene::default()
    };
}

/// Writes into the scene what a built-in model defines and other profiles do not: length, rows, columns and width.
fn write_model_size(scene: &mut Scene) {
    let Some(model) = model(scene) else { return };
    let length = *scene.profile.length.get_or_insert(model.length());
    let rows = *scene.sheet.rows.get_or_insert(count(model.rows));
    let case = scene.sheet.case;
    scene.sheet.columns.get_or_insert(count(model.columns.of(columns_case(case))));
    if !matches!(case, None | Some(CaseChoice::E | CaseChoice::Auto)) {
        let width = model.columns.e as f64 * length / rows.max(1) as f64;
        scene.sheet.width.get_or_insert(width);
    }
}

/// The case whose number of columns a built-in model uses.
pub(super) fn columns_case(case: Option<CaseChoice>) -> Case {
    case.and_then(own_case).unwrap_or(Case::E)
}

/// The case that a choice stands for; `None` for `auto`.
pub(super) fn own_case(choice: CaseChoice) -> Option<Case> {
    match choice {
        CaseChoice::E => Some(Case::E),
        CaseChoice::T => Some(Case::T),
        CaseChoice::S => Some(Case::S),
        CaseChoice::SII => Some(Case::SII),
        CaseChoice::Plain => Some(Case::Plain),
        CaseChoice::Auto => None,
    }
}

/// Adds a draggable point at `place` and returns its index. Without knots in the scene, the point is inserted where the
/// polygon passes closest; with knots, a knot is inserted at the nearest parameter, which leaves the curve unchanged.
pub(super) fn add_handle(scene: &mut ProfileScene, place: DVec2) -> Option<usize> {
    if scene.knots.is_some() {
        return add_knot(scene, place);
    }
    let is_closed = scene.closed.is_some();
    let points = handles_mut(scene)?;
    let ends = vectors(points);
    let count = if is_closed { ends.len() } else { ends.len().saturating_sub(1) };
    let distance = |k: &usize| to_segment(place, ends[*k], ends[(*k + 1) % ends.len()]);
    let nearest = (0..count).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    points.insert(nearest + 1, place.into());
    Some(nearest + 1)
}

fn add_knot(scene: &mut ProfileScene, place: DVec2) -> Option<usize> {
    let profile = own_profile(scene)?;
    let (given, knots) = (scene.control_points.as_ref()?, scene.knots.as_ref()?);
    let mut points = vectors(given);
    let is_returning = points.len() + 1 == profile.curve().control_points().len();
    if is_returning {
        points.push(points[0]);
    }
    let (start, end) = (*knots.get(3)?, *knots.get(points.len())?);
    let u = start + (end - start) * nearest_parameter(&profile, place);
    let (mut more, knots) = inserted(&points, knots, u)?;
    let index = more.iter().zip(&points).position(|(new, old)| new != old)?;
    if is_returning {
        more.pop();
    }
    scene.control_points = Some(more.into_iter().map(<[f64; 2]>::from).collect());
    scene.knots = Some(knots);
    Some(index)
}

/// Removes a point if enough points remain; returns whether it did.
pub(super) fn remove_handle(scene: &mut ProfileScene, index: usize) -> bool {
    let fewest = fewest_handles(scene);
    let Some(points) = handles_mut(scene) else {
        return false;
    };
    if points.len() <= fewest || index >= points.len() {
        return false;
    }
    points.remove(index);
    if let Some(knots) = &scene.knots {
        scene.knots = Some(removed(knots, index));
    }
    true
}

/// The parameter, inside the domain, of the sample of the curve nearest to `place`.
fn nearest_parameter(profile: &Profile, place: DVec2) -> f64 {
    let at = |k: usize| (k as f64 + 0.5) / SAMPLES as f64;
    let distance = |u: f64| profile.position(u).distance_squared(place);
    (0..SAMPLES).map(at).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0.5)
}

fn to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    p.distance(a.lerp(b, share.clamp(0.0, 1.0)))
}

/// Rounds a point to as many decimals as locate it to a ten-thousandth of `size`.
pub(super) fn rounded(point: DVec2, size: f64) -> DVec2 {
    let power = (4.0 - size.max(1e-12).log10().floor()).clamp(-12.0, 15.0) as i32;
    let unit = 10.0_f64.powi(power);
    (point * unit).round() / unit
}

pub(super) fn vectors(points: &[[f64; 2]]) -> Vec<DVec2> {
    points.iter().copied().map(DVec2::from).collect()
}

fn count(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

fn closed(closure: Closure) -> Option<Closed> {
    match closure {
        Closure::Open => None,
        Closure::Corner => Some(Closed::Corner),
        Closure::Smooth => Some(Closed::Smooth),
    }
}

#[cfg(test)]
mod tests {
    use foldmotion_study::models;

    use super::*;

    fn scene_of(model: &ProfileModel) -> Scene {
        let mut scene = Scene::default();
        into_model(&mut scene, model.name);
        scene
    }

    #[test]
    fn a_model_as_control_points_is_the_same_curve() {
        for model in models() {
            let before = model.profile().unwrap();
            let mut scene = scene_of(model);
            assert!(into_control_points(&mut scene, None));
            assert_eq!(scene.profile.model, None);
            let after = own_profile(&scene.profile).unwrap();
            assert_eq!(before.is_closed(), after.is_closed());
            for k in 0..=500 {
                let u = f64::from(k) / 500.0;
                let error = before.position(u).distance(after.position(u));
                assert!(error <= 1e-12 * before.magnitude(), "{} at {u}: {error}", model.name);
            }
        }
    }

    #[test]
    fn a_model_of_control_points_needs_no_knots_and_an_interpolated_one_does() {
        let knots = |name: &str| {
            let model = models().iter().find(|m| m.name == name).unwrap();
            let mut scene = scene_of(model);
            into_control_points(&mut scene, None);
            scene.profile.knots
        };
        assert_eq!(knots("shelter"), None);
        assert_eq!(knots("whale"), None);
        assert!(knots("airfoil").is_some());
    }

    #[test]
    fn a_model_as_control_points_keeps_its_sheet() {
        let mut scene = scene_of(&models()[0]);
        scene.sheet.case = Some(CaseChoice::T);
        into_control_points(&mut scene, None);
        let model = models()[0];
        assert_eq!(scene.profile.length, Some(model.length()));
        assert_eq!(scene.sheet.rows, Some(count(model.rows)));
        assert_eq!(scene.sheet.columns, Some(count(model.columns.t)));
        let h = model.length() / model.rows as f64;
        assert_eq!(scene.sheet.width, Some(model.columns.e as f64 * h));
    }

    #[test]
    fn adding_a_point_to_a_curve_with_knots_keeps_the_curve() {
        for name in ["airfoil", "bunny", "fermat-spiral"] {
            let model = models().iter().find(|m| m.name == name).unwrap();
            let mut scene = scene_of(model);
            into_control_points(&mut scene, None);
            let before = own_profile(&scene.profile).unwrap();
            let count = handles(&scene.profile).unwrap().len();
            let place = before.position(0.4321);
            assert!(add_handle(&mut scene.profile, place).is_some());
            assert_eq!(handles(&scene.profile).unwrap().len(), count + 1);
            let after = own_profile(&scene.profile).unwrap();
            for k in 0..=500 {
                let u = f64::from(k) / 500.0;
                let error = before.position(u).distance(after.position(u));
                assert!(error <= 1e-12 * before.magnitude(), "{name} at {u}: {error}");
            }
        }
    }

    #[test]
    fn a_point_added_without_knots_goes_between_its_neighbours() {
        let mut scene = ProfileScene {
            control_points: Some(vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]]),
            ..ProfileScene::default()
        };
        assert_eq!(add_handle(&mut scene, DVec2::new(1.4, 0.1)), Some(2));
        assert_eq!(scene.control_points.as_ref().unwrap()[2], [1.4, 0.1]);
    }

    #[test]
    fn the_last_four_control_points_cannot_be_removed() {
        let mut scene = ProfileScene {
            control_points: Some((0..5).map(|k| [f64::from(k), 0.0]).collect()),
            knots: Some(vec![0.0, 0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0, 1.0]),
            ..ProfileScene::default()
        };
        assert!(remove_handle(&mut scene, 1));
        assert_eq!(scene.knots.as_ref().unwrap().len(), 8);
        assert!(!remove_handle(&mut scene, 1));
        assert_eq!(scene.control_points.unwrap().len(), 4);
    }

    #[test]
    fn a_curve_converted_to_interpolation_points_keeps_its_closure() {
        for model in models() {
            let before = model.profile().unwrap();
            let mut scene = scene_of(model);
            assert!(into_points(&mut scene, None));
            assert!(own_profile(&scene.profile).is_some(), "{}", model.name);
            assert_eq!(own_profile(&scene.profile).unwrap().closure(), before.closure());
        }
    }
}
