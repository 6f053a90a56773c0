//! Replays the seeds of the fuzz targets: each seed, and each seed with changed bytes, is read or refused.

use std::path::{Path, PathBuf};

use foldmotion_pattern::{ImportOptions, UnknownElements, import_fold, import_svg};
use foldmotion_study::SceneSource;

/// The seeds of a target, in order.
fn seeds(target: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target);
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= 4, "{target}");
    let read = |path: PathBuf| {
        let bytes = std::fs::read(&path).unwrap();
        (path, bytes)
    };
    paths.into_iter().map(read).collect()
}

/// Hands over `bytes` with a few of them changed, dropped or doubled, many times over.
fn mutated(bytes: &[u8], mut each: impl FnMut(&[u8])) {
    const SPICE: &[u8] = b"0159-+.eE\"<>/{}[],: #\n\xff";
    let mut seed = 0x9e37_79b9_7f4a_7c15u64;
    let mut random = |below: usize| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed % below as u64) as usize
    };
    for _ in 0..300 {
        let mut changed = bytes.to_vec();
        for _ in 0..=random(4) {
            let at = random(changed.len());
            match random(4) {
                0 => changed[at] = SPICE[random(SPICE.len())],
                1 => changed.insert(at, SPICE[random(SPICE.len())]),
                2 => drop(changed.remove(at)),
                _ => {
                    let until = (at + 1 + random(20)).min(changed.len());
                    let piece = changed[at..until].to_vec();
                    let to = random(changed.len());
                    changed.splice(to..to, piece);
                }
            }
        }
        each(&changed);
    }
}

#[test]
fn svg_seeds_and_their_mutants_are_read_or_refused() {
    let lenient = ImportOptions {
        unknown: UnknownElements::Ignore,
        curve_tolerance: Some(0.01),
        ..ImportOptions::default()
    };
    for (path, bytes) in seeds("import_svg") {
        let read = |bytes: &[u8]| {
            let _ = import_svg(bytes, &ImportOptions::default());
            import_svg(bytes, &lenient)
        };
        let known = read(&bytes);
        assert!(known.is_ok(), "{}: {known:?}", path.display());
        mutated(&bytes, |changed| drop(read(changed)));
    }
}

#[test]
fn fold_seeds_and_their_mutants_are_read_or_refused() {
    let read = |bytes: &[u8]| import_fold(bytes, &ImportOptions::default());
    for (path, bytes) in seeds("import_fold") {
        let imported = read(&bytes);
        assert!(imported.is_ok(), "{}: {imported:?}", path.display());
        mutated(&bytes, |changed| {
            if let Ok(imported) = read(changed) {
                assert!(read(imported.fold("test").as_bytes()).is_ok());
            }
        });
    }
}

#[test]
fn scene_seeds_and_their_mutants_are_read_or_refused() {
    let read = |text: &str| SceneSource::new(Path::new("seed.toml"), text.to_owned()).scene();
    for (path, bytes) in seeds("scene") {
        let text = String::from_utf8(bytes.clone()).unwrap();
        let is_wrong = path.ends_with("wrong.toml");
        assert_eq!(read(&text).is_err(), is_wrong, "{}", path.display());
        mutated(&bytes, |changed| {
            if let Ok(text) = std::str::from_utf8(changed) {
                let _ = read(text);
            }
        });
    }
}
