//! Films read back.

use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::common::*;
use ::gif::{ColorOutput, DecodeOptions, Repeat};
use foldmotion_pattern::{Case, Frame, Motion, Unit, UnitSheet};
use foldmotion_record::{
    Camera, FilmOptions, Marks, Palette, RecordError, gif, picture, positions_at, timeline,
};
use glam::DVec3;
use rayon::ThreadPoolBuilder;

fn options() -> FilmOptions {
    FilmOptions {
        size: SIZE,
        fps: 20.0,
        seconds: [0.2, 0.3],
        hold: [0.25; 3],
        is_following: false,
        ..FilmOptions::default()
    }
}

#[expect(clippy::unwrap_used, reason = "a film that fails must fail its test")]
fn film(motion: &Motion, options: &FilmOptions) -> Vec<u8> {
    let mut bytes = Vec::new();
    gif(motion, &Marks::default(), options, &mut bytes, &|_| true).unwrap();
    bytes
}

#[test]
fn a_film_reads_back_frame_by_frame_as_the_pictures_it_was_made_of() {
    let motion = folding_square(&[0.0, 0.4, 1.0, 1.5, 2.0]);
    let options = options();
    let bytes = film(&motion, &options);

    let points = motion.frames.iter().flat_map(|f| f.positions.clone());
    let camera = Camera::fit(options.view, points, options.size, options.margin).unwrap();
    let palette = Palette::new(&options.style, false);
    let shots = timeline(&motion, &options).unwrap();
    let mut settings = DecodeOptions::new();
    settings.set_color_output(ColorOutput::Indexed);
    let mut decoder = settings.read_info(bytes.as_slice()).unwrap();
    assert_eq!([decoder.width(), decoder.height()], [96, 72]);
    assert_eq!(decoder.global_palette().unwrap()[..3], [255, 255, 255]);
    let mut canvas = vec![Palette::TRANSPARENT; 96 * 72];
    let (mut frames, mut delay) = (0, 0);
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let (left, top) = (usize::from(frame.left), usize::from(frame.top));
        for (y, row) in frame.buffer.chunks(usize::from(frame.width)).enumerate() {
            for (x, &index) in row.iter().enumerate() {
                if Some(index) != frame.transparent {
                    canvas[(top + y) * 96 + left + x] = index;
                }
            }
        }
        let positions = positions_at(&motion, shots[frames].time);
        let order = &motion.compact_order;
        let size = options.size;
        let style = shown_style(&motion.sheet, &positions, &camera, &options.style);
        let image = picture(&motion.sheet, &positions, order, &camera, &style, size);
        let expected = palette.indices(&image.unwrap());
        assert!(canvas == expected, "frame {frames} differs");
        assert_eq!(frame.delay, shots[frames].centiseconds);
        frames += 1;
        delay += u32::from(frame.delay);
    }
    assert_eq!(decoder.repeat(), Repeat::Infinite);
    assert_eq!(frames, 1 + 4 + 6);
    // 11 frames at 20 a second and three holds.
    assert_eq!(delay, 55 + 75);
}

#[test]
fn the_bytes_are_the_same_for_one_and_two_threads() {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    let units = UnitSheet::new(unit, 3, 2).unwrap();
    let frame = |time, positions| Frame { time, positions };
    let motion = Motion {
        frames: vec![frame(1.0, units.sheet.planar()), frame(2.0, units.compact())],
        compact_order: units.compact_order(),
        sheet: units.sheet,
    };
    let options = FilmOptions { seconds: [0.0, 1.0], is_following: true, ..options() };
    let with_threads = |count| {
        let pool = ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| film(&motion, &options))
    };
    let (one, two) = (with_threads(1), with_threads(2));
    assert!(one.len() > 1000 && one == two);
}

