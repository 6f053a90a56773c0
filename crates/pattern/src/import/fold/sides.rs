//! The sides of the faces of a FOLD file.

use std::collections::BTreeMap;

/// The faces at every side, by its ends in order.
pub(super) type Sides = BTreeMap<[u32; 2], Vec<u32>>;

pub(super) fn sides(faces: &[Vec<u32>]) -> Sides {
    let mut sides = Sides::new();
    for (face, index) in faces.iter().zip(0..) {
        for (&a, &b) in face.iter().zip(face.iter().cycle().skip(1)) {
            sides.entry([a.min(b), a.max(b)]).or_default().push(index);
        }
    }
    sides
}
