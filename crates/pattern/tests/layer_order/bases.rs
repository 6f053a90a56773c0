//! Bases and tessellations of origami.

use foldmotion_pattern::{FoundLayers, ImportedPattern};

use crate::grids::{count, find, grid, lines, of_fold, of_lines};

/// The border of the square from −1 to 1.
const SQUARE: [(char, f64, f64, f64, f64); 4] = [
    ('B', -1.0, -1.0, 1.0, -1.0),
    ('B', 1.0, -1.0, 1.0, 1.0),
    ('B', 1.0, 1.0, -1.0, 1.0),
    ('B', -1.0, 1.0, -1.0, -1.0),
];

fn square(creases: &[(char, f64, f64, f64, f64)]) -> ImportedPattern {
    of_lines(&[&SQUARE[..], creases].concat())
}

/// Diagonals fold as valleys, the line across as a mountain.
fn waterbomb_base() -> ImportedPattern {
    let corner = |x: f64, y: f64| ('V', 0.0, 0.0, x, y);
    square(&[
        corner(1.0, 1.0),
        corner(-1.0, 1.0),
        corner(-1.0, -1.0),
        corner(1.0, -1.0),
        ('M', -1.0, 0.0, 0.0, 0.0),
        ('M', 0.0, 0.0, 1.0, 0.0),
    ])
}

/// Horizontal and vertical lines fold as valleys, a diagonal as a mountain.
fn preliminary_base() -> ImportedPattern {
    square(&[
        ('V', -1.0, 0.0, 0.0, 0.0),
        ('V', 0.0, 0.0, 1.0, 0.0),
        ('V', 0.0, -1.0, 0.0, 0.0),
        ('V', 0.0, 0.0, 0.0, 1.0),
        ('M', -1.0, -1.0, 0.0, 0.0),
        ('M', 0.0, 0.0, 1.0, 1.0),
    ])
}

/// The preliminary base with its four flaps petal-folded at 22.5°, as two folds of the kites and one across.
///
/// The open corner of the base is the corner (1, 1); flaps are numbered from there.
fn bird_base() -> ImportedPattern {
    let t = std::f64::consts::FRAC_PI_8.tan();
    let mut creases = Vec::new();
    // The kites: from each corner of the square, lines at 22.5° to its sides meet the middle lines at 1 − t from the
    // middle of the sides.
    let knot = 1.0 - t;
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        creases.push(('U', x, y, x * knot, 0.0));
        creases.push(('U', x, y, 0.0, y * knot));
    }
    for (x, y) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
        creases.push(('U', x * knot, y * knot, x, y));
        creases.push(('U', 0.0, 0.0, x * knot, y * knot));
    }
    // The petals' base lines join neighbouring knots.
    creases.push(('U', knot, 0.0, 0.0, knot));
    creases.push(('U', 0.0, knot, -knot, 0.0));
    creases.push(('U', -knot, 0.0, 0.0, -knot));
    creases.push(('U', 0.0, -knot, knot, 0.0));
    square(&creases)
}

/// One square turned by pleats at each of its sides.
fn square_twist(inner: char, pleat: char) -> ImportedPattern {
    let mut lines = Vec::new();
    let (w, p) = (4.0, 1.0);
    let border = [(-w, -w), (w, -w), (w, w), (-w, w)];
    for k in 0..4 {
        let ((a, b), (c, d)) = (border[k], border[(k + 1) % 4]);
        lines.push(('B', a, b, c, d));
    }
    // The inner square has corners at (1, 0), (0, 1), (−1, 0), (0, −1); from each two pleat creases run outwards, parallel
    // to those of its neighbours.
    let corners = [(p, 0.0), (0.0, p), (-p, 0.0), (0.0, -p)];
    for k in 0..4 {
        let ((a, b), (c, d)) = (corners[k], corners[(k + 1) % 4]);
        lines.push((inner, a, b, c, d));
    }
    let other = if pleat == 'M' { 'V' } else { 'M' };
    lines.push((pleat, p, 0.0, w, 0.0));
    lines.push((other, p, 0.0, p, -w));
    lines.push((pleat, 0.0, p, 0.0, w));
    lines.push((other, 0.0, p, w, p));
    lines.push((pleat, -p, 0.0, -w, 0.0));
    lines.push((other, -p, 0.0, -p, w));
    lines.push((pleat, 0.0, -p, 0.0, -w));
    lines.push((other, 0.0, -p, -w, -p));
    of_lines(&lines)
}