#[test]
fn a_film_hits_the_three_states_exactly_and_holds_them() {
    let motion = folding_square(&[0.0, 0.3, 1.3, 2.0]);
    let shots = timeline(&motion, &FilmOptions::default()).unwrap();
    assert_eq!(shots.len(), 1 + 90 + 150);
    assert_eq!([shots[0].time, shots[90].time, shots[240].time], [0.0, 1.0, 2.0]);
    assert!(shots.is_sorted_by(|a, b| a.time < b.time));
    for (index, shot) in shots.iter().enumerate() {
        let held = if [0, 90, 240].contains(&index) { 50 } else { 0 };
        let moving = shot.centiseconds - held;
        assert!(moving == 3 || moving == 4, "shot {index} lasts {moving}");
    }
    let total: u32 = shots.iter().map(|s| u32::from(s.centiseconds)).sum();
    // 241 thirtieths of a second and three half seconds, rounded once.
    assert_eq!(total, 803 + 150);
}

#[test]
fn a_film_shows_the_part_that_was_recorded_and_its_settling() {
    let from_planar = timeline(&folding_square(&[1.0, 2.0]), &options()).unwrap();
    assert_eq!((from_planar[0].time, from_planar.len()), (1.0, 1 + 6));
    let half = timeline(&folding_square(&[0.5, 1.0]), &options()).unwrap();
    assert_eq!((half[0].time, half.len()), (0.5, 1 + 2));
    let settled = timeline(&folding_square(&[1.0, 2.0, 2.5]), &options()).unwrap();
    assert!(settled.iter().any(|s| s.time == 2.0));
    assert_eq!(settled.last().unwrap().time, 2.5);
    assert!(settled.last().unwrap().centiseconds >= 25);
    let still = timeline(&folding_square(&[0.0]), &options()).unwrap();
    assert_eq!(still.len(), 1);
}

#[test]
fn vertices_move_straight_between_frames() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let [a, b, c] = [0, 1, 2].map(|i| motion.frames[i].positions.clone());
    assert_eq!(positions_at(&motion, 1.0), b);
    assert_eq!(positions_at(&motion, -1.0), a);
    assert_eq!(positions_at(&motion, 3.0), c);
    let quarter = positions_at(&motion, 0.25)[3];
    assert!(quarter.distance(a[3] * 0.75 + b[3] * 0.25) < 1e-15);
}

#[test]
fn films_of_bad_input_are_refused_before_anything_is_written() {
    type Broken = (fn(&mut FilmOptions), fn(&RecordError) -> bool);
    let broken: [Broken; 9] = [
        (|o| o.size = [0, 72], |e| matches!(e, RecordError::Size { .. })),
        (|o| o.size = [65_536, 72], |e| matches!(e, RecordError::Size { .. })),
        (|o| o.fps = 0.0, |e| matches!(e, RecordError::FramesPerSecond { .. })),
        (|o| o.fps = f64::NAN, |e| matches!(e, RecordError::FramesPerSecond { .. })),
        (|o| o.fps = 51.0, |e| matches!(e, RecordError::FramesPerSecond { .. })),
        (|o| o.hold[1] = -1.0, |e| matches!(e, RecordError::Seconds { .. })),
        (|o| o.seconds[1] = f64::NAN, |e| matches!(e, RecordError::Seconds { .. })),
        (|o| o.margin = 0.5, |e| matches!(e, RecordError::Margin { .. })),
        (|o| o.style.line_width = -1.0, |e| matches!(e, RecordError::LineWidth { .. })),
    ];
    let refused = |motion: &Motion, options: &FilmOptions| {
        let mut bytes = Vec::new();
        let error = gif(motion, &Marks::default(), options, &mut bytes, &|_| true).unwrap_err();
        assert!(bytes.is_empty(), "{error} after {} bytes", bytes.len());
        error
    };
    let motion = folding_square(&[0.0, 1.0]);
    for (index, (change, is_right)) in broken.iter().enumerate() {
        let mut options = options();
        change(&mut options);
        let error = refused(&motion, &options);
        assert!(is_right(&error), "case {index}: {error}");
    }
    let mut nan = motion.clone();
    nan.frames[1].positions[2] = DVec3::NAN;
    let error = refused(&nan, &options());
    assert!(matches!(error, RecordError::NotFinite { frame: 1, vertex: 2, .. }), "{error}");
    let mut short = motion.clone();
    short.frames[0].positions.pop();
    let error = refused(&short, &options());
    assert!(matches!(error, RecordError::VertexCount { frame: 0, .. }), "{error}");
    for times in [[0.0, 0.0], [1.0, 0.5], [0.0, f64::NAN]] {
        let mut still = motion.clone();
        still.frames[0].time = times[0];
        still.frames[1].time = times[1];
        let error = refused(&still, &options());
        assert!(matches!(error, RecordError::Time { frame: 1, .. }), "{error}");
    }
    let mut empty = motion;
    empty.frames.clear();
    let error = refused(&empty, &options());
    assert!(matches!(error, RecordError::NoFrames), "{error}");
}

