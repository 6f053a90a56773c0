//! The crease pattern of a scene as files for cutting, printing and Origami Simulator.

use std::borrow::Cow;
use std::fmt::Write as _;
use std::path::PathBuf;

use foldmotion_pattern::{
    CutOptions, CutPattern, FacetModel, LineClass, PageLayout, PaperSize, Sheet, Tiles, UnitSheet,
    crease_pattern_fold,
};

use crate::VERSION;
use crate::digest::sha256;
use crate::folded_pattern::FoldedPattern;
use crate::resolve::imported::{ImportedStudy, imported};
use crate::resolve::input::Input;
use crate::resolve::rows::clash_drawing;
use crate::resolve::units::sheet;
use crate::results::{Command, Destination, ManifestEntry, Results};
use crate::scene::LengthUnit;
use crate::{Phase, Progress, SceneSource, StudyError};

/// The file that is moved into the folder last.
const PATTERN_SVG: &str = "pattern.svg";
/// The drawing of rows whose creases do not meet.
const CLASHES_SVG: &str = "clashes.svg";
/// Origami Simulator merges ends of lines closer than this, in SVG units, by default.
const ORIGAMI_SIMULATOR_TOLERANCE: f64 = 3.0;

/// A kind of pattern file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PatternFormat {
    /// SVG, in layers.
    Svg,
    /// DXF R12, in layers.
    Dxf,
    /// FOLD 1.2.
    Fold,
}

impl PatternFormat {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Dxf, Self::Fold];

    /// The name of the format, with which its files end.
    pub fn name(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Dxf => "dxf",
            Self::Fold => "fold",
        }
    }

    /// The format called `name`.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.name() == name)
    }
}

/// The scale of the pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PatternScale {
    /// A multiple of the size in the scene; 1 is life size.
    Factor(f64),
    /// The scale at which the sheet has this width W, in mm.
    Width(f64),
}

/// Which pattern files are written, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternOptions {
    /// The files to write.
    pub formats: Vec<PatternFormat>,
    /// The scale of the pattern.
    pub scale: PatternScale,
    /// The paper size of the pages; `None` for the whole pattern only.
    pub paper: Option<PaperSize>,
    /// The overlap of neighbouring pages, in mm.
    pub overlap: f64,
    /// Lines, dashes and margin; `title`, `note` and `scale` are set from the scene.
    pub lines: CutOptions,
}

/// The sheet of a scene, for its crease pattern.
#[derive(Debug, Clone)]
pub struct PatternStudy {
    /// The title of the scene.
    pub title: String,
    /// The unit of length of the sheet.
    pub unit: LengthUnit,
    /// The sheet.
    pub subject: PatternSubject,
}

/// The sheet whose crease pattern is written.
#[derive(Debug, Clone)]
pub enum PatternSubject {
    /// A sheet of units.
    Units(Box<UnitSheet>),
    /// The crease pattern of a file.
    Imported(Box<ImportedStudy>),
}

impl PatternSubject {
    /// The sheet as it is put on paper, which turns it by half a turn.
    fn on_paper(&self) -> Cow<'_, Sheet> {
        match self {
            Self::Units(units) => Cow::Borrowed(&units.sheet),
            Self::Imported(study) => {
                // A drawing keeps its upper edge.
                let mut sheet = study.imported.sheet.clone();
                sheet.vertices.iter_mut().for_each(|vertex| *vertex = -*vertex);
                Cow::Owned(sheet)
            }
        }
    }

    fn end_angles(&self) -> &[f64] {
        match self {
            Self::Units(units) => units.compact_angles(),
            Self::Imported(study) => study.end_angles(),
        }
    }

    /// The width W of a sheet of units, or of the box around a pattern.
    fn width(&self) -> f64 {
        match self {
            Self::Units(units) => units.unit.width * units.columns as f64,
            Self::Imported(study) => {
                let across = study.imported.sheet.vertices.iter().map(|vertex| vertex.x);
                let (low, high) = across
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
                high - low
            }
        }
    }

    /// The sheet in words.
    fn words(&self) -> String {
        match self {
            Self::Units(units) => {
                let case = units.unit.case.name();
                format!("case {case}, {} x {} units", units.rows, units.columns)
            }
            Self::Imported(study) => format!("pattern of {}", study.file),
        }
    }
}

impl PatternStudy {
    /// Resolves profile, division and sheet, or the pattern of a scene; the tables that describe the motion are parsed but
    /// ignored.
    ///
    /// # Errors
    /// Every unusable value, with file, line, key, value and remedy.
    pub fn resolve(source: &SceneSource) -> Result<Self, StudyError> {
        let scene = source.scene()?;
        let input = Input::new(source, &scene);
        if let Some(pattern) = &scene.pattern {
            let study = imported(&input, pattern)?;
            return Ok(Self {
                title: input.title(study.imported.title.as_ref()),
                unit: LengthUnit::named(study.unit_name).unwrap_or(LengthUnit::Unit),
                subject: PatternSubject::Imported(Box::new(study)),
            });
        }
        // Nodes in the middle of facets belong to the mechanical model, not to the pattern.
        let units = sheet(&input)?.units.with_facet_model(FacetModel::OneDiagonal);
        Ok(Self {
            title: input.title(None),
            unit: scene.profile.unit.unwrap_or_default(),
            subject: PatternSubject::Units(Box::new(units)),
        })
    }

