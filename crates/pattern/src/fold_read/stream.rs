//! The walk over the text of a FOLD file: one frame at a time.

use std::cell::Cell;
use std::fmt;
use std::io::{BufReader, Read};

use glam::DVec3;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::error::{FoldError, FrameNumber};
use super::utf8::Utf8Reader;

/// Bytes read at a time.
const BUFFER: usize = 1 << 16;

/// What a frame says itself, before inheritance.
#[derive(Debug, Default)]
pub(crate) struct FrameFields {
    pub(crate) title: Option<String>,
    pub(crate) outcome: Option<String>,
    pub(crate) classes: Vec<String>,
    pub(crate) parent: Option<u64>,
    pub(crate) inherit: bool,
    pub(crate) time: Option<f64>,
    /// Whether the frame has coordinates, kept or not.
    pub(crate) has_coordinates: bool,
    pub(crate) coordinates: Vec<DVec3>,
    pub(crate) faces: Option<Vec<Vec<u32>>>,
    pub(crate) edges: Option<Vec<[u32; 2]>>,
    pub(crate) assignments: Option<Vec<String>>,
    pub(crate) facets: Option<Vec<u32>>,
    pub(crate) unit_length: Option<f64>,
    /// Whether the frame has `faceOrders`, kept or not.
    pub(crate) has_orders: bool,
    pub(crate) orders: Vec<FaceOrder>,
    /// `edges_foldAngle`, or `edges_foldAngles` of FOLD 1.0, degrees.
    pub(crate) angles: Option<Vec<Option<f64>>>,
    pub(crate) frame_title: Option<String>,
    pub(crate) unit: Option<String>,
    /// Every other key, where they are kept.
    pub(crate) other: serde_json::Map<String, serde_json::Value>,
    seen: Vec<String>,
}

/// An entry of `faceOrders`: [f, g, s].
pub(crate) type FaceOrder = (u32, u32, i8);

/// What of a frame is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Keep {
    /// Coordinates and the order of the layers.
    pub(crate) coordinates: bool,
    pub(crate) topology: bool,
    /// Fold angles, unit, and every key not known here.
    pub(crate) rest: bool,
}

/// What a walk keeps of which frame, and whom it tells of each.
pub(crate) struct Walk<'a> {
    pub(crate) keep: &'a dyn Fn(FrameNumber) -> Keep,
    /// Told every element of `file_frames` in order; false ends the walk.
    pub(crate) each: &'a mut dyn FnMut(FrameNumber, FrameFields) -> bool,
}

/// Walks over a file; returns the key frame.
pub(crate) fn walk(input: impl Read, walk: Walk<'_>) -> Result<FrameFields, FoldError> {
    let place = Place::default();
    let input = BufReader::with_capacity(BUFFER, Utf8Reader::new(input));
    let mut reader = serde_json::Deserializer::from_reader(input);
    let file = FileObject {
        walk,
        place: &place,
    };
    let read = reader.deserialize_map(file);
    read.and_then(|fields| {
        place.key.set("end of the file");
        place.element.set(None);
        reader.end().map(|()| fields)
    })
    .map_err(|e| FoldError::Json {
        place: place.to_string(),
        message: e.to_string(),
    })
}

/// What is being read, for messages.
#[derive(Debug, Default)]
struct Place {
    frame: Cell<usize>,
    key: Cell<&'static str>,
    element: Cell<Option<usize>>,
}

impl Place {
    fn enter(&self, key: &'static str) {
        self.key.set(key);
        self.element.set(None);
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", FrameNumber(self.frame.get()))?;
        if !self.key.get().is_empty() {
            write!(f, ", {}", self.key.get())?;
        }
        self.element
            .get()
            .map_or(Ok(()), |element| write!(f, "[{element}]"))
    }
}

/// The whole file: the key frame's keys beside `file_frames`.
struct FileObject<'a, 'b> {
    walk: Walk<'b>,
    place: &'a Place,
}

impl<'de> Visitor<'de> for FileObject<'_, '_> {
    type Value = FrameFields;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a FOLD file, a JSON object")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<FrameFields, A::Error> {
        let mut fields = FrameFields::default();
        let keep = (self.walk.keep)(FrameNumber(0));
        while let Some(key) = map.next_key::<String>()? {
            if key == "file_frames" {
                fields.once(&key)?;
                map.next_value_seed(FrameList {
                    walk: &mut self.walk,
                    place: self.place,
                })?;
                self.place.frame.set(0);
                self.place.enter("");
            } else {
                fields.read(&key, keep, self.place, &mut map)?;
            }
        }
        Ok(fields)
    }
}

/// The elements of `file_frames`.
struct FrameList<'a, 'b> {
    walk: &'a mut Walk<'b>,
    place: &'a Place,
}

impl<'de> DeserializeSeed<'de> for FrameList<'_, '_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for FrameList<'_, '_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of frames")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        for number in 1.. {
            self.place.frame.set(number);
            self.place.enter("");
            let number = FrameNumber(number);
            let frame = FrameObject {
                keep: (self.walk.keep)(number),
                place: self.place,
            };
            let Some(fields) = list.next_element_seed(frame)? else {
                break;
            };
            if !(self.walk.each)(number, fields) {
                return Err(A::Error::custom("the walk was ended here"));
            }
        }
        Ok(())
    }
}

/// One element of `file_frames`.
struct FrameObject<'a> {
    keep: Keep,
    place: &'a Place,
}

