//! The reader: the text of a FOLD file as a stream, one frame at a time.

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

/// The keys that a frame has itself, before inheritance.
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
    /// Every other key, if [`Selection::rest`] is set.
    pub(crate) other: serde_json::Map<String, serde_json::Value>,
    seen: Vec<String>,
}

/// An entry of `faceOrders`: [f, g, s].
pub(crate) type FaceOrder = (u32, u32, i8);

/// Which keys of a frame are kept; the values of others are skipped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Selection {
    /// Coordinates and the order of the layers.
    pub(crate) coordinates: bool,
    pub(crate) topology: bool,
    /// Fold angles, unit, and every key that is not listed in [`known`].
    pub(crate) rest: bool,
}

/// The two callbacks of [`read_frames`].
pub(crate) struct FrameVisitor<'a> {
    /// Which keys of a frame to keep.
    pub(crate) select: &'a dyn Fn(FrameNumber) -> Selection,
    /// Called with every element of `file_frames` in order; reading ends if it returns false.
    pub(crate) each: &'a mut dyn FnMut(FrameNumber, FrameFields) -> bool,
}

/// Reads a file from start to end and returns its key frame.
pub(crate) fn read_frames(
    input: impl Read,
    visitor: FrameVisitor<'_>,
) -> Result<FrameFields, FoldError> {
    let location = Location::default();
    let input = BufReader::with_capacity(BUFFER, Utf8Reader::new(input));
    let mut reader = serde_json::Deserializer::from_reader(input);
    let file = FileObject { visitor, location: &location };
    let read = reader.deserialize_map(file);
    read.and_then(|fields| {
        location.key.set("end of the file");
        location.element.set(None);
        reader.end().map(|()| fields)
    })
    .map_err(|e| FoldError::Json { location: location.to_string(), message: e.to_string() })
}

/// The frame, key and list element being read, for error messages.
#[derive(Debug, Default)]
struct Location {
    frame: Cell<usize>,
    key: Cell<&'static str>,
    element: Cell<Option<usize>>,
}

impl Location {
    fn enter(&self, key: &'static str) {
        self.key.set(key);
        self.element.set(None);
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", FrameNumber(self.frame.get()))?;
        if !self.key.get().is_empty() {
            write!(f, ", {}", self.key.get())?;
        }
        self.element.get().map_or(Ok(()), |element| write!(f, "[{element}]"))
    }
}

/// The whole file: the key frame's keys beside `file_frames`.
struct FileObject<'a, 'b> {
    visitor: FrameVisitor<'b>,
    location: &'a Location,
}

impl<'de> Visitor<'de> for FileObject<'_, '_> {
    type Value = FrameFields;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a FOLD file, a JSON object")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> Result<FrameFields, A::Error> {
        let mut fields = FrameFields::default();
        let select = (self.visitor.select)(FrameNumber(0));
        while let Some(key) = map.next_key::<String>()? {
            if key == "file_frames" {
                fields.once(&key)?;
                map.next_value_seed(FrameList {
                    visitor: &mut self.visitor,
                    location: self.location,
                })?;
                self.location.frame.set(0);
                self.location.enter("");
            } else {
                fields.read(&key, select, self.location, &mut map)?;
            }
        }
        Ok(fields)
    }
}

/// The elements of `file_frames`.
struct FrameList<'a, 'b> {
    visitor: &'a mut FrameVisitor<'b>,
    location: &'a Location,
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
            self.location.frame.set(number);
            self.location.enter("");
            let number = FrameNumber(number);
            let frame =
                FrameObject { select: (self.visitor.select)(number), location: self.location };
            let Some(fields) = list.next_element_seed(frame)? else {
                break;
            };
            if !(self.visitor.each)(number, fields) {
                return Err(A::Error::custom("reading ended here"));
            }
        }
        Ok(())
    }
}

/// One element of `file_frames`.
struct FrameObject<'a> {
    select: Selection,
    location: &'a Location,
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
            fields.read(&key, self.select, self.location, &mut map)?;
        }
        Ok(fields)
    }
}

impl FrameFields {
    /// The earlier frame that frame `number` inherits from, if it inherits.
    ///
    /// # Errors
    /// [`FoldError::Parent`] if it names itself, a later frame, or none although it inherits.
    pub(crate) fn parent(&self, number: usize) -> Result<Option<usize>, FoldError> {
        let earlier = |&parent: &u64| parent < number as u64;
        let parent = self.parent.filter(earlier);
        if (self.inherit || self.parent.is_some()) && parent.is_none() {
            return Err(FoldError::Parent {
                frame: FrameNumber(number),
                parent: self.parent.map_or("none".to_owned(), |p| p.to_string()),
            });
        }
        Ok(parent.filter(|_| self.inherit).map(|parent| parent as usize))
    }

