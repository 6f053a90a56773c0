//! The independence of the second proof.

use std::path::Path;

#[test]
fn the_second_proof_uses_nothing_of_the_first_but_its_report() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/verification");
    let mut read = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.ends_with("tests.rs") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(foreign(&text), None, "{}", path.display());
        read += 1;
    }
    assert!(read >= 15);
    for planted in [
        "use foldmotion_geometry::Aabb;",
        "use foldmotion_geometry::{Aabb, collide::Tree};",
        "use crate::collision::Checker;",
        "let x = crate::collision::pair::Pair;",
        "use crate::strain;",
        "use crate::{collision, strain};",
        "use super::super::collision;",
        "use crate::Checker;",
        "use crate::{Cluster, Checker};",
        "use crate::layers::prove;",
        "let order = crate::layers::order_of(sheet, positions, pairs);",
    ] {
        assert!(foreign(planted).is_some(), "{planted}");
    }
}

/// The first thing used that the two proofs may not share.
fn foreign(text: &str) -> Option<String> {
    let of_collision = [
        "CollisionReport",
        "Penetration",
        "PenetrationKind",
        "Separation",
        "Verdict",
    ];
    let of_layers = [
        "Claims",
        "Cluster",
        "LayerConflict",
        "LayerProof",
        "LayerRule",
    ];
    let code = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    let code = code.collect::<Vec<_>>().join(" ");
    if let Some(at) = code.find("foldmotion_geometry") {
        return Some(code[at..].chars().take(40).collect());
    }
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        let (named, allowed) = match rest.strip_prefix("collision::") {
            Some(named) => (named, &of_collision[..]),
            None => (rest, &of_layers[..]),
        };
        let end = named.find(';').unwrap_or(named.len());
        let names = named[..end].trim_matches(|c| c == '{' || c == '}');
        let foreign = names
            .split(',')
            .map(str::trim)
            .find(|n| !n.is_empty() && !allowed.contains(n));
        if let Some(name) = foreign {
            return Some(name.to_owned());
        }
    }
    code.find("super::super::collision")
        .map(|_| "collision".to_owned())
}
