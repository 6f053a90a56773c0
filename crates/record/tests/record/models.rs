//! 3D files read back.

use std::collections::BTreeMap;

use crate::common::*;
use foldmotion_pattern::{Assignment, Case, Frame, LayerOrder, Motion, Unit, UnitSheet};
use foldmotion_record::{
    GlbOptions, RecordError, Solid, glb, obj, positions_at, solid, stl, surface_of,
};
use glam::{DVec3, Vec3};
use gltf::animation::util::ReadOutputs;

fn tower() -> UnitSheet {
    let unit = Unit::new(Case::S, 1.6, 1.0, None, None).unwrap();
    UnitSheet::new(unit, 3, 2).unwrap()
}

fn written(motion: &Motion, options: &GlbOptions) -> gltf::Gltf {
    let mut bytes = Vec::new();
    glb(motion, options, &mut bytes).unwrap();
    gltf::Gltf::from_slice(&bytes).unwrap()
}

/// The positions of a primitive at `seconds`, as a viewer mixes its targets.
fn shown(file: &gltf::Gltf, primitive: &gltf::Primitive<'_>, seconds: f32) -> Vec<Vec3> {
    let reader = primitive.reader(|_| file.blob.as_deref());
    let mut points: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
    let animation = file.animations().next().unwrap();
    let channel = animation.channels().next().unwrap();
    let channel = channel.reader(|_| file.blob.as_deref());
    let times: Vec<f32> = channel.read_inputs().unwrap().collect();
    let Some(ReadOutputs::MorphTargetWeights(weights)) = channel.read_outputs() else {
        panic!("the animation moves weights");
    };
    let weights: Vec<f32> = weights.into_f32().collect();
    let count = times.len() - 1;
    let next = times.partition_point(|&t| t < seconds).clamp(1, count);
    let part = (seconds - times[next - 1]) / (times[next] - times[next - 1]);
    for (k, (target, _, _)) in reader.read_morph_targets().enumerate() {
        let [a, b] = [next - 1, next].map(|row| weights[row * count + k]);
        let weight = a + (b - a) * part;
        for (point, change) in points.iter_mut().zip(target.unwrap()) {
            *point += weight * Vec3::from(change);
        }
    }
    points
}

#[test]
fn a_glb_shows_every_frame_of_the_motion_within_its_tolerance_on_both_sides_and_lines() {
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 20.0).collect();
    let motion = folding_square(&times);
    let options = GlbOptions { provenance: "a square".to_owned(), ..GlbOptions::default() };
    let file = written(&motion, &options);
    let meshes: Vec<_> = file.meshes().collect();
    let sides: Vec<_> = meshes[0].primitives().collect();
    let lines: Vec<_> = meshes[1].primitives().collect();
    assert_eq!((sides.len(), lines.len()), (2, 2), "two sides, valley and border");
    let edges = &motion.sheet.edges;
    let ends_of = |kind: Assignment| -> Vec<u32> {
        let chosen = edges.iter().filter(|edge| edge.assignment == kind);
        chosen.flat_map(|edge| edge.vertices).collect()
    };
    let corners: Vec<u32> = motion.sheet.faces.as_flattened().to_vec();
    let parts = [
        (&sides[0], corners.clone()),
        (&sides[1], corners),
        (&lines[0], ends_of(Assignment::Valley)),
        (&lines[1], ends_of(Assignment::Border)),
    ];
    for (primitive, vertices) in parts {
        for &time in &times {
            let seconds = time.min(1.0) * 3.0 + (time - 1.0).max(0.0) * 5.0;
            let found = shown(&file, primitive, seconds as f32);
            let expected = positions_at(&motion, time);
            assert_eq!(found.len(), vertices.len());
            for (point, &vertex) in found.iter().zip(&vertices) {
                let distance = point.as_dvec3().distance(expected[vertex as usize]);
                assert!(distance < 1e-3 + 1e-5, "{time}: {distance}");
            }
        }
    }
    let targets = |p: &gltf::Primitive<'_>| p.morph_targets().count();
    assert!((2..40).contains(&targets(&sides[0])), "{}", targets(&sides[0]));
    let extras = file.document.as_json().asset.extras.as_ref().unwrap();
    assert!(extras.get().contains("a square"));
}

#[test]
fn the_back_of_a_glb_turns_its_triangles_and_normals_over() {
    let motion = folding_square(&[0.0, 1.0]);
    let file = written(&motion, &GlbOptions::default());
    let mesh = file.meshes().next().unwrap();
    for (primitive, sign) in mesh.primitives().zip([1.0, -1.0]) {
        let reader = primitive.reader(|_| file.blob.as_deref());
        let points: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
        let normals: Vec<Vec3> = reader.read_normals().unwrap().map(Vec3::from).collect();
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        for triangle in indices.chunks(3) {
            let [a, b, c] = [0, 1, 2].map(|i| points[triangle[i] as usize]);
            let across = (b - a).cross(c - a).normalize();
            assert!((across - sign * Vec3::Z).length() < 1e-6);
            assert!((normals[triangle[0] as usize] - across).length() < 1e-6);
        }
    }
}

