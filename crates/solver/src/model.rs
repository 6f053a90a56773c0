//! The bar-and-hinge model of a sheet: its elements, its energy and the gradient of it.
//!
//! Every edge of the triangulated sheet is a bar, every edge between two triangles a hinge, every vertex a node of
//! unit mass:
//!
//! U = Σ ½ (EA / l₀) (l − l₀)² + Σ ½ κ l₀ (θ − θ*)² + Σ ½ φ (α − α₀)²
//!
//! over the bars (length l, rest length l₀), the hinges (fold angle θ, target θ*, κ the fold or the facet stiffness)
//! and the corners of the triangles (angle α, rest angle α₀, φ the face-angle stiffness, 0 by default). Source:
//! Ghassaei, Demaine, Gershenfeld 2018, "Fast, interactive origami simulation using GPU computation"; Schenk and Guest
//! 2011 for the bar-and-hinge idea.
//!
//! **Units.** Inside the model every length is divided by the sheet's unit length h, so that a sheet drawn in
//! millimetres or in metres is the same model. Positions given to and returned by [`Model`]'s methods are in these
//! units; [`Model::to_model`] and [`Model::to_sheet`] convert. Scaling all lengths by one factor scales the bar and
//! the hinge energies alike, so h does not shape the equilibrium of bars and hinges; it does weigh the face-angle
//! term, whose stiffness is per corner, and sets the pace against the unit node mass. Energies are in units of EA·h
//! for a stiffness of EA = 1, forces in units of EA.

use foldmotion_geometry::{fold_angle, fold_angle_gradient, nearest_turn};
use foldmotion_pattern::{Assignment, Edge, Sheet};
use glam::{DVec2, DVec3};

use crate::face_angle::{face_angle, face_angle_gradient};
use crate::gather::Gather;
use crate::locality::hilbert_order;
use crate::{Material, SolverError};

/// The smallest edge length and triangle height taken, in unit lengths: below it stiffnesses and fold-angle gradients
/// outgrow what f64 resolves.
const MIN_LENGTH: f64 = 1e-6;

/// An axial spring along an edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bar {
    /// The nodes of the element.
    pub vertices: [u32; 2],
    /// l₀, its length in the crease pattern, in unit lengths.
    pub rest_length: f64,
    /// The axial stiffness k = EA / l₀.
    pub stiffness: f64,
}

/// The kind of a hinge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum HingeKind {
    /// Mountain or valley: driven by the schedule.
    Crease,
    /// Inside a facet: held flat.
    Facet,
    /// Neither driven nor held: its stiffness is 0.
    Free,
}

/// A rotational spring along an edge between two triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hinge {
    /// Ends e₀, e₁ of the edge and the apexes on its left and right, as [`fold_angle`] takes them.
    pub vertices: [u32; 4],
    /// The index of the edge in the sheet.
    pub edge: u32,
    /// k l₀, the moment per radian.
    pub stiffness: f64,
    /// Crease or facet hinge.
    pub kind: HingeKind,
}

/// A triangle with its rest angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceAngles {
    /// The nodes of the element.
    pub vertices: [u32; 3],
    /// α₀ at each of them, in radians.
    pub rest_angles: [f64; 3],
}

/// Energy by the kind of element that stores it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyByKind {
    /// The energy of the bars.
    pub bars: f64,
    /// The energy of the creases.
    pub creases: f64,
    /// The energy of the facet hinges.
    pub facets: f64,
    /// The energy of the face-angle springs.
    pub face_angles: f64,
}

impl EnergyByKind {
    /// The total energy U.
    pub fn total(&self) -> f64 {
        self.bars + self.creases + self.facets + self.face_angles
    }
}

/// The bar-and-hinge model of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// h, the sheet's unit length in the sheet's unit.
    pub unit_length: f64,
    /// The material it was built with.
    pub material: Material,
    /// One for each edge of the sheet, in its order.
    pub bars: Vec<Bar>,
    /// One for each edge between two triangles, in the order of the sheet's edges.
    pub hinges: Vec<Hinge>,
    /// The nodes of the triangles of the sheet, in its order.
    pub faces: Vec<[u32; 3]>,
    /// The triangles whose angles are held: all, or none if the face-angle stiffness is 0.
    pub face_angles: Vec<FaceAngles>,
    /// The crease pattern in unit lengths.
    pub(crate) pattern: Vec<DVec2>,
    /// The nodes in an order that keeps neighbours together.
    pub(crate) locality: Vec<u32>,
    pub(crate) bar_gather: Gather,
}

