//! `motion.pvd`, and in `vtk/` a VTP file of each frame.

use foldmotion_pattern::Frame;
use foldmotion_record::{Field, RecordError, pvd, vtp};
use rayon::prelude::*;

use super::{Quantity, Recorder, require_progress};
use crate::results::{Results, VTK, write_error};
use crate::scene::OutputChoice;
use crate::{Progress, StudyError, VERSION};

/// The name of the collection.
pub(super) const COLLECTION: &str = "motion.pvd";

/// How many frames are written between two looks at the progress.
const CHUNK: usize = 64;

impl Recorder<'_> {
    /// Writes every frame with the strain of its triangles and the bending of its facets, and the collection of all.
    pub(super) fn vtk(
        &self,
        results: &mut Results,
        progress: Progress<'_>,
    ) -> Result<(), StudyError> {
        if !self.recording.has(OutputChoice::Vtk) {
            return Ok(());
        }
        let folder = results.create_subfolder(VTK)?;
        let frames = &self.motion.frames;
        let names: Vec<String> = (1..=frames.len()).map(frame_name).collect();
        let numbered: Vec<(&Frame, &String)> = frames.iter().zip(&names).collect();
        for chunk in numbered.chunks(CHUNK) {
            chunk.par_iter().try_for_each(|(frame, name)| {
                let bytes = self.vtp(frame)?;
                std::fs::write(folder.join(name), bytes)
                    .map_err(|e| write_error(results.folder(), &format!("{VTK}/{name}"), e))
            })?;
            require_progress(progress)?;
        }
        let paths: Vec<String> = names.iter().map(|name| format!("{VTK}/{name}")).collect();
        results.add(paths.clone());
        let times = frames.iter().map(|frame| frame.time);
        let files: Vec<(f64, String)> = times.zip(paths).collect();
        let label = format!(
            "foldmotion {VERSION}; lengths in {}; motion {}",
            self.unit, self.source_info.sha256
        );
        results.write(COLLECTION, |out| pvd(&files, &label, out).map_err(StudyError::from))
    }

    /// One frame. Without rest lengths there is no strain.
    fn vtp(&self, frame: &Frame) -> Result<Vec<u8>, RecordError> {
        let (sheet, positions) = (&self.motion.sheet, &frame.positions);
        let bending = Quantity::Bending.values(sheet, positions);
        let strain = self.has_rest_lengths.then(|| Quantity::Strain.values(sheet, positions));
        let mut fields = vec![Field { name: "facet_bending_deg", values: &bending }];
        fields.extend(strain.iter().map(|values| Field { name: "strain_percent", values }));
        let mut bytes = Vec::new();
        vtp(sheet, positions, &fields, &mut bytes)?;
        Ok(bytes)
    }
}

/// The name of the file of frame `number`, counted from 1.
fn frame_name(number: usize) -> String {
    format!("{number:04}.vtp")
}
