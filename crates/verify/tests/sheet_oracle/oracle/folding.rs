//! Sheets that fold: their truth follows from heights that are linear in time, compared in integers.
//!
//! - *ClosingFold*: two panels, a profile extruded along y. One lies at z = 0, x ≤ 0; the free edge of the other
//!   follows a path above it to a height h above or below: past ±180° by −h.
//! - *Layers*: panels between fixed abscissas whose ends move up and down. Two of them keep their order if the heights
//!   at the ends of their common abscissas do so at all frames, because the heights are linear in time.
//! - *Flap*: a triangle at the end of a crease, with the other corners above or below the two panels.
//! - *OwnCrease*: a strip whose last panel reaches down to its own first crease, with its free edge above or below.

use super::{
    class::Class,
    distance::to_f64,
    exact::{Point, UNIT},
    mesh::Mesh,
    part::{Part, below, between, sixteenths},
    scene::{Scene, Truth},
};
use foldmotion_random::Random;

/// 0.4 τ: heights up to this count as touching.
const SLIGHT: i64 = 28;
/// 10 τ: heights beyond this count as clearly off.
const CLEAR: i64 = 671;

/// A random scene of a sheet that folds.
pub(crate) fn scene(class: Class, random: &mut Random) -> Scene {
    let (part, frames, truth) = loop {
        let made = match class {
            Class::ClosingFold => closing_fold(random),
            Class::Layers => layers(random),
            Class::Flap => flap(random),
            _ => own_crease(random),
        };
        if keeps_its_areas(&made.0, &made.1) {
            break made;
        }
    };
    let mesh = Mesh::random(&part, random, false);
    let mut scene = Scene { part, frames, mesh, truth, separation: None, allows_slivers: false };
    transform(&mut scene, random);
    scene
}

/// Whether no polygon vanishes during the motion.
fn keeps_its_areas(part: &Part, frames: &[Vec<Point>]) -> bool {
    let area = |frames: &[Vec<Point>], polygon: &[usize], share: f64| {
        let at =
            |k: usize| to_f64(frames[0][polygon[k]]).lerp(to_f64(frames[1][polygon[k]]), share);
        (at(1) - at(0)).cross(at(2) - at(0))
    };
    let keeps = |frames: &[Vec<Point>]| {
        part.polygons.iter().all(|polygon| {
            (0..=16).all(|k| {
                let now = area(frames, polygon, f64::from(k) / 16.0);
                now.length() > 0.02
            })
        })
    };
    frames.windows(2).all(keeps)
}

type Made = (Part, Vec<Vec<Point>>, Truth);

/// Shears the scene along y and permutes its axes; heights do not change.
fn transform(scene: &mut Scene, random: &mut Random) {
    let skew = [0, 0, 4, -8][random.index(4)];
    let first = random.index(3);
    let sign = [-1, 1][random.index(2)];
    let image = |[x, y, z]: Point| {
        let p = [sign * x, y + x / 16 * skew, z];
        [0, 1, 2].map(|i| p[(i + first) % 3])
    };
    let corners = scene.part.corners.iter_mut();
    for p in corners.chain(scene.frames.iter_mut().flatten()) {
        *p = image(*p);
    }
}

/// The truth according to the smallest height of what should stay above: below −10 τ it is through, above −0.4 τ it is
/// not.
fn by_height(least: i64, nearest: i64) -> Truth {
    if least <= -CLEAR {
        Truth::Penetrating
    } else if least < -SLIGHT {
        Truth::Open
    } else if nearest <= SLIGHT {
        Truth::Touching
    } else if nearest > 100 * CLEAR {
        Truth::Free
    } else {
        Truth::NotThrough
    }
}

/// A height at the end of a motion: touching, slightly off or clearly off.
fn end_height(random: &mut Random) -> i64 {
    let choices = [0, 0, 0, 17, -17, -27, 6711, 90_000, -700, -6711, -90_000];
    match random.index(14) {
        k if k < choices.len() => choices[k],
        11 => sixteenths(between(random, 1, 8)),
        _ => -sixteenths(between(random, 1, 8)),
    }
}

