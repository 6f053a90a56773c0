//! Strips of states and the files they are written to.

use crate::common::*;
use foldmotion_pattern::{Case, LayerOrder, Unit, UnitSheet};
use foldmotion_record::{
    Bounds, Drawing, FigureState, Legend, LineStyle, Marks, Provenance, RecordError, StripOptions,
    Style, View, strip,
};
use glam::DVec3;

fn units() -> UnitSheet {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    UnitSheet::new(unit, 3, 2).unwrap()
}

/// The planar and the compact state.
fn states<'a>(units: &UnitSheet, order: &'a LayerOrder) -> Vec<FigureState<'a>> {
    vec![
        FigureState::new(units.sheet.planar(), order, "planar"),
        FigureState::new(units.compact(), order, "compact"),
    ]
}

fn figure(options: &StripOptions) -> Result<Drawing, RecordError> {
    let units = units();
    let order = units.compact_order();
    strip(&units.sheet, &states(&units, &order), options)
}

/// The lines of `svg` that begin so.
fn count(svg: &str, start: &str) -> usize {
    svg.lines().filter(|line| line.starts_with(start)).count()
}

#[test]
fn a_strip_has_its_width_on_paper_and_no_more_than_its_height() {
    for (width, height) in [(180.0, 240.0), (85.0, 40.0), (123.4, 30.0)] {
        let options = StripOptions { width, height, ..StripOptions::default() };
        let svg = figure(&options).unwrap().svg().unwrap();
        let head = svg.lines().next().unwrap();
        assert!(head.contains(&format!("width=\"{width}mm\"")), "{head}");
        let high = head.split("height=\"").nth(1).unwrap();
        let high: f64 = high.split("mm").next().unwrap().parse().unwrap();
        assert!(high <= height + 0.3, "{high} mm of {height}");
    }
    let narrow = StripOptions { width: 10.0, ..StripOptions::default() };
    let refused = figure(&narrow);
    assert!(matches!(refused, Err(RecordError::NoRoom { states: 2, .. })));
}

#[test]
fn what_cannot_be_drawn_is_refused_with_its_value() {
    let units = units();
    let order = LayerOrder::default();
    let wrong = |change: &dyn Fn(&mut Vec<FigureState<'_>>, &mut StripOptions)| {
        let (mut states, mut options) = (states(&units, &order), StripOptions::default());
        change(&mut states, &mut options);
        strip(&units.sheet, &states, &options).unwrap_err()
    };
    assert!(matches!(wrong(&|states, _| states.clear()), RecordError::NoFrames));
    assert!(matches!(
        wrong(&|states, _| states[1].positions[3].y = f64::NAN),
        RecordError::NotFinite { frame: 1, vertex: 3, .. }
    ));
    assert!(matches!(
        wrong(&|states, _| states[1].values = vec![1.0; 5]),
        RecordError::ValueCount { frame: 1, found: 5, .. }
    ));
    assert!(matches!(
        wrong(&|states, _| states[0].target = vec![DVec3::ZERO, DVec3::INFINITY]),
        RecordError::NotFinite { vertex: 1, .. }
    ));
    assert!(matches!(
        wrong(&|_, options| options.line_width = f64::NAN),
        RecordError::Length { name: "line_width", .. }
    ));
    let legend = Some(Legend { title: "strain".to_owned(), range: [1.0, 1.0] });
    assert!(matches!(
        wrong(&|_, options| options.legend.clone_from(&legend)),
        RecordError::Range { .. }
    ));
    assert!(matches!(
        wrong(&|states, _| {
            states[0].positions[0].x = 1.7e308;
            states[0].positions[1].x = -1.7e308;
        }),
        RecordError::NoRoom { .. }
    ));
}

#[test]
fn lines_take_their_style_and_greys_stay_grey() {
    let plain = figure(&StripOptions::default()).unwrap().svg().unwrap();
    assert!(!plain.contains("stroke-dasharray"));
    let grey =
        StripOptions { style: Style::grey(), lines: LineStyle::Dashed, ..StripOptions::default() };
    let svg = figure(&grey).unwrap().svg().unwrap();
    let dashes = svg.split("stroke-dasharray=\"").skip(1);
    let lengths: Vec<usize> =
        dashes.map(|rest| rest.split('"').next().unwrap().split(' ').count()).collect();
    assert!(lengths.contains(&2) && lengths.contains(&4), "{lengths:?}");
    for color in svg.split('#').skip(1) {
        let channels: Vec<u8> =
            (0..3).map(|k| u8::from_str_radix(&color[2 * k..2 * k + 2], 16).unwrap()).collect();
        let spread = channels.iter().max().unwrap() - channels.iter().min().unwrap();
        // Words are a very dark grey with a breath of blue.
        assert!(spread <= 4, "#{}", &color[..6]);
    }
}