impl Model {
    /// The model of `sheet` in `material`.
    ///
    /// # Errors
    /// [`SolverError::MaterialOutOfRange`], [`SolverError::UnitLength`], [`SolverError::NoFacets`], and
    /// [`SolverError::DegenerateEdge`] or [`SolverError::DegenerateFace`] for an edge or a height below 1e-6 unit
    /// lengths.
    pub fn new(sheet: &Sheet, material: &Material) -> Result<Self, SolverError> {
        material.validate()?;
        let unit_length = sheet.unit_length;
        if !(unit_length.is_finite() && unit_length > 0.0) {
            return Err(SolverError::UnitLength { value: unit_length });
        }
        if sheet.faces.is_empty() {
            return Err(SolverError::NoFacets);
        }
        let rest: Vec<DVec3> =
            sheet.vertices.iter().map(|v| (*v / unit_length).extend(0.0)).collect();
        let bars = build_bars(sheet, material, &rest)?;
        let hinges = build_hinges(sheet, material, &bars);
        let faces = build_faces(sheet, &rest)?;
        let face_angles = if material.face_angle_stiffness > 0.0 { faces } else { Vec::new() };
        Ok(Self {
            unit_length,
            material: *material,
            pattern: sheet.vertices.iter().map(|&v| v / unit_length).collect(),
            locality: hilbert_order(&sheet.vertices),
            bar_gather: Gather::new(rest.len(), bars.iter().map(|bar| &bar.vertices)),
            bars,
            hinges,
            faces: sheet.faces.clone(),
            face_angles,
        })
    }

    /// The number of nodes; each has mass 1.
    pub fn node_count(&self) -> usize {
        self.locality.len()
    }

    /// Positions in unit lengths, from positions in the sheet's unit.
    pub fn to_model(&self, positions: &[DVec3]) -> Vec<DVec3> {
        positions.iter().map(|&p| p / self.unit_length).collect()
    }

    /// Positions in the sheet's unit, from positions in unit lengths.
    pub fn to_sheet(&self, positions: &[DVec3]) -> Vec<DVec3> {
        positions.iter().map(|&p| p * self.unit_length).collect()
    }

    /// Follows the fold angle of every hinge to `positions`: each entry of `angles` moves to the value of the fold
    /// angle, modulo 2π, nearest to what it was.
    ///
    /// Start from zeros for any state folded by less than ±π. Precondition: one entry a hinge, one position a node,
    /// and no hinge turned by π or more since.
    pub fn follow_angles(&self, positions: &[DVec3], angles: &mut [f64]) {
        for (hinge, angle) in self.hinges.iter().zip(angles) {
            let [e0, e1, left, right] = hinge.vertices.map(|v| positions[v as usize]);
            *angle = nearest_turn(fold_angle(e0, e1, left, right), *angle);
        }
    }

    /// The energy of the sheet at `positions`.
    ///
    /// `angles`: the followed fold angle of every hinge at these positions; `targets`: their targets, radians.
    pub fn energy_by_kind(
        &self,
        positions: &[DVec3],
        angles: &[f64],
        targets: &[f64],
    ) -> EnergyByKind {
        let mut energy = EnergyByKind::default();
        for bar in &self.bars {
            let [a, b] = bar.vertices.map(|v| positions[v as usize]);
            let elongation = a.distance(b) - bar.rest_length;
            energy.bars += 0.5 * bar.stiffness * elongation * elongation;
        }
        for ((hinge, angle), target) in self.hinges.iter().zip(angles).zip(targets) {
            let share = match hinge.kind {
                HingeKind::Crease => &mut energy.creases,
                HingeKind::Facet | HingeKind::Free => &mut energy.facets,
            };
            *share += 0.5 * hinge.stiffness * (angle - target) * (angle - target);
        }
        for face in &self.face_angles {
            for deviation in face.deviations(positions) {
                energy.face_angles +=
                    0.5 * self.material.face_angle_stiffness * deviation * deviation;
            }
        }
        energy
    }

    /// Writes the gradient of the energy at `positions` into `gradient`, one vector a node; the force is its negative.
    ///
    /// `angles` and `targets` as in [`Self::energy_by_kind`].
    pub fn gradient(
        &self,
        positions: &[DVec3],
        angles: &[f64],
        targets: &[f64],
        gradient: &mut [DVec3],
    ) {
        gradient.fill(DVec3::ZERO);
        for bar in &self.bars {
            let pull = bar.pull(positions);
            gradient[bar.vertices[0] as usize] -= pull;
            gradient[bar.vertices[1] as usize] += pull;
        }
        for ((hinge, angle), target) in self.hinges.iter().zip(angles).zip(targets) {
            let moment = hinge.stiffness * (angle - target);
            for (vertex, slope) in hinge.vertices.iter().zip(hinge.angle_gradient(positions)) {
                gradient[*vertex as usize] += slope * moment;
            }
        }
        for face in &self.face_angles {
            let slopes = face.energy_gradient(positions, self.material.face_angle_stiffness);
            for (vertex, slope) in face.vertices.iter().zip(slopes) {
                gradient[*vertex as usize] += slope;
            }
        }
    }

