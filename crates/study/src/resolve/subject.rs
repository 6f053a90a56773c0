//! The sheet that is folded: units on a profile, or the crease pattern of a file.

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

/// The sheet that is folded.
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

    /// The sheet of units; `None` for an imported pattern.
    pub fn units(&self) -> Option<&UnitStudy> {
        match self {
            Self::Units(study) => Some(study),
            Self::Imported(_) => None,
        }
    }

    /// The imported pattern; `None` for a sheet of units.
    pub fn imported(&self) -> Option<&ImportedStudy> {
        match self {
            Self::Units(_) => None,
            Self::Imported(study) => Some(study),
        }
    }

    /// The stages of the motion.
    pub fn stages(&self) -> &'static [Stage] {
        match self {
            Self::Units(_) => &Stage::ALL,
            Self::Imported(_) => &[Stage::Fold],
        }
    }

    /// The motion time at which the motion starts.
    pub fn start_time(&self) -> f64 {
        self.stages()[0].start_time()
    }

    /// The positions at which the motion starts.
    pub fn start(&self) -> Cow<'_, [DVec3]> {
        match self {
            Self::Units(study) => Cow::Borrowed(&study.deployed),
            Self::Imported(study) => Cow::Owned(study.imported.sheet.planar()),
        }
    }

    /// The target fold angle of each edge at the end of the motion, in radians.
    pub fn end_angles(&self) -> &[f64] {
        match self {
            Self::Units(study) => study.units.compact_angles(),
            Self::Imported(study) => study.end_angles(),
        }
    }

    /// Motion times that are recorded in addition to the frames of the scene.
    pub(crate) fn times_of_interest(&self) -> Vec<f64> {
        match self {
            Self::Units(_) => Vec::new(),
            Self::Imported(study) => study.waypoint_times(),
        }
    }

    /// The exact layer order of the compact state; `None` for an imported pattern.
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

    /// The closed form of the compact box; `None` if there is none.
    pub fn closed_form(&self) -> Option<CompactBox> {
        self.units()?.closed_form
    }

    /// Unknown keys of the imported file, which the motion file preserves.
    pub(crate) fn preserved_keys(&self) -> Map<String, Value> {
        match self {
            Self::Units(_) => Map::new(),
            Self::Imported(study) => study.imported.keys_of_motion(&study.waypoints),
        }
    }

    /// The title of the imported pattern, if it has one.
    pub(crate) fn title(&self) -> Option<&String> {
        self.imported()?.imported.title.as_ref()
    }

    /// Places the frames of a motion as they are displayed and written.
    ///
    /// Units are placed by their exact states ([`place`]). Each frame of a pattern with a fixed facet is moved rigidly so that
    /// this facet best fits its position in the pattern. Other patterns are not moved.
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
                let position = |v: &u32| sheet.vertices[*v as usize].extend(0.0);
                let fixed: Vec<DVec3> = corners.iter().map(position).collect();
                for frame in frames {
                    let now = corners.iter().map(|&v| frame.positions[v as usize]);
                    let now: Vec<DVec3> = now.collect();
                    apply(&RigidMotion::best_fit(&now, &fixed), frame);
                }
            }
        }
    }

    /// Places a state of a run in progress for display: a pattern by its fixed facet. Units are not moved, since their
    /// placement depends on the end of the run.
    pub fn show(&self, positions: Vec<DVec3>) -> Vec<DVec3> {
        let mut frame = Frame { time: 0.0, positions };
        if self.imported().is_some() {
            self.place(std::slice::from_mut(&mut frame));
        }
        frame.positions
    }

    /// The box of a state: for units after the best rigid fit to the exact compact state, for a pattern along its principal axes.
    pub(crate) fn measured_box(&self, positions: &[DVec3]) -> FittedBox {
        match self {
            Self::Units(study) => fitted_box(positions, &study.units.compact()),
            Self::Imported(study) => principal_box(positions, &study.imported.sheet.faces),
        }
    }

    /// The longest side of the flat sheet, in unit lengths.
    pub(crate) fn size(&self) -> f64 {
        let sheet = self.sheet();
        let vertices = || sheet.vertices.iter().copied();
        let low = vertices().reduce(glam::DVec2::min).unwrap_or_default();
        let high = vertices().reduce(glam::DVec2::max).unwrap_or_default();
        (high - low).max_element() / sheet.unit_length
    }

    /// The width of the thinnest part of the sheet, and the number of layers that have to fit next to it.
    pub(crate) fn thinnest_part(&self) -> (f64, usize) {
        /// The number of layers in a column of a compact sheet, also assumed for a pattern.
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