/// A profile at one frame, extruded along y.
fn drawn_out(profile: &[[i64; 2]], widths: &[[i64; 2]]) -> Vec<Point> {
    let both = profile.iter().zip(widths);
    both.flat_map(|(&[x, z], ys)| ys.map(|y| [x, y, z])).collect()
}

fn closing_fold(random: &mut Random) -> Made {
    let [a, b] = [(); 2].map(|()| sixteenths(between(random, 8, 16)));
    let half = sixteenths(between(random, 6, 16));
    let taper = sixteenths([0, 0, 3, -3][random.index(4)]);
    let h = end_height(random);
    let mut ends = vec![[b / 2, b], [-b, h]];
    if random.index(2) == 0 {
        ends.insert(0, [b, 0]);
    }
    match random.index(4) {
        0 => ends.push([-b / 2, b]),
        1 if h <= -CLEAR => ends.push([-b / 2, -b]),
        2 => ends.push([-b, h]),
        _ => {}
    }
    let widths = [[-half, half], [-half, half], [-half - taper, half]];
    let frames: Vec<_> =
        ends.iter().map(|&end| drawn_out(&[[-a, 0], [0, 0], end], &widths)).collect();
    // Over the end of the shorter panel the height is a share of h.
    let over = if a < b { (i128::from(h) * i128::from(a) / i128::from(b)) as i64 } else { h };
    let is_clear = over > -CLEAR && h <= -CLEAR;
    let truth = if is_clear { Truth::Open } else { by_height(h, over.abs()) };
    let mut part = Part::extruded(&[[-16, 0], [0, 0], [16, 0]], false, [-16, 16]);
    part.corners.clone_from(&frames[0]);
    (part, frames, truth)
}

/// A panel between two ends.
struct Panel {
    ends: [usize; 2],
    strip: usize,
}

/// The panels between fixed abscissas, from below.
#[derive(Default)]
struct Layers {
    part: Part,
    panels: Vec<Panel>,
    abscissas: Vec<i64>,
    /// The height of every end at every frame.
    heights: Vec<Vec<i64>>,
}

impl Layers {
    /// Adds a strip without heights; its panels come last.
    fn add_strip(&mut self, abscissas: &[i64], half: i64, strip: usize) {
        let start = self.abscissas.len();
        let profile: Vec<_> = abscissas.iter().map(|&x| [x, x]).collect();
        self.part.append(&Part::extruded(&profile, false, [-half, half]));
        self.abscissas.extend(abscissas.iter().map(|&x| sixteenths(x)));
        self.panels.extend(
            (0..abscissas.len() - 1).map(|i| Panel { ends: [start + i, start + i + 1], strip }),
        );
    }

    /// Changes one end at one frame.
    fn violate(&mut self, random: &mut Random) {
        let frame = 1 + random.index(self.heights.len() - 1);
        let vertex = random.index(self.abscissas.len());
        let by = [
            -sixteenths(7),
            sixteenths(7),
            -17,
            -27,
            20,
            27,
            -700,
            6711,
            -sixteenths(6),
            sixteenths(6),
        ][random.index(10)];
        self.heights[frame][vertex] += by;
    }

    fn made(self) -> Made {
        let frames: Vec<Vec<Point>> = self
            .heights
            .iter()
            .map(|heights| {
                let corners = self.part.corners.iter().enumerate();
                corners.map(|(i, p)| [p[0], p[1], heights[i / 2]]).collect()
            })
            .collect();
        let (least, nearest) = clearance(&self.panels, &self.abscissas, &self.heights);
        let mut part = self.part;
        part.corners.clone_from(&frames[0]);
        (part, frames, by_height(least, nearest))
    }
}

fn layers(random: &mut Random) -> Made {
    let mut layers = if random.index(3) == 0 { nested(random) } else { stacked(random) };
    if random.index(2) == 0 {
        layers.violate(random);
    }
    layers.made()
}

