//! Reads FOLD 1.0 to 1.2 as a motion, one frame at a time.
//!
//! Source: Demaine, Ku, Lang, "A New File Standard to Represent Folded Structures" (FOLD specification 1.2).

mod error;
mod stream;
#[cfg(test)]
mod tests;
mod topology;
mod triangulate;
mod utf8;

use std::collections::BTreeMap;
use std::io::Read;

use glam::DVec3;

pub use error::{FoldError, FrameNumber};
use stream::FaceOrder;
pub(crate) use stream::{FrameFields, Keep, Walk, walk};

use crate::{Frame, LayerOrder, Sheet};

/// Frames whose coordinates, and those whose layer orders, are held because later frames inherit them.
const HELD_FRAMES: usize = 16;

/// A FOLD file without its frames, and what is needed to read those.
///
/// The keys of the file may stand in any order. The sheet is that of the key frame: its `faces_vertices`, cut into
/// triangles; its edges (built from the faces where they are missing; those of no face left out); M and V between
/// faces that turn alike, every other joined edge as F. The motion is the key frame, unless its `frame_classes` hold
/// `creasePattern` or it has no coordinates, and then every element of `file_frames`.
///
/// `sheet.vertices` are x and y of [`FoldFile::rest`]: the crease pattern where the key frame is one, otherwise the
/// first frame seen from above. Fold angles and lengths at rest are therefore not those of a crease pattern there.
/// `sheet.unit_length` is `foldmotion:unitLength`, otherwise the mean side of the faces at rest.
#[derive(Debug)]
pub struct FoldFile {
    /// `file_title`.
    pub title: Option<String>,
    /// `foldmotion:outcome`: how the run ended that made the motion, in its own words.
    pub outcome: Option<String>,
    /// What moves.
    pub sheet: Sheet,
    /// The face of the file each triangle of the sheet belongs to.
    pub triangle_faces: Vec<u32>,
    /// `faces_vertices`.
    pub polygons: Vec<Vec<u32>>,
    /// Whether `faces_foldmotion:facet` names the facets.
    pub has_facets: bool,
    /// Whether `foldmotion:unitLength` gives the unit of length.
    pub has_unit_length: bool,
    /// Whether every frame of the motion has a `foldmotion:time`.
    pub has_times: bool,
    /// `frame_unit` of the key frame.
    pub unit: Option<String>,
    /// The coordinates of the key frame, of `file_frames[0]` where it has none.
    pub rest: Vec<DVec3>,
    /// `faceOrders` of the key frame.
    key_order: LayerOrder,
    /// The frames of the motion.
    frames: Vec<FrameSource>,
    /// `edges_vertices` of the key frame.
    edges: Option<Vec<[u32; 2]>>,
}

/// Where a frame of the motion takes its coordinates from.
#[derive(Debug, Clone, Copy)]
struct FrameSource {
    number: FrameNumber,
    time: f64,
    /// The frame that has them: itself or one it inherits from.
    source: FrameNumber,
    /// The frame that has its `faceOrders`, if any has.
    order_source: Option<FrameNumber>,
}

/// What the first walk notes of a frame.
struct Noted {
    parent: Option<u64>,
    inherit: bool,
    time: Option<f64>,
    has_coordinates: bool,
    has_orders: bool,
}

impl FoldFile {
    /// Reads everything but the frames; their numbers are passed over.
    ///
    /// # Errors
    /// [`FoldError`]: text that is no JSON, a sheet that cannot be built, frames that inherit wrongly.
    pub fn read(input: impl Read) -> Result<Self, FoldError> {
        let mut noted = Vec::new();
        let mut first = Vec::new();
        let keep = |number: FrameNumber| Keep {
            coordinates: number.0 <= 1,
            topology: number.0 == 0,
            rest: false,
        };
        let mut note = |number: FrameNumber, fields: FrameFields| {
            if number.0 == 1 {
                first = fields.coordinates;
            }
            noted.push(Noted {
                parent: fields.parent,
                inherit: fields.inherit,
                time: fields.time,
                has_coordinates: fields.has_coordinates,
                has_orders: fields.has_orders,
            });
            true
        };
        let mut key = walk(
            input,
            Walk {
                keep: &keep,
                each: &mut note,
            },
        )?;
        let polygons = key.faces.take().filter(|f| !f.is_empty());
        let polygons = polygons.ok_or_else(|| missing(0, "faces_vertices", NEED_FACES))?;
        let rest = if key.has_coordinates {
            std::mem::take(&mut key.coordinates)
        } else {
            first
        };
        if rest.is_empty() {
            return Err(missing(0, "vertices_coords", NEED_COORDINATES));
        }
        let topology = topology::build(&key, &polygons, &rest)?;
        let orders = std::mem::take(&mut key.orders);
        let key_order = layer_order(FrameNumber(0), &orders, polygons.len())?;
        let (frames, has_times) = motion_frames(&key, &noted)?;
        Ok(Self {
            frames,
            has_times,
            unit: key.unit,
            title: key.title,
            outcome: key.outcome,
            sheet: topology.sheet,
            triangle_faces: topology.faces,
            polygons,
            has_facets: key.facets.is_some(),
            has_unit_length: key.unit_length.is_some(),
            rest,
            key_order,
            edges: key.edges,
        })
    }

