//! The traditional crane: a bird base whose legs are narrowed and folded up inside, one with a head.
//!
//! Drawn in quarters, each from a leg's corner (1, 1) to a wing's corner (1, −1) of the square of side 2. Five rays
//! 11.25° apart leave the leg's corner: its diagonal, the edges of the narrow leg, of the kite, of the narrow leg
//! again, and the border. The front of the sheet is the outside of the crane, its wings point up.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::draw::Pattern;

pub(crate) type Point = [f64; 2];

/// How far from the tip of the neck, along the diagonal, the head turns.
pub(crate) const BEAK: f64 = 0.25;
pub(crate) const CENTRE: Point = [0.0, 0.0];
pub(crate) const CORNER: Point = [1.0, 1.0];
pub(crate) const WING_TIP: Point = [1.0, -1.0];

/// The sine of `steps` times 11.25°, 0 to 8, by half angles: square roots have the same digits on every machine.
fn sine(steps: usize) -> f64 {
    match steps {
        0 => 0.0,
        8 => 1.0,
        1..=4 => f64::midpoint(1.0, -sine(8 - 2 * steps)).sqrt(),
        _ => f64::midpoint(1.0, sine(2 * steps - 8)).sqrt(),
    }
}

fn tangent(steps: usize) -> f64 {
    sine(steps) / sine(8 - steps)
}

/// A point on a ray, at a distance from the leg's corner.
pub(crate) fn on_ray(ray: usize, distance: f64) -> Point {
    [1.0 - distance * sine(4 - ray), 1.0 - distance * sine(4 + ray)]
}

/// Where an inside reverse fold crosses the rays: at `distance` on the diagonal, at `steps` times 11.25° to it,
/// reflected at each ray.
fn reverse_fold(distance: f64, steps: usize) -> [Point; 5] {
    let odd = distance * sine(steps) / sine(steps + 1);
    [0, 1, 2, 3, 4].map(|ray| on_ray(ray, if ray.is_multiple_of(2) { distance } else { odd }))
}

/// A quarter of the crane.
pub(crate) struct Quarter {
    /// Where the rays inside the sheet start: at the centre, on the middle line, at its kites, on the wing's edge.
    starts: [Point; 4],
    /// Where the narrowing fold crosses the hinge of the wing.
    hinge: Point,
    /// The reverse folds, from the body to the tip.
    folds: Vec<[Point; 5]>,
}

impl Quarter {
    /// Of the neck, with a head, or of the tail.
    pub(crate) fn new(has_head: bool) -> Self {
        let [narrow, kite] = [tangent(1), tangent(2)];
        // Between the border at 11.25° to the leg's corner and the kite at 22.5° to the wing's.
        let y = (narrow - kite) / (narrow + kite);
        let [kites, along] = [1.0 - kite, narrow * FRAC_1_SQRT_2];
        let mut folds = vec![reverse_fold(1.0, 6)];
        if has_head {
            folds.push(reverse_fold(BEAK, 4));
        }
        Self {
            starts: [CENTRE, [1.0 - tangent(3), 0.0], [kites, 0.0], [1.0 - (1.0 - y) * narrow, y]],
            hinge: [kites / 2.0 + along, along - kites / 2.0],
            folds,
        }
    }

    fn draw(&self, quarter: usize, pattern: &mut Pattern) {
        let mut add = |letter, points: &[Point]| {
            let placed: Vec<Point> = points.iter().map(|p| place(quarter, *p)).collect();
            pattern.add(letter, &placed);
        };
        let [_, narrow, kites, wing] = self.starts;
        add('M', &[CENTRE, narrow, kites]);
        add('V', &[narrow, self.hinge]);
        add('M', &[self.hinge, wing, WING_TIP]);
        add('M', &[kites, wing]);
        add('V', &[kites, self.hinge]);
        let along = |ray: usize| self.folds.iter().map(move |fold| fold[ray]).chain([CORNER]);
        for (ray, letter) in [(1, 'M'), (2, 'M'), (3, 'V')] {
            let points: Vec<Point> = [self.starts[ray]].into_iter().chain(along(ray)).collect();
            add(letter, &points);
        }
        // Every reverse fold turns the diagonal inside out; layers that show their front fold back.
        for (index, fold) in self.folds.iter().enumerate() {
            for (ray, pair) in fold.windows(2).enumerate() {
                add(if (ray + index) % 2 == 0 { 'V' } else { 'M' }, pair);
            }
        }
        let border: Vec<Point> = along(4).collect();
        add('B', &border);
        add('B', &[self.folds[0][4], WING_TIP]);
        if quarter.is_multiple_of(2) {
            let diagonal: Vec<Point> = [CENTRE].into_iter().chain(along(0)).collect();
            for (index, pair) in diagonal.windows(2).enumerate() {
                add(if index % 2 == 0 { 'V' } else { 'M' }, pair);
            }
        }
    }

    /// Corners of each facet, from the outermost layer to the innermost.
    pub(crate) fn layers(&self) -> Vec<Vec<Point>> {
        let ([_, a, p, w], h, bend) = (self.starts, self.hinge, self.folds[0]);
        let mut layers = vec![
            vec![a, p, bend[2], bend[1]],
            vec![a, p, h],
            vec![p, h, w],
            vec![p, w, bend[3], bend[2]],
            vec![w, WING_TIP, bend[4], bend[3]],
            vec![w, WING_TIP, h],
            vec![CENTRE, a, h],
            vec![CENTRE, a, bend[1], bend[0]],
        ];
        for (index, fold) in self.folds.iter().enumerate() {
            let next = self.folds.get(index + 1).unwrap_or(&[CORNER; 5]);
            let sectors = [[0, 3, 2, 1], [1, 2, 3, 0]][index];
            layers.extend(sectors.map(|s| vec![fold[s], fold[s + 1], next[s + 1], next[s]]));
        }
        layers
    }
}

/// A point in one of the quarters: front and back of the neck, front and back of the tail.
pub(crate) fn place(quarter: usize, [x, y]: Point) -> Point {
    [[x, y], [y, x], [-y, -x], [-x, -y]][quarter]
}

/// The crane.
pub(crate) fn crane() -> Pattern {
    let mut pattern = Pattern::default();
    for quarter in 0..4 {
        Quarter::new(quarter < 2).draw(quarter, &mut pattern);
    }
    let hinge = Quarter::new(false).hinge;
    for quarter in [0, 1] {
        pattern.add('V', &[place(quarter, hinge), place(quarter + 2, hinge)]);
    }
    pattern
}
