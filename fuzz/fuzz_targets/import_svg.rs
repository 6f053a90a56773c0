//! Any bytes as SVG: read or refused, and what is read is a sheet.
#![no_main]

use foldmotion_pattern::{ImportOptions, MergeTolerance, UnknownElements, import_svg};
use libfuzzer_sys::fuzz_target;

mod sheet;

fuzz_target!(|bytes: &[u8]| {
    let lenient = ImportOptions {
        unknown: UnknownElements::Ignore,
        curve_tolerance: Some(0.01),
        merge: Some(MergeTolerance::Relative(1e-3)),
    };
    for options in [ImportOptions::default(), lenient] {
        if let Ok(imported) = import_svg(bytes, &options) {
            sheet::check(&imported);
        }
    }
});