    /// Draws a column of a scene whose rows clash as `clashes.svg` (figure 10 of the paper) and returns its path; `None` if
    /// the rows are equal or the scene has another error.
    ///
    /// # Errors
    /// [`StudyError::Output`]; the folder is then as it was.
    pub fn write_clashes<'a>(
        source: &SceneSource,
        destination: impl Into<Destination<'a>>,
    ) -> Result<Option<PathBuf>, StudyError> {
        let Ok(Some(figure)) = clash_drawing(source) else {
            return Ok(None);
        };
        let mut results = Results::open(destination.into(), Command::Pattern, Some(CLASHES_SVG))?;
        results.require_clear(&|name| name == CLASHES_SVG)?;
        let folder = results.folder().to_owned();
        results.write_bytes(CLASHES_SVG, figure.as_bytes())?;
        results.publish(None, &|_| false)?;
        Ok(Some(folder.join(CLASHES_SVG)))
    }

    /// The whole pattern as SVG: what [`Self::write`] writes as `pattern.svg`.
    ///
    /// # Errors
    /// [`StudyError::Cut`].
    pub fn svg(&self, options: &PatternOptions) -> Result<String, StudyError> {
        let lines = self.line_options(options);
        let pattern = CutPattern::new(&self.subject.on_paper(), self.subject.end_angles(), &lines)?;
        Ok(pattern.whole().svg())
    }

    /// Writes pattern.svg, pattern.dxf and pattern.fold, and pattern-ROW-COLUMN.svg and .dxf for pages, into a folder; of the
    /// crease pattern of a file also folded.fold and folded.svg, its flat state, if an order of its layers is proved.
    ///
    /// Files of earlier calls are replaced, or removed if they belong to another pattern or paper size; other files are kept.
    /// Returns a summary for the terminal.
    ///
    /// # Errors
    /// [`StudyError`]; the folder is then as it was.
    pub fn write<'a>(
        &self,
        destination: impl Into<Destination<'a>>,
        options: &PatternOptions,
        progress: Progress<'_>,
    ) -> Result<String, StudyError> {
        let lines = self.line_options(options);
        let pattern = CutPattern::new(&self.subject.on_paper(), self.subject.end_angles(), &lines)?;
        let layout =
            |PaperSize(paper)| PageLayout { paper, margin: lines.margin, overlap: options.overlap };
        let tiles = options.paper.map(|paper| pattern.tiles(layout(paper)));
        let tiles = tiles.transpose()?;
        let fold = self.fold(&lines)?;
        let folded = match &self.subject {
            PatternSubject::Units(_) => None,
            PatternSubject::Imported(study) => Some(FoldedPattern::of(study, &self.title)?),
        };
        let has = |format| options.formats.contains(&format);
        let is_wanted = |name: &str| format_of(name).is_some_and(has);
        let mut results = Results::open(destination.into(), Command::Pattern, Some(PATTERN_SVG))?;
        results.require_clear(&|name| {
            let is_folded = folded.as_ref().is_some_and(|folded| folded.has(name));
            let is_missing =
                is_page(name) && tiles.is_none() || FoldedPattern::may_have(name) && !is_folded;
            is_wanted(name) && !is_missing
        })?;
        let mut save = |name: &str, text: &str| results.write_bytes(name, text.as_bytes());
        if has(PatternFormat::Fold) {
            save("pattern.fold", &fold)?;
        }
        let of_folded = folded.iter().flat_map(|folded| &folded.files);
        for (name, text) in of_folded.filter(|(name, _)| is_wanted(name)) {
            save(name, text)?;
        }
        let whole = std::iter::once(pattern.whole());
        let pages = whole.chain(tiles.iter().flat_map(Tiles::pages));
        let count = 1 + tiles.as_ref().map_or(0, |t| t.counts().iter().product());
        for (index, page) in pages.enumerate() {
            if !progress(Phase::Record, index as f64 / count as f64) {
                return Err(StudyError::Interrupted);
            }
            let stem = match page.number {
                None => "pattern".to_owned(),
                Some(number) => format!("pattern-{}-{}", number.row + 1, number.column + 1),
            };
            if has(PatternFormat::Svg) {
                save(&format!("{stem}.svg"), &page.svg())?;
            }
            if has(PatternFormat::Dxf) {
                save(&format!("{stem}.dxf"), &page.dxf())?;
            }
        }
        let paper = format!("{:?} {} {lines:?}", options.paper, options.overlap);
        let angles = self.subject.end_angles();
        let of = sha256(format!("{fold}{angles:?}{paper}").as_bytes());
        let is_stale =
            |file: &ManifestEntry| file.name != CLASHES_SVG && file.of.as_ref() != Some(&of);
        let published = results.publish(Some(&of), &is_stale)?;
        let pages = tiles.map(|tiles| tiles.counts());
        let mut summary = self.summary(&pattern, pages, &lines.note);
        if let Some(folded) = &folded {
            summary.push_str(&folded.summary);
        }
        for line in published.words() {
            let _ = writeln!(summary, "{line}");
        }
        Ok(summary)
    }

    /// The pattern as FOLD: of units in mm on paper, of a file in its own coordinates.
    fn fold(&self, lines: &CutOptions) -> Result<String, StudyError> {
        let creator = format!("foldmotion {VERSION}");
        match &self.subject {
            PatternSubject::Units(units) => {
                Ok(crease_pattern_fold(&units.sheet, units.compact_angles(), lines, &creator)?)
            }
            PatternSubject::Imported(study) => Ok(study.imported.fold(&creator)),
        }
    }

    /// The options with title, scale and note.
    fn line_options(&self, options: &PatternOptions) -> CutOptions {
        let natural = self.unit.millimetres();
        let life_size = natural.unwrap_or(1.0);
        let scale = match options.scale {
            PatternScale::Factor(factor) => factor * life_size,
            PatternScale::Width(millimetres) => millimetres / self.subject.width(),
        };
        let of_scene = match natural {
            Some(_) => format!("1 {} of the scene", self.unit.name()),
            None => "1 unit of the scene, which has no physical length,".to_owned(),
        };
        CutOptions {
            title: self.title.clone(),
            // To 1e-9 mm, as the lines themselves.
            note: format!("{of_scene} is {} mm on paper", (scale * 1e9).round() / 1e9),
            scale,
            ..options.lines.clone()
        }
    }

    fn summary(&self, pattern: &CutPattern, pages: Option<[usize; 2]>, note: &str) -> String {
        let size = pattern.size;
        let mut text = format!(
            "{}: {}; {:.3} mm x {:.3} mm; {note}\n",
            self.title,
            self.subject.words(),
            size.x,
            size.y
        );
        if let PatternSubject::Imported(study) = &self.subject {
            let warnings = study.imported.warnings.iter().map(ToString::to_string);
            for note in study.notes().into_iter().chain(warnings) {
                let _ = writeln!(text, "note: {note}");
            }
        }
        for class in LineClass::ALL {
            let count = pattern.count(class);
            if count > 0 {
                let length = pattern.length(class);
                let name = class.name();
                let _ = writeln!(text, "{name:<9}{count:>7} lines {length:>15.3} mm");
            }
        }
        let _ = writeln!(text, "pen up {:>23.3} mm", pattern.travel());
        if let Some([columns, rows]) = pages {
            let _ = writeln!(text, "pages    {rows:>7} x {columns} (rows x columns)");
        }
        if pattern.shortest_edge < ORIGAMI_SIMULATOR_TOLERANCE {
            let _ = writeln!(
                text,
                "the shortest line is {:.3} mm: set Origami Simulator's vertex merge tolerance below it before \
                 importing pattern.svg, or open pattern.fold there",
                pattern.shortest_edge
            );
        }
        text
    }
}