#[test]
fn a_motion_of_more_targets_than_viewers_take_is_refused_and_a_still_one_is_written() {
    let mut motion = folding_square(&(0..400).map(f64::from).collect::<Vec<_>>());
    for frame in motion.frames.iter_mut().step_by(2) {
        frame.positions[0].z = 1.0;
    }
    let mut bytes = Vec::new();
    let error = glb(&motion, &GlbOptions::default(), &mut bytes).unwrap_err();
    assert!(matches!(error, RecordError::Targets { needed: 399, .. }), "{error}");
    assert!(bytes.is_empty());
    motion.frames.truncate(1);
    assert_eq!(written(&motion, &GlbOptions::default()).animations().count(), 0);
    let no_time = GlbOptions { seconds: [0.0, 1.0], ..GlbOptions::default() };
    let error = glb(&motion, &no_time, &mut bytes).unwrap_err();
    assert!(matches!(error, RecordError::NotPositive { .. }), "{error}");
}

/// How often each directed edge occurs, and how often its opposite.
fn is_closed(solid: &Solid) -> bool {
    let mut counts: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    for face in &solid.faces {
        for i in 0..3 {
            *counts.entry([face[i], face[(i + 1) % 3]]).or_default() += 1;
        }
    }
    let opposite = |[a, b]: &[u32; 2]| counts.get(&[*b, *a]) == Some(&1);
    counts.iter().all(|(edge, &count)| count == 1 && opposite(edge))
}

#[test]
fn a_thick_sheet_is_closed_outward_and_holds_area_times_thickness() {
    let units = tower();
    let area: f64 = (units.sheet.faces.iter())
        .map(|face| {
            let [a, b, c] = face.map(|v| units.sheet.vertices[v as usize]);
            0.5 * (b - a).perp_dot(c - a)
        })
        .sum();
    for positions in [units.sheet.planar(), units.compact()] {
        let thick = solid(&units.sheet, &positions, 0.01).unwrap();
        assert!(is_closed(&thick));
        assert!((thick.volume() - 0.01 * area).abs() < 1e-9 * area, "{}", thick.volume());
    }
    let thin = surface_of(&units.sheet, &units.sheet.planar()).unwrap();
    assert!(!is_closed(&thin), "a surface has a border");
    let mut hollow = solid(&units.sheet, &units.sheet.planar(), 0.01).unwrap();
    hollow.faces[0].swap(0, 1);
    assert!(!is_closed(&hollow), "a triangle turned over is found");
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(solid(&units.sheet, &units.sheet.planar(), thickness).is_err());
    }
}

#[test]
fn stl_and_obj_read_back_as_the_triangles_they_were() {
    let units = tower();
    let thick = solid(&units.sheet, &units.compact(), 0.02).unwrap();
    let mut bytes = Vec::new();
    stl(&thick, "solid 0123", &mut bytes).unwrap();
    assert_eq!(&bytes[..11], b" solid 0123");
    assert_eq!(bytes.len(), 84 + 50 * thick.faces.len());
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let vector = |at: usize| Vec3::new(float(at), float(at + 4), float(at + 8));
    for (index, &face) in thick.faces.iter().enumerate() {
        let at = 84 + 50 * index;
        let corners = [1, 2, 3].map(|k| vector(at + 12 * k));
        assert_eq!(corners, face.map(|v| thick.vertices[v as usize].as_vec3()));
        let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        assert!(vector(at).dot(across.normalize()) > 0.999);
    }
    let mut bytes = Vec::new();
    obj(&thick, "scene\nhash", &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.starts_with("# scene\n# hash\n"));
    let numbers = |kind: &str| -> Vec<f64> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(kind));
        lines.flat_map(|line| line.split(' ').map(|n| n.parse().unwrap())).collect()
    };
    let vertices: Vec<DVec3> = numbers("v ").chunks(3).map(DVec3::from_slice).collect();
    assert_eq!(vertices, thick.vertices);
    let faces = numbers("f ");
    let all = thick.faces.as_flattened().iter();
    assert!(all.map(|&v| f64::from(v) + 1.0).eq(faces));
}

#[test]
fn positions_that_do_not_fit_are_refused() {
    let sheet = square(Assignment::Valley);
    assert!(surface_of(&sheet, &[DVec3::ZERO]).is_err());
    assert!(solid(&sheet, &[DVec3::NAN; 4], 0.1).is_err());
    let motion = Motion {
        frames: vec![Frame { time: 0.0, positions: vec![DVec3::NAN; 4] }],
        compact_order: LayerOrder::default(),
        sheet,
    };
    assert!(glb(&motion, &GlbOptions::default(), Vec::new()).is_err());
}