    /// (l − l₀) / l₀ of every bar.
    pub fn strains(&self, positions: &[DVec3]) -> Vec<f64> {
        self.bars.iter().map(|bar| bar.length(positions) / bar.rest_length - 1.0).collect()
    }
}

impl Bar {
    /// Its length at `positions`.
    pub fn length(&self, positions: &[DVec3]) -> f64 {
        positions[self.vertices[0] as usize].distance(positions[self.vertices[1] as usize])
    }

    /// The force it exerts on its first node: k (l − l₀) towards the second; ∂U/∂(second node).
    ///
    /// 0 for a bar pressed to a point, which has no direction.
    pub fn pull(&self, positions: &[DVec3]) -> DVec3 {
        let [a, b] = self.vertices.map(|v| positions[v as usize]);
        let along = b - a;
        let length = along.length();
        if length == 0.0 {
            return DVec3::ZERO;
        }
        along * (self.stiffness * (1.0 - self.rest_length / length))
    }
}

impl Hinge {
    /// The gradient of its fold angle with respect to its four nodes.
    pub fn angle_gradient(&self, positions: &[DVec3]) -> [DVec3; 4] {
        let [e0, e1, left, right] = self.vertices.map(|v| positions[v as usize]);
        fold_angle_gradient(e0, e1, left, right)
    }
}

impl FaceAngles {
    /// α − α₀ at its three corners.
    pub fn deviations(&self, positions: &[DVec3]) -> [f64; 3] {
        let [a, b, c] = self.vertices.map(|v| positions[v as usize]);
        let [a0, b0, c0] = self.rest_angles;
        [face_angle(a, b, c) - a0, face_angle(b, c, a) - b0, face_angle(c, a, b) - c0]
    }

    /// The gradient of Σ k (α − α₀)² / 2 over its corners with respect to its nodes.
    pub fn energy_gradient(&self, positions: &[DVec3], stiffness: f64) -> [DVec3; 3] {
        let [a, b, c] = self.vertices.map(|v| positions[v as usize]);
        let moments = self.deviations(positions).map(|deviation| stiffness * deviation);
        let at_a = face_angle_gradient(a, b, c).map(|g| g * moments[0]);
        let at_b = face_angle_gradient(b, c, a).map(|g| g * moments[1]);
        let at_c = face_angle_gradient(c, a, b).map(|g| g * moments[2]);
        [at_a[0] + at_b[2] + at_c[1], at_a[1] + at_b[0] + at_c[2], at_a[2] + at_b[1] + at_c[0]]
    }
}

fn build_bars(sheet: &Sheet, material: &Material, rest: &[DVec3]) -> Result<Vec<Bar>, SolverError> {
    let bar = |(edge, vertices): (usize, [u32; 2])| {
        let [a, b] = vertices.map(|v| rest[v as usize]);
        let length = a.distance(b);
        if !(length >= MIN_LENGTH && length.is_finite()) {
            return Err(SolverError::DegenerateEdge {
                edge,
                vertices,
                length,
                minimum: MIN_LENGTH,
            });
        }
        let stiffness = material.axial_stiffness / length;
        Ok(Bar { vertices, rest_length: length, stiffness })
    };
    sheet.edges.iter().map(|edge| edge.vertices).enumerate().map(bar).collect()
}

fn build_hinges(sheet: &Sheet, material: &Material, bars: &[Bar]) -> Vec<Hinge> {
    let hinge = |(index, edge): (usize, &Edge)| {
        let vertices = sheet.hinge_vertices(edge)?;
        let (kind, stiffness) = match edge.assignment {
            Assignment::Mountain | Assignment::Valley => {
                (HingeKind::Crease, material.fold_stiffness)
            }
            Assignment::Free => (HingeKind::Free, 0.0),
            Assignment::Border | Assignment::Facet => (HingeKind::Facet, material.facet_stiffness),
        };
        let rest_length = bars[index].rest_length;
        Some(Hinge { vertices, edge: index as u32, stiffness: stiffness * rest_length, kind })
    };
    sheet.edges.iter().enumerate().filter_map(hinge).collect()
}

fn build_faces(sheet: &Sheet, rest: &[DVec3]) -> Result<Vec<FaceAngles>, SolverError> {
    let face = |(index, &vertices): (usize, &[u32; 3])| {
        let [a, b, c] = vertices.map(|v| rest[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let height = (b - a).cross(c - a).length() / longest;
        if !(height >= MIN_LENGTH && height.is_finite()) {
            return Err(SolverError::DegenerateFace {
                face: index,
                vertices,
                height,
                minimum: MIN_LENGTH,
            });
        }
        let rest_angles = [face_angle(a, b, c), face_angle(b, c, a), face_angle(c, a, b)];
        Ok(FaceAngles { vertices, rest_angles })
    };
    sheet.faces.iter().enumerate().map(face).collect()
}
