//! The frames of a FOLD file that ask for fold angles.

use std::f64::consts::PI;

use super::super::imported::RECORDED_STAGES;
use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, ImportedPattern, MOST_STAGE_ANGLES, PatternStage, Source};
use super::FoldPattern;
use super::edges::{check_angles, check_count};
use super::frames::Frames;

/// A stage for every frame with angles of its own, after those that the file of a recorded motion lists.
pub(super) fn stages(
    frames: &Frames,
    pattern: &FoldPattern<'_>,
    imported: &ImportedPattern,
    warnings: &mut Warnings,
) -> Result<Vec<PatternStage>, ImportError> {
    let edges = &imported.sheet.edges;
    let mut stages = Vec::new();
    let angle_of = |given: &[Option<f64>], edge: &crate::Edge, source: &Option<u32>| {
        let is_hinge = edge.is_crease() && edge.is_hinge();
        let Source::FoldEdge(listed) = imported.sources[source.filter(|_| is_hinge)? as usize]
        else {
            return None;
        };
        given[listed as usize].map(|degrees| degrees * (PI / 180.0))
    };
    let angles_of = |given: &[Option<f64>]| -> Vec<Option<f64>> {
        let edges = edges.iter().zip(&imported.edge_sources);
        edges.map(|(edge, source)| angle_of(given, edge, source)).collect()
    };
    for (index, given) in recorded_stages(frames, pattern)?.iter().enumerate() {
        stages.push(PatternStage { frame: index as u32, title: None, angles: angles_of(given) });
    }
    for (number, reason) in frames.not_stages(pattern.frame) {
        warnings.add(reason, &Source::FoldFrame(number as u32 - 1));
    }
    for (number, frame) in frames.stages(pattern.frame) {
        let index = number as u32 - 1;
        let own_edges = frames.edges(number).unwrap_or(&[]);
        if own_edges != pattern.edges {
            warnings.add(WarningKind::OtherFrame, &Source::FoldFrame(index));
            continue;
        }
        let found = (stages.len() + 1) * edges.len();
        if found > MOST_STAGE_ANGLES {
            return Err(ImportError::TooMany {
                what: "fold angles of stages",
                found,
                limit: MOST_STAGE_ANGLES,
            });
        }
        let given = frame.angles.as_deref().unwrap_or(&[]);
        let key = format!("file_frames[{index}].edges_foldAngle");
        check_count(&key, Some(given.len()), pattern.edges.len())?;
        check_angles(&key, given)?;
        stages.push(PatternStage {
            frame: index,
            title: frame.frame_title.clone(),
            angles: angles_of(given),
        });
    }
    Ok(stages)
}

/// The fold angles of the stages of a recorded motion, one list for each, degrees.
fn recorded_stages(
    frames: &Frames,
    pattern: &FoldPattern<'_>,
) -> Result<Vec<Vec<Option<f64>>>, ImportError> {
    let Some(listed) = frames.keys().get(RECORDED_STAGES) else {
        return Ok(Vec::new());
    };
    let stages: Vec<Vec<Option<f64>>> = serde_json::from_value(listed.clone())
        .map_err(|error| ImportError::RecordedStages { message: error.to_string() })?;
    for given in &stages {
        check_count(RECORDED_STAGES, Some(given.len()), pattern.edges.len())?;
        check_angles(RECORDED_STAGES, given)?;
    }
    Ok(stages)
}