impl<'de> DeserializeSeed<'de> for FrameObject<'_> {
    type Value = FrameFields;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<FrameFields, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for FrameObject<'_> {
    type Value = FrameFields;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a frame, a JSON object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<FrameFields, A::Error> {
        let mut fields = FrameFields::default();
        while let Some(key) = map.next_key::<String>()? {
            fields.read(&key, self.keep, self.place, &mut map)?;
        }
        Ok(fields)
    }
}

impl FrameFields {
    /// Reads the value of `key`; values of no use here are passed over.
    fn read<'de, A: MapAccess<'de>>(
        &mut self,
        key: &str,
        keep: Keep,
        place: &Place,
        map: &mut A,
    ) -> Result<(), A::Error> {
        place.enter(known(key).unwrap_or(""));
        match known(key) {
            Some(known) => self.once(known)?,
            None if keep.rest => {
                self.once(key)?;
                self.other.insert(key.to_owned(), map.next_value()?);
                return Ok(());
            }
            None => return map.next_value::<IgnoredAny>().map(drop),
        }
        match key {
            "file_title" => self.title = Some(map.next_value()?),
            "foldmotion:outcome" => self.outcome = Some(map.next_value()?),
            "frame_classes" => self.classes = map.next_value()?,
            "frame_parent" => self.parent = Some(map.next_value()?),
            "frame_inherit" => self.inherit = map.next_value()?,
            "foldmotion:time" => self.time = Some(map.next_value()?),
            "foldmotion:unitLength" => self.unit_length = Some(map.next_value()?),
            "vertices_coords" => {
                self.has_coordinates = true;
                if keep.coordinates {
                    let points = map.next_value_seed(List::<Point>::new(place))?;
                    self.coordinates = points.into_iter().map(|p| p.0).collect();
                } else {
                    map.next_value::<IgnoredAny>()?;
                }
            }
            "faceOrders" => {
                self.has_orders = true;
                if keep.coordinates {
                    self.orders = map.next_value_seed(List::new(place))?;
                } else {
                    map.next_value::<IgnoredAny>()?;
                }
            }
            "frame_unit" if keep.topology && !keep.rest => {
                self.unit = Some(map.next_value()?);
            }
            "edges_foldAngle" | "edges_foldAngles" | "frame_title" | "frame_unit" if !keep.rest => {
                map.next_value::<IgnoredAny>()?;
            }
            "edges_foldAngle" | "edges_foldAngles" => {
                self.angles = Some(map.next_value_seed(List::new(place))?);
            }
            "frame_title" => self.frame_title = Some(map.next_value()?),
            "frame_unit" => self.unit = Some(map.next_value()?),
            _ if !keep.topology => drop(map.next_value::<IgnoredAny>()?),
            "faces_vertices" => self.faces = Some(map.next_value_seed(List::new(place))?),
            "edges_vertices" => self.edges = Some(map.next_value_seed(List::new(place))?),
            "edges_assignment" => self.assignments = Some(map.next_value_seed(List::new(place))?),
            _ => self.facets = Some(map.next_value_seed(List::new(place))?),
        }
        place.enter("");
        Ok(())
    }

    fn once<E: Error>(&mut self, key: &str) -> Result<(), E> {
        if self.seen.iter().any(|k| k == key) {
            return Err(E::custom(format_args!("the key {key} is given twice")));
        }
        self.seen.push(key.to_owned());
        Ok(())
    }
}

/// The keys that matter to a motion or a crease pattern.
fn known(key: &str) -> Option<&'static str> {
    const KEYS: [&str; 17] = [
        "edges_foldAngle",
        "edges_foldAngles",
        "frame_title",
        "frame_unit",
        "file_title",
        "frame_classes",
        "frame_parent",
        "frame_inherit",
        "foldmotion:outcome",
        "foldmotion:time",
        "foldmotion:unitLength",
        "vertices_coords",
        "faceOrders",
        "faces_vertices",
        "edges_vertices",
        "edges_assignment",
        "faces_foldmotion:facet",
    ];
    KEYS.into_iter().find(|&k| k == key)
}

/// A list whose elements are named in messages.
struct List<'a, T> {
    place: &'a Place,
    elements: Vec<T>,
}

impl<'a, T> List<'a, T> {
    fn new(place: &'a Place) -> Self {
        Self {
            place,
            elements: Vec::new(),
        }
    }
}

impl<'de, T: Deserialize<'de>> DeserializeSeed<'de> for List<'_, T> {
    type Value = Vec<T>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<T>, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for List<'_, T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut list: A) -> Result<Vec<T>, A::Error> {
        loop {
            self.place.element.set(Some(self.elements.len()));
            match list.next_element()? {
                Some(element) => self.elements.push(element),
                None => return Ok(self.elements),
            }
        }
    }
}

/// Two or three coordinates; the third is 0 where left out.
struct Point(DVec3);

impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PointVisitor)
    }
}

struct PointVisitor;

impl<'de> Visitor<'de> for PointVisitor {
    type Value = Point;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "2 or 3 finite coordinates")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Point, A::Error> {
        let mut point = DVec3::ZERO;
        let mut count = 0;
        while let Some(value) = list.next_element::<f64>()? {
            if count == 3 || !value.is_finite() {
                return Err(A::Error::custom(format_args!(
                    "coordinate {count} is {value}, expected 2 or 3 finite coordinates"
                )));
            }
            point[count] = value;
            count += 1;
        }
        if count < 2 {
            return Err(A::Error::invalid_length(count, &self));
        }
        Ok(Point(point))
    }
}
