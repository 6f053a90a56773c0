//! The timeline of a film: which motion time is shown when, and for how long.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use foldmotion_pattern::{Frame, Motion};
use glam::DVec3;

use crate::image::check_size;
use crate::raster::check_positions;
use crate::{RecordError, Style, View};

/// The largest rate: most viewers show a GIF frame of less than 0.02 s for 0.1 s.
const MAX_FRAMES_PER_SECOND: f64 = 50.0;

/// The longest stage and hold: a GIF frame lasts at most 655.35 s.
const MAX_SECONDS: f64 = 600.0;

/// The longest time given to settling after the schedule's end.
const MAX_SETTLING_SECONDS: f64 = 1.0;

/// The largest turn of the camera, in degrees.
const MAX_TURN: f64 = 3600.0;

/// How often the states of a motion are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Playback {
    /// From the first to the last.
    #[default]
    #[serde(rename = "forward")]
    Once,
    /// To the last and back to the first; a film that repeats then has no jump.
    BackAndForth,
}

/// The options of a film.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmOptions {
    /// Pixels across and down.
    pub size: [u32; 2],
    /// Film frames a second of movement, above 0 and at most 50.
    pub fps: f64,
    /// Seconds for deployed → planar and for planar → compact; 0 jumps.
    pub seconds: [f64; 2],
    /// Seconds the first state, the planar state and the last state are held: deployed, planar and compact of a
    /// whole motion.
    pub hold: [f64; 3],
    /// Whether the film runs once or also back.
    pub playback: Playback,
    /// The direction from which the sheet is seen.
    pub view: View,
    /// The part of the picture's sides kept free on each side.
    pub margin: f64,
    /// The point in the middle of the picture, in the motion's unit; `None`: the middle of all that is seen.
    pub centre: Option<DVec3>,
    /// The length across the picture; `None`: all of the motion is seen from its own middle.
    pub width: Option<f64>,
    /// Degrees by which the camera turns about the vertical through `centre`, or the middle of the motion, evenly over
    /// the film.
    pub turn: f64,
    /// Whether the camera comes nearer where the sheet is small in the picture; a camera aimed by `centre` or `width`
    /// does not.
    pub is_following: bool,
    /// Whether the stage and the time are written into the picture.
    pub has_caption: bool,
    /// What the caption of the last state says instead of its stage, such as how the motion ended.
    pub ending: Option<String>,
    /// Whether pictures are also made without background, for those formats that can be transparent. Takes twice the
    /// time.
    pub is_transparent: bool,
    /// The scene and the program that made the film; written into every file if not empty.
    pub provenance: String,
    /// Colours and lines.
    pub style: Style,
}

impl Default for FilmOptions {
    fn default() -> Self {
        Self {
            size: [960, 720],
            fps: 30.0,
            seconds: [3.0, 5.0],
            hold: [0.5; 3],
            playback: Playback::Once,
            view: View::default(),
            margin: 0.04,
            centre: None,
            width: None,
            turn: 0.0,
            is_following: true,
            has_caption: false,
            ending: None,
            is_transparent: false,
            provenance: String::new(),
            style: Style::default(),
        }
    }
}

impl FilmOptions {
    /// Whether the camera looks where it was told to.
    pub(crate) fn is_aimed(&self) -> bool {
        self.centre.is_some() || self.width.is_some()
    }

    /// Refuses what cannot be filmed.
    ///
    /// # Errors
    /// [`RecordError::Size`], [`RecordError::FramesPerSecond`], [`RecordError::Seconds`], [`RecordError::LineWidth`],
    /// [`RecordError::Turn`].
    pub fn check(&self) -> Result<(), RecordError> {
        check_size(self.size)?;
        self.style.check()?;
        if !(self.fps > 0.0 && self.fps <= MAX_FRAMES_PER_SECOND) {
            return Err(RecordError::FramesPerSecond {
                value: self.fps,
                limit: MAX_FRAMES_PER_SECOND,
            });
        }
        let durations = [
            ("seconds[0]", self.seconds[0]),
            ("seconds[1]", self.seconds[1]),
            ("hold", self.hold[0]),
            ("hold", self.hold[1]),
            ("hold", self.hold[2]),
        ];
        for (name, value) in durations {
            if !(0.0..=MAX_SECONDS).contains(&value) {
                return Err(RecordError::Seconds { name, value, limit: MAX_SECONDS });
            }
        }
        if !(-MAX_TURN..=MAX_TURN).contains(&self.turn) {
            return Err(RecordError::Turn { value: self.turn, limit: MAX_TURN });
        }
        Ok(())
    }
}

/// One film frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shot {
    /// The motion time it shows.
    pub time: f64,
    /// The time for which it is shown, in hundredths of a second.
    pub centiseconds: u16,
    /// The number of frames that show it in a film of constant rate, at least one.
    pub repeats: u32,
}

