//! A scene folded, its motion checked, and the certificate proved again.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use foldmotion_study::{Report, SceneSource, Study, VerifiedCertificate, verify_file};

/// A scene with changed settings.
pub(crate) struct Motion {
    /// The name in `scenes/`, without the extension.
    pub(crate) scene: String,
    /// Whether contact keeps layers apart.
    pub(crate) has_contact: bool,
    /// Other settings, as after `--set`.
    pub(crate) settings: Vec<String>,
}

/// The result of a motion.
pub(crate) struct Checked {
    pub(crate) report: Report,
    /// The certificate with the result of the second proof.
    pub(crate) verified: VerifiedCertificate,
    pub(crate) verify_seconds: f64,
}

/// The folder of scene files.
pub(crate) fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

impl Motion {
    /// Folds, checks and verifies, by the files that `foldmotion run` writes.
    pub(crate) fn check(&self) -> Result<Checked, Box<dyn Error>> {
        let mut source = SceneSource::read(&scenes().join(&self.scene).with_extension("toml"))?;
        source.set("record.outputs=[\"fold\"]")?;
        source.set(&format!("motion.contact={}", self.has_contact))?;
        for setting in &self.settings {
            source.set(setting)?;
        }
        let folder = tempfile::tempdir()?;
        let report = Study::resolve(&source)?.run(folder.path(), &|_, _| true)?;
        let started = Instant::now();
        let verified = verify_file(
            &folder.path().join("motion.fold"),
            &folder.path().join("certificate.json"),
            &|_, _| true,
        )?;
        Ok(Checked { report, verified, verify_seconds: started.elapsed().as_secs_f64() })
    }
}

impl Checked {
    /// The verdict, with the last time checked if the check ended early.
    pub(crate) fn verdict(&self) -> String {
        let certificate = &self.verified.certificate;
        match &certificate.stopped {
            None => certificate.verdict.to_string(),
            Some(stopped) => {
                format!("{}, checked up to t = {:.3}", certificate.verdict, stopped.time)
            }
        }
    }

    /// Whether the motion reached its end.
    pub(crate) fn is_finished(&self) -> bool {
        self.report.outcome.is_at_end()
    }

    /// The outcome of the motion.
    pub(crate) fn outcome(&self) -> String {
        self.report.outcome.headline()
    }

    /// The result of the second proof.
    pub(crate) fn second_proof(&self) -> String {
        let verification = &self.verified.verification;
        match self.verified.status() {
            2 => format!("refuted in {}", verification.refuted.len()),
            3 => format!("open in {}", verification.unproved.len()),
            _ => "verified".to_owned(),
        }
    }
}
