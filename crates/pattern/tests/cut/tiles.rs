//! Pages together are the pattern.

use foldmotion_pattern::{
    CutError, CutLine, CutOptions, CutPage, CutPattern, LineClass, PageLayout, UnitSheet,
};
use glam::DVec2;

use crate::read::{self, sheets};

const OVERLAP: f64 = 8.0;
const MARGIN: f64 = 5.0;
const PAPER: DVec2 = DVec2::new(120.0, 90.0);

fn pattern(units: &UnitSheet) -> CutPattern {
    // 7 rows of 100 mm.
    CutPattern::new(&units.sheet, units.compact_angles(), &CutOptions::new(300.0)).unwrap()
}

fn layout(overlap: f64) -> PageLayout {
    PageLayout { paper: PAPER, margin: MARGIN, overlap }
}

/// The length of a line inside a box, by the shares at which it enters and leaves.
fn length_inside(ends: [DVec2; 2], low: DVec2, high: DVec2) -> f64 {
    // Densely many cuts at the sides of the box, then the middle of each piece decides.
    let along = ends[1] - ends[0];
    let mut shares = vec![0.0, 1.0];
    for (axis, side) in [(0, low.x), (0, high.x), (1, low.y), (1, high.y)] {
        let share = (side - ends[0][axis]) / along[axis];
        if share > 0.0 && share < 1.0 {
            shares.push(share);
        }
    }
    shares.sort_by(f64::total_cmp);
    let is_inside = |w: &[f64]| {
        let middle = ends[0] + f64::midpoint(w[0], w[1]) * along;
        middle.cmpge(low).all() && middle.cmplt(high).all()
    };
    let inside = shares.windows(2).filter(|w| is_inside(w));
    inside.map(|w| (w[1] - w[0]) * along.length()).sum()
}

/// The page's lines in the coordinates of the pattern.
fn in_pattern(page: &CutPage<'_>) -> Vec<CutLine> {
    let shift = |line: &CutLine| CutLine { ends: line.ends.map(|end| end - page.origin), ..*line };
    page.lines.iter().map(shift).collect()
}

#[test]
fn pages_without_what_they_repeat_add_up_to_the_pattern_class_by_class() {
    for units in sheets() {
        let pattern = pattern(&units);
        for overlap in [0.0, OVERLAP] {
            let tiles = pattern.tiles(layout(overlap)).unwrap();
            let step = PAPER - DVec2::splat(2.0 * MARGIN + overlap);
            let [columns, rows] = tiles.counts();
            assert!(columns > 2 && rows > 1);
            for class in LineClass::ALL {
                let mut sum = 0.0;
                for page in tiles.pages() {
                    let number = page.number.unwrap();
                    let start = DVec2::new(number.column as f64, number.row as f64) * step;
                    // The last page of a row or column keeps what no other repeats.
                    let mut end = start + step;
                    if number.column + 1 == columns {
                        end.x = f64::INFINITY;
                    }
                    if number.row + 1 == rows {
                        end.y = f64::INFINITY;
                    }
                    let lines = in_pattern(&page);
                    let of_class = lines.iter().filter(|l| l.class == class);
                    // Ends move by rounding when a page shifts them: a hair keeps lines on a seam on one side.
                    let hair = DVec2::splat(1e-9);
                    sum += of_class
                        .map(|l| length_inside(l.ends, start - hair, end - hair))
                        .sum::<f64>();
                }
                let length = pattern.length(class);
                assert!((sum - length).abs() < 1e-6, "{class:?}: {sum} {length}");
            }
        }
    }
}

#[test]
fn every_page_shows_all_of_its_window_and_nothing_beyond() {
    for units in sheets() {
        let pattern = pattern(&units);
        for page in pattern.tiles(layout(OVERLAP)).unwrap().pages() {
            let (low, high) = (DVec2::splat(MARGIN), PAPER - DVec2::splat(MARGIN));
            let hair = DVec2::splat(1e-9);
            for end in page.lines.iter().flat_map(|l| l.ends) {
                assert!(end.cmpge(low - hair).all() && end.cmple(high + hair).all());
            }
            let shown: f64 = page.lines.iter().map(CutLine::length).sum();
            let all = pattern.lines.iter().map(|line| {
                length_inside(line.ends.map(|p| p + page.origin), low - hair, high + hair)
            });
            assert!((shown - all.sum::<f64>()).abs() < 1e-6);
            assert_eq!(page.size, PAPER);
        }
    }
}

