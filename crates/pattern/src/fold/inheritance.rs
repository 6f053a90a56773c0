//! What frames of a FOLD file inherit from earlier ones (`frame_parent`, `frame_inherit`).

use std::collections::BTreeMap;

use super::error::{FoldError, FrameNumber};
use super::frames::FrameFields;

/// The most frames whose coordinates, or whose layer orders, are held at one time for later frames.
const HELD_FRAMES: usize = 16;

/// A frame of the motion and the frames that its values come from.
#[derive(Debug, Clone, Copy)]
pub(super) struct FrameSource {
    pub(super) number: FrameNumber,
    pub(super) time: f64,
    /// The frame that has its coordinates: itself or one that it inherits from.
    pub(super) source: FrameNumber,
    /// The frame that has its `faceOrders`; `None` if neither it nor its parents have any.
    pub(super) order_source: Option<FrameNumber>,
}

/// The data of each frame that the first reading of a file keeps.
pub(super) struct FrameSummary {
    parent: Result<Option<usize>, FoldError>,
    time: Option<f64>,
    has_coordinates: bool,
    has_orders: bool,
}

impl FrameSummary {
    pub(super) fn new(number: FrameNumber, fields: &FrameFields) -> Self {
        Self {
            parent: fields.parent(number.0),
            time: fields.time,
            has_coordinates: fields.has_coordinates,
            has_orders: fields.has_orders,
        }
    }
}

/// The reason in [`FoldError::Missing`] for frames that inherit nothing.
pub(super) const NEED_OWN: &str = "a frame that does not inherit (frame_inherit) must be complete";

pub(super) fn missing(frame: usize, key: &'static str, need: &'static str) -> FoldError {
    FoldError::Missing { frame: FrameNumber(frame), key, need }
}

/// The frames of the motion with their times and the frames that have their coordinates, and whether the file gives all
/// times.
pub(super) fn motion_frames(
    key: &FrameFields,
    summaries: Vec<FrameSummary>,
) -> Result<(Vec<FrameSource>, bool), FoldError> {
    let is_pattern = key.classes.iter().any(|class| class == "creasePattern");
    let has_key = key.has_coordinates && (!is_pattern || summaries.is_empty());
    let times: Vec<Option<f64>> = summaries.iter().map(|frame| frame.time).collect();
    // Parents come before their children, so that chains of inheritance end at the key frame.
    let mut sources = vec![key.has_coordinates.then_some(0)];
    let mut orders = vec![key.has_orders.then_some(0)];
    for (index, frame) in summaries.into_iter().enumerate() {
        let number = index + 1;
        let parent = frame.parent?;
        let from = |has_own: bool, sources: &[Option<usize>]| match parent {
            _ if has_own => Some(number),
            Some(parent) => sources[parent],
            None => None,
        };
        let source = from(frame.has_coordinates, &sources);
        if source.is_none() {
            return Err(missing(number, "vertices_coords", NEED_OWN));
        }
        sources.push(source);
        orders.push(from(frame.has_orders, &orders));
    }
    let key_time = has_key.then_some(key.time).into_iter();
    let times: Option<Vec<f64>> = key_time.chain(times).collect();
    let numbers = (usize::from(!has_key)..sources.len()).filter_map(|n| Some((n, sources[n]?)));
    let frames = numbers.enumerate().map(|(index, (number, source))| FrameSource {
        number: FrameNumber(number),
        time: times.as_ref().map_or(index as f64, |t| t[index]),
        source: FrameNumber(source),
        order_source: orders[number].map(FrameNumber),
    });
    Ok((frames.collect(), times.is_some()))
}

/// Values of frames, held as long as later frames inherit them.
pub(super) struct Inherited<T> {
    /// The last frame of the motion that takes its value from each source.
    last_use: BTreeMap<usize, usize>,
    values: BTreeMap<usize, T>,
}

impl<T: Clone + Default> Inherited<T> {
    pub(super) fn new(uses: Vec<(Option<FrameNumber>, FrameNumber)>) -> Self {
        let uses = uses.into_iter();
        Self {
            last_use: uses.filter_map(|(s, f)| Some((s?.0, f.0))).collect(),
            values: BTreeMap::new(),
        }
    }

    /// Holds the value of frame `number` if a later frame inherits it.
    pub(super) fn hold(&mut self, number: FrameNumber, own: &T) -> Result<(), FoldError> {
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
    pub(super) fn value(&mut self, number: FrameNumber, source: Option<FrameNumber>, own: T) -> T {
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
