//! The directions along which a pair was kept on its side through an interval.

use glam::DVec3;

use crate::instant::{axes, roomiest};
use crate::moving_pair::{Feature, MovingPair};
use crate::side::Side;

/// The direction used over a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum StepDirection {
    /// The normal given by a feature, and its sense.
    Along((Feature, f64)),
    Fixed(DVec3),
}

/// The steps in order. Steps over which the pair is strictly apart have no directions.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Trail {
    start: Vec<DVec3>,
    steps: Vec<([f64; 2], Vec<StepDirection>)>,
}

impl Trail {
    pub(crate) fn new(side: &Side) -> Self {
        let contact = (!side.is_apart).then(|| side.directions.clone());
        Self { start: contact.unwrap_or_default(), steps: Vec::new() }
    }

    /// The trail of a pair that does not move.
    pub(crate) fn at_rest(side: &Side) -> Self {
        let directions = side.directions.iter().copied().map(StepDirection::Fixed);
        Self { steps: vec![([0.0, 1.0], directions.collect())], ..Self::new(side) }
    }

    pub(crate) fn push(&mut self, times: [f64; 2], directions: Vec<StepDirection>) {
        self.steps.push((times, directions));
    }

    /// The ends of the steps in contact.
    pub(crate) fn instants(&self) -> impl Iterator<Item = f64> {
        let in_contact = self.steps.iter().filter(|(_, directions)| !directions.is_empty());
        in_contact.flat_map(|(times, _)| *times)
    }

    /// Directions in the part of D(t) that the pair has reached, some in each of its components; empty if none is
    /// known.
    pub(crate) fn at(&self, moving: &MovingPair, t: f64) -> Vec<DVec3> {
        if t <= 0.0 && !self.start.is_empty() {
            return self.start.clone();
        }
        let index = self.steps.partition_point(|(times, _)| times[1] < t);
        let directions = self.steps.get(index).map(|(_, directions)| &directions[..]);
        let directions = directions.unwrap_or_default();
        if directions.is_empty() {
            return apart(moving, t);
        }
        let pose = moving.at(t);
        let here = moving.part(&pose, &pose);
        let directions = directions.iter().filter_map(|step_direction| match *step_direction {
            StepDirection::Along(feature) => here.directed(feature).ends()[0].try_normalize(),
            StepDirection::Fixed(direction) => Some(direction),
        });
        directions.collect()
    }
}

/// A direction along which the triangles are strictly apart, if there is one.
pub(crate) fn apart(moving: &MovingPair, t: f64) -> Vec<DVec3> {
    let pose = moving.at(t);
    roomiest(&axes(moving, &pose)).into_iter().collect()
}
