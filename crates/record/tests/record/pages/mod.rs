//! One-file pages read back: the data in them (here) and what browsers may do with them (`safety`).

mod safety;

use std::collections::BTreeMap;

use crate::common::*;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use foldmotion_pattern::{Case, Frame, LayerOrder, Motion, Unit, UnitSheet};
use foldmotion_record::{
    Curve, Marks, Page, PageOptions, Panel, Provenance, RecordError, Values, page, positions_at,
};
use glam::DVec3;
use serde_json::Value;
use sha2::{Digest, Sha256};

/// A sheet that folds from flat to compact along curved paths.
fn tower() -> Motion {
    let unit = Unit::new(Case::SII, 1.6, 1.0, Some(0.7), None).unwrap();
    let units = UnitSheet::new(unit, 3, 2).unwrap();
    let (flat, compact) = (units.sheet.planar(), units.compact());
    let frame = |k: i32| {
        let part = f64::from(k) / 40.0;
        let pairs = flat.iter().zip(&compact);
        let bulge = DVec3::Z * (3.0 * part).sin();
        let positions = pairs.map(|(a, b)| a.lerp(*b, part) + bulge * a.x).collect();
        Frame { time: 1.0 + part, positions }
    };
    Motion {
        frames: (0..=40).map(frame).collect(),
        compact_order: units.compact_order(),
        sheet: units.sheet,
    }
}

fn bare<'a>(motion: &'a Motion, marks: &'a Marks) -> Page<'a> {
    Page { motion, marks, values: &[], panels: &[], report: None, certificate: None, fold: None }
}

fn written(contents: &Page<'_>, options: &PageOptions) -> String {
    let mut bytes = Vec::new();
    page(contents, options, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}

/// The text between `<script … id="ID">` and its end.
fn block<'a>(html: &'a str, id: &str) -> &'a str {
    let start = html.find(&format!("id=\"{id}\">")).unwrap();
    let text = &html[start..];
    let text = &text[text.find('>').unwrap() + 1..];
    &text[..text.find("</script").unwrap()]
}

fn unpacked(html: &str, id: &str) -> Vec<u8> {
    let packed = STANDARD.decode(block(html, id)).unwrap();
    miniz_oxide::inflate::decompress_to_vec_zlib(&packed).unwrap()
}

/// The header and the arrays of a page as whole numbers, each read as the header says.
fn read(html: &str) -> (Value, BTreeMap<String, Vec<i64>>) {
    let header: Value = serde_json::from_str(block(html, "scene")).unwrap();
    let bytes = unpacked(html, "payload");
    let array = |entry: &Value| -> Vec<i64> {
        let [offset, length] =
            ["offset", "length"].map(|key| entry[key].as_u64().unwrap() as usize);
        let words = |size: usize| bytes[offset..offset + size * length].chunks(size);
        let word = |w: &[u8]| <[u8; 4]>::try_from(w).unwrap();
        match entry["type"].as_str().unwrap() {
            "Uint8" => words(1).map(|w| i64::from(w[0])).collect(),
            "Uint32" => words(4).map(|w| u32::from_le_bytes(word(w)).into()).collect(),
            "Int32" => words(4).map(|w| i32::from_le_bytes(word(w)).into()).collect(),
            other => panic!("{other}"),
        }
    };
    let entries = header["arrays"].as_object().unwrap();
    let arrays = entries.iter().map(|(name, entry)| (name.clone(), array(entry)));
    let arrays = arrays.collect();
    (header, arrays)
}

fn floats(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap().iter();
    list.map(|x| x.as_f64().unwrap()).collect()
}

/// The motion of the key frames in a page.
fn shown(html: &str, sheet: &Motion) -> Motion {
    let (header, arrays) = read(html);
    let (step, origin) = (header["step"].as_f64().unwrap(), floats(&header["origin"]));
    let times = floats(&header["times"]);
    let keys = header["keys"].as_array().unwrap();
    let count = sheet.sheet.vertices.len();
    let mut places = vec![0_i64; 3 * count];
    let changes = arrays["positions"].chunks(3 * count);
    let frames = keys.iter().zip(changes).map(|(key, changes)| {
        for (place, change) in places.iter_mut().zip(changes) {
            *place += change;
        }
        let point = |p: &[i64]| {
            DVec3::from_slice(&origin) + step * DVec3::new(p[0] as f64, p[1] as f64, p[2] as f64)
        };
        Frame {
            time: times[key.as_u64().unwrap() as usize],
            positions: places.chunks(3).map(point).collect(),
        }
    });
    Motion { frames: frames.collect(), ..sheet.clone() }
}

