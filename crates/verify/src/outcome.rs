//! The result of a verification.

/// A statement that is false.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refutation {
    /// The field of the certificate that states it.
    pub field: String,
    /// What the certificate states.
    pub stated: String,
    /// What the second proof found instead.
    pub found: String,
}

impl Refutation {
    #[expect(
        clippy::needless_pass_by_value,
        reason = "numbers and texts just made are handed over"
    )]
    /// A refutation of a field, from what it states and what was found.
    pub fn new(field: impl Into<String>, stated: impl ToString, found: impl ToString) -> Self {
        Self { field: field.into(), stated: stated.to_string(), found: found.to_string() }
    }
}

/// A statement that could be neither proved nor refuted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unproved {
    /// The indices of the two triangles concerned.
    pub faces: [u32; 2],
    /// The index of the frame at the start of the interval.
    pub frame: usize,
    /// The question that remains open.
    pub what: String,
}

/// The result of the second proof.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Verification {
    /// The statements found false.
    pub refuted: Vec<Refutation>,
    /// The statements that could be neither proved nor refuted.
    pub unproved: Vec<Unproved>,
    /// The number of pairs of triangles, counted once for each interval.
    pub pairs: u64,
    /// The number of pairs whose swept boxes came close enough to be examined.
    pub near: u64,
    /// The number of pairs whose sides were followed.
    pub followed: u64,
    /// The number of pairs that surely touch, and of those that may.
    pub touching: [usize; 2],
}

impl Verification {
    /// Whether everything stated was proved again.
    pub fn is_verified(&self) -> bool {
        self.refuted.is_empty() && self.unproved.is_empty()
    }
}
