//! The plane that keeps the two primitives of a pair apart during one Newton step.
//!
//! c ≥ g asks that a vertex stays on its side of a facet's plane, or the line of an edge on its side of another's, or,
//! where the closest points lie on the border of either, that the closest points stay apart along the direction from
//! one to the other. Those two distances are smooth for every state of the sheet, unlike that of the primitives itself,
//! which has kinks where closest points pass from an inside to a border, and whose Hessian grows as its inverse there:
//! in a flat stack, where vertices lie over vertices a millionth of their facets' size apart, it outgrows all others.
//! Planes are made anew from the closest points for every step, so that what a search ends in is an equilibrium of
//! contact at distances. The force of a plane is that of an augmented Lagrangian (Hestenes 1969, Powell 1969)
//!
//! ψ = max(0, λ + κ (g − c))² / (2 κ),
//!
//! whose multiplier λ carries the force at the gap itself, so that κ need not grow without bound.

use glam::{DMat3, DVec3};

use super::super::hinge_hessian::outer;
use super::closest::Closest;
use super::pair::{ContactPair, PairKind};

/// Edges whose share of the stiffness is at most this leave their contact to the vertices at their ends.
const LEAST_SHARE: f64 = 1e-3;
/// A vertex that slides off a facet is held over the facet's plane until it is this many gaps away, or less than this
/// share of the gap over the plane.
const OFF_FACET: f64 = 2.0;
const LEAST_HEIGHT: f64 = 0.5;

/// The largest growth of κ in all.
const MOST_STIFFENING: f64 = 1e6;

/// How the distance between the two is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// From the plane of the facet, on one side of it.
    Facet,
    /// Between the lines of the edges.
    Lines,
    /// Along a direction held during the step.
    Fixed,
}

/// A linear inequality and its multiplier.
#[derive(Debug, Clone)]
pub(super) struct Plane {
    /// The index of the pair.
    pub(super) pair: u32,
    kind: PairKind,
    pub(super) nodes: [u32; 4],
    pub(super) form: Form,
    /// On which side of the facet or of the second edge the other is: the sign of c along the normal.
    side: f64,
    /// ∇c at the start of the step.
    pub(super) slopes: [DVec3; 4],
    /// c at the start of the step.
    pub(super) value: f64,
    /// g.
    pub(super) gap: f64,
    /// κ.
    pub(super) stiffness: f64,
    /// λ.
    pub(super) multiplier: f64,
    /// Whether the Newton step is to keep it.
    pub(super) is_active: bool,
}

impl Plane {
    /// The plane of `pair` with the corners `x`; `None` if its contact is left to other pairs.
    pub(super) fn new(pair: &ContactPair, x: &[DVec3; 4]) -> Option<Self> {
        let closest = pair.closest(x);
        let mut share = 1.0;
        let form = match pair.kind {
            PairKind::VertexFacet if closest.is_inside() => Form::Facet,
            PairKind::VertexFacet => {
                let height = facet_normal(x).dot(closest.apart).abs();
                let least = if pair.is_on_facet { LEAST_HEIGHT * pair.gap } else { pair.gap };
                if closest.distance < OFF_FACET * pair.gap && height >= least {
                    Form::Facet
                } else {
                    Form::Fixed
                }
            }
            // The vertices at the ends hold what slides off an edge, but a search that leaves it to them at once may
            // come back and go on in circles.
            PairKind::EdgeEdge
                if !closest.is_inside() && !pair.pushes && pair.multiplier == 0.0 =>
            {
                return None;
            }
            PairKind::EdgeEdge => {
                share = pair.share(x);
                if share < 1.0 || !closest.is_inside() { Form::Fixed } else { Form::Lines }
            }
        };
        if share <= LEAST_SHARE || closest.distance.is_nan() || closest.distance == 0.0 {
            return None;
        }
        let mut plane = Self {
            pair: 0,
            kind: pair.kind,
            nodes: pair.nodes,
            form,
            side: 1.0,
            slopes: closest.gradient(),
            value: closest.distance,
            gap: pair.gap,
            stiffness: share * pair.stiffening,
            multiplier: pair.multiplier,
            is_active: false,
        };
        if form != Form::Fixed {
            plane.side = plane.normal(x).dot(closest.apart).signum();
            (plane.value, plane.slopes) = plane.measure(x);
        }
        Some(plane)
    }

