//! Films of several kinds at once, read back.

use std::io::{self, Cursor};

use crate::common::*;
use foldmotion_pattern::Motion;
use foldmotion_record::{
    Camera, FilmOptions, FilmWriter, Frames, Gif, Image, Marks, Playback, RecordError, Scene,
    Values, View, film, gif, picture, positions_at, timeline,
};

fn options() -> FilmOptions {
    FilmOptions {
        size: SIZE,
        fps: 20.0,
        seconds: [0.2, 0.3],
        hold: [0.1, 0.0, 0.2],
        provenance: "scene square, version 0, hash 12".to_owned(),
        is_following: false,
        ..FilmOptions::default()
    }
}

fn scene<'a>(motion: &'a Motion, marks: &'a Marks, values: Option<&'a Values>) -> Scene<'a> {
    Scene { motion, marks, values }
}

/// The PNG files of a film.
fn frames(motion: &Motion, options: &FilmOptions, values: Option<&Values>) -> Vec<Vec<u8>> {
    let mut files: Vec<Vec<u8>> = Vec::new();
    let mut writer = Frames::new(|name: &str, bytes: &[u8]| {
        assert_eq!(name, format!("{:04}.png", files.len() + 1));
        files.push(bytes.to_vec());
        Ok(())
    });
    let marks = Marks::default();
    film(scene(motion, &marks, values), options, &mut [&mut writer], &|_| true).unwrap();
    drop(writer);
    files
}

/// The pixels of a PNG file, its channels and its text.
fn read(file: &[u8]) -> (Vec<u8>, usize, String) {
    let mut reader = png::Decoder::new(Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let texts = &reader.info().utf8_text;
    let text = texts.first().map(|t| t.get_text().unwrap());
    (pixels, info.color_type.samples(), text.unwrap_or_default())
}

fn pictures(motion: &Motion, options: &FilmOptions) -> Vec<Image> {
    let points = motion.frames.iter().flat_map(|f| f.positions.clone());
    let (size, style) = (options.size, &options.style);
    let camera = Camera::fit(options.view, points, size, options.margin).unwrap();
    let draw = |time| {
        let positions = positions_at(motion, time);
        let order = &motion.compact_order;
        let style = shown_style(&motion.sheet, &positions, &camera, style);
        picture(&motion.sheet, &positions, order, &camera, &style, size).unwrap()
    };
    let shots = timeline(motion, options).unwrap();
    let repeated = shots.iter().flat_map(|s| vec![s.time; s.repeats as usize]);
    repeated.map(draw).collect()
}

#[test]
fn png_files_are_the_pictures_at_constant_rate_with_their_provenance() {
    let motion = folding_square(&[0.0, 0.4, 1.0, 1.5, 2.0]);
    let options = options();
    let (files, expected) = (frames(&motion, &options, None), pictures(&motion, &options));
    // 11 states, two more for the first hold and four for the last.
    assert_eq!((files.len(), expected.len()), (17, 17));
    for (file, image) in files.iter().zip(&expected) {
        let (pixels, channels, text) = read(file);
        assert_eq!(channels, 3);
        assert!(pixels == image.pixels.as_flattened());
        assert_eq!(text, options.provenance);
    }
}

#[test]
fn png_files_without_background_give_the_picture_when_laid_over_it() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let mut options = options();
    options.is_transparent = true;
    options.style.background = [250, 240, 30];
    let (files, expected) = (frames(&motion, &options, None), pictures(&motion, &options));
    let background = options.style.background;
    let mut partly = 0;
    for (file, image) in files.iter().zip(&expected) {
        let (pixels, channels, _) = read(file);
        assert_eq!(channels, 4);
        for (found, wanted) in pixels.chunks(4).zip(&image.pixels) {
            let a = f64::from(found[3]) / 255.0;
            partly += usize::from(a > 0.0 && a < 1.0);
            for c in 0..3 {
                let over = a * linear(found[c]) + (1.0 - a) * linear(background[c]);
                assert!((over - linear(wanted[c])).abs() < 0.006, "{found:?} {wanted:?}");
            }
            assert_eq!(found[3] == 0, *wanted == background, "{found:?}");
        }
    }
    assert!(partly > 100, "outlines cover pixels in part");
}

#[test]
fn films_made_together_are_those_made_alone() {
    let motion = folding_square(&[0.0, 0.4, 1.0, 1.5, 2.0]);
    let options = options();
    let (mut alone, mut together) = (Vec::new(), Vec::new());
    let marks = Marks::default();
    gif(&motion, &marks, &options, &mut alone, &|_| true).unwrap();
    let mut count = 0;
    let mut files = Frames::new(|_: &str, _: &[u8]| {
        count += 1;
        Ok(())
    });
    let mut writer = Gif::new(&mut together);
    let writers: &mut [&mut dyn FilmWriter] = &mut [&mut writer, &mut files];
    film(scene(&motion, &marks, None), &options, writers, &|_| true).unwrap();
    drop((writer, files));
    assert!(alone == together && count == 17);
    let comment = options.provenance.as_bytes();
    assert!(alone.windows(comment.len()).any(|part| part == comment));
}

