//! What is folded: units and sheets of each case, their exact states and closed forms, and the motions of a sheet.
//!
//! A [`Sheet`] is a triangulated crease pattern in the plane (rows along −x, width along +y, front towards +z).
//! A [`Frame`] is the sheet at one motion time; a [`Motion`] is the sheet with its frames.
//! Motion time t: 0 deployed, 1 planar, 2 compact.

mod motion;
mod sheet;

pub use motion::{Frame, LayerOrder, Motion};
pub use sheet::{Assignment, CreaseKind, Edge, Facet, FacetKind, Sheet};
