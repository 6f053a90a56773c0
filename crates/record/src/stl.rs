//! Binary STL.

use std::io::Write;

use crate::{RecordError, Solid};

/// The bytes of the header.
const HEADER: usize = 80;

/// The bytes of a triangle.
const TRIANGLE: u64 = 50;

/// The largest file.
const MAX_BYTES: u64 = 1 << 31;

/// Writes `solid` as binary STL, metres as f32; triangles that have no area are written with a zero normal.
///
/// `label`: ASCII for the header, such as the hash of the scene; it is cut at 80 bytes, and other characters become
/// `?`. A label that starts with "solid" would be taken for a text file and gets a leading space.
///
/// # Errors
/// [`RecordError::FileSize`], [`RecordError::Write`].
pub fn stl(solid: &Solid, label: &str, mut writer: impl Write) -> Result<(), RecordError> {
    let bytes = HEADER as u64 + 4 + TRIANGLE * solid.faces.len() as u64;
    if bytes > MAX_BYTES {
        return Err(RecordError::FileSize {
            format: "STL",
            bytes,
            limit: MAX_BYTES,
            remedy: "make the sheet smaller",
        });
    }
    let space = if label.starts_with("solid") { " " } else { "" };
    let printable = |c: char| {
        if matches!(c, ' '..='~') { c as u8 } else { b'?' }
    };
    let mut header: Vec<u8> = space.chars().chain(label.chars()).map(printable).collect();
    header.resize(HEADER, 0);
    writer.write_all(&header)?;
    writer.write_all(&(solid.faces.len() as u32).to_le_bytes())?;
    for &face in &solid.faces {
        let corners = face.map(|v| solid.vertices[v as usize]);
        for point in [solid.normal(face)].into_iter().chain(corners) {
            for value in point.as_vec3().to_array() {
                writer.write_all(&value.to_le_bytes())?;
            }
        }
        writer.write_all(&[0, 0])?;
    }
    Ok(writer.flush()?)
}
