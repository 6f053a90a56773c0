//! The creases of an imported pattern that a step names by id, class or edge.

use std::collections::BTreeSet;

use foldmotion_pattern::{ImportedPattern, Names, Source};

use super::input::Input;
use crate::StudyError;
use crate::scene::StepScene;

/// The most names that an error lists.
const MOST_LISTED: usize = 12;

/// The edges that the step with this index names; `None` if it names none in these ways, and so all.
pub(super) fn named_edges(
    input: &Input<'_>,
    index: usize,
    step: &StepScene,
    imported: &ImportedPattern,
) -> Result<Option<BTreeSet<u32>>, StudyError> {
    if step.ids.is_none() && step.classes.is_none() && step.edges.is_none() {
        return Ok(None);
    }
    let mut found = BTreeSet::new();
    for (key, wanted, of) in [
        ("ids", &step.ids, (|names| &names.ids) as fn(&Names) -> &Vec<String>),
        ("classes", &step.classes, |names| &names.classes),
    ] {
        for name in wanted.iter().flatten() {
            let edges = edges_called(imported, name, of);
            if edges.is_empty() {
                let message = unknown(imported, name, of);
                return Err(input.error(&format!("motion.step.{index}.{key}"), message));
            }
            found.extend(edges);
        }
    }
    for &edge in step.edges.iter().flatten() {
        let edges = edges_numbered(imported, edge);
        if edges.is_empty() {
            let message = format!("the pattern has no edge {edge}");
            return Err(input.error(&format!("motion.step.{index}.edges"), message));
        }
        found.extend(edges);
    }
    Ok(Some(found))
}

fn edges_called(
    imported: &ImportedPattern,
    name: &str,
    of: fn(&Names) -> &Vec<String>,
) -> Vec<u32> {
    let is_called = |source: &Option<u32>| {
        let names = source.and_then(|source| imported.names.get(source as usize));
        names.is_some_and(|names| of(names).iter().any(|known| known == name))
    };
    let edges = (0..).zip(&imported.edge_sources);
    edges.filter(|(_, source)| is_called(source)).map(|(edge, _)| edge).collect()
}

/// The edges that come from an edge of a FOLD file; in other formats the edge itself.
fn edges_numbered(imported: &ImportedPattern, number: i64) -> Vec<u32> {
    let Ok(number) = u32::try_from(number) else { return Vec::new() };
    let is_fold = imported.sources.iter().any(|source| matches!(source, Source::FoldEdge(_)));
    let edges = 0..imported.sheet.edges.len() as u32;
    if is_fold {
        let wanted = Source::FoldEdge(number);
        return edges.filter(|&edge| imported.edge_source(edge) == Some(&wanted)).collect();
    }
    edges.filter(|&edge| edge == number).collect()
}

fn unknown(imported: &ImportedPattern, name: &str, of: fn(&Names) -> &Vec<String>) -> String {
    let known: BTreeSet<&String> = imported.names.iter().flat_map(of).collect();
    let listed: Vec<&str> = known.iter().take(MOST_LISTED).map(|name| name.as_str()).collect();
    let more = if known.len() > MOST_LISTED { " and others" } else { "" };
    match listed.as_slice() {
        [] => format!("no line of the pattern is called {name:?}; none has such a name"),
        _ => format!(
            "no line of the sheet is called {name:?}; known are {}{more}",
            listed.join(", ")
        ),
    }
}
