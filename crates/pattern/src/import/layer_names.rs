//! What the name of a layer, a group or a material says about its lines.

use super::colour::Meaning;
use super::drawing::Role;

/// The words by which each meaning is known, in names split at what is neither letter nor digit.
const WORDS: [(Meaning, &[&str]); 7] = [
    (Meaning::Auxiliary, &["aux", "auxiliary", "construction", "marks", "guide", "guides"]),
    (Meaning::Exact(Role::Mountain), &["m", "mountain", "mountains", "mtn", "山", "山折り"]),
    (Meaning::Exact(Role::Valley), &["v", "valley", "valleys", "谷", "谷折り"]),
    (Meaning::Exact(Role::Border), &["b", "border", "borders", "boundary", "outline", "edge"]),
    (Meaning::Exact(Role::Cut), &["c", "cut", "cuts", "slit", "slits"]),
    (Meaning::Exact(Role::Facet), &["f", "facet", "facets", "flat", "triangulation"]),
    (Meaning::Exact(Role::Free), &["u", "free", "hinge", "hinges", "unassigned"]),
];

/// What a name says; `None` if it says nothing.
pub(super) fn named_meaning(name: &str) -> Option<Meaning> {
    let name = name.to_lowercase();
    let words = || name.split(|c: char| !c.is_alphanumeric());
    let found = WORDS.iter().find(|(_, known)| words().any(|word| known.contains(&word)));
    found.map(|(meaning, _)| *meaning)
}
