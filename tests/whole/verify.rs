//! Certificates are proved again; every changed motion and every changed certificate is refused.

use std::fs;
use std::path::{Path, PathBuf};

use foldmotion_study::{
    CheckOptions, SceneSource, Study, StudyError, VerifiedCertificate, check_file, verify_file,
};
use serde_json::{Value, json};
use tempfile::TempDir;

/// A motion file with its certificate.
struct Certified {
    home: TempDir,
    motion: Value,
    certificate: Value,
}

impl Certified {
    fn of_scene(scene: &str, set: &[&str]) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let mut source = SceneSource::read(&path.join(format!("{scene}.toml"))).unwrap();
        for assignment in set.iter().chain(&["record.outputs=[\"fold\"]"]) {
            source.set(assignment).unwrap();
        }
        let home = tempfile::tempdir().unwrap();
        let study = Study::resolve(&source).unwrap();
        study.run(home.path(), &|_, _| true).unwrap();
        let text = fs::read_to_string(home.path().join("motion.fold")).unwrap();
        Self::of_motion(home, &serde_json::from_str(&text).unwrap())
    }

    /// Writes the motion and certifies it.
    fn of_motion(home: TempDir, motion: &Value) -> Self {
        fs::write(home.path().join("motion.fold"), motion.to_string()).unwrap();
        let path = home.path().join("motion.fold");
        let checked = check_file(&path, &CheckOptions::default(), &|_, _| true).unwrap();
        Self {
            home,
            motion: motion.clone(),
            certificate: serde_json::from_str(&checked.certificate.to_json()).unwrap(),
        }
    }

    fn write(&self, name: &str, content: &Value) -> PathBuf {
        let path = self.home.path().join(name);
        fs::write(&path, content.to_string()).unwrap();
        path
    }

    /// Verifies this or a changed motion against this or a changed certificate.
    fn verify(
        &self,
        motion: &Value,
        certificate: &Value,
    ) -> Result<VerifiedCertificate, StudyError> {
        let motion = self.write("motion.fold", motion);
        let certificate = self.write("certificate.json", certificate);
        verify_file(&motion, &certificate, &|_, _| true)
    }

    fn status(&self, motion: &Value, certificate: &Value) -> u8 {
        match self.verify(motion, certificate) {
            Ok(verified) => verified.status(),
            Err(error) => error.status(),
        }
    }

    /// A forged certificate: this one with the hash of another motion.
    fn forged_for(&self, motion: &Value) -> Value {
        let path = self.write("motion.fold", motion);
        let sha256 = check_file(&path, &CheckOptions::default(), &|_, _| true)
            .map_or_else(|_| "0".repeat(64), |checked| checked.certificate.sha256);
        let mut certificate = self.certificate.clone();
        certificate["sha256"] = json!(sha256);
        certificate
    }
}

/// Free, touching, penetrating, and touching with the `faceOrders` of two layers turned round.
fn certified() -> [Certified; 4] {
    let frames = "motion.frames=12";
    let short = ["sheet.rows=2", "profile.length=2.0", frames];
    let touching = Certified::of_scene("one-row", &[frames, "motion.contact=false"]);
    let swapped = with_layers_swapped(&touching.motion);
    [
        Certified::of_scene("one-row", &[frames]),
        touching,
        Certified::of_scene("shelter-short-plain", &short),
        Certified::of_motion(tempfile::tempdir().unwrap(), &swapped),
    ]
}

/// The motion with one order of its last frame turned round.
fn with_layers_swapped(motion: &Value) -> Value {
    let mut motion = motion.clone();
    let last = frames(&mut motion).last_mut().unwrap();
    let sign = last.pointer_mut("/faceOrders/0/2").unwrap();
    *sign = json!(-sign.as_i64().unwrap());
    motion
}

/// Seeded numbers (`SplitMix64`, Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

