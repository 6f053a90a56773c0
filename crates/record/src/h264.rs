//! The film of a motion as MP4: H.264 that browsers, slide programs and players take.
//!
//! Constrained baseline, 4:2:0, ITU-R BT.709 in video range, constant rate and constant quantiser, one slice a picture
//! on one thread: the same film gives the same bytes for any number of threads on one kind of processor.

use std::io::Write;

#[cfg(feature = "mp4")]
use openh264::encoder::Encoder;
#[cfg(feature = "mp4")]
use rayon::prelude::*;

#[cfg(feature = "mp4")]
use crate::Image;
use crate::mp4::Track;
use crate::{FilmWriter, Picture, RecordError, Title};

/// The quantiser of H.264: the step doubles with every 6; flat colours and thin lines show no blocks at this one.
#[cfg(feature = "mp4")]
const QUANTISER: u8 = 22;

/// Seconds between pictures that do not depend on others, to which players can jump.
#[cfg(feature = "mp4")]
const SECONDS_BETWEEN_KEYS: f64 = 2.0;

/// Takes a film as MP4.
///
/// A side of odd length is made longer by one pixel that repeats the last, because colours are stored for squares of 2
/// × 2 pixels. At most 3840 × 2160 pixels, upright or across, and at least 16 in each direction. The compressed film is
/// kept in memory until its end. Needs the cargo feature `mp4`.
pub struct Mp4<W> {
    writer: W,
    track: Track,
    #[cfg(feature = "mp4")]
    encoder: Option<Encoder>,
}

impl<W> std::fmt::Debug for Mp4<W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let frames = self.track.lengths.len();
        f.debug_struct("Mp4").field("frames", &frames).finish_non_exhaustive()
    }
}

impl<W: Write + Send> Mp4<W> {
    /// Refuses sizes of pictures that do not fit.
    ///
    /// # Errors
    /// [`RecordError::H264`].
    pub fn check_size(size: [u32; 2]) -> Result<(), RecordError> {
        let [width, height] = size;
        let (short, long) = (width.min(height), width.max(height));
        // An odd side grows by one pixel.
        if (15..=2160).contains(&short) && long <= 3840 {
            return Ok(());
        }
        Err(RecordError::H264 {
            message: format!(
                "{width} × {height} pixels: at least 16 in each direction and at most 3840 × 2160 fit; change the size"
            ),
        })
    }

    /// `writer`: where the bytes go, at the end of the film.
    ///
    /// # Errors
    /// [`RecordError::Feature`] in a build without the feature `mp4`.
    pub fn new(writer: W) -> Result<Self, RecordError> {
        if cfg!(not(feature = "mp4")) {
            return Err(RecordError::Feature { what: "an MP4 film", feature: "mp4" });
        }
        Ok(Self {
            writer,
            track: Track::default(),
            #[cfg(feature = "mp4")]
            encoder: None,
        })
    }
}

#[cfg(not(feature = "mp4"))]
impl<W: Write + Send> FilmWriter for Mp4<W> {
    fn begin(&mut self, _: Title<'_>) -> Result<(), RecordError> {
        Ok(())
    }

    fn take(&mut self, _: &[Picture]) -> Result<(), RecordError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<(), RecordError> {
        self.track.write(&mut self.writer)
    }
}

#[cfg(feature = "mp4")]
impl<W: Write + Send> FilmWriter for Mp4<W> {
    fn begin(&mut self, title: Title<'_>) -> Result<(), RecordError> {
        let options = title.options;
        Self::check_size(options.size)?;
        let [width, height] = options.size.map(|side| side.next_multiple_of(2));
        self.track = Track {
            size: [width, height].map(|side| side as u16),
            fps: options.fps,
            provenance: options.provenance.clone(),
            ..Track::default()
        };
        self.encoder = Some(encoder(options.fps)?);
        Ok(())
    }

    fn take(&mut self, pictures: &[Picture]) -> Result<(), RecordError> {
        let planes: Vec<_> =
            (pictures.par_iter()).map(|picture| Planes::new(&picture.image)).collect();
        for (planes, picture) in planes.iter().zip(pictures) {
            for _ in 0..picture.shot.repeats {
                self.push(planes)?;
            }
        }
        Ok(())
    }

    fn finish(&mut self) -> Result<(), RecordError> {
        self.track.write(&mut self.writer)?;
        Ok(self.writer.flush()?)
    }
}

#[cfg(feature = "mp4")]
impl<W> Mp4<W> {
    fn push(&mut self, planes: &Planes) -> Result<(), RecordError> {
        let Some(encoder) = &mut self.encoder else {
            return Ok(());
        };
        let stream = encoder.encode(&planes.slices())?;
        let track = &mut self.track;
        let start = track.data.len();
        let mut is_key = false;
        for layer in (0..stream.num_layers()).filter_map(|i| stream.layer(i)) {
            for nal in (0..layer.nal_count()).filter_map(|i| layer.nal_unit(i)) {
                let unit = without_start_code(nal);
                match unit.first().map_or(0, |byte| byte & 31) {
                    7 if track.sequence.is_empty() => track.sequence = unit.to_vec(),
                    8 if track.parameters.is_empty() => track.parameters = unit.to_vec(),
                    kind @ (1 | 5) => {
                        is_key |= kind == 5;
                        track.data.extend((unit.len() as u32).to_be_bytes());
                        track.data.extend(unit);
                    }
                    _ => {}
                }
            }
        }
        let length = track.data.len() - start;
        if length == 0 {
            let message = "the encoder left out a frame".to_owned();
            return Err(RecordError::H264 { message });
        }
        track.lengths.push(length as u32);
        if is_key {
            track.keys.push(track.lengths.len() as u32);
        }
        Ok(())
    }
}

