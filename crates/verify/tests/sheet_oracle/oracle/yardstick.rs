//! A cheap test at sampled instants: every coordinate is moved by a random 1e-9, then edges are tested against facets.
//!
//! It finds crossings that last, gives false alarms if facets slide on each other in one plane, and misses what passes
//! between two instants.

use foldmotion_pattern::Motion;
use glam::DVec3;

use foldmotion_random::Random;

/// The number of instants in each interval.
const SAMPLES: u32 = 16;

fn volume(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}

fn pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let sides = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    let is_inside = sides.iter().all(|&v| v > 0.0) || sides.iter().all(|&v| v < 0.0);
    is_inside && volume(a, b, c, p) * volume(a, b, c, q) < 0.0
}

/// Whether an edge pierces a facet with other vertices at a sampled instant.
pub(crate) fn shows_crossing(motion: &Motion, random: &mut Random) -> bool {
    let sheet = &motion.sheet;
    motion.frames.windows(2).any(|pair| {
        (0..=SAMPLES).any(|k| {
            let t = f64::from(k) / f64::from(SAMPLES);
            let both = pair[0].positions.iter().zip(&pair[1].positions);
            let at: Vec<DVec3> =
                both.map(|(p, q)| p.lerp(*q, t) + random.vector() * 1e-9).collect();
            sheet.edges.iter().any(|edge| {
                let ends = edge.vertices;
                sheet.faces.iter().any(|face| {
                    !face.iter().any(|v| ends.contains(v))
                        && pierces(ends.map(|v| at[v as usize]), face.map(|v| at[v as usize]))
                })
            })
        })
    })
}