#[test]
fn a_page_without_background_lets_through_what_lies_behind() {
    let options = StripOptions { background: None, ..StripOptions::default() };
    let clear = figure(&options).unwrap();
    let white = figure(&StripOptions::default()).unwrap();
    assert_eq!(count(&clear.svg().unwrap(), "<rect"), 0);
    assert_eq!(count(&white.svg().unwrap(), "<rect"), 1);
    let alpha = |drawing: &Drawing| {
        let file = drawing.png().unwrap();
        tiny_skia::Pixmap::decode_png(&file).unwrap().pixels()[0].alpha()
    };
    assert_eq!((alpha(&clear), alpha(&white)), (0, 255));
}

#[test]
fn values_marks_targets_and_boxes_are_drawn() {
    let units = units();
    let order = units.compact_order();
    let bare = states(&units, &order);
    let options = StripOptions::default();
    let words = |drawing: Drawing| count(&drawing.svg().unwrap(), "<text");
    let base = words(strip(&units.sheet, &bare, &options).unwrap());
    let mut boxed = bare.clone();
    boxed[1].bounds = Some(Bounds {
        low: DVec3::ZERO,
        high: DVec3::new(1.0, 2.0, 0.5),
        sizes: ["1 m".to_owned(), "2 m".to_owned(), String::new()],
        words: "G_r = 4 h".to_owned(),
    });
    let with_box = strip(&units.sheet, &boxed, &options).unwrap();
    assert_eq!(words(with_box), base + 3, "two sizes and a closed form");
    let mut marked = bare.clone();
    marked[0].marked = vec![false; units.sheet.faces.len()];
    let none = strip(&units.sheet, &marked, &options).unwrap();
    assert_eq!(words(none), base);
    marked[0].marked[2] = true;
    let svg = strip(&units.sheet, &marked, &options).unwrap().svg().unwrap();
    assert!(svg.contains(">penetrating<"));
    let mut valued = bare.clone();
    valued[0].values = (0..units.sheet.faces.len()).map(|k| k as f64).collect();
    let hidden = strip(&units.sheet, &valued, &options).unwrap();
    assert_eq!(hidden, strip(&units.sheet, &bare, &options).unwrap());
    let legend = Some(Legend { title: "strain, %".to_owned(), range: [0.0, 10.0] });
    let shown = StripOptions { legend, ..options };
    let svg = strip(&units.sheet, &valued, &shown).unwrap().svg().unwrap();
    assert!(svg.contains("strain, %") && svg.contains("#00224e") && svg.contains("#fee838"));
}

#[test]
fn marks_of_a_motion_show_in_the_state_at_their_time() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let mut marks = Marks::default();
    marks.insert(1, 0.5, 1.5);
    let marked = |time| FigureState::at(&motion, &marks, time).marked;
    assert_eq!(marked(1.0), [false, true]);
    assert_eq!(marked(2.0), [false, false]);
    assert_eq!(FigureState::at(&motion, &marks, 2.0).label, "t = 2, compact");
}

#[test]
fn one_scale_serves_all_states() {
    let square = square(foldmotion_pattern::Assignment::Facet);
    let order = LayerOrder::default();
    let half: Vec<DVec3> = square.planar().iter().map(|&p| 0.5 * p).collect();
    let states =
        [FigureState::new(square.planar(), &order, ""), FigureState::new(half, &order, "")];
    let options = StripOptions { view: View::Top, has_key: false, ..StripOptions::default() };
    let svg = strip(&square, &states, &options).unwrap().svg().unwrap();
    let shapes = svg.lines().filter(|l| l.contains("fill=\"#") && l.contains("<path"));
    let widths: Vec<f64> = shapes
        .map(|line| {
            let path = line.split("d=\"").nth(1).unwrap().split('"').next().unwrap();
            let numbers = path.split(|c: char| !(c.is_ascii_digit() || c == '.'));
            let all: Vec<f64> = numbers.filter_map(|n| n.parse().ok()).collect();
            let x = all.iter().step_by(2);
            let most = x.clone().copied().fold(f64::NEG_INFINITY, f64::max);
            most - x.copied().fold(f64::INFINITY, f64::min)
        })
        .collect();
    assert_eq!(widths.len(), 2, "{svg}");
    assert!((widths[0] - 2.0 * widths[1]).abs() < 0.03, "{widths:?}");
}

/// The objects of a PDF by its table of references, each from its first byte on; numbers without object are empty.
fn objects(pdf: &[u8]) -> Vec<&[u8]> {
    let text = String::from_utf8_lossy(pdf);
    let start = text.rsplit("startxref\n").next().unwrap();
    let start: usize = start.lines().next().unwrap().parse().unwrap();
    let table = String::from_utf8_lossy(&pdf[start..]).into_owned();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("xref"));
    let size = lines.next().unwrap().split(' ').nth(1).unwrap();
    let object = |(number, entry): (usize, &str)| {
        let offset: usize = entry[..10].parse().unwrap();
        if entry.contains('f') {
            return &pdf[..0];
        }
        let object = &pdf[offset..];
        let head = format!("{number} 0 obj");
        assert!(object.starts_with(head.as_bytes()), "{entry}");
        object
    };
    let entries = lines.take(size.parse().unwrap()).enumerate();
    entries.skip(1).map(object).collect()
}

