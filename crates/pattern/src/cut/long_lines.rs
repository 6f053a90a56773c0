//! Joins the edges of a crease pattern that continue each other in a straight line.

use glam::DVec2;

use super::LineClass;

/// Edges whose directions differ by less than this (sine of the angle) continue each other.
const STRAIGHT: f64 = 1e-9;

/// A line between two vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    pub(super) ends: [u32; 2],
    pub(super) class: LineClass,
    pub(super) fold_angle: f64,
}

/// The longest straight lines made of segments of one class and fold angle; every segment is in exactly one.
///
/// `segments` must not cross or overlap except at their ends.
pub(super) fn join(vertices: &[DVec2], segments: &[Segment]) -> Vec<Segment> {
    let links = links(vertices, segments);
    let mut is_used = vec![false; segments.len()];
    let mut lines = Vec::new();
    for (index, &segment) in segments.iter().enumerate() {
        if is_used[index] {
            continue;
        }
        is_used[index] = true;
        let ends = [0, 1].map(|side| follow(segments, &links, &mut is_used, index, side));
        lines.push(Segment { ends, ..segment });
    }
    lines
}

/// For both ends of every segment, the segment that continues it there.
fn links(vertices: &[DVec2], segments: &[Segment]) -> Vec<[Option<usize>; 2]> {
    let mut at_vertex: Vec<(u32, usize, usize)> = Vec::with_capacity(2 * segments.len());
    for (index, segment) in segments.iter().enumerate() {
        at_vertex.extend([0, 1].map(|side| (segment.ends[side], index, side)));
    }
    at_vertex.sort_unstable();
    let away = |&(vertex, index, side): &(u32, usize, usize)| {
        let other = segments[index].ends[1 - side];
        (vertices[other as usize] - vertices[vertex as usize]).normalize_or_zero()
    };
    let continues = |a, b| {
        let (u, v): (DVec2, DVec2) = (away(a), away(b));
        let (a, b) = (&segments[a.1], &segments[b.1]);
        let is_same = a.class == b.class && a.fold_angle == b.fold_angle;
        is_same && u.dot(v) < 0.0 && u.perp_dot(v).abs() <= STRAIGHT
    };
    let mut links = vec![[None; 2]; segments.len()];
    for around in at_vertex.chunk_by(|a, b| a.0 == b.0) {
        for (position, a) in around.iter().enumerate() {
            let partner = around[position + 1..].iter().find(|b| continues(a, b));
            if let Some(b) = partner {
                links[a.1][a.2] = Some(b.1);
                links[b.1][b.2] = Some(a.1);
            }
        }
    }
    links
}

/// The last vertex reached from `side` of segment `start`.
fn follow(
    segments: &[Segment],
    links: &[[Option<usize>; 2]],
    is_used: &mut [bool],
    start: usize,
    side: usize,
) -> u32 {
    let mut end = segments[start].ends[side];
    let mut next = links[start][side];
    while let Some(index) = next.filter(|&index| !is_used[index]) {
        is_used[index] = true;
        let far = usize::from(segments[index].ends[0] == end);
        end = segments[index].ends[far];
        next = links[index][far];
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(ends: [u32; 2], class: LineClass, fold_angle: f64) -> Segment {
        Segment { ends, class, fold_angle }
    }

    #[test]
    fn a_straight_chain_of_one_class_and_angle_is_one_line() {
        let vertices: Vec<DVec2> = (0..6).map(|i| DVec2::new(f64::from(i) / 3.0, 1.0)).collect();
        let chain = |order: [u32; 5]| {
            order.map(|i| segment([i + i % 2, i + 1 - i % 2], LineClass::Valley, 1.0)).to_vec()
        };
        for order in [[0, 1, 2, 3, 4], [2, 0, 4, 1, 3]] {
            let mut ends = join(&vertices, &chain(order))[0].ends;
            ends.sort_unstable();
            assert_eq!((ends, join(&vertices, &chain(order)).len()), ([0, 5], 1));
        }
    }

    #[test]
    fn lines_end_where_class_angle_or_direction_change() {
        let vertices =
            [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [4.0, 1e-6]].map(DVec2::from);
        let of = |class, angle, ends| segment(ends, class, angle);
        let segments = [
            of(LineClass::Valley, 1.0, [0, 1]),
            of(LineClass::Mountain, 1.0, [1, 2]),
            of(LineClass::Mountain, 2.0, [2, 3]),
            of(LineClass::Mountain, 2.0, [3, 4]),
        ];
        assert_eq!(join(&vertices, &segments), segments);
    }
}
