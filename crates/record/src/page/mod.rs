//! The one-file page: a motion beside its plots, report and certificate, in any browser, without a network.
//!
//! Words, tables and plots are plain HTML, there before any script runs. The sheet is drawn by three.js, which the page
//! carries (`assets/three`); a content security policy by hash lets the browser run these two scripts and nothing
//! else, and fetch nothing.

mod certificate;
mod html;
mod payload;
mod policy;
mod report;
mod sections;
mod sheet;

use std::io::Write;

use foldmotion_pattern::Motion;
use serde_json::Value;

use self::html::{data, escaped};
use self::payload::{archived, check_size};
use crate::{KeyFrames, Marks, Panel, Provenance, RecordError, Style, Values, View, key_frames};

const TEMPLATE: &str = include_str!("page.html");
const STYLES: &str = include_str!("page.css");
const LIBRARY: &str = include_str!("../../assets/three/three.min.js");
const SCRIPT: &str = concat!(
    "\"use strict\";\n(() => {\n",
    include_str!("data.js"),
    include_str!("paper.js"),
    include_str!("stage.js"),
    include_str!("player.js"),
    include_str!("timeline.js"),
    include_str!("legend.js"),
    include_str!("main.js"),
    "})();\n"
);

/// The part of the tolerance that rounding positions to steps may take, see [`sheet`].
const ROUNDING: f64 = 1.0 / 16.0;

/// The content of a page.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The motion that is shown.
    pub motion: &'a Motion,
    /// Facets painted in the colour of marks, each in its span; foldmotion marks facets that penetrate each other.
    pub marks: &'a Marks,
    /// Values that can be shown as colours instead of paper, such as strain and facet bending.
    pub values: &'a [Values],
    /// The plots; without any there is no section of plots.
    pub panels: &'a [Panel],
    /// The text of `report.json`. Times, threads and device are left out of the page.
    pub report: Option<&'a str>,
    /// The text of `certificate.json`, also to download.
    pub certificate: Option<&'a str>,
    /// The bytes of `motion.fold`, to download.
    pub fold: Option<&'a [u8]>,
}

/// The options of a page.
#[derive(Debug, Clone, PartialEq)]
pub struct PageOptions {
    /// How far a vertex may be drawn from the motion, in the sheet's `unit_length`.
    pub tolerance: f64,
    /// Seconds for deployed → planar and for planar → compact.
    pub seconds: [f64; 2],
    /// The direction from which the sheet is seen at first.
    pub view: View,
    /// Colours and lines; the background is the page's.
    pub style: Style,
    /// Title, program, scene and hash; embedded as they are, so that the page can be made again.
    pub provenance: Provenance,
}

impl Default for PageOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            seconds: [3.0, 5.0],
            view: View::default(),
            style: Style::default(),
            provenance: Provenance::default(),
        }
    }
}

/// Writes `page` as one HTML file and returns which frames of the motion it holds, and how accurately.
///
/// Every vertex is drawn within the tolerance of the motion at all times; values run straight between all frames of the
/// motion, in 254 steps of their range. Where layers coincide the order of the compact state decides, in steps of
/// depth of 4e-3 `unit_length`: closer than a few of these, layers are seen in their order rather than where they are.
/// The page holds no time and no device: the same input gives the same bytes.
///
/// Browsers: those with WebGL 2 and `DecompressionStream` (since 2023); others show all but the sheet.
///
/// # Errors
/// Those of [`key_frames()`]; [`RecordError::NotPositive`], [`RecordError::LineWidth`], [`RecordError::Range`],
/// [`RecordError::ValueCount`], [`RecordError::Json`], [`RecordError::FileSize`] before anything is written, then
/// [`RecordError::Write`].
pub fn page(
    page: &Page<'_>,
    options: &PageOptions,
    mut writer: impl Write,
) -> Result<KeyFrames, RecordError> {
    let keys = checked(page, options)?;
    check_size(page, keys.frames.len())?;
    let contents = Contents::new(page, options, &keys)?;
    for (name, text) in parts(TEMPLATE) {
        writer.write_all(text.as_bytes())?;
        writer.write_all(contents.filling(name)?.as_bytes())?;
    }
    writer.flush()?;
    Ok(keys)
}

