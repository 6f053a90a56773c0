//! The JSON schemas in `schemas/` are those of the types.

use std::path::Path;

use foldmotion_study::{certificate_schema, paper_schema, report_schema, scene_schema};

/// Compares a schema with its file, or writes the file where `UPDATE_SCHEMAS` is set.
fn is_current(name: &str, schema: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../schemas")
        .join(name);
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        std::fs::write(&path, schema).unwrap();
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        stored == schema,
        "schemas/{name} is not current: run the tests once with UPDATE_SCHEMAS=1"
    );
}

#[test]
fn the_schema_of_the_scene_is_current() {
    is_current("scene.schema.json", &scene_schema());
}

#[test]
fn the_schema_of_the_report_is_current() {
    is_current("report.schema.json", &report_schema());
}

#[test]
fn the_schema_of_the_certificate_is_current() {
    is_current("certificate.schema.json", &certificate_schema());
}

#[test]
fn the_schema_of_the_paper_is_current() {
    is_current("paper.schema.json", &paper_schema());
}