/// The pointers of all values that are no objects or lists, but for the name of the file, which states nothing, and whether
/// bounds are tight: that they are not states less.
fn leaves(value: &Value, at: &str, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            map.iter().for_each(|(key, v)| leaves(v, &format!("{at}/{key}"), found));
        }
        Value::Array(list) => (0..).zip(list).for_each(|(k, v)| {
            let k: usize = k;
            leaves(v, &format!("{at}/{k}"), found);
        }),
        _ if at != "/file" && !at.ends_with("/is_tight") => found.push(at.to_owned()),
        _ => {}
    }
}

/// Changes one value: numbers by a thousandth (at least 1 where they count), names to others.
fn change_leaf(certificate: &mut Value, pointer: &str) {
    let entry = pointer.split("/point/").next().unwrap();
    let of_layers = certificate.pointer(&format!("{entry}/layers"));
    let is_of_layers = of_layers.is_some_and(|layers| !layers.is_null());
    let leaf = certificate.pointer_mut(pointer).unwrap();
    let changed = match &*leaf {
        Value::String(text) if pointer == "/verdict" => {
            json!(if text == "free" { "touching" } else { "free" })
        }
        Value::String(text) if pointer.ends_with("/kind") => {
            json!(if text.starts_with("vertex") {
                "edge through edge"
            } else {
                "vertex through facet"
            })
        }
        Value::String(text) => json!(format!("{text}.")),
        // A slightly larger tolerance would be another true statement.
        Value::Number(_) if pointer == "/tolerance" => json!(0.2),
        // Of triangles with a vertex in common any depth up to their largest overlap is as true.
        Value::Number(n) if pointer.ends_with("/depth") => json!(1.0 + n.as_f64().unwrap() * 1e3),
        Value::Number(n) if n.is_u64() => {
            let n = n.as_u64().unwrap();
            json!(n + (n / 1000).max(1))
        }
        // Any point of what the layers have in common is as true.
        Value::Number(n) if pointer.contains("/point/") && is_of_layers => {
            json!(n.as_f64().unwrap() + 10.0)
        }
        Value::Number(n) => {
            let x = n.as_f64().unwrap();
            // A thousandth of what is nearly nothing is within the accuracy stated.
            json!(if x.abs() < 1e-3 { x + 1e-3 } else { x * 1.001 })
        }
        Value::Null if pointer == "/title" => json!("another"),
        Value::Null => json!([0, 1]),
        other => panic!("{pointer}: {other}"),
    };
    *leaf = changed;
}

/// Changes what is listed.
fn change_lists(certificate: &mut Value, which: usize) -> &'static str {
    let triangles = certificate["triangles"].as_u64().unwrap();
    let times = certificate["times"].clone();
    let has_some = !certificate["penetrations"].as_array().unwrap().is_empty();
    let has_clusters = !certificate["clusters"].as_array().unwrap().is_empty();
    match which {
        0 if has_some => {
            certificate["penetrations"].as_array_mut().unwrap().pop();
            "a penetration left out"
        }
        1 if has_some => {
            let list = certificate["penetrations"].as_array_mut().unwrap();
            list.push(list[0].clone());
            "a penetration twice"
        }
        2 if certificate["penetrations"].as_array().unwrap().len() > 1 => {
            certificate["penetrations"].as_array_mut().unwrap().reverse();
            "penetrations in another order"
        }
        3 => {
            certificate["min_separation"] = Value::Null;
            "no closest approach"
        }
        4 => {
            let pair = json!({"triangles": [0, triangles - 1], "faces": [0, 0], "facets": null});
            let entry = json!({"frames": [0, 1], "interval": times, "t": times[0], "pair": pair});
            certificate["undecided"] = json!([entry]);
            "a pair undecided that is not"
        }
        5 => {
            certificate["assumptions"].as_array_mut().unwrap().pop();
            "an assumption left out"
        }
        6 if has_clusters => {
            certificate["clusters"].as_array_mut().unwrap().pop();
            "a cluster left out"
        }
        7 if has_clusters => {
            let list = certificate["clusters"].as_array_mut().unwrap();
            list.push(list[0].clone());
            "a cluster twice"
        }
        8 => {
            certificate["proved_by"] = json!("somebody");
            "a key nobody knows"
        }
        _ => {
            certificate.as_object_mut().unwrap().remove("verdict");
            "no verdict"
        }
    }
}

