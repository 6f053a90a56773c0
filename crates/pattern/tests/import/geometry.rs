//! Lines that cross, nearly meet, lie on each other and end nowhere.

use std::fmt::Write as _;

use foldmotion_pattern::{
    ImportError, ImportOptions, ImportedPattern, MergeTolerance, WarningKind, import_svg,
};

use crate::draw::{Pattern, bird_base, frame, miura, pop_up, square_twist};
use crate::patterns::{check_sheet, counts};
use crate::svg::document;

fn import_with(options: &ImportOptions, body: &str) -> Result<ImportedPattern, ImportError> {
    let imported = import_svg(document("", body).as_bytes(), options)?;
    check_sheet(&imported);
    Ok(imported)
}

fn import(body: &str) -> ImportedPattern {
    import_with(&ImportOptions::default(), body).unwrap()
}

fn warned(imported: &ImportedPattern, kind: WarningKind) -> usize {
    let found = imported.warnings.iter().find(|w| w.kind == kind);
    found.map_or(0, |w| w.count)
}

fn square(lines: &str) -> String {
    format!("<rect width=\"100\" height=\"100\" stroke=\"black\"/>{lines}")
}

fn line(ends: [f64; 4], colour: &str) -> String {
    let [x1, y1, x2, y2] = ends;
    format!("<path d=\"M{x1} {y1}L{x2} {y2}\" stroke=\"{colour}\"/>\n")
}

#[test]
fn a_grid_of_long_lines_has_the_facets_of_its_closed_form() {
    for n in [1, 7, 40] {
        let mut body = square("");
        for k in 1..=n {
            let at = 100.0 * f64::from(k) / f64::from(n + 1);
            body += &line([at, 0.0, at, 100.0], "red");
            body += &line([0.0, at, 100.0, at], "blue");
        }
        let imported = import(&body);
        let side = usize::try_from(n).unwrap() + 1;
        assert_eq!(imported.sheet.facets.len(), side * side);
        assert_eq!(imported.sheet.vertices.len(), (side + 1) * (side + 1));
        assert_eq!(imported.euler_characteristic(), 1);
    }
}

#[test]
fn random_lines_across_have_as_many_facets_as_crossings_say() {
    // Chords of a square: facets = 1 + chords + crossings (Euler), if no three meet.
    let mut random = fastrand::Rng::with_seed(7);
    for count in [3, 20, 80] {
        let chords: Vec<[f64; 4]> =
            (0..count).map(|_| [0.0, 100.0 * random.f64(), 100.0, 100.0 * random.f64()]).collect();
        let mut body = square("");
        for chord in &chords {
            body += &line(*chord, "red");
        }
        let crosses = |a: &[f64; 4], b: &[f64; 4]| (a[1] - b[1]) * (a[3] - b[3]) < 0.0;
        let mut crossings = 0;
        for (i, a) in chords.iter().enumerate() {
            crossings += chords[..i].iter().filter(|b| crosses(a, b)).count();
        }
        let options = ImportOptions {
            merge: Some(MergeTolerance::Relative(1e-11)),
            ..ImportOptions::default()
        };
        let imported = import_with(&options, &body).unwrap();
        assert_eq!(imported.sheet.facets.len(), 1 + count + crossings);
        assert_eq!(imported.euler_characteristic(), 1);
    }
}

#[test]
fn many_lines_through_nearly_one_point_become_one_sheet() {
    let mut body = square("");
    for k in 0..60 {
        let (sin, cos) = (std::f64::consts::PI * f64::from(k) / 60.0).sin_cos();
        let wobble = 0.004 * f64::from(k % 7);
        let (x, y) = (50.0 + wobble, 50.0 - wobble);
        body += &line([x - 40.0 * cos, y - 40.0 * sin, x + 40.0 * cos, y + 40.0 * sin], "red");
    }
    body += "<polygon stroke=\"blue\" points=\"";
    for k in 0..120 {
        let (sin, cos) = (std::f64::consts::PI * f64::from(k) / 60.0).sin_cos();
        let _ = write!(body, "{},{} ", 50.0 + 30.0 * cos, 50.0 + 30.0 * sin);
    }
    body += "\"/>";
    for merge in [1e-3, 1e-4, 1e-5, 1e-9] {
        let options = ImportOptions {
            merge: Some(MergeTolerance::Relative(merge)),
            ..ImportOptions::default()
        };
        let imported = import_with(&options, &body).unwrap();
        assert_eq!(imported.euler_characteristic(), 1, "{merge}");
    }
}