    /// Lets κ of its `pair` grow by `factor`, if it may.
    pub(super) fn stiffen(&mut self, pair: &mut ContactPair, factor: f64) -> bool {
        let may_grow = pair.stiffening < MOST_STIFFENING;
        if may_grow {
            pair.stiffening *= factor;
            self.stiffness *= factor;
        }
        may_grow
    }

    fn corners(&self, positions: &[DVec3]) -> [DVec3; 4] {
        self.nodes.map(|node| positions[node as usize])
    }

    /// The normal of the facet, or of both edges.
    fn normal(&self, x: &[DVec3; 4]) -> DVec3 {
        match self.kind {
            PairKind::VertexFacet => facet_normal(x),
            PairKind::EdgeEdge => (x[1] - x[0]).cross(x[3] - x[2]).normalize_or_zero(),
        }
    }

    /// The closest points of the vertex and the plane, or of the two lines.
    fn feet(&self, x: &[DVec3; 4]) -> Closest {
        match self.kind {
            PairKind::VertexFacet => Closest::vertex_plane(x),
            PairKind::EdgeEdge => Closest::lines(x),
        }
    }

    /// c and ∇c at the corners `x`.
    fn measure(&self, x: &[DVec3; 4]) -> (f64, [DVec3; 4]) {
        match self.form {
            Form::Fixed => (self.slopes.iter().zip(x).map(|(s, &x)| s.dot(x)).sum(), self.slopes),
            Form::Facet | Form::Lines => {
                let feet = self.feet(x);
                let normal = self.normal(x) * self.side;
                (normal.dot(feet.apart), feet.weights.map(|w| normal * w))
            }
        }
    }

    /// c at other positions.
    pub(super) fn value_at(&self, positions: &[DVec3]) -> f64 {
        let x = self.corners(positions);
        match (self.form, self.kind) {
            (Form::Fixed, _) => self.change(positions),
            (_, PairKind::VertexFacet) => self.normal(&x).dot(x[0] - x[1]) * self.side,
            (_, PairKind::EdgeEdge) => self.normal(&x).dot(x[0] - x[2]) * self.side,
        }
    }

    /// ∇c · d.
    #[inline]
    pub(super) fn change(&self, direction: &[DVec3]) -> f64 {
        let nodes = self.nodes.iter().zip(&self.slopes);
        nodes.map(|(&node, slope)| slope.dot(direction[node as usize])).sum()
    }

    /// λ + κ (g − c): the force, where positive.
    #[inline]
    pub(super) fn push(&self, value: f64) -> f64 {
        self.multiplier + self.stiffness * (self.gap - value)
    }

    /// The push after the step `direction`, were c linear.
    #[inline]
    pub(super) fn push_after(&self, direction: &[DVec3]) -> f64 {
        self.push(self.value + self.change(direction))
    }

    /// Subtracts `push` ∇c at the start of the step from `gradient`.
    pub(super) fn add_push(&self, push: f64, gradient: &mut [DVec3]) {
        for (&node, &slope) in self.nodes.iter().zip(&self.slopes) {
            gradient[node as usize] -= slope * push;
        }
    }

    /// ψ.
    pub(super) fn energy(&self, positions: &[DVec3]) -> f64 {
        let push = self.push(self.value_at(positions)).max(0.0);
        0.5 * push * push / self.stiffness
    }

    /// −∇ψ at other positions, if it pushes there.
    pub(super) fn forces(&self, positions: &[DVec3]) -> Option<[DVec3; 4]> {
        let (value, slopes) = self.measure(&self.corners(positions));
        let push = self.push(value);
        (push > 0.0).then(|| slopes.map(|slope| slope * push))
    }

    /// κ ∇c ∇cᵀ, and if `exact` the part of the curvature of c.
    pub(super) fn hessian(&self, positions: &[DVec3], exact: bool) -> [[DMat3; 4]; 4] {
        let mut hessian =
            self.slopes.map(|row| self.slopes.map(|column| outer(row * self.stiffness, column)));
        let push = self.push(self.value);
        if exact && push > 0.0 && self.form != Form::Fixed && self.value > 0.0 {
            let x = self.corners(positions);
            self.feet(&x).add_hessian(&x, -push, &mut hessian);
        }
        hessian
    }
}

