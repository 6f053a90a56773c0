//! The motion as glTF 2.0 binary (Khronos 2021, glTF 2.0 Specification, revision 2.0.1), for viewers and programs
//! that show things in space.
//!
//! Every triangle has corners of its own, so that facets look flat. The front and the back are two primitives of
//! opposite winding, each seen from its own side; creases and border are lines in a mesh of their own. The motion is
//! one morph target a key frame after the first, whose weights run straight from key to key: so positions are exactly
//! the straight paths between key frames, see [`crate::key_frames()`].

use std::io::Write;

use foldmotion_pattern::{Assignment, Motion};
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

use crate::glb_buffer::{Buffer, container};
use crate::shade::linear;
use crate::{KeyFrames, RecordError, Style, key_frames};

/// The most morph targets: Filament takes 256, and WebGL 2 grants 256 layers of a texture, in which three.js and
/// Babylon.js keep them.
pub const MAX_TARGETS: usize = 255;

/// The largest file.
const MAX_BYTES: u64 = 1 << 30;

/// The options of a GLB file.
#[derive(Debug, Clone, PartialEq)]
pub struct GlbOptions {
    /// How far a vertex may be from the motion, in the sheet's `unit_length`.
    pub tolerance: f64,
    /// Seconds for deployed → planar and for planar → compact.
    pub seconds: [f64; 2],
    /// Whether triangles carry normals that morph too. Without them files are a third as large, and viewers find the
    /// normals themselves: three.js at every state, others only at the first.
    pub has_normals: bool,
    /// Colours of sides and lines.
    pub style: Style,
    /// The name shown.
    pub title: String,
    /// The scene and the program that made the motion.
    pub provenance: String,
}

impl Default for GlbOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            seconds: [3.0, 5.0],
            has_normals: true,
            style: Style::default(),
            title: "folding motion".to_owned(),
            provenance: String::new(),
        }
    }
}

/// Writes `motion` as GLB, in metres and with y up as glTF requires, and returns which frames it holds and how
/// accurately.
///
/// glTF asks viewers for no more than 8 attributes that morph at once. Here at most two targets have weight at a time,
/// but a viewer must hold them all: those that keep targets in textures do (three.js also needs a uniform each, of
/// which graphics cards have a thousand and WebGL 2 grants 256); engines of 8 or 60 targets show such a file wrongly or
/// not at all, and need a larger tolerance. The error of f32 (about 1e-7 of the sheet's size) comes on top of the
/// tolerance. Viewers know no order of layers: those that coincide flicker.
///
/// # Errors
/// Those of [`key_frames()`], [`RecordError::NotPositive`], [`RecordError::Targets`], [`RecordError::FileSize`] before
/// anything is written, then [`RecordError::Write`].
pub fn glb(
    motion: &Motion,
    options: &GlbOptions,
    mut writer: impl Write,
) -> Result<KeyFrames, RecordError> {
    for (name, value) in [("seconds[0]", options.seconds[0]), ("seconds[1]", options.seconds[1])] {
        if !(value.is_finite() && value > 0.0) {
            return Err(RecordError::NotPositive { name, value });
        }
    }
    let keys = key_frames(motion, options.tolerance * motion.sheet.unit_length)?;
    let targets = keys.frames.len() - 1;
    if targets > MAX_TARGETS {
        return Err(RecordError::Targets {
            needed: targets,
            limit: MAX_TARGETS,
            tolerance: options.tolerance,
        });
    }
    check_size(motion, options, keys.frames.len())?;
    let mut scene = Model { motion, options, keys: &keys, buffer: Buffer::default() };
    let document = scene.document();
    writer.write_all(&container(&document, &scene.buffer.bytes))?;
    writer.flush()?;
    Ok(keys)
}

fn check_size(motion: &Motion, options: &GlbOptions, keys: usize) -> Result<(), RecordError> {
    let vectors = if options.has_normals { 3 } else { 1 };
    let corners = 3 * vectors * motion.sheet.faces.len() + 2 * motion.sheet.edges.len();
    let bytes = 12 * (corners as u64) * keys as u64;
    if bytes <= MAX_BYTES {
        return Ok(());
    }
    Err(RecordError::FileSize {
        format: "GLB",
        bytes,
        limit: MAX_BYTES,
        remedy: "raise the tolerance or leave out the normals",
    })
}

/// The file while it is put together.
struct Model<'a> {
    motion: &'a Motion,
    options: &'a GlbOptions,
    keys: &'a KeyFrames,
    buffer: Buffer,
}