    /// How many frames the motion has; at least one.
    pub fn frame_count(&self) -> usize {
        self.frames.len()
    }

    /// The FOLD number of frame `index` of the motion.
    pub fn frame_number(&self, index: usize) -> Option<FrameNumber> {
        self.frames.get(index).map(|f| f.number)
    }

    /// Reads the frames of the motion from the same text and hands each to `each`, in order, with the order of the
    /// faces of the file (not of the triangles) that its `faceOrders` claim; empty where it has none.
    ///
    /// Entries of sign 0, an order that is not known, are left out.
    /// A frame's time is its `foldmotion:time`, its index in the motion where any frame has none. At a time, the
    /// frame being read is held, and those whose coordinates later frames inherit.
    ///
    /// # Errors
    /// [`FoldError`] where a frame cannot be read or has other vertices or faces than the sheet; what `each` returns.
    pub fn frames<E: From<FoldError>>(
        &self,
        input: impl Read,
        each: &mut dyn FnMut(Frame, &LayerOrder) -> Result<(), E>,
    ) -> Result<(), E> {
        let frames = self.frames.iter();
        let orders = frames.clone().map(|f| (f.order_source, f.number));
        let mut reading = Reading {
            file: self,
            next: 0,
            positions: Held::new(frames.map(|f| (Some(f.source), f.number)).collect()),
            orders: Held::new(orders.collect()),
            each,
        };
        reading.supply(FrameNumber(0), self.rest.clone(), self.key_order.clone())?;
        let mut failure = None;
        let keep = |number: FrameNumber| Keep {
            coordinates: number.0 > 0,
            topology: number.0 > 0,
            rest: false,
        };
        let mut read = |number, fields| {
            let outcome = reading.take(number, fields);
            failure = outcome.err();
            failure.is_none()
        };
        let walked = walk(
            input,
            Walk {
                keep: &keep,
                each: &mut read,
            },
        );
        match failure {
            Some(failure) => Err(failure),
            None => walked.map(drop).map_err(E::from),
        }
    }
}

const NEED_FACES: &str = "the sheet is made of the key frame's faces";
const NEED_COORDINATES: &str = "one position for every vertex is needed there or in file_frames[0]";
const NEED_OWN: &str = "a frame that does not inherit (frame_inherit) must be complete";

fn missing(frame: usize, key: &'static str, need: &'static str) -> FoldError {
    FoldError::Missing {
        frame: FrameNumber(frame),
        key,
        need,
    }
}

/// The frames of the motion: their times and where their coordinates stand; and whether the file gives the times.
fn motion_frames(
    key: &FrameFields,
    noted: &[Noted],
) -> Result<(Vec<FrameSource>, bool), FoldError> {
    let is_pattern = key.classes.iter().any(|class| class == "creasePattern");
    let has_key = key.has_coordinates && (!is_pattern || noted.is_empty());
    // Parents come before their children, so that chains of inheritance end at the key frame.
    let mut sources = vec![key.has_coordinates.then_some(0)];
    let mut orders = vec![key.has_orders.then_some(0)];
    for (index, frame) in noted.iter().enumerate() {
        let number = index + 1;
        let parent = frame.parent.filter(|&p| p < number as u64);
        if (frame.inherit || frame.parent.is_some()) && parent.is_none() {
            return Err(FoldError::Parent {
                frame: FrameNumber(number),
                parent: frame.parent.map_or("none".to_owned(), |p| p.to_string()),
            });
        }
        let parent = parent.filter(|_| frame.inherit);
        let from = |has_own: bool, sources: &[Option<usize>]| match parent {
            _ if has_own => Some(number),
            Some(parent) => sources[parent as usize],
            None => None,
        };
        let source = from(frame.has_coordinates, &sources);
        if source.is_none() {
            return Err(missing(number, "vertices_coords", NEED_OWN));
        }
        sources.push(source);
        orders.push(from(frame.has_orders, &orders));
    }
    let times: Option<Vec<f64>> = std::iter::once(key.time)
        .filter(|_| has_key)
        .chain(noted.iter().map(|n| n.time))
        .collect();
    let numbers = (usize::from(!has_key)..sources.len()).filter_map(|n| Some((n, sources[n]?)));
    let frames = numbers
        .enumerate()
        .map(|(index, (number, source))| FrameSource {
            number: FrameNumber(number),
            time: times.as_ref().map_or(index as f64, |t| t[index]),
            source: FrameNumber(source),
            order_source: orders[number].map(FrameNumber),
        });
    Ok((frames.collect(), times.is_some()))
}