#[test]
fn ends_that_nearly_meet_are_merged_within_the_tolerance_only() {
    let body = square(
        &(line([50.0, 0.008, 50.0, 49.995], "red") + &line([50.0, 50.0, 50.0, 99.99], "red")),
    );
    let imported = import(&body);
    assert_eq!(imported.sheet.facets.len(), 2);
    assert!(warned(&imported, WarningKind::Merged) > 0);
    let exact =
        ImportOptions { merge: Some(MergeTolerance::Relative(1e-6)), ..ImportOptions::default() };
    let error = import_with(&exact, &body).unwrap_err();
    assert!(matches!(error, ImportError::MostDropped { .. }), "{error}");
    // Origami Simulator's 3 units.
    let body = square(&line([50.0, 2.0, 50.0, 98.0], "red"));
    let simulator =
        ImportOptions { merge: Some(MergeTolerance::Absolute(3.0)), ..ImportOptions::default() };
    assert_eq!(import_with(&simulator, &body).unwrap().sheet.facets.len(), 2);
    let error = import_with(&ImportOptions::default(), &body).unwrap_err();
    assert!(error.to_string().contains("pattern.vertex_tolerance"), "{error}");
    for merge in [
        MergeTolerance::Relative(0.0),
        MergeTolerance::Relative(f64::NAN),
        MergeTolerance::Relative(0.5),
        MergeTolerance::Absolute(-1.0),
        MergeTolerance::Absolute(1e9),
    ] {
        let options = ImportOptions { merge: Some(merge), ..ImportOptions::default() };
        let error = import_with(&options, &body).unwrap_err();
        assert!(matches!(error, ImportError::Tolerance { .. }), "{error}");
    }
}

#[test]
fn lines_on_lines_count_once_and_the_stronger_meaning_wins() {
    let body = square(
        &(line([50.0, 0.0, 50.0, 100.0], "red")
            + &line([50.0, 20.0, 50.0, 120.0], "red")
            + &line([50.0, 60.0, 50.0, 80.0], "yellow")
            + &line([0.0, 0.0, 100.0, 0.0], "red")
            + &line([10.0, 10.0, 10.0, 10.0], "red")),
    );
    let imported = import(&body);
    assert_eq!(counts(&imported)[&'M'], 1);
    assert_eq!(imported.sheet.facets.len(), 2);
    assert_eq!(warned(&imported, WarningKind::Duplicate), 1);
    assert_eq!(warned(&imported, WarningKind::Conflict), 2);
    assert_eq!(warned(&imported, WarningKind::Stray), 1);
    assert_eq!(warned(&imported, WarningKind::TooShort), 1);
}

#[test]
fn strays_outsiders_and_hole_fillers_are_left_out() {
    let body = square(
        &("<rect x=\"40\" y=\"40\" width=\"20\" height=\"20\" stroke=\"black\"/>".to_owned()
            + &line([45.0, 40.0, 45.0, 60.0], "red")
            + &line([10.0, 10.0, 20.0, 20.0], "red")
            + &line([20.0, 20.0, 30.0, 20.0], "blue")
            + &line([0.0, 50.0, 40.0, 50.0], "blue")),
    );
    let imported = import(&body);
    assert_eq!(warned(&imported, WarningKind::Stray), 2);
    assert_eq!(warned(&imported, WarningKind::Outside), 1);
    // A crease from the border to the hole has the same facet on both sides.
    assert_eq!((imported.sheet.facets.len(), counts(&imported)[&'V']), (1, 1));
    assert_eq!(imported.euler_characteristic(), 0);
}

#[test]
fn creases_that_leave_the_sheet_and_return_end_at_its_border() {
    let imported = import(&square(
        "<path d=\"M50 0V50H130V120H50V80\" stroke=\"red\"/><path d=\"M50 50L0 100\" stroke=\"red\"/>",
    ));
    assert_eq!((imported.sheet.facets.len(), imported.euler_characteristic()), (3, 1));
    assert_eq!(warned(&imported, WarningKind::Outside), 1);
}

