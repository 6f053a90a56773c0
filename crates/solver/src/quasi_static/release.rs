//! Where creases end if contact lets go.

/// Contact is not what keeps creases from their targets if without it they are still this share as far off.
const STILL_OFF: f64 = 0.8;

/// How far creases are from their targets in the last state, and where the sheet goes if its layers may then pass through
/// each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Release {
    /// The mean |θ − θ*| of the creases with contact, radians.
    pub with_contact: f64,
    /// The same in the equilibrium that follows without contact.
    pub without_contact: f64,
}

impl Release {
    /// Whether contact keeps the creases from their targets, rather than the sheet's own stiffness.
    pub(super) fn is_jam(&self) -> bool {
        self.without_contact < STILL_OFF * self.with_contact
    }
}
