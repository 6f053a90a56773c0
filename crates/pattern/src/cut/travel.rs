//! The order in which a plotter follows the lines of one class.

use std::collections::BTreeMap;

use super::long_lines::Segment;
use super::{CutLine, LineClass};
use glam::DVec2;

/// Bands across the rows are this many to a row of units.
const BANDS_A_ROW: f64 = 4.0;

/// Sorts lines of one class so that the pen sweeps band by band, there and back, and enters each line at the nearer
/// end. `row`: the height of a row of units.
pub(super) fn sweep(lines: &mut Vec<CutLine>, row: f64) {
    let mut bands: BTreeMap<i64, Vec<CutLine>> = BTreeMap::new();
    for &line in lines.iter() {
        let middle = line.ends[0].midpoint(line.ends[1]).x;
        let band = (middle / row * BANDS_A_ROW).round() as i64;
        bands.entry(band).or_default().push(line);
    }
    lines.clear();
    let mut pen = DVec2::ZERO;
    for mut band in bands.into_values() {
        let low = |line: &CutLine| line.ends[0].y.min(line.ends[1].y);
        let high = |line: &CutLine| line.ends[0].y.max(line.ends[1].y);
        let (first, last) =
            band.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(first, last), line| {
                (first.min(low(line)), last.max(high(line)))
            });
        if (pen.y - first).abs() <= (pen.y - last).abs() {
            band.sort_by(|a, b| low(a).total_cmp(&low(b)));
        } else {
            band.sort_by(|a, b| high(b).total_cmp(&high(a)));
        }
        for mut line in band {
            if pen.distance_squared(line.ends[1]) < pen.distance_squared(line.ends[0]) {
                line.ends.swap(0, 1);
            }
            pen = line.ends[1];
            lines.push(line);
        }
    }
}

/// Sorts the border head to tail, loop by loop.
pub(super) fn outline(border: &[Segment]) -> Vec<Segment> {
    let mut at_vertex: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (index, segment) in border.iter().enumerate() {
        for end in segment.ends {
            at_vertex.entry(end).or_default().push(index);
        }
    }
    let mut is_used = vec![false; border.len()];
    let mut sorted = Vec::with_capacity(border.len());
    for start in 0..border.len() {
        let mut next = Some(start).filter(|&index| !is_used[index]);
        let mut pen = border[start].ends[0];
        while let Some(index) = next {
            is_used[index] = true;
            let [from, to] = border[index].ends;
            let ends = if from == pen { [from, to] } else { [to, from] };
            pen = ends[1];
            sorted.push(Segment { ends, class: LineClass::Cut, ..border[index] });
            next = at_vertex[&pen].iter().copied().find(|&i| !is_used[i]);
        }
    }
    sorted
}

/// The distance that the pen moves between lines, mm, starting at the origin.
pub(super) fn travel(lines: &[CutLine]) -> f64 {
    let starts = lines.iter().map(|line| line.ends[0]);
    let ends = lines.iter().map(|line| line.ends[1]);
    let before = std::iter::once(DVec2::ZERO).chain(ends);
    before.zip(starts).map(|(from, to)| from.distance(to)).sum()
}
