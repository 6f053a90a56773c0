//! The JSON schemas of the files.

use schemars::{JsonSchema, schema_for};

use crate::{Certificate, Report, Scene};

/// The schema of scene files.
pub fn scene_schema() -> String {
    schema_text::<Scene>()
}

/// The schema of `report.json`.
pub fn report_schema() -> String {
    schema_text::<Report>()
}

/// The schema of `certificate.json`.
pub fn certificate_schema() -> String {
    schema_text::<Certificate>()
}

/// The schema of a type, as the text of a file.
pub fn schema_text<T: JsonSchema>() -> String {
    // A schema is plain JSON with string keys, which always serialises.
    let mut text = serde_json::to_string_pretty(&schema_for!(T)).unwrap_or_default();
    text.push('\n');
    text
}