/// Accordions above each other that close, some of them exactly flat.
fn stacked(random: &mut Random) -> Layers {
    let strips = 1 + random.index(3);
    let frames = 2 + random.index(3);
    let mut layers = Layers { heights: vec![Vec::new(); frames], ..Layers::default() };
    let mut level = vec![0_i64; frames];
    for strip in 0..strips {
        let count = if strips == 1 { 3 + random.index(3) } else { 2 + random.index(3) };
        let first = random.index(2);
        let ends = [-between(random, 8, 16), between(random, 8, 16)];
        let abscissas: Vec<i64> = (0..count).map(|i| ends[(i + first) % 2]).collect();
        layers.add_strip(&abscissas, between(random, 6, 16), strip);
        for _ in 0..count {
            for (frame, level) in level.iter_mut().enumerate() {
                let is_last = frame + 1 == frames;
                *level += match random.index(6) {
                    k if frame == 0 || k > 3 => sixteenths(between(random, 1, 4)),
                    1 => 6711,
                    k if k == 0 || is_last => 0,
                    _ => sixteenths(between(random, 1, 4)),
                };
                layers.heights[frame].push(*level);
            }
        }
    }
    layers
}

/// A fold with an accordion inside, closing together.
fn nested(random: &mut Random) -> Layers {
    let frames = 2 + random.index(2);
    let inner = 1 + below(random, 3);
    let right = between(random, 12, 16);
    let ends = [-between(random, 8, 15), right - between(random, 2, 6)];
    let first = below(random, 2);
    let mut layers = Layers::default();
    layers.add_strip(&[-16, right, -16], between(random, 8, 16), 0);
    let abscissas: Vec<i64> =
        (0..=inner).map(|i| if i % 2 == first { ends[0] } else { ends[1] }).collect();
    layers.add_strip(&abscissas, between(random, 6, 16), 1);
    // From below: the lower panel of the fold, what is inside, the upper panel.
    let upper = layers.panels.remove(1);
    layers.panels.push(upper);
    for frame in 0..frames {
        let high = match random.index(3) {
            k if frame == 0 || k == 0 => sixteenths(between(random, 8, 16)),
            1 if frame + 1 < frames => sixteenths(4),
            _ => [0, 0, 0, 27, 6711][random.index(5)],
        };
        let inside = abscissas
            .iter()
            .zip(1..)
            .map(|(&x, rank)| high * (right - x) / (right + 16) * rank / (inner + 2));
        let heights = [0, 0, high].into_iter().chain(inside);
        layers.heights.push(heights.collect());
    }
    layers
}

/// The smallest height of a later panel above an earlier one, and the smallest distance of panels without a common end.
fn clearance(panels: &[Panel], abscissas: &[i64], heights: &[Vec<i64>]) -> (i64, i64) {
    let (mut least, mut nearest) = (i64::MAX, i64::MAX);
    for (g, upper) in panels.iter().enumerate() {
        for lower in &panels[..g] {
            let range = |panel: &Panel| {
                let [a, b] = panel.ends.map(|e| abscissas[e]);
                [a.min(b), a.max(b)]
            };
            let ([a0, a1], [b0, b1]) = (range(lower), range(upper));
            let shared = lower.strip == upper.strip && lower.ends[1] == upper.ends[0];
            for x in [a0.max(b0), a1.min(b1)] {
                for heights in heights {
                    let at = |panel: &Panel| height(panel, x, abscissas, heights);
                    let gap = at(upper) - at(lower);
                    least = least.min(gap);
                    let is_common = shared && abscissas[upper.ends[0]] == x;
                    if !is_common {
                        nearest = nearest.min(gap.abs());
                    }
                }
            }
        }
    }
    (least, nearest)
}

fn height(panel: &Panel, x: i64, abscissas: &[i64], heights: &[i64]) -> i64 {
    let [p, q] = panel.ends;
    let [xp, xq, hp, hq] = [abscissas[p], abscissas[q], heights[p], heights[q]].map(i128::from);
    (hp + (hq - hp) * (i128::from(x) - xp) / (xq - xp)) as i64
}

