//! VTK's XML format of polygons (VTP): one state with its values.

use std::io::{self, Write};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use foldmotion_pattern::Sheet;
use glam::DVec3;

use crate::RecordError;

/// A value of each triangle.
#[derive(Debug, Clone, Copy)]
pub struct Field<'a> {
    /// The name that programs show, letters, digits and underscores.
    pub name: &'static str,
    /// One value for each triangle.
    pub values: &'a [f64],
}

/// Writes the sheet with its vertices at `positions` as VTP: points in f64, triangles, the facet of each triangle, and `fields`.
///
/// Arrays are binary, as base64, little-endian, each after its length as a 64-bit number.
///
/// # Errors
/// [`RecordError::Write`].
pub fn vtp(
    sheet: &Sheet,
    positions: &[DVec3],
    fields: &[Field<'_>],
    mut writer: impl Write,
) -> Result<(), RecordError> {
    let (points, faces) = (positions.len(), sheet.faces.len());
    writeln!(
        writer,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PolyData>\n<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{faces}\">\n<Points>"
    )?;
    let coordinates = positions.iter().flat_map(DVec3::to_array).flat_map(f64::to_le_bytes);
    array(&mut writer, "Float64", "Points", 3, coordinates)?;
    writeln!(writer, "</Points>\n<Polys>")?;
    let corners = sheet.faces.iter().flatten().map(|&vertex| i64::from(vertex));
    array(&mut writer, "Int64", "connectivity", 1, corners.flat_map(i64::to_le_bytes))?;
    let ends = (1..=faces as u64).map(|face| 3 * face);
    array(&mut writer, "Int64", "offsets", 1, ends.flat_map(u64::to_le_bytes))?;
    writeln!(writer, "</Polys>\n<CellData>")?;
    let facets = sheet.face_facets.iter().copied().flat_map(u32::to_le_bytes);
    array(&mut writer, "UInt32", "facet", 1, facets)?;
    for Field { name, values } in fields {
        let values = values.iter().copied().flat_map(f64::to_le_bytes);
        array(&mut writer, "Float64", name, 1, values)?;
    }
    writeln!(writer, "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>")?;
    Ok(writer.flush()?)
}

/// Writes one array.
fn array(
    writer: &mut impl Write,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = u8>,
) -> io::Result<()> {
    let mut bytes = vec![0; 8];
    bytes.extend(values);
    let length = (bytes.len() - 8) as u64;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    let text = STANDARD.encode(bytes);
    writeln!(
        writer,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{text}</DataArray>"
    )
}

#[cfg(test)]
mod tests {
    use foldmotion_pattern::{Case, Unit, UnitSheet};

    use super::*;

    /// The bytes of the array `name`, decoded by hand of the format's description.
    fn decoded(text: &str, name: &str) -> Vec<u8> {
        let after = text.split_once(&format!("Name=\"{name}\"")).unwrap().1;
        let content = after.split_once('>').unwrap().1.split_once('<').unwrap().0;
        let bytes = STANDARD.decode(content).unwrap();
        let (length, values) = bytes.split_first_chunk::<8>().unwrap();
        assert_eq!(u64::from_le_bytes(*length), values.len() as u64);
        values.to_vec()
    }

    #[test]
    fn every_number_reads_back_as_it_was() {
        let unit = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None).unwrap();
        let sheet = UnitSheet::new(unit, 2, 1).unwrap().sheet;
        let positions: Vec<DVec3> = sheet.planar().iter().map(|p| *p / 3.0).collect();
        let values: Vec<f64> = (0..sheet.faces.len()).map(|face| 0.1 * face as f64).collect();
        let mut out = Vec::new();
        vtp(&sheet, &positions, &[Field { name: "strain", values: &values }], &mut out).unwrap();
        let text = String::from_utf8(out).unwrap();
        let floats = |name| -> Vec<f64> {
            let chunks = decoded(&text, name);
            chunks.chunks_exact(8).map(|c| f64::from_le_bytes(c.try_into().unwrap())).collect()
        };
        assert_eq!(floats("strain"), values);
        let coordinates: Vec<f64> = positions.iter().flat_map(DVec3::to_array).collect();
        assert_eq!(floats("Points"), coordinates);
        let whole = |name| -> Vec<u64> {
            let chunks = decoded(&text, name);
            chunks.chunks_exact(8).map(|c| u64::from_le_bytes(c.try_into().unwrap())).collect()
        };
        let corners: Vec<u64> = sheet.faces.iter().flatten().map(|&v| v.into()).collect();
        assert_eq!(whole("connectivity"), corners);
        assert_eq!(whole("offsets").last(), Some(&(3 * sheet.faces.len() as u64)));
    }
}
