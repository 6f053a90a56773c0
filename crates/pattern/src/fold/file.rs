//! A FOLD file as a motion: read once for the sheet, then once more for the frames.

use std::io::Read;

use glam::DVec3;

use super::error::{FoldError, FrameNumber};
use super::frames::{FaceOrder, FrameFields, FrameVisitor, Selection, read_frames};
use super::inheritance::{FrameSource, FrameSummary, Inherited, NEED_OWN, missing, motion_frames};
use super::topology;
use crate::{Frame, LayerOrder, Sheet};

const NEED_FACES: &str = "the sheet is made of the key frame's faces";
const NEED_COORDINATES: &str = "one position for every vertex is needed there or in file_frames[0]";

/// A FOLD file without its frames, and what is needed to read those.
///
/// The keys of the file may be in any order. The sheet is that of the key frame: its `faces_vertices`, cut into
/// triangles, and its edges. Edges that the file does not list are built from the faces; edges of no face are left out.
/// Between faces of the same orientation M and V are kept; every other joined edge is F. The motion consists of the key
/// frame, unless its `frame_classes` include `creasePattern` or it has no coordinates, and of all `file_frames`.
///
/// `sheet.vertices` are x and y of [`FoldFile::rest`]: the crease pattern if the key frame is one, otherwise the first
/// frame seen from above, whose lengths and fold angles are not those of the crease pattern.
/// `sheet.unit_length` is `foldmotion:unitLength`; if that is missing, the mean side of the faces at rest.
#[derive(Debug)]
pub struct FoldFile {
    /// The title of the file, `file_title`.
    pub title: Option<String>,
    /// `foldmotion:outcome`: how the run ended that made the motion, in its own words.
    pub outcome: Option<String>,
    /// The triangulated sheet that moves.
    pub sheet: Sheet,
    /// The face of the file each triangle of the sheet belongs to.
    pub triangle_faces: Vec<u32>,
    /// The faces as the file lists them, `faces_vertices`.
    pub polygons: Vec<Vec<u32>>,
    /// Whether `faces_foldmotion:facet` names the facets.
    pub has_facets: bool,
    /// Whether `foldmotion:unitLength` gives the unit of length.
    pub has_unit_length: bool,
    /// Whether every frame of the motion has a `foldmotion:time`.
    pub has_times: bool,
    /// `frame_unit` of the key frame.
    pub unit: Option<String>,
    /// The coordinates of the key frame, or of `file_frames[0]` if the key frame has none.
    pub rest: Vec<DVec3>,
    /// `faceOrders` of the key frame.
    key_order: LayerOrder,
    /// The frames of the motion.
    frames: Vec<FrameSource>,
    /// `edges_vertices` of the key frame.
    edges: Option<Vec<[u32; 2]>>,
}

impl FoldFile {
    /// Reads everything but the frames, whose numbers are skipped.
    ///
    /// # Errors
    /// [`FoldError`]: text that is not JSON, a sheet that cannot be built, frames that inherit wrongly.
    pub fn read(input: impl Read) -> Result<Self, FoldError> {
        let mut summaries = Vec::new();
        let mut first = Vec::new();
        let select = |number: FrameNumber| Selection {
            coordinates: number.0 <= 1,
            topology: number.0 == 0,
            rest: false,
        };
        let mut summarise = |number: FrameNumber, fields: FrameFields| {
            summaries.push(FrameSummary::new(number, &fields));
            if number.0 == 1 {
                first = fields.coordinates;
            }
            true
        };
        let mut key = read_frames(input, FrameVisitor { select: &select, each: &mut summarise })?;
        let polygons = key.faces.take().filter(|f| !f.is_empty());
        let polygons = polygons.ok_or_else(|| missing(0, "faces_vertices", NEED_FACES))?;
        let rest = if key.has_coordinates { std::mem::take(&mut key.coordinates) } else { first };
        if rest.is_empty() {
            return Err(missing(0, "vertices_coords", NEED_COORDINATES));
        }
        let topology = topology::build(&key, &polygons, &rest)?;
        let orders = std::mem::take(&mut key.orders);
        let key_order = layer_order(FrameNumber(0), &orders, polygons.len())?;
        let (frames, has_times) = motion_frames(&key, summaries)?;
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

    /// The number of frames of the motion; at least one.
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
    /// Entries of sign 0, which say that an order is unknown, are left out. A frame's time is its `foldmotion:time`; if
    /// any frame has none, all times are indices. Only the frame being read and those that later frames inherit from
    /// are held in memory.
    ///
    /// # Errors
    /// [`FoldError`] if a frame cannot be read or its vertices or faces differ from those of the sheet; any error of `each`.
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
            positions: Inherited::new(frames.map(|f| (Some(f.source), f.number)).collect()),
            orders: Inherited::new(orders.collect()),
            each,
        };
        reading.supply(FrameNumber(0), self.rest.clone(), self.key_order.clone())?;
        let mut failure = None;
        let select = |number: FrameNumber| Selection {
            coordinates: number.0 > 0,
            topology: number.0 > 0,
            rest: false,
        };
        let mut read = |number, fields| {
            let outcome = reading.take(number, fields);
            failure = outcome.err();
            failure.is_none()
        };
        let finished = read_frames(input, FrameVisitor { select: &select, each: &mut read });
        match failure {
            Some(failure) => Err(failure),
            None => finished.map(drop).map_err(E::from),
        }
    }
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
            return Err(FoldError::FaceOrder { frame, entry, order: (f, g, sign), faces });
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

/// The state of reading the frames of a motion.
struct Reading<'a, E> {
    file: &'a FoldFile,
    /// The frame of the motion that comes next.
    next: usize,
    positions: Inherited<Vec<DVec3>>,
    orders: Inherited<LayerOrder>,
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

    /// Passes frame `number` on if it belongs to the motion, and holds its values as long as later frames inherit them.
    fn supply(
        &mut self,
        number: FrameNumber,
        own: Vec<DVec3>,
        own_order: LayerOrder,
    ) -> Result<(), E> {
        self.positions.hold(number, &own)?;
        self.orders.hold(number, &own_order)?;
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