#[test]
fn nested_holes_and_islands_are_distinguished() {
    let ring = |low: f64, colour: &str| {
        let side = 100.0 - 2.0 * low;
        format!(
            "<rect x=\"{low}\" y=\"{low}\" width=\"{side}\" height=\"{side}\" stroke=\"{colour}\"/>\n"
        )
    };
    // Two facets that only a crease parts: the inner one lies in the outer.
    let imported = import(&(ring(0.0, "black") + &ring(20.0, "red")));
    assert_eq!((imported.sheet.facets.len(), counts(&imported)[&'M']), (2, 4));
    assert_eq!(imported.euler_characteristic(), 1);
    let imported = import(&(ring(0.0, "black") + &ring(20.0, "red") + &ring(30.0, "black")));
    assert_eq!((imported.sheet.facets.len(), imported.euler_characteristic()), (2, 0));
    // An island in the hole is a second piece.
    let imported = import(&(ring(0.0, "black") + &ring(20.0, "black") + &ring(30.0, "black")));
    assert_eq!((imported.sheet.facets.len(), imported.euler_characteristic()), (1, 0));
    assert_eq!(warned(&imported, WarningKind::OtherPiece), 1);
}

#[test]
fn a_border_with_the_sheet_on_both_sides_is_a_cut() {
    for slit in ["M50 0V60", "M50 0V40M50 40V60"] {
        let drawn = |colour: &str| {
            let crease = line([50.0, 60.0, 50.0, 100.0], "red");
            import(&square(&format!("<path d=\"{slit}\" stroke=\"{colour}\"/>{crease}")))
        };
        let (border, cut) = (drawn("black"), drawn("#0f0"));
        assert_eq!((&border.sheet, &border.targets), (&cut.sheet, &cut.targets));
        assert_eq!(warned(&border, WarningKind::InnerBorder), 1);
        assert_eq!(warned(&cut, WarningKind::InnerBorder), 0);
    }
}

#[test]
fn a_sheet_drawn_without_a_border_gets_one() {
    let body =
        "<rect width=\"10\" height=\"10\" stroke=\"red\"/><path d=\"M0 0L10 10\" stroke=\"blue\"/>";
    let imported = import(body);
    let counts = counts(&imported);
    assert_eq!((counts[&'B'], counts[&'V'], counts.get(&'M')), (4, 1, None));
    assert_eq!(warned(&imported, WarningKind::MadeBorder), 1);
}

#[test]
fn a_slit_opens_where_a_crease_meets_it() {
    let slit = "<path d=\"M20 50H80\" stroke=\"#0f0\"/>";
    let closed = import(&square(slit));
    assert_eq!(warned(&closed, WarningKind::ClosedCut), 1);
    let body = square(&(slit.to_owned() + &line([50.0, 0.0, 50.0, 100.0], "red")));
    let open = import(&body);
    assert_eq!(warned(&open, WarningKind::ClosedCut), 0);
    assert_eq!(open.euler_characteristic(), 0);
    let notch = import(&square("<path d=\"M0 50H50L80 20\" stroke=\"#0f0\"/>"));
    assert_eq!((notch.euler_characteristic(), counts(&notch)[&'B']), (1, 5 + 4));
}

/// The pattern with every line as it was drawn, one upon another and in any direction.
fn redrawn(pattern: &Pattern, random: &mut fastrand::Rng) -> Pattern {
    let mut creases = pattern.creases.clone();
    random.shuffle(&mut creases);
    for (a, b, _) in &mut creases {
        if random.bool() {
            std::mem::swap(a, b);
        }
    }
    Pattern { creases }
}

#[test]
fn the_order_and_direction_of_lines_do_not_matter() {
    let mut random = fastrand::Rng::with_seed(1);
    for pattern in [miura(6, 5), bird_base(), square_twist(), pop_up(), frame()] {
        let known = import_svg(pattern.svg().as_bytes(), &ImportOptions::default()).unwrap();
        for _ in 0..5 {
            let text = redrawn(&pattern, &mut random).svg();
            let imported = import_svg(text.as_bytes(), &ImportOptions::default()).unwrap();
            check_sheet(&imported);
            assert_eq!(counts(&imported), counts(&known));
            assert_eq!(imported.sheet.vertices.len(), known.sheet.vertices.len());
            assert_eq!(imported.sheet.facets.len(), known.sheet.facets.len());
        }
    }
}

#[test]
fn the_same_bytes_give_the_same_sheet() {
    let text = bird_base().svg();
    let import = || import_svg(text.as_bytes(), &ImportOptions::default()).unwrap();
    assert_eq!(import(), import());
}