/// The order that `faceOrders` claim.
fn layer_order(
    frame: FrameNumber,
    orders: &[FaceOrder],
    faces: usize,
) -> Result<LayerOrder, FoldError> {
    let mut order = LayerOrder::default();
    for (entry, &(f, g, sign)) in orders.iter().enumerate() {
        let is_in_range = (f as usize) < faces && (g as usize) < faces;
        if !is_in_range || f == g || !(-1..=1).contains(&sign) {
            return Err(FoldError::FaceOrder {
                frame,
                entry,
                order: (f, g, sign),
                faces,
            });
        }
        if sign == 0 {
            continue;
        }
        if order.sign(f, g).is_some_and(|known| known != sign) {
            return Err(FoldError::TwoOrders { frame, entry, f, g });
        }
        order.insert(f, g, sign);
    }
    Ok(order)
}

/// What frames say themselves, held as long as later frames inherit it.
struct Held<T> {
    /// The last frame of the motion that takes its value from each source.
    last_use: BTreeMap<usize, usize>,
    values: BTreeMap<usize, T>,
}

impl<T: Clone + Default> Held<T> {
    fn new(uses: Vec<(Option<FrameNumber>, FrameNumber)>) -> Self {
        let uses = uses.into_iter();
        Self {
            last_use: uses.filter_map(|(s, f)| Some((s?.0, f.0))).collect(),
            values: BTreeMap::new(),
        }
    }

    /// Holds the value of frame `number` if a later frame needs it.
    fn keep(&mut self, number: FrameNumber, own: &T) -> Result<(), FoldError> {
        let last = self.last_use.get(&number.0);
        if last.is_some_and(|&last| last > number.0) {
            self.values.insert(number.0, own.clone());
            if self.values.len() > HELD_FRAMES {
                return Err(FoldError::HeldFrames {
                    frame: number,
                    held: self.values.len(),
                    limit: HELD_FRAMES,
                });
            }
        }
        Ok(())
    }

    /// The value of frame `number`, which takes it from `source`.
    fn value(&mut self, number: FrameNumber, source: Option<FrameNumber>, own: T) -> T {
        let Some(source) = source else {
            return T::default();
        };
        let value = if source == number {
            own
        } else {
            self.values.get(&source.0).cloned().unwrap_or_default()
        };
        if self.last_use.get(&source.0) == Some(&number.0) {
            self.values.remove(&source.0);
        }
        value
    }
}

/// The second walk under way.
struct Reading<'a, E> {
    file: &'a FoldFile,
    /// The frame of the motion that comes next.
    next: usize,
    positions: Held<Vec<DVec3>>,
    orders: Held<LayerOrder>,
    each: &'a mut dyn FnMut(Frame, &LayerOrder) -> Result<(), E>,
}

impl<E: From<FoldError>> Reading<'_, E> {
    fn take(&mut self, number: FrameNumber, fields: FrameFields) -> Result<(), E> {
        self.same_topology(number, &fields)?;
        let order = layer_order(number, &fields.orders, self.file.polygons.len())?;
        self.supply(number, fields.coordinates, order)
    }

    fn same_topology(&self, number: FrameNumber, fields: &FrameFields) -> Result<(), FoldError> {
        let file = self.file;
        if !fields.inherit && fields.faces.is_none() {
            return Err(missing(number.0, "faces_vertices", NEED_OWN));
        }
        let other_faces = fields.faces.as_ref().is_some_and(|f| *f != file.polygons);
        let known = file.edges.as_ref();
        let other_edges = matches!((&fields.edges, known), (Some(own), Some(key)) if own != key);
        if other_faces || other_edges {
            return Err(FoldError::OtherTopology { frame: number });
        }
        let (found, expected) = (fields.coordinates.len(), file.rest.len());
        if fields.has_coordinates && found != expected {
            return Err(FoldError::Count {
                frame: number,
                key: "vertices_coords",
                found,
                expected,
                of: "the vertices of the first frame",
            });
        }
        Ok(())
    }

    /// Hands on frame `number`, if it belongs to the motion, and holds what it says as long as it is needed.
    fn supply(
        &mut self,
        number: FrameNumber,
        own: Vec<DVec3>,
        own_order: LayerOrder,
    ) -> Result<(), E> {
        self.positions.keep(number, &own)?;
        self.orders.keep(number, &own_order)?;
        let file = self.file;
        let Some(frame) = file.frames.get(self.next).filter(|f| f.number == number) else {
            return Ok(());
        };
        let positions = self.positions.value(number, Some(frame.source), own);
        let order = self.orders.value(number, frame.order_source, own_order);
        self.next += 1;
        let time = frame.time;
        (self.each)(Frame { time, positions }, &order)
    }
}
