//! The frames of a FOLD file that ask for fold angles.

use std::f64::consts::PI;

use super::super::warning::{WarningKind, Warnings};
use super::super::{ImportError, ImportedPattern, MOST_STAGE_ANGLES, PatternStage, Source};
use super::FoldPattern;
use super::edges::{check_angles, check_count};
use super::frames::Frames;

/// A stage for every frame with angles of its own.
pub(super) fn stages(
    frames: &Frames,
    pattern: &FoldPattern<'_>,
    imported: &ImportedPattern,
    warnings: &mut Warnings,
) -> Result<Vec<PatternStage>, ImportError> {
    let edges = &imported.sheet.edges;
    let mut stages = Vec::new();
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
        let angle = |(edge, source): (&crate::Edge, &Option<u32>)| {
            let is_hinge = edge.is_crease() && edge.is_hinge();
            let Source::FoldEdge(listed) = imported.sources[source.filter(|_| is_hinge)? as usize]
            else {
                return None;
            };
            given[listed as usize].map(|degrees| degrees * (PI / 180.0))
        };
        stages.push(PatternStage {
            frame: index,
            title: frame.frame_title.clone(),
            angles: edges.iter().zip(&imported.edge_sources).map(angle).collect(),
        });
    }
    Ok(stages)
}
