//! The binary part of a GLB file and its container.

use glam::Vec3;
use serde_json::{Value, json};

/// f32.
const FLOAT: u32 = 5126;

/// u32.
const UNSIGNED: u32 = 5125;

/// Numbers one after the other, with the accessors that find them.
#[derive(Debug, Default)]
pub(crate) struct Buffer {
    pub(crate) bytes: Vec<u8>,
    pub(crate) views: Vec<Value>,
    pub(crate) accessors: Vec<Value>,
}

impl Buffer {
    /// The accessor of vectors of corners, with their bounds.
    pub(crate) fn vectors(&mut self, vectors: &[Vec3]) -> usize {
        let low = vectors.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = vectors.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let bytes = vectors.iter().flat_map(Vec3::to_array);
        let view = self.view(bytes.flat_map(f32::to_le_bytes), Some(34_962));
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": "VEC3",
            "min": low.to_array(), "max": high.to_array(),
        }))
    }

    /// The accessor of corners of triangles.
    pub(crate) fn indices(&mut self, indices: &[u32]) -> usize {
        let view = self.view(indices.iter().flat_map(|i| i.to_le_bytes()), Some(34_963));
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED, "count": indices.len(), "type": "SCALAR",
        }))
    }

    /// The accessor of numbers of an animation, of rising ones with their bounds.
    pub(crate) fn scalars(&mut self, numbers: &[f32], is_rising: bool) -> usize {
        let view = self.view(numbers.iter().flat_map(|x| x.to_le_bytes()), None);
        let mut accessor = json!({
            "bufferView": view, "componentType": FLOAT, "count": numbers.len(), "type": "SCALAR",
        });
        if let (true, Some(first), Some(last)) = (is_rising, numbers.first(), numbers.last()) {
            accessor["min"] = json!([first]);
            accessor["max"] = json!([last]);
        }
        self.accessor(accessor)
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(bytes);
        let length = self.bytes.len() - offset;
        let mut view = json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// A GLB file of `document` and `buffer`, whose length is a multiple of four.
pub(crate) fn container(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + 8 + buffer.len();
    let mut file = Vec::with_capacity(length);
    let word = |file: &mut Vec<u8>, value: usize| file.extend((value as u32).to_le_bytes());
    file.extend(b"glTF");
    word(&mut file, 2);
    word(&mut file, length);
    for (kind, chunk) in [(b"JSON", text.as_slice()), (b"BIN\0", buffer)] {
        word(&mut file, chunk.len());
        file.extend(kind);
        file.extend(chunk);
    }
    file
}
