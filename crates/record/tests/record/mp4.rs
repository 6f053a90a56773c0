//! MP4 films decoded.

use crate::common::*;
use foldmotion_pattern::Motion;
use foldmotion_record::{FilmOptions, FilmWriter, Frames, Marks, Mp4, RecordError, Scene, film};
use openh264::decoder::Decoder;
use openh264::formats::YUVSource;
use rayon::ThreadPoolBuilder;

fn options() -> FilmOptions {
    FilmOptions {
        size: [95, 71],
        fps: 20.0,
        seconds: [0.2, 0.3],
        hold: [0.1, 0.0, 0.2],
        provenance: "scene square".to_owned(),
        ..FilmOptions::default()
    }
}

/// The MP4 file and, of the same pass, the PNG files.
fn filmed(motion: &Motion, options: &FilmOptions) -> (Vec<u8>, Vec<Vec<u8>>) {
    let (mut bytes, mut files) = (Vec::new(), Vec::new());
    let marks = Marks::default();
    let scene = Scene { motion, marks: &marks, values: None };
    let mut frames = Frames::new(|_: &str, bytes: &[u8]| {
        files.push(bytes.to_vec());
        Ok(())
    });
    let mut mp4 = Mp4::new(&mut bytes).unwrap();
    let writers: &mut [&mut dyn FilmWriter] = &mut [&mut mp4, &mut frames];
    film(scene, options, writers, &|_| true).unwrap();
    drop((mp4, frames));
    (bytes, files)
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

/// Where the content of the first box `kind` begins.
fn content(bytes: &[u8], kind: [u8; 4]) -> usize {
    bytes.windows(4).position(|w| *w == kind).unwrap() + 4
}

/// The pictures as a decoder wants them: units after start codes, the parameter sets first.
fn stream(bytes: &[u8]) -> Vec<Vec<u8>> {
    let start = [0, 0, 0, 1];
    let at = content(bytes, *b"avcC");
    let length = usize::from(bytes[at + 7]);
    let sequence = &bytes[at + 8..at + 8 + length];
    let rest = at + 8 + length;
    let parameters = &bytes[rest + 3..rest + 3 + usize::from(bytes[rest + 2])];
    let mut first = [&start, sequence, &start, parameters].concat();
    let table = content(bytes, *b"stsz");
    let mut place = word(bytes, content(bytes, *b"stco") + 8);
    let mut pictures = Vec::new();
    for index in 0..word(bytes, table + 8) {
        let end = place + word(bytes, table + 12 + 4 * index);
        let mut picture = std::mem::take(&mut first);
        while place < end {
            let length = word(bytes, place);
            picture.extend(start);
            picture.extend(&bytes[place + 4..place + 4 + length]);
            place += 4 + length;
        }
        pictures.push(picture);
    }
    assert_eq!(place, bytes.len(), "the table tells of every byte");
    pictures
}

#[test]
fn an_mp4_decodes_to_the_pictures_it_was_made_of() {
    let motion = folding_square(&[0.0, 0.4, 1.0, 1.5, 2.0]);
    let (bytes, files) = filmed(&motion, &options());
    assert!(bytes.windows(12).any(|part| part == b"scene square"));
    let pictures = stream(&bytes);
    assert_eq!((pictures.len(), files.len()), (17, 17));
    let mut decoder = Decoder::new().unwrap();
    for (picture, file) in pictures.iter().zip(&files) {
        let decoded = decoder.decode(picture).unwrap().unwrap();
        assert_eq!(decoded.dimensions(), (96, 72), "odd sides grow");
        let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut pixels = vec![0; 95 * 71 * 3];
        reader.next_frame(&mut pixels).unwrap();
        let mut sum = 0.0;
        for (index, pixel) in pixels.chunks(3).enumerate() {
            let [r, g, b] = [0, 1, 2].map(|c| f64::from(pixel[c]));
            let luma = 16.0 + (0.2126 * r + 0.7152 * g + 0.0722 * b) * 219.0 / 255.0;
            let found = decoded.y()[index / 95 * decoded.strides().0 + index % 95];
            sum += (f64::from(found) - luma).powi(2);
        }
        let psnr = 10.0 * (255.0 * 255.0 * 95.0 * 71.0 / sum).log10();
        assert!(psnr > 36.0, "{psnr} dB");
    }
}

#[test]
fn the_bytes_of_an_mp4_are_the_same_for_one_and_two_threads() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let with_threads = |count| {
        let pool = ThreadPoolBuilder::new().num_threads(count).build().unwrap();
        pool.install(|| filmed(&motion, &options()).0)
    };
    let (one, two) = (with_threads(1), with_threads(2));
    assert!(one.len() > 1000 && one == two);
}

#[test]
fn no_frame_is_left_out_where_the_whole_picture_moves() {
    let motion = folding_square(&(0..30).map(|k| f64::from(k) / 29.0).collect::<Vec<_>>());
    let mut hard =
        FilmOptions { size: [640, 480], fps: 50.0, seconds: [0.6, 0.0], turn: 3600.0, ..options() };
    hard.style.line_width = 40.0;
    let count = stream(&filmed(&motion, &hard).0).len();
    assert_eq!(count, 31 + 5 + 10);
}

#[test]
fn sizes_that_the_encoder_does_not_take_are_refused_before_anything_is_drawn() {
    let motion = folding_square(&[0.0, 1.0]);
    for size in [[8, 72], [4000, 100], [3000, 3000]] {
        let options = FilmOptions { size, ..options() };
        let mut bytes = Vec::new();
        let marks = Marks::default();
        let scene = Scene { motion: &motion, marks: &marks, values: None };
        let mut writer = Mp4::new(&mut bytes).unwrap();
        let error = film(scene, &options, &mut [&mut writer], &|_| true).unwrap_err();
        assert!(matches!(error, RecordError::H264 { .. }), "{error}");
        drop(writer);
        assert!(bytes.is_empty());
    }
}