#[test]
fn a_page_holds_the_motion_within_its_tolerance_at_every_time_and_says_so() {
    let times: Vec<f64> = (0..=40).map(|k| f64::from(k) / 20.0).collect();
    for motion in [folding_square(&times), tower()] {
        for tolerance in [1e-2, 1e-3, 1e-9] {
            let options = PageOptions { tolerance, ..PageOptions::default() };
            let html = written(&bare(&motion, &Marks::default()), &options);
            let keys = shown(&html, &motion);
            let mut largest: f64 = 0.0;
            for k in 0..=400 {
                let time = f64::from(k) / 200.0;
                let pairs = positions_at(&keys, time).into_iter();
                let distances = pairs.zip(positions_at(&motion, time));
                largest = distances.map(|(p, q)| p.distance(q)).fold(largest, f64::max);
            }
            let (header, _) = read(&html);
            let said = header["largestError"].as_f64().unwrap();
            let rounding = 1e-14;
            assert!(largest <= said + rounding, "{largest} {said}");
            assert!(said <= tolerance * motion.sheet.unit_length + 1e-8, "{said}");
            assert!(tolerance < 1e-2 || keys.frames.len() < motion.frames.len());
        }
    }
}

#[test]
fn lifted_layers_keep_every_order_of_the_compact_state() {
    let motion = tower();
    let html = written(&bare(&motion, &Marks::default()), &PageOptions::default());
    let (_, arrays) = read(&html);
    let last = &motion.frames.last().unwrap().positions;
    let normal = |face: u32| {
        let [a, b, c] = motion.sheet.faces[face as usize].map(|v| last[v as usize]);
        (b - a).cross(c - a)
    };
    assert!(!motion.compact_order.is_empty());
    let mut pairs = Vec::new();
    for (f, g, sign) in motion.compact_order.iter() {
        let [of_f, of_g] = [f, g].map(|face| arrays["lifts"][face as usize]);
        let along_g = of_f * normal(f).dot(normal(g)).signum() as i64;
        assert!(i64::from(sign) * (along_g - of_g) >= 2, "{f} and {g}");
        pairs.push([f.min(g), f.max(g)].map(i64::from));
    }
    pairs.sort_unstable();
    pairs.dedup();
    assert_eq!(arrays["pairs"], pairs.concat());
}

#[test]
fn orders_in_a_circle_and_of_missing_triangles_are_accepted() {
    let mut motion = folding_square(&[0.0, 1.0]);
    motion.compact_order.insert(0, 1, 1);
    motion.compact_order.insert(1, 0, 1);
    motion.compact_order.insert(7, 1, 1);
    motion.compact_order.insert(0, 0, 1);
    let html = written(&bare(&motion, &Marks::default()), &PageOptions::default());
    let (_, arrays) = read(&html);
    assert_eq!(arrays["pairs"], [0, 1]);
}

#[test]
fn values_are_read_back_within_half_a_step_of_their_range_and_those_that_are_none_as_none() {
    let motion = folding_square(&[0.0, 1.0, 2.0]);
    let values = [Values {
        title: "strain".to_owned(),
        range: [-1.0, 3.0],
        frames: vec![vec![-1.0, 0.4], vec![f64::NAN, 9.0], vec![2.99, -7.0]],
    }];
    let marks = Marks::default();
    let contents = Page { values: &values, ..bare(&motion, &marks) };
    let (header, arrays) = read(&written(&contents, &PageOptions::default()));
    let most = header["levels"].as_f64().unwrap();
    let mut levels = [0_i64; 2];
    let rows = arrays["values0"].chunks(2).zip(&values[0].frames);
    for (changes, expected) in rows {
        for i in 0..2 {
            levels[i] = (levels[i] + changes[i]).rem_euclid(256);
            if expected[i].is_nan() {
                assert!(levels[i] as f64 > most);
                continue;
            }
            let found = -1.0 + 4.0 * levels[i] as f64 / most;
            assert!((found - expected[i].clamp(-1.0, 3.0)).abs() <= 2.0 / most + 1e-12);
        }
    }
}

#[test]
fn the_files_in_a_page_are_those_that_were_given() {
    let motion = folding_square(&[0.0, 1.0]);
    let fold: Vec<u8> = (0..200_000_u32).map(|k| (k.wrapping_mul(k) >> 3) as u8).collect();
    let certificate = "{\"verdict\": \"touching\",\n \"title\": \"λ </script>\"}\n";
    let marks = Marks::default();
    let contents =
        Page { fold: Some(&fold), certificate: Some(certificate), ..bare(&motion, &marks) };
    let html = written(&contents, &PageOptions::default());
    assert_eq!(unpacked(&html, "fold-file"), fold);
    assert_eq!(unpacked(&html, "certificate-file"), certificate.as_bytes());
    assert!(html.contains("touching</strong>"));
    let html = written(&bare(&motion, &marks), &PageOptions::default());
    assert!(!html.contains("id=\"save-"), "nothing to save");
    assert_eq!(block(&html, "fold-file"), "");
}
