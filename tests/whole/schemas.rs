//! The JSON schemas in `schemas/` and the scene reference of the book are those of the types, and they describe every key.

use std::path::Path;

use foldmotion_paper::paper_schema;
use foldmotion_study::scene::fields::{fields, reference};
use foldmotion_study::{certificate_schema, report_schema, scene_schema};
use serde_json::Value;

/// The smallest length of a description.
const SHORTEST: usize = 30;

/// Compares a file of the repository with what the program makes of it, or writes it if `UPDATE_SCHEMAS` is set.
fn is_current(file: &str, text: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file);
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        std::fs::write(&path, text).unwrap();
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(stored == text, "{file} is not current: run the tests once with UPDATE_SCHEMAS=1");
}

#[test]
fn the_schema_of_the_scene_is_current() {
    is_current("schemas/scene.schema.json", &scene_schema());
}

#[test]
fn the_schema_of_the_report_is_current() {
    is_current("schemas/report.schema.json", &report_schema());
}

#[test]
fn the_schema_of_the_certificate_is_current() {
    is_current("schemas/certificate.schema.json", &certificate_schema());
}

#[test]
fn the_schema_of_the_paper_is_current() {
    is_current("schemas/paper.schema.json", &paper_schema());
}

#[test]
fn the_scene_reference_of_the_book_is_current() {
    is_current("docs/src/scene.md", &reference());
}

/// The keys of `node` and of all below it whose description is missing or too short.
fn undescribed(node: &Value, path: &str, found: &mut Vec<String>) {
    let properties = node.get("properties").and_then(Value::as_object);
    for (name, property) in properties.into_iter().flatten() {
        let text = property.get("description").and_then(Value::as_str);
        let text = text.unwrap_or_default();
        if text.chars().count() < SHORTEST {
            found.push(format!("{path}.{name}: {text:?}"));
        }
    }
    let definitions = node.get("$defs").and_then(Value::as_object);
    for (name, definition) in definitions.into_iter().flatten() {
        undescribed(definition, name, found);
    }
}

#[test]
fn every_key_of_the_schemas_is_described_in_thirty_characters_or_more() {
    for schema in [scene_schema(), report_schema(), certificate_schema(), paper_schema()] {
        let schema: Value = serde_json::from_str(&schema).unwrap();
        let mut found = Vec::new();
        let title = schema["title"].as_str().unwrap_or_default();
        undescribed(&schema, title, &mut found);
        assert!(found.is_empty(), "{}", found.join("\n"));
    }
    let mut found = Vec::new();
    undescribed(
        &serde_json::json!({ "properties": { "h": { "description": "Its h." } } }),
        "",
        &mut found,
    );
    assert_eq!(found.len(), 1);
}

#[test]
fn every_key_of_a_scene_has_a_default_unless_it_is_required() {
    // What a scene must say, what has no value by default, and lists.
    let without = [
        "profile.model",
        "profile.points",
        "profile.file",
        "profile.control_points",
        "sheet.lambda",
        "motion.step.stage",
        "pattern.file",
        "record.camera.azimuth",
        "record.camera.elevation",
    ];
    for field in fields().iter().filter(|field| !field.is_table) {
        let has_default = field.default_text().is_some();
        let expected = !without.contains(&field.key.as_str());
        assert_eq!(has_default, expected, "{}", field.key);
    }
}