fn frames(motion: &mut Value) -> &mut Vec<Value> {
    motion["file_frames"].as_array_mut().unwrap()
}

/// The corners of a triangle at a frame.
fn corners(frame: &Value, vertices: &[usize]) -> Vec<[f64; 3]> {
    let at = |&v: &usize| serde_json::from_value(frame["vertices_coords"][v].clone()).unwrap();
    vertices.iter().map(at).collect()
}

/// Moves a triangle along its normal by 0.3.
fn move_triangle(frame: &mut Value, vertices: &[usize]) {
    let p = corners(frame, vertices);
    let edge = |i: usize| [0, 1, 2].map(|k| p[i][k] - p[0][k]);
    let (u, v) = (edge(1), edge(2));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    for (&vertex, p) in vertices.iter().zip(&p) {
        let moved = [0, 1, 2].map(|k| p[k] + 0.3 * n[k] / length);
        frame["vertices_coords"][vertex] = json!(moved);
    }
}

/// Changes a motion so that what its certificate states is no longer true of it.
fn change_motion(of: &Certified, which: usize, random: &mut Random) -> (Value, &'static str) {
    let mut motion = of.motion.clone();
    let count = frames(&mut motion).len();
    let name = match which {
        0 => {
            let k = random.below(count);
            frames(&mut motion).remove(k);
            "a frame dropped"
        }
        1 => {
            let last = frames(&mut motion).last_mut().unwrap();
            last["foldmotion:time"] = json!(2.0 + 1e-9);
            "the last time changed"
        }
        2 => {
            let unit = motion["foldmotion:unitLength"].as_f64().unwrap();
            motion["foldmotion:unitLength"] = json!(unit * 1.001);
            "the unit of length changed"
        }
        3 => {
            let faces = motion["faces_vertices"].as_array().unwrap().len();
            let face = random.below(faces);
            let corners = motion["faces_vertices"][face].as_array_mut().unwrap();
            let other = (0..9).find(|v| !corners.contains(&json!(v)));
            corners[0] = json!(other);
            "a corner of a face changed"
        }
        4 => {
            // The facet of the stated closest approach, at the frames around it.
            let t = of.certificate["min_separation"]["t"].as_f64().unwrap();
            let face = of.certificate["min_separation"]["pair"]["triangles"][random.below(2)]
                .as_u64()
                .unwrap();
            let triangle = &of.motion["faces_vertices"][face as usize];
            let triangle: Vec<usize> = serde_json::from_value(triangle.clone()).unwrap();
            let frames = frames(&mut motion);
            let times: Vec<f64> =
                frames.iter().map(|f| f["foldmotion:time"].as_f64().unwrap()).collect();
            for (k, frame) in frames.iter_mut().enumerate() {
                let before = times[k.saturating_sub(1)];
                let after = times[(k + 1).min(count - 1)];
                if (before..=after).contains(&t) {
                    move_triangle(frame, &triangle);
                }
            }
            "a facet moved"
        }
        5 => {
            let frames = frames(&mut motion);
            let (first, last) = (0, count - 1);
            let coordinates = frames[first]["vertices_coords"].take();
            frames[first]["vertices_coords"] = frames[last]["vertices_coords"].take();
            frames[last]["vertices_coords"] = coordinates;
            "the first and the last frame exchanged"
        }
        _ => {
            // Farther than the sheet is large: the stated points are then on no facet.
            for frame in frames(&mut motion) {
                for point in frame["vertices_coords"].as_array_mut().unwrap() {
                    point[0] = json!(point[0].as_f64().unwrap() + 100.0);
                }
            }
            "the motion carried away"
        }
    };
    (motion, name)
}

