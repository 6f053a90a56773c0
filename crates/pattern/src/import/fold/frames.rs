//! The frames of a FOLD file and what they inherit.

use glam::DVec3;
use serde_json::{Map, Value};

use super::super::ImportError;
use super::super::warning::WarningKind;
use crate::fold::{FrameFields, FrameVisitor, Selection, read_frames};
use crate::{FoldError, FrameNumber};

/// The most frames.
const MOST_FRAMES: usize = 100_000;

/// Every frame, the key frame first.
pub(super) struct Frames {
    list: Vec<FrameFields>,
}

impl Frames {
    /// Reads the frames; each inherits from one before it.
    pub(super) fn read(bytes: &[u8]) -> Result<Self, ImportError> {
        let mut list = vec![FrameFields::default()];
        let select = |_| Selection { coordinates: true, topology: true, rest: true };
        let mut each = |_, fields| {
            list.push(fields);
            list.len() <= MOST_FRAMES
        };
        let finished = read_frames(bytes, FrameVisitor { select: &select, each: &mut each });
        if list.len() > MOST_FRAMES {
            return Err(ImportError::TooMany {
                what: "frames",
                found: list.len(),
                limit: MOST_FRAMES,
            });
        }
        list[0] = finished?;
        for (number, frame) in list.iter().enumerate().skip(1) {
            frame.parent(number)?;
        }
        Ok(Self { list })
    }

    /// The frame that is the pattern.
    pub(super) fn pattern(&self) -> Result<usize, ImportError> {
        let has_coordinates = |frame: usize| self.coordinates(frame).is_some_and(|c| !c.is_empty());
        let is_pattern = |frame: &usize| {
            let classes = &self.list[*frame].classes;
            has_coordinates(*frame) && classes.iter().any(|class| class == "creasePattern")
        };
        let frames = 0..self.list.len();
        let found = frames.clone().find(is_pattern);
        let first = frames.take(2).find(|&frame| has_coordinates(frame));
        found.or(first).ok_or_else(|| {
            let error = FoldError::Missing {
                frame: FrameNumber(0),
                key: "vertices_coords",
                need: "a crease pattern has a position for every vertex",
            };
            error.into()
        })
    }

    /// A value that a frame has itself or inherits.
    fn inherited<'a, T>(
        &'a self,
        mut frame: usize,
        own: impl Fn(&'a FrameFields) -> Option<T>,
    ) -> Option<T> {
        loop {
            let fields = &self.list[frame];
            let found = own(fields);
            if found.is_some() || !fields.inherit {
                return found;
            }
            frame = usize::try_from(fields.parent?).ok()?;
        }
    }

    pub(super) fn coordinates(&self, frame: usize) -> Option<&[DVec3]> {
        self.inherited(frame, |f| f.has_coordinates.then_some(f.coordinates.as_slice()))
    }

    pub(super) fn edges(&self, frame: usize) -> Option<&[[u32; 2]]> {
        self.inherited(frame, |f| f.edges.as_deref())
    }

    pub(super) fn assignments(&self, frame: usize) -> Option<&[String]> {
        self.inherited(frame, |f| f.assignments.as_deref())
    }

    pub(super) fn angles(&self, frame: usize) -> Option<&[Option<f64>]> {
        self.inherited(frame, |f| f.angles.as_deref())
    }

    pub(super) fn faces(&self, frame: usize) -> Option<&[Vec<u32>]> {
        self.inherited(frame, |f| f.faces.as_deref())
    }

    pub(super) fn unit(&self, frame: usize) -> Option<&str> {
        let own = self.inherited(frame, |f| f.unit.as_deref());
        own.or(self.list[0].unit.as_deref())
    }

    pub(super) fn unit_length(&self) -> Option<f64> {
        self.list[0].unit_length
    }

    /// The keys of the key frame that are not read.
    pub(super) fn keys(&self) -> &Map<String, Value> {
        &self.list[0].other
    }

    /// The orders of faces in the flat state: those of `pattern` itself, or of the first frame in the plane z = 0 that has
    /// some and inherits its faces.
    pub(super) fn face_orders(&self, pattern: usize) -> &[(u32, u32, i8)] {
        let is_flat = |frame: usize| {
            let coordinates = self.coordinates(frame).unwrap_or_default();
            self.list[frame].faces.is_none() && coordinates.iter().all(|p| p.z == 0.0)
        };
        let mut flat = (1..self.list.len()).filter(|&frame| is_flat(frame));
        let mut own = |frame: usize| Some(frame).filter(|&f| !self.list[f].orders.is_empty());
        let found = own(pattern).or_else(|| flat.find_map(&mut own));
        found.map_or(&[], |frame| self.list[frame].orders.as_slice())
    }

    pub(super) fn take_title(&mut self) -> Option<String> {
        self.list[0].title.take()
    }

    /// Whether a frame is the shape of a folded sheet.
    pub(super) fn is_folded(&self, frame: usize) -> bool {
        self.list[frame].classes.iter().any(|class| class == "foldedForm")
    }

    /// The stages of a motion: frames besides `pattern` with fold angles of their own.
    pub(super) fn stages(&self, pattern: usize) -> impl Iterator<Item = (usize, &FrameFields)> {
        let frames = self.with_angles(pattern);
        frames.filter(|(_, frame)| self.reason_against(frame).is_none())
    }

    /// The frames besides `pattern` that have fold angles of their own and are no stages, each with the reason.
    pub(super) fn not_stages(&self, pattern: usize) -> impl Iterator<Item = (usize, WarningKind)> {
        let frames = self.with_angles(pattern);
        frames.filter_map(|(number, frame)| Some((number, self.reason_against(frame)?)))
    }

    fn with_angles(&self, pattern: usize) -> impl Iterator<Item = (usize, &FrameFields)> {
        let frames = self.list.iter().enumerate();
        frames.filter(move |(number, f)| *number > 0 && *number != pattern && f.angles.is_some())
    }

    /// Why a frame is no stage: patterns and models are alternatives, and frames with a motion time are states of a
    /// motion towards the angles of the key frame.
    fn reason_against(&self, frame: &FrameFields) -> Option<WarningKind> {
        let of_file = self.list[0].other.get("file_classes");
        let is_multi_model = match of_file {
            Some(Value::String(class)) => class == "multiModel",
            Some(Value::Array(classes)) => classes.iter().any(|class| class == "multiModel"),
            _ => false,
        };
        if is_multi_model || frame.classes.iter().any(|class| class == "creasePattern") {
            return Some(WarningKind::Alternative);
        }
        frame.time.is_some().then_some(WarningKind::Recorded)
    }
}
