//! Numbers of orders that are known, or found by trying all orders.

use crate::grids::{count, find, grid, lines, of_fold, strip};

/// Lunnon 1968, "A map-folding problem": the ways to fold a strip of n stamps (OEIS A000136).
#[test]
fn a_strip_of_stamps_folds_in_the_known_number_of_ways() {
    for (n, known) in [(1, 1), (2, 2), (3, 6), (4, 16), (5, 50), (6, 144), (7, 462), (8, 1392)] {
        let pattern = strip(&vec![1.0; n], &"U".repeat(n));
        assert_eq!(count(&of_fold(&pattern)), known, "{n} stamps");
    }
}

/// Lunnon 1971, "Multi-dimensional map-folding": the ways to fold maps (OEIS A001415, A001418).
#[test]
fn a_map_folds_in_the_known_number_of_ways() {
    let maps = [(2, 2, 8), (2, 3, 60), (2, 4, 320), (2, 5, 1980), (3, 3, 1368)];
    for (rows, columns, known) in maps {
        let map = grid(&lines(columns), &lines(rows), &|_, _| 'U', &|_, _| 'U');
        assert_eq!(count(&of_fold(&map)), known, "{rows} x {columns}");
    }
}

#[test]
fn a_single_crease_has_one_order_and_its_valley_puts_each_facet_on_the_front_of_the_other() {
    use foldmotion_pattern::FoundLayers;
    for (letter, sign) in [("V", 1), ("M", -1)] {
        let folding = find(&of_fold(&strip(&[1.0, 1.0], letter))).unwrap();
        assert_eq!((folding.pairs, folding.conditions.total(), folding.components), (1, 0, 0));
        let FoundLayers::Order { order, solutions: Some(1) } = folding.found else {
            panic!("{letter}: {:?}", folding.found);
        };
        assert!(order.len() >= 4 && order.iter().all(|(_, _, s)| s == sign));
    }
}

/// All orders in which `heights[facet]` is a permutation, in a fixed order of permutations.
fn permutations(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let shorter = permutations(count - 1);
    let insert = |heights: &Vec<usize>| {
        let heights = heights.clone();
        (0..count).map(move |new| {
            let moved = heights.iter().map(|&h| if h < new { h } else { h + 1 });
            moved.chain([new]).collect::<Vec<usize>>()
        })
    };
    shorter.iter().flat_map(insert).collect()
}

/// Whether two arcs, each between two heights on one side of a line, cross.
fn cross([a, b]: [usize; 2], [c, d]: [usize; 2]) -> bool {
    let is_between = |x: usize| (a.min(b)..=a.max(b)).contains(&x);
    is_between(c) != is_between(d)
}

/// A crease of a map of 2 x n units: facets (smaller first), the folded line it comes to lie on, its letter.
type MapCrease = ([usize; 2], (bool, usize), char);

/// Counts the heights of the units at which no two creases on one folded line cross and every crease folds to its side.
///
/// Units with an odd sum of row and column face down. A crease comes to lie on one of the four sides of the folded unit.
fn heights_without_crossings(columns: usize, creases: &[MapCrease], units: usize) -> u64 {
    let is_valid = |heights: &Vec<usize>| {
        let at = |facets: [usize; 2]| facets.map(|f| heights[f]);
        let to_its_side = creases.iter().all(|&([f, g], _, letter)| {
            let is_turned = (f / columns + f % columns) % 2 == 1;
            let is_above = heights[g] > heights[f];
            letter == 'U' || is_above == ((letter == 'V') != is_turned)
        });
        let crosses = creases.iter().enumerate().any(|(k, one)| {
            creases[k + 1..].iter().any(|other| one.1 == other.1 && cross(at(one.0), at(other.0)))
        });
        to_its_side && !crosses
    };
    permutations(units).iter().filter(|heights| is_valid(heights)).count() as u64
}

