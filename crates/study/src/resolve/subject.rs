//! What is folded: a sheet of units on a profile, or the crease pattern of a file.

use std::borrow::Cow;

use foldmotion_check::{FittedBox, fitted_box, principal_box};
use foldmotion_geometry::RigidMotion;
use foldmotion_pattern::{CompactBox, Frame, LayerOrder, PatternCheck, Sheet};
use foldmotion_solver::Stage;
use glam::DVec3;
use serde_json::{Map, Value};

use super::imported::ImportedStudy;
use super::placement::{ExactStates, apply, place};
use super::units::UnitStudy;

/// What is folded.
#[derive(Debug, Clone)]
pub enum Subject {
    /// A sheet of units, from its deployed state through the flat one into the compact one.
    Units(Box<UnitStudy>),
    /// A crease pattern of a file, from flat to its fold angles.
    Imported(Box<ImportedStudy>),
}

impl Subject {
    /// The sheet.
    pub fn sheet(&self) -> &Sheet {
        match self {
            Self::Units(study) => &study.units.sheet,
            Self::Imported(study) => &study.imported.sheet,
        }
    }

    /// The sheet of units, where it is one.
    pub fn units(&self) -> Option<&UnitStudy> {
        match self {
            Self::Units(study) => Some(study),
            Self::Imported(_) => None,
        }
    }

    /// The imported pattern, where it is one.
    pub fn imported(&self) -> Option<&ImportedStudy> {
        match self {
            Self::Units(_) => None,
            Self::Imported(study) => Some(study),
        }
    }

    /// The stages of its motion.
    pub fn stages(&self) -> &'static [Stage] {
        match self {
            Self::Units(_) => &Stage::ALL,
            Self::Imported(_) => &[Stage::Fold],
        }
    }

    /// The motion time at which it starts.
    pub fn start_time(&self) -> f64 {
        self.stages()[0].start_time()
    }

    /// The state in which it starts.
    pub fn start(&self) -> Cow<'_, [DVec3]> {
        match self {
            Self::Units(study) => Cow::Borrowed(&study.deployed),
            Self::Imported(study) => Cow::Owned(study.imported.sheet.planar()),
        }
    }

    /// The fold angle every edge ends with, radians.
    pub fn end_angles(&self) -> &[f64] {
        match self {
            Self::Units(study) => study.units.compact_angles(),
            Self::Imported(study) => study.end_angles(),
        }
    }

    /// Motion times that are recorded whatever the frames.
    pub(crate) fn times_of_interest(&self) -> Vec<f64> {
        match self {
            Self::Units(_) => Vec::new(),
            Self::Imported(study) => study.waypoint_times(),
        }
    }

    /// The exact order of the layers in the compact state, where it is known.
    pub fn compact_order(&self) -> Option<&LayerOrder> {
        Some(&self.units()?.compact_order)
    }

    /// The pattern check.
    pub fn pattern_check(&self) -> &PatternCheck {
        match self {
            Self::Units(study) => &study.pattern,
            Self::Imported(study) => &study.pattern,
        }
    }

    /// The closed form of the compact box, where there is one.
    pub fn closed_form(&self) -> Option<CompactBox> {
        self.units()?.closed_form
    }

    /// Keys of the file it comes from that its motion file keeps.
    pub(crate) fn preserved_keys(&self) -> Map<String, Value> {
        match self {
            Self::Units(_) => Map::new(),
            Self::Imported(study) => study.imported.keys_of_triangles(),
        }
    }

    /// Its title, where it has one.
    pub(crate) fn title(&self) -> Option<&String> {
        self.imported()?.imported.title.as_ref()
    }

    /// Moves the frames of a motion to where they are shown.
    ///
    /// Units: at t = 0, 1, 2 as the exact states lie, between them smoothly ([`place`]). A pattern with a
    /// fixed facet: each frame by the rigid motion that best fits this facet to its place in the pattern. Others stay.
    pub(crate) fn place(&self, frames: &mut [Frame]) {
        match self {
            Self::Units(study) => {
                let exact = ExactStates {
                    deployed: &study.deployed,
                    planar: &study.units.sheet.planar(),
                    compact: &study.units.compact(),
                };
                place(frames, &exact);
            }
            Self::Imported(study) => {
                let Some(facet) = study.fixed else { return };
                let sheet = &study.imported.sheet;
                let corners = &sheet.facets[facet as usize].polygon;
                let place = |v: &u32| sheet.vertices[*v as usize].extend(0.0);
                let places: Vec<DVec3> = corners.iter().map(place).collect();
                for frame in frames {
                    let now = corners.iter().map(|&v| frame.positions[v as usize]);
                    let now: Vec<DVec3> = now.collect();
                    apply(&RigidMotion::best_fit(&now, &places), frame);
                }
            }
        }
    }

    /// Moves a state of a run under way to where it is shown: a pattern with its fixed facet to its place. Where units
    /// will be shown is known at the end of the run only.
    pub fn show(&self, positions: Vec<DVec3>) -> Vec<DVec3> {
        let mut frame = Frame {
            time: 0.0,
            positions,
        };
        if self.imported().is_some() {
            self.place(std::slice::from_mut(&mut frame));
        }
        frame.positions
    }

    /// The box of a state: of units in the frame of the exact compact state, of a pattern along its principal axes.
    pub(crate) fn measured_box(&self, positions: &[DVec3]) -> FittedBox {
        match self {
            Self::Units(study) => fitted_box(positions, &study.units.compact()),
            Self::Imported(study) => principal_box(positions, &study.imported.sheet.faces),
        }
    }

    /// The width of its thinnest part, and how many layers may have to fit beside it.
    pub(crate) fn thinnest_part(&self) -> (f64, usize) {
        /// Layers in a column of a compact sheet; a pattern is taken to have as many.
        const LAYERS: usize = 8;
        match self {
            Self::Units(study) => {
                let layers = study.units.map_layers().unwrap_or(LAYERS);
                (study.units.thinnest_part(), layers)
            }
            Self::Imported(study) => (smallest_height(&study.imported.sheet), LAYERS),
        }
    }
}

/// The smallest height of a triangle.
fn smallest_height(sheet: &Sheet) -> f64 {
    let height = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| sheet.vertices[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        (b - a).perp_dot(c - a) / longest
    };
    sheet.faces.iter().map(height).fold(f64::INFINITY, f64::min)
}
