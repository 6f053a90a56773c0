//! Motions with a known verdict, which stays the same if they are rotated, triangulated differently or reversed.

use std::fs;
use std::path::Path;

use foldmotion_check::Verdict;
use foldmotion_study::{CheckOptions, check_file, verify_file};
use foldmotion_verify::Verification;
use serde_json::{Value, json};

/// The name of the file, the verdict, and the smallest separation if it is known.
const CASES: [(&str, Verdict, Option<f64>); 13] = [
    ("diag_square_through_square", Verdict::Penetrating, None),
    ("diag_other_diagonal", Verdict::Penetrating, None),
    ("crack_static", Verdict::Penetrating, None),
    ("crack_isometric_strip_K9", Verdict::Penetrating, None),
    ("crack_x5e-07", Verdict::Penetrating, None),
    ("crack_x3e-06", Verdict::Penetrating, None),
    ("erl_wedge_crack_thin1e-06", Verdict::Penetrating, None),
    ("slide_quad_5frames", Verdict::Penetrating, None),
    ("sep7_5e-06_3.3e-11", Verdict::Free, Some(5.74e-6)),
    ("sep7_2e-05_1e-10", Verdict::Free, Some(2.29e-5)),
    ("pair_verify_6506", Verdict::Touching, Some(3.9e-11)),
    ("false_touching_min", Verdict::Free, Some(1.92e-5)),
    ("nb_vertex_1e-12", Verdict::Touching, None),
];

