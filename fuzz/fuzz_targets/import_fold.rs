//! Any bytes as FOLD: read or refused, and what is read is a sheet that can be written and read again.
#![no_main]

use foldmotion_pattern::{ImportOptions, import_fold};
use libfuzzer_sys::fuzz_target;

mod sheet;

fuzz_target!(|bytes: &[u8]| {
    let options = ImportOptions::default();
    if let Ok(imported) = import_fold(bytes, &options) {
        sheet::check(&imported);
        let again = import_fold(imported.fold("fuzz").as_bytes(), &options);
        let again = again.expect("what is written can be read");
        assert_eq!(again.sheet.faces.len(), imported.sheet.faces.len());
    }
});
