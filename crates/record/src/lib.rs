//! What is seen: pictures and films of a folding sheet, drawn on the CPU by one visible-surface path.
//!
//! A [`Camera`] projects the sheet in parallel, so that papers get equal scales. A [`Surface`] is the projected sheet
//! and answers which triangle is in front at a point of the screen; the layer order decides between triangles that
//! coincide. [`picture`] draws one state from it, [`film()`] a whole motion into every [`FilmWriter`] given: [`Gif`],
//! [`Mp4`], [`Frames`]. [`glb()`], [`obj()`] and [`stl()`] carry the sheet into 3D programs, [`vtp()`] and [`pvd()`] into
//! ParaView, [`page()`] into browsers. A
//! [`Drawing`] puts pictures beside crease patterns and words, as SVG and PNG.
//!
//! Screen coordinates are pixels, x to the right, y down, depth towards the viewer in pixels too. Colours are sRGB
//! bytes outside and linear light inside; pixels average linear light. The same input gives the same bytes for any
//! number of threads.
//!
//! ```
//! use foldmotion_pattern::{Assignment, CreaseKind, Edge, Facet, FacetKind, LayerOrder, Sheet};
//! use foldmotion_record::{Camera, Style, View, picture};
//! use glam::DVec2;
//!
//! let edge = |a, b| Edge {
//!     vertices: [a, b],
//!     assignment: Assignment::Border,
//!     kind: CreaseKind::Border,
//!     row: 0,
//!     column: 0,
//!     faces: [Some(0), None],
//! };
//! let sheet = Sheet {
//!     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
//!     edges: vec![edge(0, 1), edge(1, 2), edge(2, 0)],
//!     faces: vec![[0, 1, 2]],
//!     face_facets: vec![0],
//!     facets: vec![Facet { polygon: vec![0, 1, 2], row: 0, column: 0, kind: FacetKind::Plain }],
//!     unit_length: 1.0,
//! };
//! let (positions, size) = (sheet.planar(), [64, 48]);
//! let camera = Camera::fit(View::Top, positions.iter().copied(), size, 0.05)?;
//! let style = Style::default();
//! let image = picture(&sheet, &positions, &LayerOrder::default(), &camera, &style, size)?;
//! assert_eq!(image.pixel(0, 0), style.background);
//! # Ok::<(), foldmotion_record::RecordError>(())
//! ```

mod camera;
mod caption;
mod colour_map;
mod cutout;
mod drawing;
mod embedded;
mod error;
mod figure;
mod film;
mod film_writer;
mod follow;
mod frames;
mod gif;
mod glb;
mod glb_buffer;
mod h264;
mod image;
mod key_frames;
mod layers;
mod line_width;
mod marks;
mod mp4;
mod obj;
mod page;
mod palette;
mod paper;
mod pixel;
mod plots;
mod pvd;
mod raster;
mod ring;
mod screen_face;
mod segment;
mod shade;
mod solid;
mod square;
mod stl;
mod surface;
mod values;
mod visible;
mod vtp;

pub use self::camera::{Camera, View};
pub use self::colour_map::colour_of;
pub use self::drawing::{Anchor, Drawing, PIXELS_A_UNIT, Provenance, Stroke, png};
pub use self::embedded::embedded;
pub use self::error::RecordError;
pub use self::figure::{Bounds, Dimension, FigureState, Legend, LineStyle, StripOptions, strip};
pub use self::film::{FilmOptions, Playback, Shot, positions_at, timeline};
pub use self::film_writer::{FilmWriter, Picture, Scene, Title, film};
pub use self::frames::Frames;
pub use self::gif::{Gif, gif};
pub use self::glb::{GlbOptions, MAX_TARGETS, glb};
pub use self::h264::Mp4;
pub use self::image::{Image, MAX_PIXELS};
pub use self::key_frames::{KeyFrames, key_frames};
pub use self::layers::Layers;
pub use self::line_width::line_width;
pub use self::marks::{Marks, Spot};
pub use self::obj::obj;
pub use self::page::{Page, PageOptions, page};
pub use self::palette::Palette;
pub use self::paper::Paper;
pub use self::plots::{Curve, Panel, plots};
pub use self::pvd::pvd;
pub use self::raster::picture;
pub use self::shade::Style;
pub use self::solid::{Solid, solid, surface_of};
pub use self::stl::stl;
pub use self::surface::{Candidate, Surface, TIE_TOLERANCE};
pub use self::values::Values;
pub use self::visible::{Visible, VisibleArea, VisibleLine};
pub use self::vtp::{Field, vtp};