    /// Reads the value of `key` or skips it.
    fn read<'de, A: MapAccess<'de>>(
        &mut self,
        key: &str,
        select: Selection,
        location: &Location,
        map: &mut A,
    ) -> Result<(), A::Error> {
        location.enter(known(key).unwrap_or(""));
        match known(key) {
            Some(known) => self.once(known)?,
            None if select.rest => {
                self.once(key)?;
                self.other.insert(key.to_owned(), map.next_value()?);
                return Ok(());
            }
            None => return map.next_value::<IgnoredAny>().map(drop),
        }
        match key {
            "file_title" => self.title = Some(map.next_value()?),
            "foldmotion:outcome" => self.outcome = Some(map.next_value()?),
            "frame_classes" => self.classes = map.next_value::<OneOrMany>()?.into(),
            "frame_parent" => self.parent = Some(map.next_value()?),
            "frame_inherit" => self.inherit = map.next_value()?,
            "foldmotion:time" => self.time = Some(map.next_value()?),
            "foldmotion:unitLength" => self.unit_length = Some(map.next_value()?),
            "vertices_coords" => {
                self.has_coordinates = true;
                if select.coordinates {
                    let points = map.next_value_seed(List::<Point>::new(location))?;
                    self.coordinates = points.into_iter().map(|p| p.0).collect();
                } else {
                    map.next_value::<IgnoredAny>()?;
                }
            }
            "faceOrders" => {
                self.has_orders = true;
                if select.coordinates {
                    self.orders = map.next_value_seed(List::new(location))?;
                } else {
                    map.next_value::<IgnoredAny>()?;
                }
            }
            "frame_unit" if select.topology && !select.rest => {
                self.unit = Some(map.next_value()?);
            }
            "edges_foldAngle" | "edges_foldAngles" | "frame_title" | "frame_unit"
                if !select.rest =>
            {
                map.next_value::<IgnoredAny>()?;
            }
            "edges_foldAngle" | "edges_foldAngles" => {
                self.angles = Some(map.next_value_seed(List::new(location))?);
            }
            "frame_title" => self.frame_title = Some(map.next_value()?),
            "frame_unit" => self.unit = Some(map.next_value()?),
            _ if !select.topology => drop(map.next_value::<IgnoredAny>()?),
            "faces_vertices" => self.faces = Some(map.next_value_seed(List::new(location))?),
            "edges_vertices" => self.edges = Some(map.next_value_seed(List::new(location))?),
            "edges_assignment" => {
                self.assignments = Some(map.next_value_seed(List::new(location))?);
            }
            _ => self.facets = Some(map.next_value_seed(List::new(location))?),
        }
        location.enter("");
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

/// `key` if it matters to a motion or a crease pattern.
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

/// A list of names, which some programs write as one name.
#[derive(Deserialize)]
#[serde(untagged)]
enum OneOrMany {
    One(String),
    Many(Vec<String>),
}

impl From<OneOrMany> for Vec<String> {
    fn from(names: OneOrMany) -> Self {
        match names {
            OneOrMany::One(name) => vec![name],
            OneOrMany::Many(names) => names,
        }
    }
}

/// A list whose elements are named in error messages by their index.
struct List<'a, T> {
    location: &'a Location,
    elements: Vec<T>,
}

impl<'a, T> List<'a, T> {
    fn new(location: &'a Location) -> Self {
        Self { location, elements: Vec::new() }
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
            self.location.element.set(Some(self.elements.len()));
            match list.next_element()? {
                Some(element) => self.elements.push(element),
                None => return Ok(self.elements),
            }
        }
    }
}

/// Two or three coordinates; the third is 0 if omitted.
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

/// Refuses a list element that names a vertex that does not exist.
pub(crate) fn check_vertices(
    key: &'static str,
    element: usize,
    corners: &[u32],
    vertices: usize,
) -> Result<(), FoldError> {
    match corners.iter().find(|&&v| v as usize >= vertices) {
        Some(&vertex) => Err(FoldError::VertexOutOfRange { key, element, vertex, vertices }),
        None => Ok(()),
    }
}
