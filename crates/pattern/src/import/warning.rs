//! Warnings: what an import changed or left out.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::Source;
use super::source::listed;

/// The most sources a warning names.
const MOST_NAMED: usize = 1_000;

/// What was changed or left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum WarningKind {
    /// A stroke or an element without a meaning is left out.
    Ignored,
    /// Auxiliary lines, whose colour is none of the six, are left out.
    Auxiliary,
    /// A colour that is none of the six was read as the one with the nearest hue.
    NearColour,
    /// Filled outlines without a stroke are the border, for no line is.
    FilledBorder,
    /// The outline of the lines was added as border, for there was none.
    AddedBorder,
    /// Curves became chords, and the facets beside curved creases are cut along rulings.
    Flattened,
    /// Border lines with the sheet on both sides are cuts.
    InnerBorder,
    /// Border lines inside the sheet that are a grid, as they cross each other or would part most creases, are left out or, if
    /// creases end on them, facet lines.
    InnerGrid,
    /// Pieces that nothing joins with the one that is read are left out.
    OtherPiece,
    /// An element that is not drawn (no stroke, hidden, in `defs`) is left out.
    NotDrawn,
    /// Ends of lines that nearly meet were made one vertex.
    Merged,
    /// Lines shorter than the tolerance are left out.
    TooShort,
    /// Lines were split where they cross or touch.
    Split,
    /// Lines on other lines are left out.
    Duplicate,
    /// Lines on other lines that say otherwise are left out.
    Conflict,
    /// Lines that end nowhere are left out.
    Stray,
    /// Straight lines of two pieces were made one.
    Joined,
    /// Lines beside the sheet or in its holes are left out.
    Outside,
    /// Lines at the edge of the sheet are its border, whatever they were drawn as.
    MadeBorder,
    /// Cuts that both ends hold together cannot open and act as free hinges.
    ClosedCut,
    /// Edges whose fold angle has the other sign than their assignment: the angle counts.
    OtherSign,
    /// Creases without a fold angle are free hinges.
    MadeFree,
    /// Edges without assignment or angle are free hinges.
    Unassigned,
    /// The listed faces do not fit the edges: the facets are found from the edges.
    StaleFaces,
    /// Edges that belong to no face are left out.
    NoFace,
    /// Vertices at which no line ends are left out.
    UnusedVertex,
    /// Faces that were listed clockwise were turned over.
    Turned,
    /// Frames with other edges than the pattern are no stages.
    OtherFrame,
    /// Frames that are patterns themselves are no stages.
    Alternative,
    /// The frames of a recorded motion are no stages.
    Recorded,
    /// A folded shape is unfolded: the angles between its facets are its fold angles.
    Unfolded,
}

impl WarningKind {
    fn text(self) -> &'static str {
        match self {
            Self::Ignored => "left out, for it has no meaning in a crease pattern",
            Self::Auxiliary => {
                "left out as an auxiliary line, for its colour is none of the six of crease patterns"
            }
            Self::NearColour => "read as the one of the six colours whose hue is nearest",
            Self::FilledBorder => "made border, for it is filled and no line is border",
            Self::AddedBorder => "added as border, for the drawing has none",
            Self::Flattened => {
                "a curve, replaced by chords; facets beside curved creases are cut along rulings"
            }
            Self::InnerBorder => "made a cut, for it is a border with the sheet on both sides",
            Self::InnerGrid => {
                "no border or cut inside the sheet, for border lines that cross each other or would cut most creases off are a grid"
            }
            Self::OtherPiece => {
                "left out with its piece, for nothing joins it to the one read; pattern.piece chooses another, or all"
            }
            Self::NotDrawn => "left out, for it is not drawn with a stroke",
            Self::Merged => "moved within the tolerance to an end near by",
            Self::TooShort => "left out, for it is shorter than the tolerance",
            Self::Split => "split where it meets other lines",
            Self::Duplicate => "left out, for it lies on another line",
            Self::Conflict => "left out, for it lies on a line that says otherwise",
            Self::Stray => "ignored: it has a dangling end",
            Self::Joined => "joined into one straight line",
            Self::Outside => "left out, for it lies beside the sheet or in a hole",
            Self::MadeBorder => "made border, for it lies at the edge of the sheet",
            Self::ClosedCut => {
                "made a free hinge: both ends of the cut hold together, so that it cannot open"
            }
            Self::OtherSign => "folded by its angle, whose sign contradicts its assignment",
            Self::MadeFree => "made a free hinge, for its fold angle is null",
            Self::Unassigned => "made a free hinge, for it has neither assignment nor angle",
            Self::StaleFaces => {
                "not a side of the listed faces, which are left out: the facets follow from the edges"
            }
            Self::NoFace | Self::UnusedVertex => "left out, for it belongs to no face",
            Self::Turned => "turned over, for it was listed clockwise",
            Self::OtherFrame => "no stage, for it has other edges than the pattern",
            Self::Alternative => "no stage, for it is a crease pattern or a model of its own",
            Self::Recorded => "no stage, for it is a frame of a recorded motion",
            Self::Unfolded => {
                "folded in space: laid out flat, to fold by the angles between its facets"
            }
        }
    }
}

/// A warning: changes or omissions of one kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// What was changed or left out.
    pub kind: WarningKind,
    /// Which, in order, each once: the first thousand.
    pub sources: Vec<Source>,
    /// The number of elements concerned in all.
    pub count: usize,
    /// What they were, such as their colours, each with the number of elements.
    pub details: Vec<(String, usize)>,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", listed(&self.sources), self.kind.text())?;
        let details: Vec<String> =
            self.details.iter().map(|(detail, count)| format!("{count} × {detail}")).collect();
        if details.is_empty() { Ok(()) } else { write!(f, " ({})", details.join(", ")) }
    }
}

/// The warnings in progress: each kind once.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    found: BTreeMap<WarningKind, BTreeSet<Source>>,
    details: BTreeMap<WarningKind, BTreeMap<String, usize>>,
}

impl Warnings {
    pub(super) fn add(&mut self, kind: WarningKind, source: &Source) {
        self.found.entry(kind).or_default().insert(source.clone());
    }

    /// Adds those found elsewhere.
    pub(super) fn append(&mut self, others: Self) {
        for (kind, sources) in others.found {
            self.found.entry(kind).or_default().extend(sources);
        }
        for (kind, details) in others.details {
            let known = self.details.entry(kind).or_default();
            for (detail, count) in details {
                *known.entry(detail).or_default() += count;
            }
        }
    }

    /// Adds an element with what it was.
    pub(super) fn add_as(&mut self, kind: WarningKind, source: &Source, detail: String) {
        *self.details.entry(kind).or_default().entry(detail).or_default() += 1;
        self.add(kind, source);
    }

    /// The warnings by kind.
    pub(super) fn finish(self) -> Vec<Warning> {
        let mut details = self.details;
        let warning = |(kind, sources): (WarningKind, BTreeSet<Source>)| Warning {
            kind,
            count: sources.len(),
            details: details.remove(&kind).unwrap_or_default().into_iter().collect(),
            sources: sources.into_iter().take(MOST_NAMED).collect(),
        };
        self.found.into_iter().map(warning).collect()
    }
}
