//! The built-in profiles: figure 6 and tables 1 and 2 of the paper.

mod airfoil;
mod bunny;
mod closed;
mod open;
mod spiral;

use foldmotion_geometry::{Closure, GeometryError, Profile};
use glam::DVec2;

use crate::Case;

pub use airfoil::NacaSection;

/// The definition of a built-in profile; each becomes a cubic NURBS with unit weights.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// Control points (x, z), with the uniform knots of the closure.
    ControlPoints(&'static [[f64; 2]]),
    /// Points (x, z) that the curve runs through.
    Points(&'static [[f64; 2]]),
    /// Both arms of Fermat's spiral r² = θ, led through points of the formula.
    FermatSpiral {
        /// Turns of each arm.
        turns: f64,
    },
    /// An airfoil, led through points of its formula.
    Naca(NacaSection),
}

/// Columns Nc in the cases of one target (Γ, W), with W = Nc·h in case E.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CaseColumns {
    /// Case E (table 1).
    pub e: usize,
    /// Case T, more than in E.
    pub t: usize,
    /// Cases S and SII, fewer than in E.
    pub s: usize,
    /// Whether `t` and `s` are our choice; table 2 prints them for four profiles only.
    pub ours: bool,
}

impl CaseColumns {
    /// The columns of a case; those of E for the unmodified rectangle.
    pub fn of(&self, case: Case) -> usize {
        match case {
            Case::E | Case::Plain => self.e,
            Case::T => self.t,
            Case::S | Case::SII => self.s,
        }
    }
}

/// A built-in profile and the sheets it is approximated with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileModel {
    /// The name a scene asks for.
    pub name: &'static str,
    /// A short description for people.
    pub title: &'static str,
    /// The curve of the profile.
    pub shape: Shape,
    /// Whether the profile is open or closed.
    pub closure: Closure,
    /// Rows Nr (table 1).
    pub rows: usize,
    /// Columns Nc of each case (tables 1 and 2).
    pub columns: CaseColumns,
    /// The source of its shape.
    pub source: &'static str,
}

impl ProfileModel {
    /// The curve Γ, in the size of its shape.
    ///
    /// # Errors
    /// `None` for the profiles of this crate.
    pub fn profile(&self) -> Result<Profile, GeometryError> {
        let list = |points: &[[f64; 2]]| -> Vec<DVec2> {
            points.iter().copied().map(DVec2::from).collect()
        };
        let points = match self.shape {
            Shape::ControlPoints(points) => return Profile::new(&list(points), self.closure),
            Shape::Points(points) => list(points),
            Shape::FermatSpiral { turns } => spiral::points(turns),
            Shape::Naca(section) => section.points(),
        };
        Profile::through(&points, self.closure)
    }

    /// Length of the divided polygon to scale the profile to, in the scene's unit: Nr, so that h = 1. The paper prints
    /// no size.
    pub fn length(&self) -> f64 {
        self.rows as f64
    }

    /// Whether it returns to its start.
    pub fn is_closed(&self) -> bool {
        self.closure != Closure::Open
    }
}

/// Every built-in profile, in the order of figure 6 and table 1.
pub fn models() -> &'static [ProfileModel] {
    const MODELS: [ProfileModel; 9] = [
        open::SHELTER,
        open::CHAIR,
        open::ROLLING_PAPER,
        spiral::FERMAT_SPIRAL,
        open::OMEGA,
        closed::MUSHROOM,
        closed::WHALE,
        airfoil::AIRFOIL,
        bunny::BUNNY,
    ];
    &MODELS
}

/// The built-in profile of that name.
pub fn find(name: &str) -> Option<&'static ProfileModel> {
    models().iter().find(|model| model.name == name)
}
