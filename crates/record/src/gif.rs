//! The film of a motion as an animated GIF.
//!
//! Frames are drawn, reduced to the palette and compressed in parallel, a few at a time, and written in order. Each
//! frame holds only the rectangle that changed, with the transparent colour where it did not; the film repeats for
//! ever.

use std::io::Write;

use ::gif::{DisposalMethod, Encoder, Frame, Repeat};
use foldmotion_pattern::Motion;
use rayon::prelude::*;

use crate::film::check_frames;
use crate::raster::raster;
use crate::{Camera, FilmOptions, Marks, Palette, Paper, RecordError, positions_at, timeline};

/// Frames worked on at a time, fewer for large pictures: bounds the memory, not the result.
const CHUNK: usize = 16;

/// Pixels worked on at a time.
const CHUNK_PIXELS: usize = 1 << 26;

/// Films `motion` with one fixed camera that sees all of it.
///
/// Facets are painted as `marks` says; a mark shows in at least one frame.
///
/// `progress` gets the part done, from 0 to 1, and answers whether to go on. The order of the compact state also
/// decides between layers at other times, wherever they come within [`crate::TIE_TOLERANCE`] of each other. The
/// bytes do not depend on the number of threads.
///
/// # Errors
/// Those of [`timeline`] and [`Camera::fit`], [`RecordError::VertexCount`] and [`RecordError::NotFinite`] before
/// anything is written; then [`RecordError::Interrupted`], [`RecordError::Write`] and [`RecordError::Encode`], which
/// leave an incomplete film behind in `writer`.
pub fn gif(
    motion: &Motion,
    marks: &Marks,
    options: &FilmOptions,
    writer: impl Write,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<(), RecordError> {
    let shots = timeline(motion, options)?;
    check_frames(motion)?;
    let points = motion.frames.iter().flat_map(|frame| &frame.positions);
    let camera = Camera::fit(options.view, points.copied(), options.size, options.margin)?;
    let paper = Paper::new(&motion.sheet, &motion.compact_order);
    let palette = Palette::new(&options.style, !marks.is_empty());
    let [width, height] = options.size.map(|side| side as u16);
    let mut encoder = Encoder::new(writer, width, height, &palette.colors().concat())?;
    encoder.set_repeat(Repeat::Infinite)?;

    let area = usize::from(width) * usize::from(height);
    let mut previous: Option<Vec<u8>> = None;
    let mut done = 0;
    for chunk in shots.chunks((CHUNK_PIXELS / area).clamp(1, CHUNK)) {
        if !progress(done as f64 / shots.len() as f64) {
            return Err(RecordError::Interrupted);
        }
        let draw = |index: usize, time: f64| {
            let positions = positions_at(motion, time);
            let previous = index.checked_sub(1).map_or(time, |index| shots[index].time);
            let marked = marks.at(&motion.sheet, previous, time);
            let (style, size) = (&options.style, options.size);
            palette.indices(&raster(&paper, &positions, &camera, style, &marked, size))
        };
        let pictures: Vec<_> = (chunk.par_iter().enumerate())
            .map(|(index, shot)| draw(done + index, shot.time))
            .collect();
        let before = |i: usize| {
            i.checked_sub(1)
                .map_or(previous.as_ref(), |j| pictures.get(j))
        };
        let frames: Vec<_> = (0..chunk.len())
            .into_par_iter()
            .map(|i| compressed(before(i), &pictures[i], width, chunk[i].centiseconds))
            .collect();
        for frame in &frames {
            encoder.write_lzw_pre_encoded_frame(frame)?;
        }
        done += chunk.len();
        previous = pictures.into_iter().last();
    }
    encoder.into_inner()?.flush()?;
    progress(1.0);
    Ok(())
}

/// The GIF frame that turns the picture `before` into `after`, the whole picture where there is none before.
fn compressed(before: Option<&Vec<u8>>, after: &[u8], width: u16, delay: u16) -> Frame<'static> {
    let row = usize::from(width);
    let height = (after.len() / row) as u16;
    let [left, top, right, bottom] = match before {
        Some(before) => changed(before, after, row),
        None => [0, 0, width, height],
    };
    let mut buffer = Vec::with_capacity(usize::from(right - left) * usize::from(bottom - top));
    for y in top..bottom {
        let row = usize::from(y) * row;
        let part = row + usize::from(left)..row + usize::from(right);
        match before {
            None => buffer.extend_from_slice(&after[part]),
            Some(before) => {
                let kept = |(old, new): (&u8, &u8)| {
                    if old == new {
                        Palette::TRANSPARENT
                    } else {
                        *new
                    }
                };
                buffer.extend(before[part.clone()].iter().zip(&after[part]).map(kept));
            }
        }
    }
    let mut frame = Frame {
        delay,
        dispose: DisposalMethod::Keep,
        transparent: Some(Palette::TRANSPARENT),
        left,
        top,
        width: right - left,
        height: bottom - top,
        buffer: buffer.into(),
        ..Frame::default()
    };
    frame.make_lzw_pre_encoded();
    frame
}

/// The rectangle [left, top, right, bottom) that holds every difference; one pixel where there is none, because a GIF
/// frame cannot be empty.
fn changed(before: &[u8], after: &[u8], row: usize) -> [u16; 4] {
    let mut found: Option<[usize; 4]> = None;
    let rows = before.chunks_exact(row).zip(after.chunks_exact(row));
    for (y, (old, new)) in rows.enumerate() {
        let mut columns = 0..row;
        let Some(left) = columns.find(|&x| old[x] != new[x]) else {
            continue;
        };
        let right = columns.rfind(|&x| old[x] != new[x]).unwrap_or(left) + 1;
        let [l, t, r, _] = found.unwrap_or([left, y, right, y]);
        found = Some([l.min(left), t, r.max(right), y + 1]);
    }
    found.unwrap_or([0, 0, 1, 1]).map(|side| side as u16)
}