#[test]
fn neighbouring_pages_have_their_marks_at_the_same_places_of_the_pattern() {
    let units = &sheets()[3];
    let pattern = pattern(units);
    let tiles = pattern.tiles(layout(OVERLAP)).unwrap();
    let pages: Vec<_> = tiles.pages().collect();
    let place = |p: DVec2| p.to_array().map(|c| (c * 1e6).round() as i64);
    let upright = |page: &CutPage<'_>| -> Vec<[[i64; 2]; 2]> {
        let shifted = page.marks.iter().map(|ends| ends.map(|p| p - page.origin));
        shifted.map(|ends| ends.map(place)).collect()
    };
    let [columns, _] = tiles.counts();
    let (first, second) = (upright(&pages[0]), upright(&pages[1]));
    assert_eq!(first[..3], second[..3], "the line and its two ticks on the right");
    let below = upright(&pages[columns]);
    let bottom = &first[3..];
    assert!(bottom.len() == 3 && bottom.iter().all(|mark| below.contains(mark)));
}

#[test]
fn pages_are_written_with_their_marks_on_a_layer_of_their_own() {
    let units = &sheets()[0];
    let pattern = pattern(units);
    let page = pattern.tiles(layout(OVERLAP)).unwrap().pages().nth(1).unwrap();
    let (root, svg) = read::svg(&page.svg());
    let dxf = read::dxf(&page.dxf());
    assert_eq!((root["width"].as_str(), root["height"].as_str()), ("120mm", "90mm"));
    assert_eq!(svg.len(), dxf.len());
    assert_eq!(svg.iter().filter(|l| l.layer == "marks").count(), page.marks.len());
    assert_eq!(dxf.iter().filter(|l| l.layer == "marks").count(), page.marks.len());
    assert!(page.svg().contains("page 1-2 of"));
    assert!(page.dxf().contains("page 1-2 of"));
    assert!(!pattern.whole().svg().contains("marks"));
}

#[test]
fn a_pattern_that_fits_is_one_page_even_if_rounding_says_a_hair_more() {
    let units = &sheets()[0];
    let pattern = pattern(units);
    let exact = PageLayout {
        paper: pattern.size * (1.0 - 1e-14) + DVec2::splat(2.0 * MARGIN),
        margin: MARGIN,
        overlap: OVERLAP,
    };
    let tiles = pattern.tiles(exact).unwrap();
    assert_eq!(tiles.counts(), [1, 1]);
    let page = tiles.pages().next().unwrap();
    assert_eq!(page.lines.len(), pattern.lines.len());
    assert!(page.marks.is_empty());
}

#[test]
fn layouts_that_cannot_be_are_refused() {
    let pattern = pattern(&sheets()[0]);
    let refused = |paper: [f64; 2], margin, overlap| {
        let layout = PageLayout { paper: paper.into(), margin, overlap };
        pattern.tiles(layout).unwrap_err()
    };
    for (paper, margin) in [([100.0, 20.0], 10.0), ([5.0, 5.0], 10.0), ([f64::NAN, 9.0], 1.0)] {
        let error = refused(paper, margin, 0.0);
        assert!(matches!(error, CutError::PaperTooSmall { .. }), "{error}");
    }
    for overlap in [-1.0, 41.0, f64::NAN] {
        let error = refused([100.0, 100.0], 10.0, overlap);
        assert!(matches!(error, CutError::Overlap { limit: 40.0, .. }), "{error}");
    }
    let error = refused([100.0, 100.0], -1.0, 0.0);
    assert!(matches!(error, CutError::Negative { .. }), "{error}");
    for paper in [[12.0, 12.0], [1e-300, 1e-300]] {
        let error = refused(paper, 0.0, 0.0);
        assert!(matches!(error, CutError::TooManyPages { limit: 1000, .. }), "{error}");
    }
}
