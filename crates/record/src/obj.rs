//! Wavefront OBJ.

use std::io::Write;

use crate::{RecordError, Solid};

/// Writes `solid` as OBJ in metres, with `provenance` as comment lines.
///
/// Numbers read back as the f64 they were. Triangles have no normals: programs shade them flat.
///
/// # Errors
/// [`RecordError::Write`].
pub fn obj(solid: &Solid, provenance: &str, mut writer: impl Write) -> Result<(), RecordError> {
    for line in provenance.lines() {
        writeln!(writer, "# {line}")?;
    }
    writeln!(writer, "# unit: metre")?;
    writeln!(writer, "o sheet")?;
    for vertex in &solid.vertices {
        writeln!(writer, "v {} {} {}", vertex.x, vertex.y, vertex.z)?;
    }
    for face in &solid.faces {
        let [a, b, c] = face.map(|v| v + 1);
        writeln!(writer, "f {a} {b} {c}")?;
    }
    Ok(writer.flush()?)
}
