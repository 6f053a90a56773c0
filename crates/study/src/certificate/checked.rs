//! The result of the check of a motion file.

use std::fmt::Write as _;

use foldmotion_check::{FilterCounts, PairCounts};

use crate::certificate::Certificate;

/// The certificate of a motion file, with counts of the work that the check did.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedFile {
    /// What was proved about the motion.
    pub certificate: Certificate,
    /// The number of pairs of triangles tested, counted once for each interval between frames.
    pub pairs_tested: PairCounts,
    /// What decided these pairs, counted once for each interval between frames.
    pub decided_by: FilterCounts,
    /// The number of pairs of triangles that touch or were not shown to stay apart.
    pub touching_pairs: usize,
}

impl CheckedFile {
    /// The table for the terminal: the certificate and the counts of work.
    pub fn table(&self) -> String {
        let mut out = self.certificate.table();
        // Writing into a string cannot fail.
        let _ = writeln!(
            out,
            "work: {} pairs of triangles tested, {:.4} % of them decided without trying all axes; {} touch",
            self.pairs_tested.total(),
            100.0 * self.decided_by.share_without_search(),
            self.touching_pairs
        );
        out
    }
}
