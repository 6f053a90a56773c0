//! From `[record]` to a [`Recording`], with errors that name the key.

use std::ops::RangeInclusive;

use foldmotion_geometry::Number;
use foldmotion_record::{FilmOptions, Mp4, Playback, RecordError, Style, View};
use glam::DVec3;

use super::Recording;
use crate::StudyError;
use crate::scene::{
    CameraChoice, CameraScene, ColourChoice, HoldScene, LoopChoice, OutputChoice, ThickenedScene,
};
use crate::study::Resolver;

/// The states of a figure, at most.
const MOST_STATES: usize = 100;

/// The colour of creases over colours that stand for values: a grey between the lightest and the darkest of them.
const NEUTRAL: [u8; 3] = [176, 176, 180];

/// The narrowest picture, and the widest and farthest one, in the motion's unit: pixels stay finite.
const NARROWEST: f64 = 1e-9;
const FARTHEST: f64 = 1e9;

/// The size of letters in figures where the scene gives none, that of captions in print, and what it may be, millimetres.
const LETTERS: f64 = 2.4;
const SIZES: RangeInclusive<f64> = 0.5..=20.0;

/// How far a turntable goes round, degrees.
const TURN: f64 = 360.0;

/// Colours and lines of pictures and figures: over colours that stand for values all creases are grey.
fn style(colour: ColourChoice) -> Style {
    match colour {
        ColourChoice::Paper => Style::default(),
        ColourChoice::Grey => Style::grey(),
        ColourChoice::Strain | ColourChoice::Bending => Style {
            mountain: NEUTRAL,
            valley: NEUTRAL,
            line_width: 0.9,
            ..Style::default()
        },
    }
}