fn read(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/verdict-cases");
    let text = fs::read_to_string(folder.join(format!("{name}.fold"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// The results of both proofs.
struct Checked {
    verdict: Verdict,
    /// In units of the unit of length.
    separation: Option<f64>,
    verification: Verification,
}

/// Checks a motion and verifies its certificate.
fn check(motion: &Value) -> Checked {
    let home = tempfile::tempdir().unwrap();
    let [path, certificate] = ["motion.fold", "certificate.json"].map(|n| home.path().join(n));
    fs::write(&path, motion.to_string()).unwrap();
    let checked = check_file(&path, &CheckOptions::default(), &|_, _| true).unwrap();
    let stated = &checked.certificate;
    fs::write(&certificate, stated.to_json()).unwrap();
    let verified = verify_file(&path, &certificate, &|_, _| true).unwrap();
    Checked {
        verdict: stated.verdict,
        separation: stated.min_separation.as_ref().map(|s| s.distance),
        verification: verified.verification,
    }
}

/// Applies a change to the coordinates of every frame.
fn change_frames(motion: &mut Value, change: impl Fn(&mut Vec<Value>)) {
    let each = |frame: &mut Value| {
        if let Some(coordinates) = frame["vertices_coords"].as_array_mut() {
            change(coordinates);
        }
    };
    each(motion);
    for frame in motion["file_frames"].as_array_mut().into_iter().flatten() {
        each(frame);
    }
}

fn point(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|i| value[i].as_f64().unwrap_or(0.0))
}

/// The 24 rotations of a cube: the coordinates permuted, with signs, without a reflection.
fn rotations() -> Vec<([usize; 3], [f64; 3])> {
    let orders = [
        ([0, 1, 2], 1.0),
        ([1, 2, 0], 1.0),
        ([2, 0, 1], 1.0),
        ([0, 2, 1], -1.0),
        ([2, 1, 0], -1.0),
        ([1, 0, 2], -1.0),
    ];
    let signs = |parity: f64| {
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(x, y)| [x, y, x * y * parity])
    };
    let all = orders.into_iter();
    all.flat_map(|(order, parity)| signs(parity).map(|sign| (order, sign))).collect()
}

fn rotated(motion: &Value, (order, sign): ([usize; 3], [f64; 3])) -> Value {
    let mut motion = motion.clone();
    change_frames(&mut motion, |coordinates| {
        for value in coordinates {
            let p = point(value);
            *value = json!([0, 1, 2].map(|i| sign[i] * p[order[i]]));
        }
    });
    motion
}

/// The motion with quadrilaterals cut along one diagonal or the other.
fn cut(motion: &Value, shift: usize) -> Value {
    let mut motion = motion.clone();
    let faces = motion["faces_vertices"].as_array().unwrap().clone();
    let cut = faces.into_iter().flat_map(|face| {
        let corners = face.as_array().unwrap().clone();
        if corners.len() != 4 {
            return vec![face];
        }
        let at = |k: usize| corners[(k + shift) % 4].clone();
        vec![json!([at(0), at(1), at(2)]), json!([at(0), at(2), at(3)])]
    });
    motion["faces_vertices"] = cut.collect();
    motion
}

/// Every triangle cut into three at a point inside, which moves along.
fn subdivided(motion: &Value) -> Value {
    let mut motion = cut(motion, 0);
    let faces = motion["faces_vertices"].as_array().unwrap().clone();
    let corners: Vec<[usize; 3]> =
        faces.iter().map(|face| [0, 1, 2].map(|i| face[i].as_u64().unwrap() as usize)).collect();
    let count = motion["vertices_coords"].as_array().unwrap().len();
    change_frames(&mut motion, |coordinates| {
        for face in &corners {
            let [p, q, r] = face.map(|v| point(&coordinates[v]));
            let inside = [0, 1, 2].map(|i| 0.375 * p[i] + 0.375 * q[i] + 0.25 * r[i]);
            coordinates.push(json!(inside));
        }
    });
    let cut = corners.iter().enumerate().flat_map(|(k, &[p, q, r])| {
        let m = count + k;
        [json!([p, q, m]), json!([q, r, m]), json!([r, p, m])]
    });
    motion["faces_vertices"] = cut.collect();
    motion
}

fn reversed(motion: &Value) -> Value {
    let mut motion = motion.clone();
    let mut frames = vec![motion["vertices_coords"].clone()];
    let later = motion["file_frames"].as_array_mut().unwrap();
    frames.extend(later.iter().map(|f| f["vertices_coords"].clone()));
    frames.reverse();
    for (frame, coordinates) in later.iter_mut().zip(&frames[1..]) {
        frame["vertices_coords"] = coordinates.clone();
    }
    motion["vertices_coords"] = frames[0].clone();
    motion
}

fn swapped(motion: &Value) -> Value {
    let mut motion = motion.clone();
    motion["faces_vertices"].as_array_mut().unwrap().reverse();
    motion
}

/// Checks verdict and separation, and that the second proof says the same.
fn is_true(name: &str, what: &str, motion: &Value, truth: (Verdict, Option<f64>)) {
    let checked = check(motion);
    assert_eq!(checked.verdict, truth.0, "{name}, {what}");
    let verification = checked.verification;
    assert!(verification.is_verified(), "{name}, {what}: {verification:?}");
    if let Some(expected) = truth.1 {
        let found = checked.separation.unwrap();
        // The expected value has three digits; the stated bound may be smaller by τ/100.
        assert!(found <= 1.005 * expected, "{name}, {what}: {found}");
        assert!(found >= 0.99 * expected - 2e-8, "{name}, {what}: {found}");
    }
}

/// Checks the verdict, and that the second proof does not refute it; cut into more triangles it may leave some pairs open.
fn is_not_refuted(name: &str, what: &str, motion: &Value, truth: Verdict) {
    let checked = check(motion);
    assert_eq!(checked.verdict, truth, "{name}, {what}");
    let refuted = checked.verification.refuted;
    assert!(refuted.is_empty(), "{name}, {what}: {refuted:?}");
}

#[test]
fn every_case_gets_its_true_verdict_and_separation_in_both_proofs() {
    for (name, verdict, separation) in CASES {
        is_true(name, "as it is", &read(name), (verdict, separation));
    }
}

#[test]
fn no_verdict_changes_in_24_rotations() {
    for (name, verdict, separation) in CASES {
        for (k, rotation) in rotations().into_iter().enumerate() {
            let motion = rotated(&read(name), rotation);
            is_true(name, &format!("rotation {k}"), &motion, (verdict, separation));
        }
    }
}

#[test]
fn no_verdict_changes_with_the_diagonals_the_triangles_the_direction_of_time_or_the_order_of_faces()
{
    for (name, verdict, separation) in CASES {
        let motion = read(name);
        // Cutting a facet makes pairs of what was one: only the verdict is that of the sheet.
        is_not_refuted(name, "one diagonal", &cut(&motion, 0), verdict);
        is_not_refuted(name, "the other diagonal", &cut(&motion, 1), verdict);
        is_not_refuted(name, "subdivided", &subdivided(&motion), verdict);
        is_not_refuted(name, "reversed", &reversed(&motion), verdict);
        is_true(name, "swapped", &swapped(&motion), (verdict, separation));
    }
}
