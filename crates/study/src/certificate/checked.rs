//! What came of the check of a motion file.

use std::fmt::Write as _;

use foldmotion_check::{FilterCounts, PairCounts};

use crate::certificate::Certificate;

/// What is proved of a motion file, and how much work that was.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedFile {
    /// What is proved.
    pub certificate: Certificate,
    /// Pairs of triangles judged, counted once an interval.
    pub pairs_tested: PairCounts,
    /// What decided them, counted once an interval.
    pub decided_by: FilterCounts,
    /// Pairs of triangles that touch or were not shown to keep apart.
    pub touching_pairs: usize,
}

impl CheckedFile {
    /// The table for the terminal: the certificate, then the work.
    pub fn table(&self) -> String {
        let mut out = self.certificate.table();
        // Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "work: {} pairs of triangles tested, {:.4} % of them shown apart by boxes and axes alone, without trying all axes; {} \
             touch",
            self.pairs_tested.total(),
            100.0 * self.decided_by.share_without_search(),
            self.touching_pairs
        );
        out
    }
}