impl Resolver<'_> {
    /// What is written of the motion, and how.
    pub(crate) fn recording(&self, title: String) -> Result<Recording, StudyError> {
        let record = &self.scene.record;
        let mut scene = self.scene.clone();
        scene.title = Some(title);
        let film = self.film()?;
        Ok(Recording {
            outputs: self.outputs(&film)?,
            film,
            at: self.states()?,
            colour: record.colour.unwrap_or(ColourChoice::Paper),
            thickness: self.thickness()?,
            has_profile: record.profile.unwrap_or(false),
            has_box: record.bounds.unwrap_or(true),
            has_dimensions: record.dimensions.unwrap_or(true),
            letters: self.letters()?,
            scene,
        })
    }

    fn outputs(&self, film: &FilmOptions) -> Result<Vec<OutputChoice>, StudyError> {
        let mut outputs = self
            .scene
            .record
            .outputs
            .clone()
            .unwrap_or_else(|| vec![OutputChoice::Fold, OutputChoice::Gif, OutputChoice::Csv]);
        outputs.sort_unstable();
        outputs.dedup();
        if outputs.contains(&OutputChoice::Mp4) {
            if cfg!(not(feature = "mp4")) {
                let message = "mp4: this program was built without MP4; build it with --features mp4, which needs a C++ \
                               compiler, or use gif";
                return Err(self.fault("record.outputs", message));
            }
            Mp4::<Vec<u8>>::check_size(film.size)
                .map_err(|e| self.fault("record.size", format!("mp4: {e}")))?;
        }
        Ok(outputs)
    }

    fn film(&self) -> Result<FilmOptions, StudyError> {
        let scene = &self.scene.record;
        let standard = FilmOptions::default();
        let (size, fps) = scene.standard_film();
        let (view, turn) = self.camera()?;
        let (centre, width) = self.aim()?;
        let film = FilmOptions {
            size: self.size(size)?,
            fps: scene.fps.unwrap_or(fps),
            seconds: scene.seconds.unwrap_or(standard.seconds),
            hold: match scene.hold {
                None => standard.hold,
                Some(HoldScene::Each(seconds)) => [seconds; 3],
                Some(HoldScene::States(seconds)) => seconds,
            },
            playback: match scene.playback {
                None | Some(LoopChoice::Forward) => Playback::Once,
                Some(LoopChoice::BackAndForth) => Playback::BackAndForth,
            },
            view,
            turn,
            centre,
            width,
            is_following: scene.follow.unwrap_or(standard.is_following),
            has_caption: scene.caption.unwrap_or(false),
            is_transparent: scene.transparent.unwrap_or(false),
            style: style(scene.colour.unwrap_or(ColourChoice::Paper)),
            ..standard
        };
        film.check().map_err(|e| {
            let key = match e {
                RecordError::FramesPerSecond { .. } => "record.fps",
                RecordError::Seconds { name: "hold", .. } => "record.hold",
                RecordError::Seconds { .. } => "record.seconds",
                RecordError::Turn { .. } => "record.camera",
                _ => "record.size",
            };
            self.fault(key, e.to_string())
        })?;
        Ok(film)
    }

    fn size(&self, standard: [u32; 2]) -> Result<[u32; 2], StudyError> {
        let Some([width, height]) = self.scene.record.size else {
            return Ok(standard);
        };
        let side = |n: i64| u32::try_from(n).ok().filter(|n| (1..=65_535).contains(n));
        if let (Some(width), Some(height)) = (side(width), side(height)) {
            return Ok([width, height]);
        }
        let message = "both sides must lie between 1 and 65535 pixels";
        Err(self.fault("record.size", message))
    }

    fn camera(&self) -> Result<(View, f64), StudyError> {
        Ok(match self.scene.record.camera {
            None | Some(CameraScene::Preset(CameraChoice::Iso)) => (View::Iso, 0.0),
            Some(CameraScene::Preset(CameraChoice::Front)) => (View::Front, 0.0),
            Some(CameraScene::Preset(CameraChoice::Side)) => (View::Side, 0.0),
            Some(CameraScene::Preset(CameraChoice::Top)) => (View::Top, 0.0),
            Some(CameraScene::Preset(CameraChoice::Turntable)) => (View::Iso, TURN),
            Some(CameraScene::Own(own)) => {
                let (azimuth, elevation) = (own.azimuth, own.elevation);
                if !(azimuth.abs() <= 360.0 && elevation.abs() <= 90.0) {
                    let message = "azimuth must lie in -360 to 360 degrees, elevation in -90 to 90";
                    return Err(self.fault("record.camera", message));
                }
                let view = View::Around { azimuth, elevation };
                (view, own.turn.unwrap_or(0.0))
            }
        })
    }

    /// The point in the middle of the picture and the length across it.
    fn aim(&self) -> Result<(Option<DVec3>, Option<f64>), StudyError> {
        let Some(CameraScene::Own(own)) = self.scene.record.camera else {
            return Ok((None, None));
        };
        let is_near = |c: f64| c.abs() <= FARTHEST;
        if !own.centre.iter().flatten().copied().all(is_near) {
            let message = format!("centre must be three numbers within ±{}", Number(FARTHEST));
            return Err(self.fault("record.camera", message));
        }
        if !own
            .width
            .is_none_or(|w| (NARROWEST..=FARTHEST).contains(&w))
        {
            let message = format!(
                "width must lie between {} and {}",
                Number(NARROWEST),
                Number(FARTHEST)
            );
            return Err(self.fault("record.camera", message));
        }
        Ok((own.centre.map(DVec3::from), own.width))
    }

    /// The size of letters in figures.
    fn letters(&self) -> Result<f64, StudyError> {
        let letters = self.scene.record.letters.unwrap_or(LETTERS);
        if SIZES.contains(&letters) {
            return Ok(letters);
        }
        let message = format!(
            "{letters} must lie between {} and {} millimetres; captions in print have 2 to 3",
            SIZES.start(),
            SIZES.end()
        );
        Err(self.fault("record.letters", message))
    }

    /// The motion times asked for, rising.
    fn states(&self) -> Result<Option<Vec<f64>>, StudyError> {
        let Some(at) = &self.scene.record.at else {
            return Ok(None);
        };
        let is_usable = (1..=MOST_STATES).contains(&at.len())
            && at.is_sorted_by(|a, b| a < b)
            && at.iter().all(|t| (0.0..=2.0).contains(t));
        if is_usable {
            return Ok(Some(at.clone()));
        }
        let message = format!(
            "must be 1 to {MOST_STATES} motion times that rise, from 0 (deployed) over 1 (planar) to 2 (compact)"
        );
        Err(self.fault("record.at", message))
    }

    /// The thickness of solids, none for surfaces.
    fn thickness(&self) -> Result<Option<f64>, StudyError> {
        let key = "record.thickened";
        match (self.scene.record.thickened, self.scene.material.thickness) {
            (None | Some(ThickenedScene::ByMaterial(false)), _) => Ok(None),
            (Some(ThickenedScene::By(thickness)), _) => self.length(key, thickness).map(Some),
            (Some(ThickenedScene::ByMaterial(true)), Some(thickness)) => {
                self.length("material.thickness", thickness).map(Some)
            }
            (Some(ThickenedScene::ByMaterial(true)), None) => {
                let message = "there is no material.thickness to take; give a thickness here";
                Err(self.fault(key, message))
            }
        }
    }
}
