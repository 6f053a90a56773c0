//! Bytes inside a page: arrays with a directory, deflated, as base64.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use miniz_oxide::deflate::compress_to_vec_zlib;
use serde_json::{Map, Value, json};

use super::Page;
use crate::RecordError;

/// The compression level of zlib, 0 to 10.
const EFFORT: u8 = 8;

/// The most bytes before they are deflated: browsers hold strings of half a gigabyte.
const MAX_BYTES: u64 = 1 << 28;

/// Bytes as base64 (RFC 4648, section 4).
pub(super) fn base64(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}

/// Bytes deflated (zlib, RFC 1950), as base64; the empty string if there are none.
pub(super) fn archived(bytes: &[u8]) -> String {
    if bytes.is_empty() {
        return String::new();
    }
    base64(&compress_to_vec_zlib(bytes, EFFORT))
}

/// Refuses what browsers could not hold.
pub(super) fn check_size(page: &Page<'_>, keys: usize) -> Result<(), RecordError> {
    let sheet = &page.motion.sheet;
    let positions = 12 * keys as u64 * sheet.vertices.len() as u64;
    let values = page.values.len() as u64 * page.motion.frames.len() as u64;
    let largest = [
        (
            positions + (values + 32) * sheet.faces.len() as u64,
            "raise the tolerance or leave out the values",
        ),
        (page.fold.map_or(0, |fold| fold.len() as u64), "leave out the FOLD file"),
    ];
    for (bytes, remedy) in largest {
        if bytes > MAX_BYTES {
            return Err(RecordError::FileSize { format: "HTML", bytes, limit: MAX_BYTES, remedy });
        }
    }
    Ok(())
}

/// Arrays one after another, little-endian, each starting at a multiple of four bytes.
#[derive(Debug, Default)]
pub(super) struct Payload {
    pub(super) bytes: Vec<u8>,
    directory: Map<String, Value>,
}

impl Payload {
    pub(super) fn bytes(&mut self, name: &str, values: impl IntoIterator<Item = u8>) {
        self.array(name, "Uint8", values.into_iter().map(|x| [x]));
    }

    pub(super) fn indices(&mut self, name: &str, values: impl IntoIterator<Item = u32>) {
        self.array(name, "Uint32", values.into_iter().map(u32::to_le_bytes));
    }

    pub(super) fn steps(&mut self, name: &str, values: impl IntoIterator<Item = i32>) {
        self.array(name, "Int32", values.into_iter().map(i32::to_le_bytes));
    }

    fn array<const N: usize>(
        &mut self,
        name: &str,
        kind: &str,
        values: impl Iterator<Item = [u8; N]>,
    ) {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let offset = self.bytes.len();
        self.bytes.extend(values.flatten());
        let length = (self.bytes.len() - offset) / N;
        let entry = json!({"type": kind, "offset": offset, "length": length});
        self.directory.insert(name.to_owned(), entry);
    }

    /// Type, offset and length of every array by its name.
    pub(super) fn directory(&mut self) -> Value {
        Value::Object(std::mem::take(&mut self.directory))
    }
}