fn facet_normal(x: &[DVec3; 4]) -> DVec3 {
    (x[2] - x[1]).cross(x[3] - x[1]).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GAP: f64 = 0.05;

    /// A vertex over a facet, a vertex held over a facet that it has left, crossing edges, and a vertex beside a facet.
    fn planes() -> Vec<(Form, ContactPair, Vec<DVec3>)> {
        let v = DVec3::new;
        let pair = |kind, mollifier| ContactPair::new(kind, [0, 1, 2, 3], [0, 1], GAP, mollifier);
        let facet = pair(PairKind::VertexFacet, 0.0);
        let held = ContactPair { is_on_facet: true, ..facet };
        let edges = pair(PairKind::EdgeEdge, ContactPair::mollifier([1.0, 1.0]));
        let corners = [v(0.0, 0.0, 0.0), v(1.0, 0.1, 0.02), v(0.0, 1.0, 0.01)];
        let over = |p: DVec3| vec![p, corners[0], corners[1], corners[2]];
        let crossing = [v(0.0, 0.0, 0.0), v(1.0, 0.1, 0.0), v(0.4, -0.5, 0.03), v(0.6, 0.7, 0.04)];
        vec![
            (Form::Facet, facet, over(v(0.3, 0.3, 0.045))),
            (Form::Facet, held, over(v(0.5, 0.035, 0.045))),
            (Form::Lines, edges, crossing.to_vec()),
            (Form::Fixed, facet, over(v(0.5, -0.02, 0.01))),
        ]
    }

    fn made((form, pair, x): &(Form, ContactPair, Vec<DVec3>)) -> Plane {
        let mut plane = Plane::new(pair, &[x[0], x[1], x[2], x[3]]).unwrap();
        assert_eq!(plane.form, *form);
        (plane.stiffness, plane.multiplier) = (7.0, 0.3);
        plane
    }

    fn shifted(x: &[DVec3], node: usize, axis: usize, by: f64) -> Vec<DVec3> {
        let mut y = x.to_vec();
        y[node][axis] += by;
        y
    }

    #[test]
    fn forces_agree_with_central_differences_of_the_energy() {
        for case in planes() {
            let plane = made(&case);
            let forces = plane.forces(&case.2).unwrap();
            for (node, axis) in (0..4).flat_map(|node| (0..3).map(move |axis| (node, axis))) {
                let energy = |by| plane.energy(&shifted(&case.2, node, axis, by));
                let slope = (energy(1e-6) - energy(-1e-6)) / 2e-6;
                let error = (slope + forces[node][axis]).abs();
                assert!(error < 1e-8, "{:?} {node} {axis}: {error}", case.0);
            }
        }
    }

    #[test]
    fn the_exact_hessian_agrees_with_central_differences_of_the_forces() {
        for case in planes() {
            let plane = made(&case);
            let hessian = plane.hessian(&case.2, true);
            for (node, axis) in (0..4).flat_map(|node| (0..3).map(move |axis| (node, axis))) {
                let forces = |by| plane.forces(&shifted(&case.2, node, axis, by)).unwrap();
                let (above, below) = (forces(1e-6), forces(-1e-6));
                for row in 0..4 {
                    let change = (below[row] - above[row]) / 2e-6;
                    let error = change.distance(hessian[row][node].col(axis));
                    assert!(error < 1e-7, "{:?} {row} {node}: {error}", case.0);
                }
            }
        }
    }

    #[test]
    fn where_it_is_made_its_distance_is_that_of_the_pair_unless_a_facet_holds_it() {
        for case in planes() {
            let plane = made(&case);
            let x = [case.2[0], case.2[1], case.2[2], case.2[3]];
            let distance = case.1.closest(&x).distance;
            if case.1.is_on_facet {
                assert!(plane.value < distance && plane.value > 0.7 * distance);
            } else {
                assert!((plane.value - distance).abs() < 1e-12, "{:?}", case.0);
            }
        }
    }

    #[test]
    fn layers_further_apart_than_the_gap_and_what_the_multiplier_carries_do_not_push() {
        let (_, pair, mut x) = planes().remove(0);
        x[0].z = 0.2;
        let plane = Plane::new(&pair, &[x[0], x[1], x[2], x[3]]).unwrap();
        assert!(plane.forces(&x).is_none() && plane.energy(&x) == 0.0);
    }
}