#[test]
fn a_film_can_be_interrupted_and_reports_its_progress() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let options = FilmOptions { seconds: [2.0, 2.0], ..options() };
    let calls = AtomicUsize::new(0);
    let stop_at_third = |part: f64| {
        assert!((0.0..=1.0).contains(&part));
        calls.fetch_add(1, Ordering::Relaxed) < 2
    };
    let error = gif(&motion, &Marks::default(), &options, Vec::new(), &stop_at_third).unwrap_err();
    assert!(matches!(error, RecordError::Interrupted), "{error}");
    assert_eq!(calls.load(Ordering::Relaxed), 3);
}

#[test]
fn a_film_that_cannot_be_written_says_so() {
    struct Full(usize);
    impl io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    for room in [0, 100, 900, 2000] {
        let error = gif(&motion, &Marks::default(), &options(), Full(room), &|_| true).unwrap_err();
        let RecordError::Write(error) = error else {
            panic!("room for {room} bytes: {error}");
        };
        assert_eq!(error.kind(), io::ErrorKind::StorageFull);
    }
}

#[test]
fn marked_facets_are_painted_in_their_span_and_nowhere_else() {
    let motion = folding_square(&[0.0, 0.4, 1.0, 1.5, 2.0]);
    let options = options();
    let mut marks = Marks::default();
    marks.insert(0, 0.9, 1.2);
    let mut bytes = Vec::new();
    gif(&motion, &marks, &options, &mut bytes, &|_| true).unwrap();
    let mut settings = DecodeOptions::new();
    settings.set_color_output(ColorOutput::RGBA);
    let mut decoder = settings.read_info(bytes.as_slice()).unwrap();
    let is_marked = |p: &[u8]| p[3] == 255 && p[0] > 90 && p[1] < p[0] / 3 && p[2] > p[0] / 2;
    let mut canvas = vec![0; 96 * 72 * 4];
    let mut painted = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        let width = usize::from(frame.width);
        for (index, pixel) in frame.buffer.chunks(4).enumerate() {
            let (x, y) = (index % width, index / width);
            let place = (usize::from(frame.top) + y) * 96 + usize::from(frame.left) + x;
            if pixel[3] == 255 {
                canvas[4 * place..4 * place + 4].copy_from_slice(pixel);
            }
        }
        painted.push(canvas.chunks(4).filter(|p| is_marked(p)).count() > 20);
    }
    let shots = timeline(&motion, &options).unwrap();
    let expected: Vec<bool> = (0..shots.len())
        .map(|k| {
            let previous = if k == 0 { 0.0 } else { shots[k - 1].time };
            shots[k].time >= 0.9 && previous < 1.2
        })
        .collect();
    assert_eq!(painted, expected);
    assert!(expected.contains(&true) && expected.contains(&false));
}