/// The film frames of `motion`.
///
/// Movement is shown at `fps`, evenly in t within a stage; the frames at the first time, at t = 1 and at the last time
/// are held for `hold` longer. t = 1 and t = 2 are hit exactly if the motion reaches them. Settling after t = 2 runs on
/// at the rate of the second stage, within one second. A film back and forth shows every state but the last a second
/// time, in the opposite order. Durations are rounded so that the sum stays right: 30 frames a second last 3, 3, 4, 3,
/// 3, 4, … hundredths.
///
/// # Errors
/// [`RecordError::Size`], [`RecordError::FramesPerSecond`], [`RecordError::Seconds`], [`RecordError::LineWidth`],
/// [`RecordError::NoFrames`], [`RecordError::Time`].
pub fn timeline(motion: &Motion, options: &FilmOptions) -> Result<Vec<Shot>, RecordError> {
    options.check()?;
    let [first, last] = check_times(motion)?;
    let mut times = vec![first];
    let stages = [
        (0.0, 1.0, options.seconds[0]),
        (1.0, 2.0, options.seconds[1]),
        (2.0, last, settling_seconds(last, options.seconds[1])),
    ];
    for (start, end, seconds) in stages {
        let (from, to) = (f64::max(start, first), f64::min(end, last));
        if to <= from {
            continue;
        }
        let shown = seconds * (to - from) / (end - start);
        let steps = (shown * options.fps).round().max(1.0);
        let mut step = 1.0;
        while step < steps {
            times.push(from + (to - from) * step / steps);
            step += 1.0;
        }
        times.push(to);
    }
    if options.playback == Playback::BackAndForth {
        let back: Vec<f64> = times.iter().rev().skip(1).copied().collect();
        times.extend(back);
    }
    Ok(with_durations(&times, options))
}

fn settling_seconds(last: f64, fold_seconds: f64) -> f64 {
    ((last - 2.0) * fold_seconds).clamp(0.0, MAX_SETTLING_SECONDS)
}

#[expect(clippy::cast_sign_loss, reason = "durations are not negative")]
fn with_durations(times: &[f64], options: &FilmOptions) -> Vec<Shot> {
    let first = times.first().copied();
    let last = times.iter().copied().reduce(f64::max);
    let hold = |time: f64| match Some(time) {
        t if t == first => options.hold[0],
        t if t == last => options.hold[2],
        _ if time == 1.0 => options.hold[1],
        _ => 0.0,
    };
    let mut seconds = 0.0;
    let mut shown = 0.0;
    let mut shots = Vec::with_capacity(times.len());
    for &time in times {
        seconds += 1.0 / options.fps + hold(time);
        let until = (seconds * 100.0).round();
        shots.push(Shot {
            time,
            centiseconds: (until - shown) as u16,
            repeats: 1 + (hold(time) * options.fps).round() as u32,
        });
        shown = until;
    }
    shots
}

/// The first and the last time of a motion whose times increase.
pub(crate) fn check_times(motion: &Motion) -> Result<[f64; 2], RecordError> {
    let mut previous = f64::NEG_INFINITY;
    for (frame, Frame { time, .. }) in motion.frames.iter().enumerate() {
        if !time.is_finite() || *time <= previous {
            return Err(RecordError::Time { frame, time: *time });
        }
        previous = *time;
    }
    match (motion.frames.first(), motion.frames.last()) {
        (Some(first), Some(last)) => Ok([first.time, last.time]),
        _ => Err(RecordError::NoFrames),
    }
}

/// Refuses frames that do not fit the sheet.
pub(crate) fn check_frames(motion: &Motion) -> Result<(), RecordError> {
    let mut frames = motion.frames.iter().enumerate();
    frames.try_for_each(|(index, frame)| check_positions(&motion.sheet, index, &frame.positions))
}

/// The positions at motion time `time`: vertices move straight from frame to frame, and are at rest before the first
/// and after the last.
///
/// Preconditions: times increase and all frames have equally many positions. No frames give no positions.
pub fn positions_at(motion: &Motion, time: f64) -> Vec<DVec3> {
    let next = motion.frames.partition_point(|frame| frame.time < time);
    let after = motion.frames.get(next);
    let before = next.checked_sub(1).and_then(|i| motion.frames.get(i));
    match (before, after) {
        (_, Some(frame)) if frame.time == time => frame.positions.clone(),
        (Some(a), Some(b)) => {
            let s = (time - a.time) / (b.time - a.time);
            let pairs = a.positions.iter().zip(&b.positions);
            pairs.map(|(&p, &q)| p.lerp(q, s)).collect()
        }
        (Some(only), None) | (None, Some(only)) => only.positions.clone(),
        (None, None) => Vec::new(),
    }
}
