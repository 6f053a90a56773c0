//! Separate line segments in any order and direction, joined end to end.

use glam::DVec2;

use super::OutlineError;

/// Ends this near to each other, over the size of the drawing, are one point.
const TOLERANCE: f64 = 1e-6;

/// A segment of a drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    /// The line of the file where it begins.
    pub(super) line: usize,
    pub(super) ends: [DVec2; 2],
}

/// The points of the one chain that all segments make: closed where they make a ring, else from the loose end that
/// comes first in the file.
pub(super) fn chain(segments: &[Segment]) -> Result<Vec<DVec2>, OutlineError> {
    let all = || segments.iter().flat_map(|segment| segment.ends);
    let low = all().fold(DVec2::INFINITY, DVec2::min);
    let high = all().fold(DVec2::NEG_INFINITY, DVec2::max);
    let ends = Ends::new(segments, TOLERANCE * low.distance(high));
    let starts = (0..segments.len()).flat_map(|k| [(k, 0), (k, 1)]);
    let mut loose = None;
    for (k, side) in starts {
        match ends.others(k, side).len() {
            0 => loose = loose.or(Some((k, side))),
            1 => {}
            _ => {
                let line = segments[k].line;
                return Err(OutlineError::Branch { line });
            }
        }
    }
    let (mut k, mut side) = loose.unwrap_or((0, 0));
    let mut points = vec![segments[k].ends[side]];
    let mut used = vec![false; segments.len()];
    loop {
        used[k] = true;
        points.push(segments[k].ends[1 - side]);
        match ends.others(k, 1 - side).first() {
            Some(&(next, at)) if !used[next] => (k, side) = (next, at),
            _ => break,
        }
    }
    if let Some(apart) = used.iter().position(|used| !used) {
        let line = segments[apart].line;
        return Err(OutlineError::SeveralChains { line });
    }
    if loose.is_none()
        && let Some(&first) = points.first()
        && let Some(last) = points.last_mut()
    {
        *last = first;
    }
    Ok(points)
}

/// The ends of all segments by x.
struct Ends<'a> {
    segments: &'a [Segment],
    tolerance: f64,
    sorted: Vec<(usize, usize)>,
}

impl<'a> Ends<'a> {
    fn new(segments: &'a [Segment], tolerance: f64) -> Self {
        let mut sorted: Vec<_> = (0..segments.len()).flat_map(|k| [(k, 0), (k, 1)]).collect();
        sorted.sort_by(|&(a, i), &(b, j)| segments[a].ends[i].x.total_cmp(&segments[b].ends[j].x));
        Self { segments, tolerance, sorted }
    }

    /// The ends of other segments at the end `side` of segment `k`; more than two are not counted.
    fn others(&self, k: usize, side: usize) -> Vec<(usize, usize)> {
        let point = self.segments[k].ends[side];
        let at = |&(k, side): &(usize, usize)| self.segments[k].ends[side];
        let from = self.sorted.partition_point(|end| at(end).x < point.x - self.tolerance);
        let near =
            self.sorted[from..].iter().take_while(|end| at(end).x <= point.x + self.tolerance);
        near.filter(|end| end.0 != k && at(end).distance(point) <= self.tolerance)
            .take(2)
            .copied()
            .collect()
    }
}
