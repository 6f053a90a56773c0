//! What is folded: units and sheets of each case, their exact states and closed forms, and the motions of a sheet.
//!
//! A [`Sheet`] is a triangulated crease pattern in the plane (rows along −x, width along +y, front towards +z).
//! A [`UnitSheet`] is a sheet of unfolded-waterbomb units with its exact states. A [`Frame`] is a sheet at one motion
//! time; a [`Motion`] is the sheet with its frames. Motion time t: 0 deployed, 1 planar, 2 compact.
//!
//! The science is the paper "Constructing foldable cylindrical surfaces via unfolded waterbomb origami units";
//! equation, figure and table numbers in this crate are that paper's.

mod clash_figure;
mod closed_form;
mod cut;
mod delaunay;
mod error;
mod facet_model;
mod fold;
mod folding;
mod import;
mod layer_count;
mod layer_order;
mod layers;
mod map;
mod model;
mod motion;
mod outline;
mod sheet;
mod skin;
mod states;
mod unequal;
mod unit;
mod unit_sheet;
mod vertex_check;
mod vertex_names;

pub use clash_figure::clash_figure;
pub use closed_form::CompactBox;
pub use cut::{
    CutError, CutLine, CutOptions, CutPage, CutPattern, LineClass, PageLayout, PageNumber,
    PaperSize, Tiles, crease_pattern_fold, parse_millimetres, pattern_dxf, pattern_svg,
};
pub use error::PatternError;
pub use facet_model::FacetModel;
pub use fold::{FoldError, FoldFile, FoldHeader, FrameNumber};
pub use folding::Folding;
pub use import::{
    CURVE_TOLERANCE, CurvedFacets, DroppedCrease, ImportError, ImportOptions, ImportedPattern,
    LARGEST_IMPORT_FILE, LengthUnit, MOST_LINES, MOST_NESTED, MOST_NODES, MOST_PIECES,
    MOST_STAGE_ANGLES, MOST_STYLE_RULES, MOST_VERTICES, Mending, MergeTolerance, Names,
    PatternFileFormat, PatternStage, Pieces, Source, UnknownElements, Warning, WarningKind,
    import_fold, import_pattern, import_svg,
};
pub use layer_order::{
    ConditionCounts, FlatFolding, FlatState, FoundLayers, LayerError, LayerOptions,
};
pub use model::{CaseColumns, NacaSection, ProfileModel, Shape, find as find_model, models};
pub use motion::{Frame, LayerOrder, Motion};
pub use outline::{LARGEST_OUTLINE_FILE, Outline, OutlineError};
pub use sheet::{Assignment, CreaseKind, Edge, Facet, FacetKind, Sheet};
pub use skin::{Skin, SkinPlane};
pub use states::Facing;
pub use unequal::{Clash, clashes, common_flap, own_cases};
pub use unit::{Case, EQUAL_WIDTH_TOLERANCE, Unit};
pub use unit_sheet::UnitSheet;
pub use vertex_check::{ANGLE_TOLERANCE, PatternCheck, VertexCheck, VertexGroup, VertexType};
