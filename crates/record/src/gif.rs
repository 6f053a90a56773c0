//! The film of a motion as an animated GIF.
//!
//! Frames are drawn, reduced to the palette and compressed in parallel, a few at a time, and written in order. Each
//! frame holds only the rectangle that changed, with the transparent colour where it did not; the film repeats for
//! ever.

use std::io::Write;

use ::gif::{AnyExtension, DisposalMethod, Encoder, Extension, Frame, Repeat};
use foldmotion_pattern::Motion;
use rayon::prelude::*;

use crate::{FilmOptions, FilmWriter, Marks, Palette, Picture, RecordError, Scene, Title, film};

/// Films `motion` as a GIF alone, see [`film()`].
///
/// # Errors
/// Those of [`film()`]; [`RecordError::Write`] and [`RecordError::Encode`] leave an incomplete film behind in `writer`.
pub fn gif(
    motion: &Motion,
    marks: &Marks,
    options: &FilmOptions,
    writer: impl Write + Send,
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<(), RecordError> {
    let scene = Scene { motion, marks, values: None };
    film(scene, options, &mut [&mut Gif::new(writer)], progress)
}

/// Takes a film as an animated GIF that repeats for ever.
pub struct Gif<W: Write> {
    writer: Option<W>,
    encoder: Option<Encoder<W>>,
    palette: Option<Palette>,
    previous: Option<Vec<u8>>,
}

impl<W: Write> Gif<W> {
    /// `writer`: where the bytes go; best buffered.
    pub fn new(writer: W) -> Self {
        Self { writer: Some(writer), encoder: None, palette: None, previous: None }
    }
}

impl<W: Write> std::fmt::Debug for Gif<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Gif").finish_non_exhaustive()
    }
}

impl<W: Write + Send> FilmWriter for Gif<W> {
    fn begin(&mut self, title: Title<'_>) -> Result<(), RecordError> {
        let [width, height] = title.options.size.map(|side| side as u16);
        let colors = title.palette.colors().concat();
        let Some(writer) = self.writer.take() else {
            return Ok(());
        };
        let mut encoder = Encoder::new(writer, width, height, &colors)?;
        encoder.set_repeat(Repeat::Infinite)?;
        let comment = title.options.provenance.as_bytes();
        if !comment.is_empty() {
            let blocks: Vec<&[u8]> = comment.chunks(u8::MAX.into()).collect();
            encoder.write_raw_extension(AnyExtension(Extension::Comment as u8), &blocks)?;
        }
        self.palette = Some(title.palette.clone());
        self.encoder = Some(encoder);
        Ok(())
    }

    fn take(&mut self, pictures: &[Picture]) -> Result<(), RecordError> {
        let (Some(encoder), Some(palette)) = (&mut self.encoder, &self.palette) else {
            return Ok(());
        };
        let Some(last) = pictures.last() else {
            return Ok(());
        };
        let width = last.image.width as u16;
        let indices: Vec<_> =
            (pictures.par_iter()).map(|picture| palette.indices(&picture.image)).collect();
        let before = |i: usize| i.checked_sub(1).map_or(self.previous.as_ref(), |j| indices.get(j));
        let frames: Vec<_> = (0..indices.len())
            .into_par_iter()
            .map(|i| compressed(before(i), &indices[i], width, pictures[i].shot.centiseconds))
            .collect();
        for frame in &frames {
            encoder.write_lzw_pre_encoded_frame(frame)?;
        }
        self.previous = indices.into_iter().last();
        Ok(())
    }

    fn finish(&mut self) -> Result<(), RecordError> {
        if let Some(encoder) = self.encoder.take() {
            encoder.into_inner()?.flush()?;
        }
        Ok(())
    }
}

/// The GIF frame that turns the picture `before` into `after`, the whole picture if there is none before.
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
                    if old == new { Palette::TRANSPARENT } else { *new }
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

/// The rectangle [left, top, right, bottom) that holds every difference; one pixel if there is none, because a GIF
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
