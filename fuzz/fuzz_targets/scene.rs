//! Any text as a scene: read or refused.
#![no_main]

use std::path::Path;

use foldmotion_study::SceneSource;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let source = SceneSource::new(Path::new("fuzz.toml"), text.to_owned());
    if let Err(error) = source.scene() {
        assert!(!error.to_string().is_empty());
    }
});
