//! The crease pattern as FOLD 1.2.

use super::{CutError, CutOptions};
use crate::Sheet;
use crate::fold::{CreasePattern, object_text};

/// The crease pattern alone, as FOLD 1.2 in mm: vertices in the sheet's own axes, edges with assignment and target
/// fold angle (degrees, null on the border), faces.
///
/// The faces are the facets, unless `options.draws_facets`: then they are the triangles, joined by F edges.
/// `target_angles` as in [`super::CutPattern::new`].
///
/// # Errors
/// [`CutError`]: options out of range.
pub fn crease_pattern_fold(
    sheet: &Sheet,
    target_angles: &[f64],
    options: &CutOptions,
    creator: &str,
) -> Result<String, CutError> {
    options.check()?;
    let pattern = CreasePattern {
        sheet,
        target_angles,
        title: &options.title,
        creator,
        description: Some(&options.note),
        file_classes: &["singleModel"],
        unit: "mm",
        scale: options.scale,
        has_triangles: options.draws_facets,
    };
    let keys = pattern.keys();
    Ok(object_text(keys.iter().map(|(key, value)| (*key, value))))
}
