//! The built-in profiles.

use foldmotion_geometry::Closure;

/// A built-in profile and the sheet it is usually approximated with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileModel {
    /// The name a scene asks for.
    pub name: &'static str,
    /// What it is, in a few words.
    pub title: &'static str,
    /// Control points (x, z) of a cubic NURBS curve with unit weights and the uniform knots of its closure.
    pub control_points: &'static [[f64; 2]],
    /// How it ends.
    pub closure: Closure,
    /// Rows Nr.
    pub rows: usize,
    /// Columns Nc of case E.
    pub columns: usize,
    /// Length of the divided polygon to scale the profile to; the unit is the scene's.
    pub length: f64,
    /// Where its shape comes from.
    pub source: &'static str,
}

impl ProfileModel {
    /// Whether it returns to its start.
    pub fn is_closed(&self) -> bool {
        self.closure != Closure::Open
    }
}

/// A foot lying on the ground, a steep wall, a roof of three segments, wall and foot: from the right foot over the roof
/// to the left one, mirror symmetric about x = 0. Doubled control points turn the curve sharply at the foot and at the eaves; the
/// feet are straight because four control points lie on the ground.
const SHELTER: ProfileModel = ProfileModel {
    name: "shelter",
    title: "shelter: foot, wall, roof, wall, foot",
    control_points: &[
        [2.47, 0.0],
        [1.67, 0.0],
        [1.40, 0.0],
        [1.40, 0.0],
        [1.38, 0.49],
        [1.30, 1.02],
        [1.30, 1.02],
        [0.53, 1.66],
        [0.0, 1.67],
        [-0.53, 1.66],
        [-1.30, 1.02],
        [-1.30, 1.02],
        [-1.38, 0.49],
        [-1.40, 0.0],
        [-1.40, 0.0],
        [-1.67, 0.0],
        [-2.47, 0.0],
    ],
    closure: Closure::Open,
    rows: 7,
    columns: 5,
    length: 7.0,
    source: "drawn for foldmotion after figure 6a and table 1 (a) of the paper, which prints no control points",
};

/// Every built-in profile, in the order in which they are listed.
pub fn models() -> &'static [ProfileModel] {
    &[SHELTER]
}

/// The built-in profile of that name.
pub fn find(name: &str) -> Option<&'static ProfileModel> {
    models().iter().find(|model| model.name == name)
}

#[cfg(test)]
mod tests {
    use foldmotion_geometry::{Division, DivisionOptions, Profile, divide_to_length};
    use glam::DVec2;

    use super::*;

    fn divided(model: &ProfileModel) -> (Profile, Division) {
        let points: Vec<_> = model
            .control_points
            .iter()
            .copied()
            .map(DVec2::from)
            .collect();
        let profile = Profile::new(&points, model.closure).unwrap();
        divide_to_length(
            &profile,
            model.rows,
            model.length,
            &DivisionOptions::default(),
        )
        .unwrap()
    }

    #[test]
    fn every_model_is_found_by_its_name_and_divides_to_its_length() {
        for model in models() {
            assert_eq!(find(model.name), Some(model));
            let (_, division) = divided(model);
            assert!(
                division.converged(),
                "{}: {:?}",
                model.name,
                division.ending
            );
            assert!(
                division.max_residual <= 1e-12,
                "{}: {}",
                model.name,
                division.max_residual
            );
            assert!((division.length() - model.length).abs() <= 1e-14 * model.length);
        }
        assert_eq!(find("Shelter"), None);
    }

    #[test]
    fn the_shelter_reads_foot_wall_roof_wall_foot_from_right_to_left() {
        let (_, division) = divided(&SHELTER);
        let directions: Vec<_> = division
            .points
            .windows(2)
            .map(|p| {
                (p[1] - p[0])
                    .to_angle()
                    .rem_euclid(std::f64::consts::TAU)
                    .to_degrees()
            })
            .collect();
        let expected = [180.0, 99.5, 143.2, 180.0, 216.8, 260.5, 180.0];
        for (direction, expected) in directions.iter().zip(expected) {
            assert!((direction - expected).abs() < 0.1, "{directions:?}");
        }
    }

    #[test]
    fn the_shelter_stands_on_the_ground_and_is_mirror_symmetric() {
        let (profile, division) = divided(&SHELTER);
        for (a, b) in division.points.iter().zip(division.points.iter().rev()) {
            assert!(
                (a.x + b.x).abs() < 1e-13 && (a.y - b.y).abs() < 1e-13,
                "{a} {b}"
            );
        }
        let feet = [0, 1, 6, 7].map(|k| division.points[k].y);
        assert_eq!(feet, [0.0; 4]);
        for k in 0..=1000 {
            assert!(profile.position(f64::from(k) / 1000.0).y >= 0.0);
        }
    }
}
