//! Crease patterns drawn by the tests: a Miura sheet, a bird base, a square twist, a pop-up with cuts, a frame.

use std::f64::consts::SQRT_2;
use std::fmt::Write as _;

/// A line of a pattern: its ends and its letter in FOLD.
pub(crate) type Crease = ([f64; 2], [f64; 2], char);

/// Lines that meet at their ends only.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pattern {
    pub(crate) creases: Vec<Crease>,
}

impl Pattern {
    pub(crate) fn add(&mut self, letter: char, points: &[[f64; 2]]) {
        for pair in points.windows(2) {
            self.creases.push((pair[0], pair[1], letter));
        }
    }

    fn closed(&mut self, letter: char, points: &[[f64; 2]]) {
        self.add(letter, points);
        self.add(letter, &[points[points.len() - 1], points[0]]);
    }

    /// How many lines have a letter.
    pub(crate) fn count(&self, letter: char) -> usize {
        self.creases.iter().filter(|c| c.2 == letter).count()
    }

    /// The pattern in SVG, a `<line>` each, y downwards.
    pub(crate) fn svg(&self) -> String {
        let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\">\n");
        for (a, b, letter) in &self.creases {
            let _ = writeln!(
                text,
                "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" stroke=\"{}\"/>",
                a[0],
                -a[1],
                b[0],
                -b[1],
                colour(*letter)
            );
        }
        text + "</svg>\n"
    }

    /// The vertices and the edges by index, in the order in which they are drawn.
    pub(crate) fn lists(&self) -> (Vec<[f64; 2]>, Vec<[usize; 2]>) {
        let mut vertices: Vec<[f64; 2]> = Vec::new();
        let mut index = |p: [f64; 2]| {
            let near = |q: &[f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]) < 1e-9;
            vertices.iter().position(near).unwrap_or_else(|| {
                vertices.push(p);
                vertices.len() - 1
            })
        };
        let edges = self.creases.iter().map(|c| [index(c.0), index(c.1)]);
        let edges = edges.collect();
        (vertices, edges)
    }

    /// The pattern in FOLD, without faces.
    pub(crate) fn fold(&self) -> serde_json::Value {
        let (vertices, edges) = self.lists();
        let letters: Vec<String> = self.creases.iter().map(|c| c.2.to_string()).collect();
        serde_json::json!({
            "file_spec": 1.1,
            "vertices_coords": vertices,
            "edges_vertices": edges,
            "edges_assignment": letters,
        })
    }
}

pub(crate) fn colour(letter: char) -> &'static str {
    match letter {
        'B' => "#000",
        'M' => "#f00",
        'V' => "#00f",
        'C' => "#0f0",
        'F' => "#ff0",
        'U' => "#f0f",
        _ => panic!("{letter}"),
    }
}

/// A Miura sheet of `m` × `n` parallelograms; the zigzags go up.
pub(crate) fn miura(m: usize, n: usize) -> Pattern {
    let at = |i: usize, j: usize| {
        let shift = if j % 2 == 1 { 0.5 } else { 0.0 };
        [i as f64 * 1.5 + shift, j as f64 * 1.25]
    };
    let mut pattern = Pattern::default();
    for i in 0..=m {
        for j in 0..n {
            let letter = match i {
                0 => 'B',
                _ if i == m => 'B',
                _ if i % 2 == 0 => 'M',
                _ => 'V',
            };
            pattern.add(letter, &[at(i, j), at(i, j + 1)]);
        }
    }
    for j in 0..=n {
        for i in 0..m {
            let letter = match j {
                0 => 'B',
                _ if j == n => 'B',
                // Of the two between the sharp sectors and the blunt ones, the former folds the other way than the
                // zigzag.
                _ if (i + j) % 2 == 1 => 'M',
                _ => 'V',
            };
            pattern.add(letter, &[at(i, j), at(i + 1, j)]);
        }
    }
    pattern
}

/// A bird base with its outer middle lines creased: the square of side 2.
pub(crate) fn bird_base() -> Pattern {
    // The kites' creases meet the middle lines at 1 − tan 22.5°.
    let p = 2.0 - SQRT_2;
    let turn = |k: usize, [x, y]: [f64; 2]| match k % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    };
    let mut pattern = Pattern::default();
    for k in 0..4 {
        let at = |point| turn(k, point);
        let (inner, outer) = if k == 0 { ('M', 'V') } else { ('V', 'M') };
        let (corner, q) = ([1.0, 1.0], [p / 2.0, p / 2.0]);
        pattern.add('B', &[at([1.0, 0.0]), at(corner), at([0.0, 1.0])]);
        pattern.add('M', &[at([0.0, 0.0]), at([p, 0.0]), at([1.0, 0.0])]);
        pattern.add(inner, &[at([0.0, 0.0]), at(q)]);
        pattern.add(outer, &[at(q), at(corner)]);
        pattern.add('M', &[at([p, 0.0]), at(corner), at([0.0, p])]);
        pattern.add('V', &[at([p, 0.0]), at(q), at([0.0, p])]);
    }
    pattern
}

/// A square twist by 45°: four pleats around a square.
pub(crate) fn square_twist() -> Pattern {
    let turn = |k: usize, [x, y]: [f64; 2]| match k % 4 {
        0 => [x, y],
        1 => [-y, x],
        2 => [-x, -y],
        _ => [y, -x],
    };
    let mut pattern = Pattern::default();
    for k in 0..4 {
        let at = |point| turn(k, point);
        pattern.add('M', &[at([1.0, 0.0]), at([0.0, 1.0])]);
        pattern.add('V', &[at([1.0, 0.0]), at([1.0, 2.0])]);
        pattern.add('M', &[at([0.0, 1.0]), at([0.0, 2.0])]);
        let side = [[2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [-2.0, 2.0]];
        pattern.add('B', &side.map(at));
    }
    pattern
}

/// A card whose middle strip, cut at both sides, pops up.
pub(crate) fn pop_up() -> Pattern {
    let mut pattern = Pattern::default();
    pattern.closed('B', &[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [4.0, 4.0], [0.0, 4.0], [0.0, 2.0]]);
    for x in [1.0, 3.0] {
        pattern.add('C', &[[x, 1.0], [x, 2.0], [x, 3.0]]);
    }
    pattern.add('V', &[[0.0, 2.0], [1.0, 2.0]]);
    pattern.add('V', &[[3.0, 2.0], [4.0, 2.0]]);
    pattern.add('V', &[[1.0, 1.0], [3.0, 1.0]]);
    pattern.add('M', &[[1.0, 2.0], [3.0, 2.0]]);
    pattern.add('V', &[[1.0, 3.0], [3.0, 3.0]]);
    pattern
}

/// A square frame, mitred at its corners.
pub(crate) fn frame() -> Pattern {
    let mut pattern = Pattern::default();
    let outer = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
    let inner = [[2.0, 2.0], [4.0, 2.0], [4.0, 4.0], [2.0, 4.0]];
    pattern.closed('B', &outer);
    pattern.closed('B', &inner);
    for (index, (a, b)) in outer.iter().zip(inner).enumerate() {
        pattern.add(if index % 2 == 0 { 'M' } else { 'V' }, &[*a, b]);
    }
    pattern
}
