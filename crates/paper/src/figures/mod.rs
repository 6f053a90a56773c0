//! The figures, each a drawing with its caption.

mod gallery;
mod panel;
mod pattern;
mod states;
mod strips;
mod tessellation;
mod unequal;
mod units;

use foldmotion_record::{Drawing, RecordError};
use serde::{Deserialize, Serialize};

use super::PaperPart;
use super::motions::{PartProgress, strip_inputs};
use super::record::FigureRow;
use super::store::Store;
use crate::PaperError;
use foldmotion_study::sha256;

/// A finished figure.
#[derive(Debug, Clone)]
pub(super) struct Figure {
    pub(super) row: FigureRow,
    pub(super) svg: String,
}

/// A figure as it is stored.
#[derive(Debug, Serialize, Deserialize)]
struct StoredFigure {
    row: FigureRow,
    /// The SHA-256 of its SVG and its PNG file.
    hashes: [String; 2],
}

/// The parts that are figures.
fn parts() -> impl Iterator<Item = PaperPart> {
    let is_figure = |part: &PaperPart| matches!(part, PaperPart::Figure(_) | PaperPart::FigureA1);
    PaperPart::ALL.into_iter().filter(is_figure)
}

/// The inputs of a figure, as text.
fn inputs(part: PaperPart) -> String {
    let models = format!("{:?}", foldmotion_pattern::models());
    match part {
        PaperPart::FigureA1 => format!("{models}\n{}", strip_inputs()),
        _ => models,
    }
}

/// The figures that are unchanged in the folder.
pub(super) fn finished(store: &Store) -> Vec<Figure> {
    parts().filter_map(|part| find(store, part)).collect()
}

fn find(store: &Store, part: PaperPart) -> Option<Figure> {
    let StoredFigure { row, hashes } = store.find(part.name(), &inputs(part))?;
    let [svg, png] = [store.read_file(&row.files[0]), store.read_file(&row.files[1])];
    let (svg, png) = (svg.ok()?, png.ok()?);
    let is_whole = hashes == [sha256(&svg), sha256(&png)];
    let svg = String::from_utf8(svg).ok().filter(|_| is_whole)?;
    Some(Figure { row, svg })
}

/// Draws the figure `part` unless it is unchanged in the folder.
pub(super) fn draw(
    store: &Store,
    part: PaperPart,
    done: PartProgress<'_>,
) -> Result<(), PaperError> {
    let name = part.name();
    if find(store, part).is_none() {
        store.forget(name)?;
    }
    store.part(name, &inputs(part), || {
        let (drawing, caption) = compose(store, part)?;
        if !done(0.5) {
            return Err(PaperError::INTERRUPTED);
        }
        let files = [format!("{name}.svg"), format!("{name}.png")];
        let (svg, png) = (drawing.svg()?, drawing.png()?);
        store.write_file(&files[0], svg.as_bytes())?;
        store.write_file(&files[1], &png)?;
        let row = FigureRow { name: name.to_owned(), caption: caption.to_owned(), files };
        let hashes = [sha256(svg.as_bytes()), sha256(&png)];
        Ok(StoredFigure { row, hashes })
    })?;
    Ok(())
}

/// A figure with its caption.
type Composed = (Drawing, &'static str);

fn compose(store: &Store, part: PaperPart) -> Result<Composed, PaperError> {
    match part {
        PaperPart::Figure(1) => tessellation::figure1(),
        PaperPart::Figure(2) => states::figure2(),
        PaperPart::Figure(3) => units::figure3(),
        PaperPart::Figure(4) => units::figure4(),
        PaperPart::Figure(5) => units::figure5(),
        PaperPart::Figure(6) => gallery::figure6(),
        PaperPart::Figure(7) => gallery::figure7(),
        PaperPart::Figure(8) => gallery::figure8(),
        PaperPart::Figure(9) => gallery::figure9(),
        PaperPart::Figure(_) => unequal::figure10(),
        _ => strips::figure_a1(store),
    }
}

/// An empty page; sizes out of range are errors.
fn page(width: f64, height: f64) -> Result<Drawing, RecordError> {
    #[expect(clippy::cast_sign_loss, reason = "sizes of pages are positive")]
    let size = [width, height].map(|side| side.ceil() as u32);
    Drawing::new(size)
}
