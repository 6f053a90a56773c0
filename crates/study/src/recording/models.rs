//! `motion.glb`, and an OBJ and STL file of each state.

use foldmotion_pattern::Motion;
use foldmotion_record::{
    GlbOptions, RecordError, Solid, Style, glb, obj, positions_at, solid, stl, surface_of,
};

use super::Recorder;
use crate::StudyError;
use crate::VERSION;
use crate::results::Results;
use crate::scene::{ColourChoice, OutputChoice};

/// The shortest stage of a GLB in seconds; a film may skip a stage.
const SHORTEST_STAGE: f64 = 0.01;

impl Recorder<'_> {
    pub(super) fn models(&self, results: &mut Results) -> Result<(), StudyError> {
        if self.recording.has(OutputChoice::Glb) {
            self.glb(results)?;
        }
        let outputs = [OutputChoice::Obj, OutputChoice::Stl].map(|o| self.recording.has(o));
        if outputs == [false, false] {
            return Ok(());
        }
        for time in self.times() {
            let solid = self.solid(time)?;
            if outputs[0] {
                let text = self.source_info.text_at(time);
                results.write(&state_name(time, OutputChoice::Obj), |out| {
                    obj(&solid, &text, out).map_err(StudyError::from)
                })?;
            }
            if outputs[1] {
                // The header has 80 bytes, too few for a scene.
                let label = format!("foldmotion {VERSION} t={time} {}", self.source_info.sha256);
                results.write(&state_name(time, OutputChoice::Stl), |out| {
                    stl(&solid, &label, out).map_err(StudyError::from)
                })?;
            }
        }
        Ok(())
    }

    /// Writes the motion with the fewest morph targets that keep the tolerance. If they are too many for viewers, the tolerance
    /// is doubled.
    fn glb(&self, results: &mut Results) -> Result<(), StudyError> {
        let mut options = GlbOptions {
            seconds: self.recording.film.seconds.map(|s| s.max(SHORTEST_STAGE)),
            style: match self.recording.colour {
                ColourChoice::Grey => Style::grey(),
                _ => Style::default(),
            },
            title: self.title.to_owned(),
            provenance: self.source_info.text(),
            ..GlbOptions::default()
        };
        let motion = self.motion_in_metres();
        let motion = motion.as_ref().unwrap_or(self.motion);
        let mut bytes = Vec::new();
        loop {
            match glb(motion, &options, &mut bytes) {
                Err(RecordError::Targets { .. }) => options.tolerance *= 2.0,
                written => break written.map(drop)?,
            }
        }
        results.write_bytes("motion.glb", &bytes)
    }

    /// The motion in metres; `None` if its unit is the metre.
    fn motion_in_metres(&self) -> Option<Motion> {
        let metres = self.metres();
        if metres == 1.0 {
            return None;
        }
        let mut motion = self.motion.clone();
        motion.sheet.unit_length *= metres;
        let positions = motion.frames.iter_mut().flat_map(|f| &mut f.positions);
        positions.for_each(|position| *position *= metres);
        Some(motion)
    }

    fn solid(&self, time: f64) -> Result<Solid, RecordError> {
        let metres = self.metres();
        let mut positions = positions_at(self.motion, time);
        for position in &mut positions {
            *position *= metres;
        }
        match self.recording.thickness {
            Some(thickness) => solid(&self.motion.sheet, &positions, thickness * metres),
            None => surface_of(&self.motion.sheet, &positions),
        }
    }
}

/// The name of the file of one state, such as `state-0.5.obj`.
pub(super) fn state_name(time: f64, output: OutputChoice) -> String {
    format!("state-{time}.{}", output.name())
}