impl Model<'_> {
    fn document(&mut self) -> Value {
        let style = &self.options.style;
        let colours = [style.front, style.back, style.mountain, style.valley, style.border];
        let names = ["front", "back", "mountain", "valley", "border"];
        let materials: Vec<Value> = names.iter().zip(colours).map(material).collect();
        let sides = [0, 1].map(|side| self.side(side));
        let lines = [Assignment::Mountain, Assignment::Valley, Assignment::Border];
        let lines: Vec<Value> = lines
            .iter()
            .zip(2..)
            .filter_map(|(&kind, material)| self.lines(kind, material))
            .collect();
        let mut meshes = vec![json!({"name": "paper", "primitives": sides})];
        if !lines.is_empty() {
            meshes.push(json!({"name": "creases", "primitives": lines}));
        }
        let mut nodes = vec![json!({
            "name": self.options.title,
            // z up becomes y up.
            "rotation": [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2],
            "children": (1..=meshes.len()).collect::<Vec<_>>(),
        })];
        nodes.extend((0..meshes.len()).map(|mesh| json!({"mesh": mesh})));
        let animations = self.animation(meshes.len());
        let mut document = json!({
            "asset": self.asset(),
            "scene": 0,
            "scenes": [{"name": self.options.title, "nodes": [0]}],
            "nodes": nodes,
            "meshes": meshes,
            "materials": materials,
            "accessors": self.buffer.accessors,
            "bufferViews": self.buffer.views,
            "buffers": [{"byteLength": self.buffer.bytes.len()}],
        });
        if let Some(animation) = animations {
            document["animations"] = json!([animation]);
        }
        document
    }

    fn asset(&self) -> Value {
        json!({
            "version": "2.0",
            "generator": concat!("foldmotion ", env!("CARGO_PKG_VERSION")),
            "extras": {
                "title": self.options.title,
                "version": env!("CARGO_PKG_VERSION"),
                "provenance": self.options.provenance,
                "unit": "m",
                "largestError": self.keys.error,
            },
        })
    }

    /// The positions of the key frames.
    fn states(&self) -> impl Iterator<Item = &[DVec3]> {
        let frames = &self.motion.frames;
        self.keys.frames.iter().map(|&i| frames[i].positions.as_slice())
    }

    /// The triangles seen from the front (0) or from the back (1).
    fn side(&mut self, side: usize) -> Value {
        let faces = &self.motion.sheet.faces;
        let corners = |state: &[DVec3]| -> Vec<Vec3> {
            let points = faces.as_flattened().iter();
            points.map(|&v| state[v as usize].as_vec3()).collect()
        };
        let normals = |state: &[DVec3]| -> Vec<Vec3> {
            let normal = |face: &[u32; 3]| {
                let [a, b, c] = face.map(|v| state[v as usize]);
                let across = (b - a).cross(c - a).normalize_or(DVec3::Z).as_vec3();
                [if side == 0 { across } else { -across }; 3]
            };
            faces.iter().flat_map(normal).collect()
        };
        let positions: Vec<_> = self.states().map(corners).collect();
        let normals: Option<Vec<_>> =
            (self.options.has_normals).then(|| self.states().map(normals).collect());
        let count = 3 * faces.len() as u32;
        let order =
            (0..count).map(|i| if side == 1 && i % 3 > 0 { i - i % 3 + 3 - i % 3 } else { i });
        let indices = self.buffer.indices(&order.collect::<Vec<_>>());
        self.primitive(&positions, normals.as_deref(), side, 4, Some(indices))
    }

    /// The lines of one kind, `None` if the sheet has none.
    fn lines(&mut self, kind: Assignment, material: usize) -> Option<Value> {
        let edges = self.motion.sheet.edges.iter();
        let chosen = edges.filter(|edge| edge.assignment == kind);
        let ends: Vec<u32> = chosen.flat_map(|edge| edge.vertices).collect();
        if ends.is_empty() {
            return None;
        }
        let points = |state: &[DVec3]| -> Vec<Vec3> {
            ends.iter().map(|&v| state[v as usize].as_vec3()).collect()
        };
        let positions: Vec<_> = self.states().map(points).collect();
        Some(self.primitive(&positions, None, material, 1, None))
    }

    /// A primitive whose targets are the states after the first, as differences to it.
    fn primitive(
        &mut self,
        positions: &[Vec<Vec3>],
        normals: Option<&[Vec<Vec3>]>,
        material: usize,
        mode: u32,
        indices: Option<usize>,
    ) -> Value {
        let change = |states: &[Vec<Vec3>], k: usize| -> Vec<Vec3> {
            let pairs = states[k].iter().zip(&states[0]);
            pairs.map(|(&now, &first)| now - first).collect()
        };
        let mut attributes = json!({"POSITION": self.buffer.vectors(&positions[0])});
        if let Some([first, ..]) = normals {
            attributes["NORMAL"] = json!(self.buffer.vectors(first));
        }
        let mut targets = Vec::new();
        for k in 1..positions.len() {
            let mut target = json!({"POSITION": self.buffer.vectors(&change(positions, k))});
            if let Some(normals) = normals {
                target["NORMAL"] = json!(self.buffer.vectors(&change(normals, k)));
            }
            targets.push(target);
        }
        let mut primitive = json!({"attributes": attributes, "material": material, "mode": mode});
        if let Some(indices) = indices {
            primitive["indices"] = json!(indices);
        }
        if !targets.is_empty() {
            primitive["targets"] = json!(targets);
        }
        primitive
    }

    /// The weights of all meshes: target k alone at key frame k + 1, none at the first.
    fn animation(&mut self, meshes: usize) -> Option<Value> {
        let count = self.keys.frames.len();
        if count < 2 {
            return None;
        }
        let [unfold, fold] = self.options.seconds;
        let seconds = |time: f64| time.min(1.0) * unfold + (time - 1.0).max(0.0) * fold;
        let times = self.keys.frames.iter().map(|&i| seconds(self.motion.frames[i].time));
        let times: Vec<f64> = times.collect();
        let times: Vec<f32> = times.iter().map(|s| (s - times[0]) as f32).collect();
        let weight = |key: usize, target: usize| f32::from(u8::from(key == target + 1));
        let rows = (0..count).flat_map(|key| (0..count - 1).map(move |t| weight(key, t)));
        let weights: Vec<f32> = rows.collect();
        let (input, output) =
            (self.buffer.scalars(&times, true), self.buffer.scalars(&weights, false));
        let channel =
            |node: usize| json!({"sampler": 0, "target": {"node": node, "path": "weights"}});
        Some(json!({
            "name": "fold",
            "samplers": [{"input": input, "output": output, "interpolation": "LINEAR"}],
            "channels": (1..=meshes).map(channel).collect::<Vec<_>>(),
        }))
    }
}

fn material((name, colour): (&&str, [u8; 3])) -> Value {
    let [r, g, b] = linear(colour).to_array();
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.9,
        },
    })
}
