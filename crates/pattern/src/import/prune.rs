//! A planar graph without lines that end nowhere and without needless vertices.

use std::collections::BTreeSet;

use super::Source;
use super::drawing::{Line, Role};
use super::predicate::from_segment;
use super::split::Graph;
use super::warning::{WarningKind, Warnings};

/// Lines as near to one straight line as this are joined, in parts of the tolerance of merging.
const STRAIGHT: f64 = 0.01;

/// How much an end that meets nothing counts beside a line that lies on another, which may be a near miss mended.
const STRAY: usize = 4;

impl Graph {
    /// The lines at each vertex.
    pub(super) fn lines_at(&self) -> Vec<Vec<u32>> {
        let mut at = vec![Vec::new(); self.points.len()];
        for (index, line) in self.lines.iter().enumerate() {
            for v in line.ends {
                at[v as usize].push(index as u32);
            }
        }
        at
    }

    /// Leaves out lines that end nowhere, again and again; cuts, and borders drawn for cuts, may end inside a facet.
    pub(super) fn drop_strays(&mut self, sources: &[Source], warnings: &mut Warnings) {
        let mut at = self.lines_at();
        let mut is_dropped = vec![false; self.lines.len()];
        let mut ends: Vec<u32> =
            (0..self.points.len() as u32).filter(|&v| at[v as usize].len() == 1).collect();
        let of_grid = |v: &&u32| self.lines[at[**v as usize][0] as usize].role == Role::Grid;
        self.lost += STRAY * (ends.len() - ends.iter().filter(of_grid).count());
        while let Some(vertex) = ends.pop() {
            let &[index] = at[vertex as usize].as_slice() else {
                continue;
            };
            let line = &self.lines[index as usize];
            if matches!(line.role, Role::Cut | Role::Border) {
                continue;
            }
            is_dropped[index as usize] = true;
            self.mending.drop(line, &self.points, sources);
            if line.role != Role::Grid {
                warnings.add(WarningKind::Stray, &sources[line.source as usize]);
            }
            for v in line.ends {
                at[v as usize].retain(|&other| other != index);
                if at[v as usize].len() == 1 {
                    ends.push(v);
                }
            }
        }
        let mut dropped = is_dropped.into_iter();
        self.lines.retain(|_| !dropped.next().unwrap_or(false));
    }

    /// Joins lines of one meaning that go straight on at a vertex where nothing else meets them.
    pub(super) fn join_straight(
        &mut self,
        tolerance: f64,
        sources: &[Source],
        warnings: &mut Warnings,
    ) {
        let mut at = self.lines_at();
        let mut pairs: BTreeSet<[u32; 2]> = self.lines.iter().map(Line::key).collect();
        let mut is_gone = vec![false; self.lines.len()];
        for vertex in 0..self.points.len() as u32 {
            let &[first, second] = at[vertex as usize].as_slice() else {
                continue;
            };
            let [a, b] = [first, second].map(|line| self.lines[line as usize]);
            let far = |line: &Line| line.ends.into_iter().find(|&v| v != vertex);
            let (Some(from), Some(to)) = (far(&a), far(&b)) else {
                continue;
            };
            let ends = [from, to].map(|v| self.points[v as usize]);
            let (off, _) = from_segment(ends, self.points[vertex as usize]);
            let is_alike = a.role == b.role && a.target == b.target;
            let key = [from.min(to), from.max(to)];
            if !is_alike || from == to || off > STRAIGHT * tolerance || !pairs.insert(key) {
                continue;
            }
            let runs_on = a.ends[1] == vertex;
            let ends = if runs_on { [from, to] } else { [to, from] };
            self.lines[first as usize].ends = ends;
            is_gone[second as usize] = true;
            for line in at[to as usize].iter_mut().filter(|l| **l == second) {
                *line = first;
            }
            at[vertex as usize].clear();
            warnings.add(WarningKind::Joined, &sources[a.source as usize]);
        }
        let mut gone = is_gone.into_iter();
        self.lines.retain(|_| !gone.next().unwrap_or(false));
    }
}