#[test]
fn maps_with_mountains_and_valleys_have_as_many_orders_as_all_permutations_show() {
    let (mut possible, mut impossible) = (0, 0);
    for (columns, rows) in [(2, 2), (3, 2)] {
        let slots = rows * (columns - 1) + columns * (rows - 1);
        for code in 0..1_u32 << slots {
            let letter = |slot: usize| if code >> slot & 1 == 1 { 'V' } else { 'M' };
            let upright = |i: usize, j: usize| letter(j * (columns - 1) + i - 1);
            let level = |i: usize, j: usize| letter(rows * (columns - 1) + (j - 1) * columns + i);
            let map = of_fold(&grid(&lines(columns), &lines(rows), &upright, &level));
            let mut creases: Vec<MapCrease> = Vec::new();
            for j in 0..rows {
                for i in 0..columns {
                    let facet = j * columns + i;
                    if i > 0 {
                        creases.push(([facet - 1, facet], (true, i % 2), upright(i, j)));
                    }
                    if j > 0 {
                        creases.push(([facet - columns, facet], (false, j % 2), level(i, j)));
                    }
                }
            }
            let tried = heights_without_crossings(columns, &creases, columns * rows);
            // Maekawa's condition is tested before any order is searched.
            let found = find(&map).map_or(0, |_| count(&map));
            assert_eq!(found, tried, "{columns} x {rows}, creases {code:b}");
            if tried > 0 { possible += 1 } else { impossible += 1 }
        }
    }
    assert!(possible > 10 && impossible > 10, "{possible} {impossible}");
}

/// Orders of a strip of pieces of any lengths, found by trying all: no piece passes through a crease, no creases cross.
fn orders_of_strip(lengths: &[f64], letters: &str) -> u64 {
    let count = lengths.len();
    let mut ends = vec![0.0];
    for (k, length) in lengths.iter().enumerate() {
        ends.push(ends[k] + if k % 2 == 0 { *length } else { -length });
    }
    let letters: Vec<char> = letters.chars().collect();
    let reaches = |piece: usize, x: f64| {
        let (a, b) = (ends[piece].min(ends[piece + 1]), ends[piece].max(ends[piece + 1]));
        a < x && x < b
    };
    let overlap = |f: usize, g: usize| {
        let span = |p: usize| (ends[p].min(ends[p + 1]), ends[p].max(ends[p + 1]));
        let ((a, b), (c, d)) = (span(f), span(g));
        b.min(d) > a.max(c)
    };
    let mut seen = std::collections::BTreeSet::new();
    for heights in permutations(count) {
        let is_between = |k: usize, piece: usize| {
            let (a, b) = (heights[k], heights[k + 1]);
            (a.min(b)..=a.max(b)).contains(&heights[piece])
        };
        let keeps_side = (0..count - 1)
            .all(|k| (heights[k + 1] > heights[k]) == ((letters[k] == 'V') == (k % 2 == 0)));
        let passes = (0..count - 1).any(|k| {
            let x = ends[k + 1];
            let others = (0..count).filter(|&p| p != k && p != k + 1);
            let through = others.clone().any(|p| reaches(p, x) && is_between(k, p));
            // Another crease at the same place, opening to the same side.
            let crossed = (0..count - 1).filter(|&l| l != k && ends[l + 1] == x && l % 2 == k % 2);
            through || crossed.clone().any(|l| is_between(k, l) != is_between(k, l + 1))
        });
        if keeps_side && !passes {
            // Orders that differ only in pieces that do not overlap are one.
            let pairs = (0..count).flat_map(|f| (f + 1..count).map(move |g| (f, g)));
            let order: Vec<bool> = pairs
                .filter(|&(f, g)| overlap(f, g))
                .map(|(f, g)| heights[f] < heights[g])
                .collect();
            seen.insert(order);
        }
    }
    seen.len() as u64
}

#[test]
fn strips_of_all_lengths_have_as_many_orders_as_all_permutations_show() {
    let lengths: [&[f64]; 6] = [
        &[2.0, 1.0, 2.0],
        &[1.0, 2.0, 1.0, 2.0],
        &[3.0, 1.0, 1.0, 3.0, 2.0],
        &[1.0, 2.0, 2.0, 1.0, 3.0],
        &[2.0, 1.0, 1.0, 1.0, 1.0, 2.0],
        &[1.0, 3.0, 2.0, 1.0, 2.0, 1.0],
    ];
    let mut impossible = 0;
    for lengths in lengths {
        let creases = lengths.len() - 1;
        for code in 0..1_u32 << creases {
            let letters: String =
                (0..creases).map(|k| if code >> k & 1 == 1 { 'V' } else { 'M' }).collect();
            let tried = orders_of_strip(lengths, &letters);
            let found = count(&of_fold(&strip(lengths, &letters)));
            assert_eq!(found, tried, "{lengths:?} {letters}");
            impossible += usize::from(tried == 0);
        }
    }
    assert!(impossible > 10, "{impossible}");
}
