//! ParaView's collection of files over time (PVD).

use std::io::Write;

use crate::RecordError;

/// Writes a collection of the files `(time, path)`, in order of time, each path relative to the collection.
///
/// `label`: a line for people who open the file as text.
///
/// # Errors
/// [`RecordError::Write`].
pub fn pvd(
    files: &[(f64, String)],
    label: &str,
    mut writer: impl Write,
) -> Result<(), RecordError> {
    // A comment ends at two hyphens.
    let label = label.replace("--", "- -");
    writeln!(writer, "<?xml version=\"1.0\"?>\n<!-- {label} -->")?;
    writeln!(writer, "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">")?;
    writeln!(writer, "<Collection>")?;
    for (time, path) in files {
        writeln!(writer, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{path}\"/>")?;
    }
    writeln!(writer, "</Collection>\n</VTKFile>")?;
    Ok(writer.flush()?)
}
