//! A table of arc length along a profile, fine enough to start a division from.

use crate::arc_length::piece_length;
use crate::compass::Samples;
use crate::{GeometryError, Profile};

/// The smallest number of pieces for each segment.
const PIECES_PER_SEGMENT: usize = 4;
/// The smallest number of pieces for each knot span.
const PIECES_PER_SPAN: usize = 4;
/// The smallest number of pieces for a profile.
const PIECES: usize = 512;

/// Parameters from 0 to 1, and the arc length up to each.
pub(crate) struct LengthTable {
    parameters: Vec<f64>,
    lengths: Vec<f64>,
}

impl LengthTable {
    pub(crate) fn new(profile: &Profile, segments: usize) -> Self {
        let breakpoints = profile.curve().breakpoints();
        let spans = breakpoints.len() - 1;
        let wanted = PIECES.max(PIECES_PER_SEGMENT * segments);
        let pieces = PIECES_PER_SPAN.max(wanted.div_ceil(spans));
        let inner = breakpoints.windows(2).flat_map(|span| {
            let (start, width) = (span[0], span[1] - span[0]);
            (0..pieces).map(move |k| start + width * (k as f64 / pieces as f64))
        });
        let parameters: Vec<_> = inner.chain([1.0]).collect();
        let mut lengths = vec![0.0];
        let mut length = 0.0;
        for u in parameters.windows(2) {
            length += piece_length(profile.curve(), u[0], u[1]);
            lengths.push(length);
        }
        Self { parameters, lengths }
    }

    /// The length of the profile.
    pub(crate) fn total(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    /// Parameters at equal steps of arc length, by linear interpolation.
    ///
    /// # Errors
    /// Points closer together than f64 resolves.
    pub(crate) fn even(&self, segments: usize) -> Result<Vec<f64>, GeometryError> {
        let (u, s) = (&self.parameters, &self.lengths);
        let inner = (1..segments).map(|k| {
            let target = self.total() * (k as f64 / segments as f64);
            let above = s.partition_point(|&length| length <= target);
            let b = above.clamp(1, s.len() - 1);
            let share = (target - s[b - 1]) / (s[b] - s[b - 1]);
            u[b - 1] + (u[b] - u[b - 1]) * share
        });
        let even: Vec<_> = std::iter::once(0.0).chain(inner).chain([1.0]).collect();
        match even.windows(2).position(|u| u[1] <= u[0]) {
            None => Ok(even),
            Some(k) => Err(GeometryError::Start { index: k + 1, value: even[k + 1] }),
        }
    }

    /// The points at the parameters of the table.
    pub(crate) fn samples(&self, profile: &Profile) -> Samples {
        let points = self.parameters.iter().map(|&u| profile.position(u));
        Samples { points: points.collect(), parameters: self.parameters.clone() }
    }
}