/// The format of a file that [`PatternStudy::write`] may write under this name.
fn format_of(name: &str) -> Option<PatternFormat> {
    let (stem, ending) = name.rsplit_once('.')?;
    let format = PatternFormat::find(ending)?;
    let may_be = stem == "pattern"
        || is_page(name) && format != PatternFormat::Fold
        || FoldedPattern::may_have(name);
    may_be.then_some(format)
}

/// Whether `name` is that of a page, such as `pattern-1-2.svg`.
fn is_page(name: &str) -> bool {
    let numbers = name.strip_prefix("pattern-").and_then(|rest| {
        let (numbers, _) = rest.rsplit_once('.')?;
        numbers.split_once('-')
    });
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    numbers.is_some_and(|(row, column)| is_number(row) && is_number(column))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_patterns_pages_and_flat_states_are_recognised_by_name() {
        for name in [
            "pattern.svg",
            "pattern.dxf",
            "pattern.fold",
            "pattern-1-12.svg",
            "folded.svg",
            "folded.fold",
        ] {
            assert!(format_of(name).is_some(), "{name}");
        }
        for name in [
            "pattern.png",
            "pattern-1.svg",
            "pattern-1-2.fold",
            "pattern-a-b.svg",
            "pattern-1-2-3.svg",
            "my-pattern.svg",
            "folded.dxf",
            "pattern--.svg",
        ] {
            assert!(format_of(name).is_none(), "{name}");
        }
    }
}