#[cfg(feature = "mp4")]
fn without_start_code(nal: &[u8]) -> &[u8] {
    let zeros = nal.iter().take_while(|&&byte| byte == 0).count();
    nal.get(zeros + 1..).unwrap_or_default()
}

#[cfg(feature = "mp4")]
#[expect(clippy::cast_sign_loss, reason = "rates are positive")]
fn encoder(fps: f64) -> Result<Encoder, RecordError> {
    use openh264::OpenH264API;
    use openh264::encoder::{
        BitRate, Complexity, EncoderConfig, FrameRate, IntraFramePeriod, Profile, QpRange,
        RateControlMode, VuiConfig,
    };
    let period = (fps * SECONDS_BETWEEN_KEYS).ceil().max(1.0) as u32;
    // Of openh264's modes this one alone keeps to the range of quantisers, never leaves out a frame, whatever its size,
    // and prints nothing; the bit rate only bounds the level from below.
    let config = EncoderConfig::new()
        .bitrate(BitRate::from_bps(1_000_000))
        .max_frame_rate(FrameRate::from_hz(fps as f32))
        .rate_control_mode(RateControlMode::Bufferbased)
        .qp(QpRange::new(QUANTISER, QUANTISER))
        .profile(Profile::Baseline)
        .complexity(Complexity::High)
        .skip_frames(false)
        .scene_change_detect(false)
        .adaptive_quantization(false)
        .background_detection(false)
        .intra_frame_period(IntraFramePeriod::from_num_frames(period))
        .num_threads(1)
        .vui(VuiConfig::bt709());
    Ok(Encoder::with_api_config(OpenH264API::from_source(), config)?)
}

#[cfg(feature = "mp4")]
impl From<openh264::Error> for RecordError {
    fn from(error: openh264::Error) -> Self {
        Self::H264 { message: error.to_string() }
    }
}

/// Luma and the two differences of colour, the latter for squares of 2 × 2 pixels.
#[cfg(feature = "mp4")]
struct Planes {
    size: [usize; 2],
    planes: [Vec<u8>; 3],
}

#[cfg(feature = "mp4")]
impl Planes {
    /// ITU-R BT.709-6, items 3.2 to 3.4, in video range: with Y = 0.2126 R + 0.7152 G + 0.0722 B of bytes,
    /// 16 + 219 Y / 255, 128 + 224 (B − Y) / (1.8556 · 255), 128 + 224 (R − Y) / (1.5748 · 255).
    #[expect(clippy::cast_sign_loss, reason = "codes lie in 16 to 240")]
    fn new(image: &Image) -> Self {
        let [width, height] = [image.width, image.height].map(|side| side as usize);
        let [even_width, even_height] = [width, height].map(|side| side.next_multiple_of(2));
        let pixel = |x: usize, y: usize| {
            let (x, y) = (x.min(width - 1), y.min(height - 1));
            image.pixels[y * width + x].map(f32::from)
        };
        let luma = |[r, g, b]: [f32; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
        let mut planes = [const { Vec::new() }; 3];
        planes[0].reserve(even_width * even_height);
        for y in 0..even_height {
            let row = (0..even_width).map(|x| {
                let light = luma(pixel(x, y));
                (16.5 + light * (219.0 / 255.0)) as u8
            });
            planes[0].extend(row);
        }
        for y in (0..even_height).step_by(2) {
            for x in (0..even_width).step_by(2) {
                let four = [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)];
                let four = four.map(|(x, y)| pixel(x, y));
                let mean: [f32; 3] =
                    std::array::from_fn(|c| four.iter().map(|p| p[c]).sum::<f32>() / 4.0);
                let light = luma(mean);
                let blue = (mean[2] - light) * (224.0 / (1.8556 * 255.0));
                let red = (mean[0] - light) * (224.0 / (1.5748 * 255.0));
                planes[1].push((128.5 + blue) as u8);
                planes[2].push((128.5 + red) as u8);
            }
        }
        Self { size: [even_width, even_height], planes }
    }

    fn slices(&self) -> openh264::formats::YUVSlices<'_> {
        let [width, height] = self.size;
        let [y, u, v] = self.planes.each_ref().map(Vec::as_slice);
        let strides = (width, width / 2, width / 2);
        openh264::formats::YUVSlices::new((y, u, v), (width, height), strides)
    }
}

#[cfg(all(test, feature = "mp4"))]
mod tests {
    use super::*;

    #[test]
    fn white_black_and_pure_colours_get_their_codes_and_odd_sides_grow() {
        let code = |color: [u8; 3]| {
            let planes = Planes::new(&Image { width: 3, height: 1, pixels: vec![color; 3] });
            assert_eq!(planes.size, [4, 2]);
            let [y, u, v] = planes.planes;
            assert_eq!([y.len(), u.len(), v.len()], [8, 2, 2]);
            [y[7], u[1], v[1]]
        };
        assert_eq!(code([255; 3]), [235, 128, 128]);
        assert_eq!(code([0; 3]), [16, 128, 128]);
        assert_eq!(code([255, 0, 0]), [63, 102, 240]);
        assert_eq!(code([0, 0, 255]), [32, 240, 118]);
    }
}
