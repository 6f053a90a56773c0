//! One film pass for every kind of film.
//!
//! Each state is drawn once and passed to every film writer. States are drawn in parallel, a batch at a time; while one
//! batch is drawn, the writers take the previous one, in order. So the memory is bounded by two batches and the bytes
//! do not depend on the number of threads.

use foldmotion_pattern::Motion;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::caption::Overlay;
use crate::cutout::uncovered;
use crate::film::check_frames;
use crate::follow::{Frame, frames};
use crate::line_width::line_width;
use crate::raster::raster;
use crate::ring::ring;
use crate::shade::Paint;
use crate::{
    Camera, FilmOptions, Image, Marks, Palette, Paper, RecordError, Shot, Style, Values,
    positions_at, timeline,
};

/// Pictures worked on at a time, fewer for large ones: bounds the memory, not the result.
const BATCH: usize = 16;

/// Pixels worked on at a time.
const BATCH_PIXELS: usize = 1 << 25;

/// The motion and what is marked in it.
#[derive(Debug, Clone, Copy)]
pub struct Scene<'a> {
    /// The motion that is filmed.
    pub motion: &'a Motion,
    /// Facets painted in the colour of marks; a mark shows in at least one picture.
    pub marks: &'a Marks,
    /// Values shown as colours with a legend, instead of paper.
    pub values: Option<&'a Values>,
}

/// What a film writer gets before the first picture.
#[derive(Debug, Clone, Copy)]
pub struct Title<'a> {
    /// The options of the film.
    pub options: &'a FilmOptions,
    /// The colours of its areas, for formats with few colours.
    pub palette: &'a Palette,
}

/// A picture as it is passed to the writers.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The state and how long it is shown.
    pub shot: Shot,
    /// The picture over its background.
    pub image: Image,
    /// How far each pixel of the sheet covers the background, if requested by [`FilmOptions::is_transparent`].
    pub alpha: Option<Vec<u8>>,
}

/// Writes a film in one format.
pub trait FilmWriter: Send {
    /// Called once, before the first picture.
    ///
    /// # Errors
    /// The film cannot be written.
    fn begin(&mut self, title: Title<'_>) -> Result<(), RecordError>;

    /// Called for the pictures in order, several at a time.
    ///
    /// # Errors
    /// The film cannot be written.
    fn take(&mut self, pictures: &[Picture]) -> Result<(), RecordError>;

    /// Called once, after the last picture.
    ///
    /// # Errors
    /// The film cannot be written.
    fn finish(&mut self) -> Result<(), RecordError>;
}

/// Films `scene` into all `writers` at once.
///
/// The camera sees all of the motion, also while it turns, unless it is aimed by `centre` and `width`; with
/// [`FilmOptions::is_following`] it comes nearer where the sheet is small. Lines are narrower than the style says where
/// facets are small in the picture. `progress` gets the part done, from 0 to 1, and answers whether to go on. The order
/// of the compact state also decides between layers at other times, wherever they come within [`crate::TIE_TOLERANCE`]
/// of each other. The bytes do not depend on the number of threads.
///
/// # Errors
/// Those of [`timeline`] and [`Camera::fit`], [`RecordError::VertexCount`], [`RecordError::NotFinite`],
/// [`RecordError::Range`] and [`RecordError::ValueCount`] before anything is written; then
/// [`RecordError::Interrupted`] and those of the writers, which leave incomplete films behind.
pub fn film(
    scene: Scene<'_>,
    options: &FilmOptions,
    writers: &mut [&mut dyn FilmWriter],
    progress: &(dyn Fn(f64) -> bool + Sync),
) -> Result<(), RecordError> {
    let set = Set::new(scene, options)?;
    let palette = match scene.values {
        Some(_) => Palette::of_values(&options.style),
        None => Palette::new(&options.style, !scene.marks.is_empty()),
    };
    for writer in writers.iter_mut() {
        let palette = &palette;
        writer.begin(Title { options, palette })?;
    }
    let [width, height] = options.size.map(|side| side as usize);
    let length = (BATCH_PIXELS / (width * height)).clamp(1, BATCH);
    let mut drawn: Vec<Picture> = Vec::new();
    let mut done = 0;
    loop {
        if !progress(done as f64 / set.shots.len() as f64) {
            return Err(RecordError::Interrupted);
        }
        let next = done..(done + length).min(set.shots.len());
        let (pictures, taken) = rayon::join(
            || next.clone().into_par_iter().map(|i| set.picture(i)).collect(),
            || writers.iter_mut().try_for_each(|writer| writer.take(&drawn)),
        );
        taken?;
        let pictures: Result<Vec<Picture>, RecordError> = pictures;
        drawn = pictures?;
        done = next.end;
        if drawn.is_empty() {
            break;
        }
    }
    for writer in writers.iter_mut() {
        writer.finish()?;
    }
    progress(1.0);
    Ok(())
}

/// Everything a picture of the film is drawn from.
struct Set<'a> {
    scene: Scene<'a>,
    options: &'a FilmOptions,
    shots: Vec<Shot>,
    paper: Paper<'a>,
    /// The camera of each shot.
    cameras: Vec<Camera>,
    legend: Option<Overlay>,
}