fn flap(random: &mut Random) -> Made {
    let slope = [0, 0, 8, -8][random.index(4)];
    let [a, b] = [(); 2].map(|()| 2 * between(random, 5, 8));
    let profile = [[-a, slope * a / 16], [0, 0], [b, slope * b / 16]];
    let mut part = Part::extruded(&profile, false, [0, 16]);
    let first = part.corners.len();
    let polygon = vec![2, first, first + 1];
    part.corners.extend([[0; 3]; 2]);
    part.polygons.push(polygon.clone());
    part.convex.push(polygon);
    let offset = [0, 0, 17, 27, 268, 6711][random.index(6)];
    let is_flat = slope == 0;
    let [xa, xb] = if is_flat && random.index(2) == 0 {
        [(); 2].map(|()| sixteenths(between(random, -7, 7)))
    } else {
        [offset; 2]
    };
    let [ya, yb] = [between(random, 8, 13), between(random, 3, 6)].map(sixteenths);
    // Above the lines x = xa and x = xb of the panels.
    let rise = |x: i64| x.abs() * slope / 16;
    let goes_around = random.index(5) == 0;
    let mut places: Vec<[i64; 4]> = Vec::new();
    let up = |random: &mut Random| sixteenths(between(random, 3, 12));
    places.push([ya, up(random), yb, up(random)]);
    let mut truth = Truth::Free;
    if goes_around {
        let [h, k] = [up(random), up(random)];
        places.push([ya, h, -yb, k]);
        places.push([-ya, h, -yb, k]);
        places.push([-ya, -h, -yb, -k]);
    } else {
        let h = end_height(random);
        let k = if random.index(2) == 0 { end_height(random) } else { up(random) };
        places.push([ya, h, yb, k]);
        match random.index(3) {
            0 => places.push(places[0]),
            1 => {
                places.remove(0);
                places.push(places[0]);
            }
            _ => {}
        }
        truth = flap_truth(&places);
    }
    let still = part.corners[..first].to_vec();
    let frames: Vec<Vec<Point>> = places
        .iter()
        .map(|&[ya, za, yb, zb]| {
            let own = [[xa, ya, za + rise(xa)], [xb, yb, zb + rise(xb)]];
            still.iter().copied().chain(own).collect()
        })
        .collect();
    part.corners.clone_from(&frames[0]);
    (part, frames, truth)
}

/// Whether the corners stay on one side throughout.
fn flap_truth(places: &[[i64; 4]]) -> Truth {
    let heights = || places.iter().flat_map(|p| [p[1], p[3]]);
    let (low, high) = (heights().min().unwrap_or(0), heights().max().unwrap_or(0));
    let nearest = heights().map(i64::abs).min().unwrap_or(0);
    by_height(low.max(-high), nearest)
}

fn own_crease(random: &mut Random) -> Made {
    let slope = [0, 0, -8, 8][random.index(4)];
    let fixed = [[-UNIT, UNIT * slope / 16], [0, 0], [UNIT, 0], [UNIT, UNIT]];
    let offset = [0, 0, 0, 17, -27, 268, -6711][random.index(7)];
    let end = end_height(random);
    let start = [UNIT / 2 + offset, UNIT / 2];
    // Above or below the panel at that position: the first beyond the crease, the second at z = 0.
    let down = |h: i64| {
        let x = h + offset;
        [x, if x < 0 { h - x * slope / 16 } else { h }]
    };
    let mut ends = vec![start];
    let mut lowest = end;
    if slope == 0 && random.index(3) == 0 {
        let (from, to) = (UNIT / 2, -UNIT / 4);
        ends.push([from, 0]);
        ends.push([to, [0, 17, -17][random.index(3)]]);
        ends.push([to, if end == 0 { UNIT / 2 } else { end }]);
        lowest = end.min(0);
    } else {
        ends.push(down(end));
        match random.index(4) {
            0 | 1 => ends.push(start),
            2 => ends.push(down(end)),
            _ => {}
        }
    }
    let slides = ends.len() == 4;
    let half = sixteenths(between(random, 8, 14));
    let narrower = sixteenths([0, 0, 3, 5, -2][random.index(5)]);
    let tip = half - narrower;
    let widths = [[-half, half], [-half, half], [-half, half], [-half, half], [-tip, tip]];
    let frames: Vec<_> = ends
        .iter()
        .map(|&end| {
            let [p, q, r, s] = fixed;
            drawn_out(&[p, q, r, s, end], &widths)
        })
        .collect();
    let mut part = Part::extruded(&[[-16, 0], [0, 0], [16, 0], [16, 16], [8, 8]], false, [-16, 16]);
    part.corners.clone_from(&frames[0]);
    let nearest = if slides { 0 } else { lowest.abs() };
    let truth =
        if slides && lowest > -CLEAR { Truth::Touching } else { by_height(lowest, nearest) };
    (part, frames, truth)
}
