//! The schema of scene files, from which tooltips and menus take their texts.

use std::sync::LazyLock;

use serde_json::Value;

/// The schema, its descriptions on one line each.
static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let mut schema = serde_json::from_str(&foldmotion_study::scene_schema()).unwrap_or_default();
    join_lines(&mut schema);
    schema
});

/// Removes line breaks and Markdown's backticks from every description in `node`.
fn join_lines(node: &mut Value) {
    match node {
        Value::Object(keys) => {
            for (key, value) in keys {
                match value {
                    Value::String(text) if key == "description" => {
                        *text = text.replace('\n', " ").replace('`', "");
                    }
                    other => join_lines(other),
                }
            }
        }
        Value::Array(values) => values.iter_mut().for_each(join_lines),
        _ => {}
    }
}

/// The description of the dotted `key`, in which numbers stand for elements of a list; empty if there is no such key.
pub(super) fn description(key: &str) -> &'static str {
    node_of(key).map_or("", description_of)
}

/// The names that are possible values of `key`, each with its description.
pub(super) fn choices(key: &str) -> Vec<(&'static str, &'static str)> {
    node_of(key).map(choices_in).unwrap_or_default()
}

fn node_of(key: &str) -> Option<&'static Value> {
    key.split('.').try_fold(&*SCHEMA, child)
}

/// The property or list element `part` of a node, or of a schema that the node refers to.
fn child(node: &'static Value, part: &str) -> Option<&'static Value> {
    let property = node.get("properties").and_then(|keys| keys.get(part));
    let is_index = part.parse::<usize>().is_ok();
    let element = node.get("items").filter(|_| is_index);
    property
        .or(element)
        .or_else(|| referenced(node).find_map(|other| child(other, part)))
}

fn choices_in(node: &'static Value) -> Vec<(&'static str, &'static str)> {
    let variants = node.get("oneOf").and_then(Value::as_array);
    let variants = variants.into_iter().flatten();
    let named = variants.filter_map(|v| Some((v.get("const")?.as_str()?, description_of(v))));
    named.chain(referenced(node).flat_map(choices_in)).collect()
}

/// The schemas that a node refers to.
fn referenced(node: &'static Value) -> impl Iterator<Item = &'static Value> {
    let path = node.get("$ref").and_then(Value::as_str);
    let definition = path.and_then(|path| SCHEMA.pointer(path.trim_start_matches('#')));
    let alternatives = node.get("anyOf").and_then(Value::as_array);
    definition
        .into_iter()
        .chain(alternatives.into_iter().flatten())
}

fn description_of(node: &'static Value) -> &'static str {
    let text = node.get("description").and_then(Value::as_str);
    text.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found_in_tables_lists_and_alternatives() {
        for key in [
            "sheet.width",
            "motion.step.0.creases",
            "record.camera.azimuth",
            "pattern.unit",
        ] {
            let text = description(key);
            assert!(!text.is_empty() && !text.contains(['\n', '`']), "{key}");
        }
        assert_eq!(description("sheet.colour"), "");
        assert_eq!(description("motion.engine.0"), "");
    }

    #[test]
    fn choices_have_the_names_of_scene_files() {
        let names = |key| {
            choices(key)
                .iter()
                .map(|(name, _)| *name)
                .collect::<Vec<_>>()
        };
        assert_eq!(names("motion.engine"), ["quasi-static", "dynamic"]);
        assert_eq!(names("sheet.case"), ["E", "T", "S", "SII", "plain", "auto"]);
        assert_eq!(names("record.outputs.0").len(), 11);
        assert!(
            choices("profile.unit")
                .iter()
                .all(|(_, tip)| !tip.is_empty())
        );
        assert!(choices("sheet.width").is_empty());
    }
}