/// The texts that fill the template.
struct Contents<'a> {
    page: &'a Page<'a>,
    origin: &'a Provenance,
    report: Option<Value>,
    certificate: Option<Value>,
    scene: Value,
    payload: Vec<u8>,
}

impl<'a> Contents<'a> {
    fn new(
        page: &'a Page<'a>,
        options: &'a PageOptions,
        keys: &KeyFrames,
    ) -> Result<Self, RecordError> {
        let report = page.report.map(|text| parsed("report", text));
        let certificate = page.certificate.map(|text| parsed("certificate", text));
        let (scene, payload) = sheet::scene(page, options, keys);
        let mut contents = Self {
            page,
            origin: &options.provenance,
            report: report.transpose()?,
            certificate: certificate.transpose()?,
            scene,
            payload,
        };
        contents.scene["verdict"] = contents.verdict().into();
        Ok(contents)
    }

    /// What was proved, best from the certificate.
    fn verdict(&self) -> Option<&str> {
        let proved = self.certificate.as_ref().and_then(|c| c.get("verdict"));
        let told = || self.report.as_ref()?.pointer("/collision/verdict");
        proved.or_else(told)?.as_str()
    }

    fn title(&self) -> String {
        match self.origin.title.trim() {
            "" => "Folding motion".to_owned(),
            title => escaped(title),
        }
    }

    /// The text that replaces `name`.
    fn filling(&self, name: &str) -> Result<String, RecordError> {
        let section = |value: &Option<Value>, of: fn(&Value) -> String| {
            value.as_ref().map(of).unwrap_or_default()
        };
        let certificate = self.page.certificate.unwrap_or_default();
        Ok(match name {
            "title" => self.title(),
            "policy" => policy::policy(STYLES, &[LIBRARY, SCRIPT]),
            "generator" => escaped(&self.origin.producer),
            "styles" => STYLES.to_owned(),
            "lead" => section(&self.report, report::lead),
            "verdict" => {
                let outcome = section(&self.report, report::outcome);
                if outcome.is_empty() { certificate::badge(self.verdict()) } else { outcome }
            }
            "plots" => sections::plotted(self.page.panels)?,
            "report" => section(&self.report, report::section),
            "certificate" => section(&self.certificate, certificate::section),
            "files" => sections::files(self.page),
            "origin" => sections::origin(self.origin),
            "scene" => data(&self.scene),
            "payload" => archived(&self.payload),
            "fold" => archived(self.page.fold.unwrap_or_default()),
            "certificate-file" => archived(certificate.as_bytes()),
            "provenance" => data(&sections::provenance(self.origin)),
            "library" => LIBRARY.to_owned(),
            "script" => SCRIPT.to_owned(),
            _ => String::new(),
        })
    }
}

/// The key frames, or what is wrong with the input.
fn checked(page: &Page<'_>, options: &PageOptions) -> Result<KeyFrames, RecordError> {
    let [unfold, fold] = options.seconds;
    for (name, value) in [("seconds[0]", unfold), ("seconds[1]", fold)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(RecordError::NotPositive { name, value });
        }
    }
    options.style.check()?;
    let tolerance = (1.0 - ROUNDING) * options.tolerance * page.motion.sheet.unit_length;
    let keys = key_frames(page.motion, tolerance)?;
    for values in page.values {
        values.check(page.motion)?;
    }
    Ok(keys)
}

fn parsed(name: &'static str, text: &str) -> Result<Value, RecordError> {
    serde_json::from_str(text)
        .map_err(|error| RecordError::Json { name, message: error.to_string() })
}

/// The text of a template up to each `{{name}}`, with that name; the last with none.
fn parts(template: &str) -> impl Iterator<Item = (&str, &str)> {
    let pieces = template.split("}}");
    pieces.map(|piece| {
        let (text, name) = piece.split_once("{{").unwrap_or((piece, ""));
        (name, text)
    })
}