#[test]
fn certificates_of_free_touching_and_penetrating_motions_verify() {
    let expected = [("free", 0), ("touching", 0), ("penetrating", 1), ("penetrating", 1)];
    for (of, (verdict, status)) in certified().iter().zip(expected) {
        assert_eq!(of.certificate["verdict"], verdict);
        let verified = of.verify(&of.motion, &of.certificate).unwrap();
        assert_eq!(verified.status(), status, "{}", verified.table());
        assert!(verified.table().contains("\nVERIFIED\n"));
    }
}

#[test]
fn every_seeded_change_of_a_motion_or_a_certificate_is_refused() {
    let all = certified();
    let mut random = Random(2026);
    let mut refused = 0;
    for seed in 0..56 {
        let of = &all[seed % 4];
        let (motion, name) = change_motion(of, seed / 4 % 7, &mut random);
        assert_ne!(motion, of.motion);
        let status = of.status(&motion, &of.certificate);
        assert_eq!(status, 2, "{seed}: {name}, hash and all");
        let forged = of.forged_for(&motion);
        let status = of.status(&motion, &forged);
        assert!(status >= 2, "{seed}: {name}, with the hash forged: {status}");
        refused += 2;
    }
    for seed in 0..180 {
        let of = &all[seed % 4];
        let mut certificate = of.certificate.clone();
        let mut pointers = Vec::new();
        leaves(&certificate, "", &mut pointers);
        let is_of_layers =
            |p: &String| ["/clusters", "/layer_orders"].iter().any(|at| p.starts_with(at));
        let is_penetration = |p: &String| p.starts_with("/penetrations");
        match seed {
            0..90 => {}
            90..150 => pointers.retain(is_of_layers),
            _ if of.certificate["penetrations"][0].is_null() => continue,
            _ => pointers.retain(is_penetration),
        }
        let pointer = &pointers[random.below(pointers.len())];
        change_leaf(&mut certificate, pointer);
        assert_ne!(certificate, of.certificate, "{pointer}");
        let status = of.status(&of.motion, &certificate);
        assert!(status >= 2, "{seed}: {pointer}: {status}");
        refused += 1;
    }
    for seed in 0..40 {
        let of = &all[seed % 4];
        let mut certificate = of.certificate.clone();
        let name = change_lists(&mut certificate, seed / 4);
        let status = of.status(&of.motion, &certificate);
        assert!(status >= 2, "{seed}: {name}: {status}");
        refused += 1;
    }
    assert!(refused >= 100, "{refused}");
    for of in &all {
        assert!(of.status(&of.motion, &of.certificate) < 2, "the unchanged twin");
    }
}

#[test]
fn a_penetrating_motion_with_a_clean_certificate_is_refuted_and_so_is_the_reverse() {
    let [_, clean, penetrating, swapped] = certified();
    // Everything that the file itself confirms is correct; only the verdict and its evidence are false.
    let mut lie = penetrating.certificate.clone();
    lie["verdict"] = json!("touching");
    lie["penetrations"] = json!([]);
    let verified = penetrating.verify(&penetrating.motion, &lie).unwrap();
    assert_eq!(verified.status(), 2);
    let fields = verified.verification.refuted.iter().map(|r| &r.field);
    assert!(fields.into_iter().any(|f| f == "penetrations"));
    // The certificate of the layers in their order, with the hash of the file in which two are swapped.
    let mut lie = clean.certificate.clone();
    lie["sha256"] = swapped.certificate["sha256"].clone();
    let verified = swapped.verify(&swapped.motion, &lie).unwrap();
    assert_eq!(verified.status(), 2, "{}", verified.table());
    let refuted = &verified.verification.refuted;
    assert!(refuted.iter().all(|r| r.field == "penetrations"), "{refuted:?}");
    let mut lie = clean.certificate.clone();
    lie["verdict"] = json!("penetrating");
    let mut invented = penetrating.certificate["penetrations"][0].clone();
    invented["pair"] = json!({"triangles": [0, 1], "faces": [0, 1], "facets": [0, 1]});
    invented["frames"] = json!([0, 1]);
    lie["penetrations"] = json!([invented]);
    let verified = clean.verify(&clean.motion, &lie).unwrap();
    assert_eq!(verified.status(), 2, "{}", verified.table());
}