/// The inflated stream of an object.
fn stream(object: &[u8]) -> String {
    let find = |word: &[u8]| object.windows(word.len()).position(|w| w == word).unwrap();
    let (start, end) = (find(b"stream\n") + 7, find(b"\nendstream"));
    let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&object[start..end]).unwrap();
    bytes.into_iter().map(char::from).collect()
}

#[test]
fn a_pdf_has_whole_objects_its_size_in_points_and_the_shapes_of_the_svg() {
    let drawing = figure(&StripOptions::default()).unwrap();
    let pdf = drawing.pdf().unwrap();
    let objects = objects(&pdf);
    let page = String::from_utf8_lossy(objects[2]);
    let media = page.split("/MediaBox [").nth(1).unwrap();
    let media = media.split(']').next().unwrap();
    let sides: Vec<f64> = media.split(' ').map(|n| n.parse().unwrap()).collect();
    assert!((sides[2] - 180.0 / 25.4 * 72.0).abs() < 1e-3, "{sides:?}");
    let content = stream(objects[3]);
    let svg = drawing.svg().unwrap();
    let shapes = svg.lines().filter(|l| l.contains("stroke-linejoin") && !l.contains("\"none\""));
    let filled = content.lines().filter(|line| *line == "B").count();
    assert_eq!(filled, shapes.count());
    assert_eq!(count(&content, "BT"), count(&svg, "<text"));
    assert_eq!(count(&content, "S"), svg.matches("fill=\"none\"").count());
}

#[test]
fn a_pdf_names_the_letters_it_shows_and_embeds_no_others() {
    let mut drawing = Drawing::new([100, 50]).unwrap();
    let at = glam::DVec2::new(5.0, 20.0);
    drawing.words(at, "λ^2 = a", 10.0, foldmotion_record::Anchor::Start);
    let pdf = drawing.pdf().unwrap();
    assert!(pdf.len() < 20_000, "{} bytes", pdf.len());
    let objects = objects(&pdf);
    let table = String::from_utf8_lossy(objects[10]).into_owned();
    for letter in "λ2=a ".chars() {
        let code = format!("<{:04X}>", u32::from(letter));
        assert!(table.contains(&code), "{letter} is {code} in {table}");
    }
    assert!(!table.contains("<0062>"), "b is not used");
}

#[test]
fn every_file_says_where_it_comes_from_and_the_same_drawing_has_the_same_bytes() {
    let origin = Provenance {
        title: "A strip & its motion".to_owned(),
        producer: "foldmotion 9.9.9".to_owned(),
        scene: "[profile]\nmodel = \"shelter\" # <one>\n".to_owned(),
        hash: "0123abcd".to_owned(),
    };
    let drawing = || {
        let plain = figure(&StripOptions::default()).unwrap();
        plain.with_provenance(origin.clone())
    };
    let (svg, pdf) = (drawing().svg().unwrap(), drawing().pdf().unwrap());
    assert_eq!(svg, drawing().svg().unwrap());
    assert_eq!(pdf, drawing().pdf().unwrap());
    objects(&pdf);
    let pdf = String::from_utf8_lossy(&pdf).into_owned();
    for file in [&svg, &pdf] {
        for text in ["0123abcd", "foldmotion 9.9.9", "# &lt;one&gt;", "A strip &amp; its motion"] {
            assert!(file.contains(text), "{text}");
        }
        assert!(!file.contains("Date"));
    }
    assert!(pdf.contains("/Producer") && pdf.contains("/Metadata"));
    let bare = figure(&StripOptions::default()).unwrap();
    assert!(!bare.svg().unwrap().contains("metadata"));
}

#[test]
fn pictures_and_plain_pages_become_pdf_too() {
    let mut drawing = Drawing::new([20, 10]).unwrap();
    let image = foldmotion_record::Image {
        width: 4,
        height: 2,
        pixels: (0..8).map(|k| [k * 30, 7, 200]).collect(),
    };
    drawing.picture(glam::DVec2::new(3.0, 2.0), image.clone());
    let pdf = drawing.pdf().unwrap();
    let objects = objects(&pdf);
    let pixels: Vec<u8> = stream(objects[11]).chars().map(|c| c as u8).collect();
    assert_eq!(pixels, image.pixels.as_flattened());
    assert!(drawing.with_unit(0.0).is_err());
    let long = Drawing::new([20_000, 1]).unwrap();
    assert!(long.with_unit(1.0).is_err());
}
