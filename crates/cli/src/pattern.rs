//! `foldmotion pattern`: the crease pattern for cutting and folding.

use std::path::PathBuf;

use clap::Args;
use foldmotion_study::{
    CutError, CutOptions, PaperSize, PatternFormat, PatternOptions, PatternScale, parse_millimetres,
};

/// `foldmotion pattern`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
pub(crate) struct PatternArguments {
    /// The scene file, or a crease pattern (.fold, .svg, .cp, .opx, .orh, .obj, .dxf), which is also folded flat: folded.fold
    /// and folded.svg have its flat state with a proved order of layers, or the summary says why there is none
    pub(crate) scene: PathBuf,
    /// Folder for the results. Default: out/ and the name of the scene
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Override a key of the scene, such as sheet.columns=5
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// The files to write
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        default_value = "svg,dxf,fold",
        value_parser = parse_format
    )]
    formats: Vec<PatternFormat>,
    /// Scale the pattern by this factor; 1 is the size in the scene
    #[arg(long, value_name = "X", allow_negative_numbers = true, conflicts_with = "width")]
    scale: Option<f64>,
    /// Scale the pattern so that the sheet is this wide (W): a length with mm, cm, m, in or pt, such as 200mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_millimetres, allow_hyphen_values = true)]
    width: Option<f64>,
    /// Also write the pattern as pages of this size, to be glued together: A0 to A6, letter, legal, tabloid (each with
    /// -landscape if wanted), or WIDTHxHEIGHT such as 300x600mm
    #[arg(long, value_name = "PAPER")]
    sheet: Option<PaperSize>,
    /// White space around the pattern and on every side of a page
    #[arg(long, value_name = "LENGTH", value_parser = parse_millimetres, default_value = "10mm", allow_hyphen_values = true)]
    margin: f64,
    /// The overlap of neighbouring pages, for glue
    #[arg(long, value_name = "LENGTH", value_parser = parse_millimetres, default_value = "10mm", allow_hyphen_values = true)]
    overlap: f64,
    /// Dashes of mountain or valley lines in mm, dash and gap in turn, such as mountain=6,2,2,2; mountain=none draws solid
    /// lines. Default: by the height of a row
    #[arg(long, value_name = "CLASS=LIST", value_parser = parse_dashes)]
    dash: Vec<Dashes>,
    /// The width of the lines. Default: 1/2000 of the diagonal of the page, at least 0.1 mm
    #[arg(long, value_name = "LENGTH", value_parser = parse_millimetres, allow_hyphen_values = true)]
    line_width: Option<f64>,
    /// Write each crease between two vertices as a line of its own, instead of joining those on one straight line
    #[arg(long)]
    segments: bool,
    /// Also draw the lines that cut facets into triangles, which are not creases
    #[arg(long)]
    facets: bool,
    /// Also replace files in the folder that this command did not make
    #[arg(long)]
    pub(crate) force: bool,
    /// Print nothing
    #[arg(long)]
    pub(crate) quiet: bool,
}

impl PatternArguments {
    /// The options of the study.
    pub(crate) fn options(&self) -> PatternOptions {
        let scale = match self.width {
            Some(width) => PatternScale::Width(width),
            None => PatternScale::Factor(self.scale.unwrap_or(1.0)),
        };
        let dashes = |class| {
            let given = self.dash.iter().rev().find(|d| d.class == class);
            given.map(|d| d.lengths.clone())
        };
        PatternOptions {
            formats: self.formats.clone(),
            scale,
            paper: self.sheet,
            overlap: self.overlap,
            lines: CutOptions {
                margin: self.margin,
                keeps_segments: self.segments,
                draws_facets: self.facets,
                mountain_dashes: dashes(DashedClass::Mountain),
                valley_dashes: dashes(DashedClass::Valley),
                stroke_width: self.line_width,
                ..CutOptions::new(1.0)
            },
        }
    }
}

/// The classes of lines that can have dashes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DashedClass {
    Mountain,
    Valley,
}

/// A value of `--dash`.
#[derive(Debug, Clone)]
struct Dashes {
    class: DashedClass,
    /// The lengths of dashes and gaps in mm; empty for solid lines.
    lengths: Vec<f64>,
}

fn parse_format(name: &str) -> Result<PatternFormat, &'static str> {
    PatternFormat::find(name).ok_or("expected svg, dxf or fold")
}

fn parse_dashes(text: &str) -> Result<Dashes, String> {
    let need = "expected mountain=LIST or valley=LIST, such as mountain=6,2,2,2 or valley=none";
    let (class, list) = text.split_once('=').ok_or(need)?;
    let class = match class {
        "mountain" => DashedClass::Mountain,
        "valley" => DashedClass::Valley,
        _ => return Err(need.to_owned()),
    };
    if list == "none" {
        let lengths = Vec::new();
        return Ok(Dashes { class, lengths });
    }
    let lengths: Result<_, CutError> = list.split(',').map(parse_millimetres).collect();
    let lengths = lengths.map_err(|e| e.to_string())?;
    Ok(Dashes { class, lengths })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dashes_are_parsed_for_each_class() {
        let dashes = parse_dashes("mountain=6,2,0.5cm,2").unwrap();
        assert_eq!(dashes.class, DashedClass::Mountain);
        assert_eq!(dashes.lengths, [6.0, 2.0, 5.0, 2.0]);
        assert!(parse_dashes("valley=none").unwrap().lengths.is_empty());
        for text in ["", "mountain", "cut=1,2", "valley=", "valley=1,,2", "valley=a,b"] {
            assert!(parse_dashes(text).is_err(), "{text}");
        }
    }
}