#[test]
fn a_film_back_and_forth_shows_the_same_states_twice_but_the_last() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let options = FilmOptions { playback: Playback::BackAndForth, ..options() };
    let times: Vec<f64> = timeline(&motion, &options).unwrap().iter().map(|s| s.time).collect();
    let back: Vec<f64> = times.iter().rev().copied().collect();
    assert_eq!((times.len(), &times), (21, &back));
    assert_eq!(times.iter().filter(|&&t| t == 2.0).count(), 1);
}

#[test]
fn captions_and_legends_change_the_picture_and_values_colour_the_facets() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let options = FilmOptions { view: View::Top, size: [192, 144], ..options() };
    let values =
        Values { title: "strain".to_owned(), range: [0.0, 1.0], frames: vec![vec![0.0, 1.0]; 3] };
    let plain = frames(&motion, &options, None);
    let with_caption = FilmOptions { has_caption: true, ..options.clone() };
    assert_ne!(frames(&motion, &with_caption, None)[0], plain[0]);
    let (pixels, ..) = read(&frames(&motion, &options, Some(&values))[0]);
    let count = |color: [u8; 3]| pixels.chunks(3).filter(|p| **p == color).count();
    // The first and the last colour of the map, on the two facets; the scale holds few pixels of each.
    assert!(count([0, 34, 78]) > 2000 && count([254, 232, 56]) > 2000);
}

#[test]
fn a_film_follows_a_sheet_that_grows_unless_that_is_off_or_the_camera_is_aimed() {
    let mut motion = folding_square(&[0.0, 1.0]);
    let large = motion.frames[0].positions.clone();
    motion.frames[0].positions = large.iter().map(|&p| 0.1 * p).collect();
    motion.frames[1].positions = large;
    let sheet_pixels = |options: &FilmOptions| {
        let files = frames(&motion, options, None);
        let count = |file: &Vec<u8>| {
            let (pixels, ..) = read(file);
            pixels.chunks(3).filter(|p| **p != [255; 3]).count()
        };
        [&files[0], files.last().unwrap()].map(count)
    };
    let still = FilmOptions { seconds: [20.0, 0.3], ..options() };
    let following = FilmOptions { is_following: true, ..still.clone() };
    let aimed = FilmOptions { width: Some(2.0), ..following.clone() };
    let ([small, all], [near, whole]) = (sheet_pixels(&still), sheet_pixels(&following));
    assert_eq!(whole, all, "the last state fills the picture either way");
    assert!(near > 10 * small && 10 * near > all, "{small} {near} {all}");
    let not_following = FilmOptions { width: Some(2.0), ..still };
    assert_eq!(sheet_pixels(&aimed), sheet_pixels(&not_following));
}

#[test]
fn a_turning_camera_shows_another_side_at_the_end() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let turning = FilmOptions { turn: 360.0, ..options() };
    let files = frames(&motion, &turning, None);
    let half = FilmOptions { turn: 180.0, ..options() };
    let halves = frames(&motion, &half, None);
    assert_eq!(files[0], halves[0], "they start alike");
    assert_ne!(files.last(), halves.last());
    let far = FilmOptions { turn: f64::NAN, ..options() };
    assert!(matches!(timeline(&motion, &far), Err(RecordError::Turn { .. })));
}

#[test]
fn values_that_do_not_fit_are_refused_and_a_full_disk_is_reported() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let marks = Marks::default();
    let good = Values { title: String::new(), range: [0.0, 1.0], frames: vec![vec![0.0; 2]; 3] };
    let refused = |values: &Values| {
        let mut writer = Frames::new(|_: &str, _: &[u8]| Err(io::ErrorKind::StorageFull.into()));
        let scene = scene(&motion, &marks, Some(values));
        film(scene, &options(), &mut [&mut writer], &|_| true).unwrap_err()
    };
    let error = refused(&good);
    assert!(matches!(error, RecordError::Write(_)), "{error}");
    let mut short = good.clone();
    short.frames[1].pop();
    let error = refused(&short);
    assert!(matches!(error, RecordError::ValueCount { frame: 1, found: 1, .. }), "{error}");
    let mut few = good.clone();
    few.frames.pop();
    assert!(matches!(refused(&few), RecordError::ValueCount { frame: 2, .. }));
    let flat = Values { range: [1.0, 1.0], ..good };
    assert!(matches!(refused(&flat), RecordError::Range { .. }));
}
