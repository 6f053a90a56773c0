//! Where every triangle is hidden by another.

use super::{Scene, VisibleArea};

pub(super) fn fill(_scene: &Scene<'_>, _areas: &mut [VisibleArea]) {}
