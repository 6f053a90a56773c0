//! Every scene with contact, without contact, and with the dynamic engine.

use std::error::Error;

use crate::checked::{Motion, scenes};
use crate::{Row, Table};

/// Engine and contact; the dynamic engine has no contact.
const MOVED: [(&str, bool); 3] =
    [("quasi-static", true), ("quasi-static", false), ("dynamic", false)];

/// The table of every scene file.
pub(crate) fn table() -> Result<Table, Box<dyn Error>> {
    let mut names = Vec::new();
    for entry in std::fs::read_dir(scenes())? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "toml")
            && let Some(name) = path.file_stem()
        {
            names.push(name.to_string_lossy().into_owned());
        }
    }
    names.sort();
    let rows = names.iter().flat_map(|scene| {
        MOVED.map(|(engine, has_contact)| Row {
            names: vec![
                scene.clone(),
                engine.to_owned(),
                if has_contact { "yes" } else { "no" }.to_owned(),
            ],
            motion: Motion {
                scene: scene.clone(),
                has_contact,
                settings: vec![format!("motion.engine={engine}")],
            },
        })
    });
    Ok(Table {
        title: "Every scene with contact, without, and moved by the dynamic engine.".to_owned(),
        columns: [
            &["scene", "engine", "contact"],
            &["verdict", "outcome", "check, s", "second proof, s", "second proof"],
        ],
        rows: rows.collect(),
        cells: |checked| {
            vec![
                checked.verdict(),
                checked.outcome(),
                format!("{:.2}", checked.report.seconds.check),
                format!("{:.2}", checked.verify_seconds),
                checked.second_proof(),
            ]
        },
    })
}
