//! A film as numbered PNG files.

use std::borrow::Cow;
use std::io::Write;

use ::png::{BitDepth, ColorType, Compression, Encoder, SrgbRenderingIntent};
use rayon::prelude::*;

use crate::cutout::lifted;
use crate::shade::linear;
use crate::{FilmWriter, Picture, RecordError, Title};

/// Takes a film as PNG files of constant rate, `0001.png` on.
///
/// A state that is held is written again for each of its frames, so that programs that cut films can take the
/// files as they are. Pictures with alpha are written without background.
pub struct Frames<F> {
    write: F,
    count: u64,
    provenance: String,
    background: [u8; 3],
}

impl<F: FnMut(&str, &[u8]) -> std::io::Result<()> + Send> Frames<F> {
    /// `write` gets the name and the bytes of each file, in order.
    pub fn new(write: F) -> Self {
        Self { write, count: 0, provenance: String::new(), background: [0; 3] }
    }
}

impl<F> std::fmt::Debug for Frames<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let count = self.count;
        f.debug_struct("Frames").field("count", &count).finish_non_exhaustive()
    }
}

impl<F: FnMut(&str, &[u8]) -> std::io::Result<()> + Send> FilmWriter for Frames<F> {
    fn begin(&mut self, title: Title<'_>) -> Result<(), RecordError> {
        self.provenance.clone_from(&title.options.provenance);
        self.background = title.options.style.background;
        Ok(())
    }

    fn take(&mut self, pictures: &[Picture]) -> Result<(), RecordError> {
        let encode = |picture| frame(picture, self.background, &self.provenance);
        let files: Result<Vec<_>, _> = pictures.par_iter().map(encode).collect();
        for (file, picture) in files?.iter().zip(pictures) {
            for _ in 0..picture.shot.repeats {
                self.count += 1;
                (self.write)(&format!("{:04}.png", self.count), file)?;
            }
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<(), RecordError> {
        Ok(())
    }
}

/// `picture` as a PNG file that tells its `provenance`, where that is not empty.
fn frame(picture: &Picture, background: [u8; 3], provenance: &str) -> Result<Vec<u8>, RecordError> {
    let image = &picture.image;
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, image.width, image.height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    let data: Cow<'_, [u8]> = match &picture.alpha {
        None => {
            encoder.set_color(ColorType::Rgb);
            Cow::Borrowed(image.pixels.as_flattened())
        }
        Some(alpha) => {
            encoder.set_color(ColorType::Rgba);
            let ground = linear(background);
            let pairs = image.pixels.iter().zip(alpha);
            Cow::Owned(pairs.flat_map(|(&p, &a)| lifted(p, a, ground)).collect())
        }
    };
    if !provenance.is_empty() {
        encoder.add_itxt_chunk("Source".to_owned(), provenance.to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    bytes.flush()?;
    Ok(bytes)
}
