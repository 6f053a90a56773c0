//! `motion.html`: the motion with its plots, report and certificate.

use foldmotion_record::{Page, PageOptions, Panel, Provenance, page};

use super::Recorder;
use super::colours::Quantity;
use crate::StudyError;
use crate::VERSION;
use crate::results::Results;
use crate::scene::OutputChoice;

/// The largest motion file inside a page, in bytes: 256 MiB, which browsers can still unpack.
pub(super) const LARGEST_FOLD: u64 = 1 << 28;

/// The shortest stage of a page in seconds; a film may skip a stage.
const SHORTEST_STAGE: f64 = 0.01;

/// What a page shows next to the motion.
#[derive(Debug, Default)]
pub(crate) struct PageContent {
    /// The text of the report; the page omits its timings, threads and device.
    pub(crate) report: Option<String>,
    /// The text of the certificate.
    pub(crate) certificate: Option<String>,
    /// The motion file, to download.
    pub(crate) fold: Option<Vec<u8>>,
    /// The plots.
    pub(crate) panels: Vec<Panel>,
}

impl Recorder<'_> {
    pub(super) fn page(&self, results: &mut Results) -> Result<(), StudyError> {
        if !self.recording.has(OutputChoice::Html) {
            return Ok(());
        }
        let film = &self.recording.film;
        let options = PageOptions {
            seconds: film.seconds.map(|s| s.max(SHORTEST_STAGE)),
            view: film.view,
            style: film.style.clone(),
            provenance: Provenance {
                title: self.title.to_owned(),
                producer: format!("foldmotion {VERSION}"),
                scene: self.source_info.text(),
                hash: self.source_info.sha256.clone(),
            },
            ..PageOptions::default()
        };
        let mut quantities = vec![Quantity::Bending];
        if self.has_rest_lengths {
            quantities.insert(0, Quantity::Strain);
        }
        let values: Vec<_> =
            quantities.into_iter().map(|quantity| quantity.of_motion(self.motion)).collect();
        let content = Page {
            motion: self.motion,
            marks: &self.marks,
            values: &values,
            panels: &self.page_content.panels,
            report: self.page_content.report.as_deref(),
            certificate: self.page_content.certificate.as_deref(),
            fold: self.page_content.fold.as_deref(),
        };
        results.write("motion.html", |out| {
            page(&content, &options, out).map(drop).map_err(StudyError::from)
        })
    }
}
