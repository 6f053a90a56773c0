//! `[motion]`: engine, frames and the steps of the schedule.

use foldmotion_solver::{ScheduleStep, SolverError};

use super::input::Input;
use crate::StudyError;
use crate::scene::{EngineChoice, StepScene};

/// The largest number of frames, which keeps the file of a small sheet below some gigabytes.
const MOST_FRAMES: usize = 100_000;

pub(crate) fn engine(input: &Input<'_>) -> EngineChoice {
    input.scene.motion.engine.unwrap_or(EngineChoice::QuasiStatic)
}

pub(crate) fn frames(input: &Input<'_>) -> Result<usize, StudyError> {
    let frames = input.scene.motion.frames.unwrap_or(240);
    usize::try_from(frames)
        .ok()
        .filter(|n| n.is_multiple_of(2) && (2..=MOST_FRAMES).contains(n))
        .ok_or_else(|| {
            let message = format!("must be an even number between 2 and {MOST_FRAMES}");
            input.error("motion.frames", message)
        })
}

/// Refuses steps of a sheet of units that name creases as those of a pattern from a file are named.
pub(crate) fn refuse_crease_names(input: &Input<'_>) -> Result<(), StudyError> {
    for (index, step) in input.scene.motion.step.iter().enumerate() {
        let given = [
            ("ids", step.ids.is_some()),
            ("classes", step.classes.is_some()),
            ("edges", step.edges.is_some()),
        ];
        if let Some((key, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
            let message = "names creases of a pattern from a file; a sheet of units has creases, rows and columns";
            return Err(input.error(&format!("motion.step.{index}.{key}"), message));
        }
    }
    Ok(())
}

pub(crate) fn steps(input: &Input<'_>) -> Result<Vec<ScheduleStep>, StudyError> {
    let step = |(index, step): (usize, &StepScene)| {
        let range = |key: &str, range: &Option<Vec<i64>>| match range.as_deref() {
            None => Ok(None),
            Some(&[one]) => index_range(input, index, key, [one, one]),
            Some(&[first, last]) => index_range(input, index, key, [first, last]),
            Some(_) => {
                let message = "must be [first, last], both included, or [index]";
                Err(input.error(&format!("motion.step.{index}.{key}"), message))
            }
        };
        Ok(ScheduleStep {
            stage: step.stage,
            creases: step.creases.unwrap_or_default(),
            rows: range("rows", &step.rows)?,
            columns: range("columns", &step.columns)?,
            from: step.from.unwrap_or(0.0),
            to: step.to.unwrap_or(1.0),
            ease: step.ease.unwrap_or_default(),
        })
    };
    input.scene.motion.step.iter().enumerate().map(step).collect()
}

fn index_range(
    input: &Input<'_>,
    index: usize,
    key: &str,
    range: [i64; 2],
) -> Result<Option<[u32; 2]>, StudyError> {
    match range.map(u32::try_from) {
        [Ok(first), Ok(last)] => Ok(Some([first, last])),
        _ => Err(input.error(&format!("motion.step.{index}.{key}"), "counts from 0")),
    }
}

pub(crate) fn schedule_error(input: &Input<'_>, error: SolverError) -> StudyError {
    let key = match &error {
        SolverError::StepTime { step, name, .. } => format!("motion.step.{step}.{name}"),
        SolverError::StepDuration { step, .. } => format!("motion.step.{step}.to"),
        SolverError::StepRange { step, what, .. } => format!("motion.step.{step}.{what}"),
        SolverError::StepNamesNone { step } => format!("motion.step.{step}"),
        SolverError::StepsOverlap { steps, .. } => format!("motion.step.{}", steps[1]),
        _ => return StudyError::Solver(error),
    };
    input.error(&key, error.to_string())
}
