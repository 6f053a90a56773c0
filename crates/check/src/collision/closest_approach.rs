//! The closest approach of a motion so far, between two bounds.

use foldmotion_geometry::{
    Closest,
    collide::{Limits, enough_clearance},
};
use glam::DVec3;

use super::{judge::DistanceBounds, report::Separation};

/// Bounds of the smallest distance between facets that share no vertex: lengths, relative to the origin of the check.
#[derive(Debug)]
pub(super) struct ClosestApproach {
    /// Where the smallest distance found is attained; `None` if no pair is measured.
    attained: Option<Attained>,
    /// No measured pair has come nearer than this in any interval so far. Pairs that were left out are farther apart
    /// than the distance attained by then, up to the accuracy to which it was needed.
    at_least: f64,
    /// The limits that determine the accuracy of the bounds, for the largest extent so far.
    limits: Limits,
}

#[derive(Debug, Clone, Copy)]
struct Attained {
    faces: [u32; 2],
    time: f64,
    closest: Closest,
}

impl ClosestApproach {
    pub(super) fn new(limits: &Limits) -> Self {
        Self { attained: None, at_least: f64::INFINITY, limits: *limits }
    }

    /// The smallest distance found; `None` if no pair is measured.
    pub(super) fn distance(&self) -> Option<f64> {
        self.attained.map(|attained| attained.closest.distance)
    }

    pub(super) fn faces(&self) -> Option<[u32; 2]> {
        self.attained.map(|attained| attained.faces)
    }

    /// Adopts the margin of the next interval if it is larger.
    pub(super) fn extend(&mut self, limits: &Limits) {
        self.limits.margin = self.limits.margin.max(limits.margin);
    }

    /// Records a distance that is attained, if it is the smallest so far.
    pub(super) fn keep(&mut self, faces: [u32; 2], time: f64, closest: Closest) {
        if self.distance().is_none_or(|least| closest.distance < least) {
            self.attained = Some(Attained { faces, time, closest });
        }
    }

    /// Records the distance bounds of a pair between two motion times.
    pub(super) fn record(&mut self, faces: [u32; 2], times: [f64; 2], distance: &DistanceBounds) {
        self.at_least = self.at_least.min(distance.at_least);
        if let Some(approach) = distance.approach {
            let time = times[0] + (times[1] - times[0]) * approach.time;
            self.keep(faces, time, approach.closest);
        }
    }

    /// The bounds in units of `unit`, with points relative to the origin of the motion.
    pub(super) fn separation(&self, unit: f64, origin: DVec3) -> Option<Separation> {
        let Attained { faces, time, closest } = self.attained?;
        let upper = closest.distance;
        let lower = self.at_least.min(upper - self.limits.margin).max(0.0);
        Some(Separation {
            distance: lower / unit,
            attained: upper / unit,
            is_tight: lower >= enough_clearance(upper, &self.limits),
            time,
            faces,
            points: [closest.on_a + origin, closest.on_b + origin],
        })
    }
}