impl<'a> Set<'a> {
    fn new(scene: Scene<'a>, options: &'a FilmOptions) -> Result<Self, RecordError> {
        let motion = scene.motion;
        let shots = timeline(motion, options)?;
        check_frames(motion)?;
        if let Some(values) = scene.values {
            values.check(motion)?;
        }
        let points = motion.frames.iter().flat_map(|f| f.positions.iter().copied());
        let (low, high) =
            points.clone().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), point| {
                (low.min(point), high.max(point))
            });
        let middle = options.centre.unwrap_or((low + high) * 0.5);
        let (view, size, margin) = (options.view, options.size, options.margin);
        let camera = if options.turn == 0.0 {
            Camera::fit(view, points, size, margin)?
        } else {
            Camera::fit_turning(view, points, middle, size, margin)?
        };
        let camera = camera.aimed(options.centre, options.width, size)?;
        let legend = scene.values.map(|values| Overlay::legend(values, size));
        let count = (shots.len() - 1).max(1) as f64;
        let turned = |index: usize| camera.turned(options.turn * index as f64 / count, middle);
        let cameras: Vec<Camera> = (0..shots.len()).map(turned).collect();
        Ok(Self {
            paper: Paper::new(&motion.sheet, &motion.compact_order),
            legend: legend.transpose()?,
            cameras: if options.is_following && !options.is_aimed() {
                following(motion, &shots, &cameras, options)
            } else {
                cameras
            },
            scene,
            options,
            shots,
        })
    }

    fn picture(&self, index: usize) -> Result<Picture, RecordError> {
        let (shot, options) = (self.shots[index], self.options);
        let (motion, camera) = (self.scene.motion, self.cameras[index]);
        let positions = positions_at(motion, shot.time);
        let style = Style {
            line_width: line_width(&motion.sheet, &positions, &camera, options.style.line_width),
            ..options.style.clone()
        };
        let paints = self.paints(index);
        let draw =
            |style: &Style| raster(&self.paper, &positions, &camera, style, &paints, options.size);
        let mut image = draw(&style);
        let mut alpha = options.is_transparent.then(|| uncovered(&image, &style, draw));
        let last = self.scene.motion.frames.last();
        let is_last = last.is_some_and(|frame| shot.time >= frame.time);
        let ending = options.ending.as_deref().filter(|_| is_last);
        let caption =
            options.has_caption.then(|| Overlay::caption(shot.time, ending, options.size));
        let overlays = [self.legend.clone(), caption.transpose()?];
        for overlay in overlays.into_iter().flatten() {
            overlay.draw(&mut image, alpha.as_deref_mut(), options.style.background);
        }
        let spot = (self.scene.marks).spot_at(&motion.sheet, &positions, shot.time);
        if let Some(spot) = spot {
            let centre = camera.project(spot).truncate();
            ring(&mut image, alpha.as_deref_mut(), centre, style.mark);
        }
        Ok(Picture { shot, image, alpha })
    }

    fn paints(&self, index: usize) -> Vec<Paint> {
        let Scene { motion, marks, values } = self.scene;
        let time = self.shots[index].time;
        let before = index.checked_sub(1).map_or(time, |i| self.shots[i].time);
        let marked = marks.at(&motion.sheet, before.min(time), before.max(time));
        let mut paints = vec![Paint::Paper; motion.sheet.faces.len()];
        if let Some(values) = values {
            let colours = values.colours(motion, time);
            for (paint, colour) in paints.iter_mut().zip(colours) {
                *paint = colour.map_or(Paint::Paper, Paint::Value);
            }
        }
        for (paint, _) in paints.iter_mut().zip(marked).filter(|(_, is)| *is) {
            *paint = Paint::Mark;
        }
        paints
    }
}

/// The `cameras`, which all see the whole of `motion`, brought nearer where the sheet is small in its shot.
fn following(
    motion: &Motion,
    shots: &[Shot],
    cameras: &[Camera],
    options: &FilmOptions,
) -> Vec<Camera> {
    let centre = DVec2::from(options.size.map(f64::from)) * 0.5;
    let around = |(shot, camera): (&Shot, &Camera)| {
        let positions = positions_at(motion, shot.time);
        let points = positions.iter().map(|&p| camera.project(p).truncate() - centre);
        let empty = [DVec2::INFINITY, DVec2::NEG_INFINITY];
        points.fold(empty, |[low, high], p| [low.min(p), high.max(p)])
    };
    let boxes: Vec<[DVec2; 2]> = shots.par_iter().zip(cameras).map(around).collect();
    let room = (1.0 - 2.0 * options.margin) * centre;
    let frames = frames(&boxes, room, options.fps);
    let near = |(camera, Frame { middle, part }): (&Camera, Frame)| {
        camera.framed(middle, part, options.size)
    };
    cameras.iter().zip(frames).map(near).collect()
}