#[test]
fn the_waterbomb_base_and_the_preliminary_base_have_an_order() {
    for base in [waterbomb_base(), preliminary_base()] {
        let folding = find(&base).unwrap();
        assert!(matches!(folding.found, FoundLayers::Order { .. }), "{:?}", folding.found);
        assert!(folding.state.misfit < 1e-12, "{}", folding.state.misfit);
        assert!(folding.pairs >= 7, "{}", folding.pairs);
    }
}

#[test]
fn the_bird_base_has_orders_whose_creases_are_found_with_them() {
    let folding = find(&bird_base()).unwrap();
    assert!(matches!(folding.found, FoundLayers::Order { .. }), "{:?}", folding.found);
}

#[test]
fn a_square_twist_has_one_order_where_the_creases_beside_its_smallest_angles_differ_and_none_where_they_do_not()
 {
    for (inner, pleat) in [('M', 'M'), ('M', 'V'), ('V', 'M'), ('V', 'V')] {
        let twist = square_twist(inner, pleat);
        let other = |letter| if letter == 'M' { 'V' } else { 'M' };
        let turned = square_twist(other(inner), other(pleat));
        let expected = u64::from(inner == pleat);
        assert_eq!([count(&twist), count(&turned)], [expected; 2], "{inner} {pleat}");
    }
}

/// A pattern of Miura: parallelograms that fold into one stack of strips.
fn miura(columns: usize, rows: usize) -> ImportedPattern {
    let upright = |i: usize, j: usize| if (i + j).is_multiple_of(2) { 'M' } else { 'V' };
    let level = |_: usize, j: usize| if j.is_multiple_of(2) { 'M' } else { 'V' };
    let mut file = grid(&lines(columns), &lines(rows), &upright, &level);
    for coordinates in file["vertices_coords"].as_array_mut().unwrap() {
        let (x, y) = (coordinates[0].as_f64().unwrap(), coordinates[1].as_f64().unwrap());
        coordinates[0] = (x + if y % 2.0 == 0.0 { 0.0 } else { 0.2 }).into();
    }
    of_fold(&file)
}

#[test]
fn miura_folds_flat_in_one_order() {
    for (columns, rows) in [(2, 2), (4, 4), (7, 6)] {
        let pattern = miura(columns, rows);
        let folding = find(&pattern).unwrap();
        assert!(folding.conditions.taco_tortilla > 0);
        assert_eq!(count(&pattern), 1, "{columns} x {rows}");
    }
}

#[test]
fn the_same_pattern_gives_the_same_order() {
    let order = || find(&bird_base()).unwrap();
    assert_eq!(order(), order());
}

#[test]
fn an_order_does_not_depend_on_where_the_pattern_lies() {
    let pattern = miura(4, 3);
    let mut moved = pattern.clone();
    for vertex in &mut moved.sheet.vertices {
        *vertex = glam::DVec2::from_angle(0.7).rotate(*vertex) + glam::DVec2::new(1000.0, -300.0);
    }
    let [here, there] = [pattern, moved].map(|pattern| find(&pattern).unwrap());
    assert_eq!((here.found, here.conditions), (there.found, there.conditions));
}

#[test]
fn a_written_flat_state_is_read_as_the_pattern_with_the_order_that_was_found() {
    for pattern in [miura(3, 3), bird_base(), waterbomb_base()] {
        let folding = find(&pattern).unwrap();
        let FoundLayers::Order { order, .. } = &folding.found else { panic!("no order") };
        let text = folding.state.fold(order, "title", "creator", "unit");
        let again = of_fold(&serde_json::from_str(&text).unwrap());
        assert_eq!(again.stages, []);
        assert!(again.folds_flat() && again.free_hinges().next().is_none());
        assert_eq!(again.face_orders.len() * 2, order.len());
        let refolded = find(&again).unwrap();
        let FoundLayers::Order { order: same, solutions } = refolded.found else {
            panic!("no order")
        };
        assert_eq!((&same, solutions), (order, Some(1)));
    }
}
