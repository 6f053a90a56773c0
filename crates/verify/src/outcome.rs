//! What comes of a verification.

/// A statement that is false.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refutation {
    /// The field of the certificate.
    pub field: String,
    /// What it states.
    pub stated: String,
    /// What was found.
    pub found: String,
}

impl Refutation {
    #[expect(
        clippy::needless_pass_by_value,
        reason = "numbers and texts just made are handed over"
    )]
    /// A field, what it states and what was found.
    pub fn new(field: impl Into<String>, stated: impl ToString, found: impl ToString) -> Self {
        Self {
            field: field.into(),
            stated: stated.to_string(),
            found: found.to_string(),
        }
    }
}

/// What could be neither proved nor refuted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unproved {
    /// The triangles.
    pub faces: [u32; 2],
    /// The frame at the start of the interval.
    pub frame: usize,
    /// What is open.
    pub what: String,
}

/// What came of the second proof.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Verification {
    /// Statements found false.
    pub refuted: Vec<Refutation>,
    /// Statements left open.
    pub unproved: Vec<Unproved>,
    /// Pairs of triangles, counted once an interval.
    pub pairs: u64,
    /// Those whose swept boxes came near enough to be looked at.
    pub near: u64,
    /// Those followed by sides.
    pub followed: u64,
    /// Pairs that surely touch, and pairs that may.
    pub touching: [usize; 2],
}

impl Verification {
    /// Whether everything stated was proved again.
    pub fn is_verified(&self) -> bool {
        self.refuted.is_empty() && self.unproved.is_empty()
    }
}
