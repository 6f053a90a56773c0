//! Verifies a certificate: proves its statement about a motion file again by the second proof.

use std::fmt::Write as _;
use std::path::Path;

use foldmotion_check::CollisionReport;
use foldmotion_geometry::Number;
use foldmotion_pattern::{FoldError, FoldFile, Frame};
use foldmotion_verify::{Refutation, Verification, Verifier};
use serde_json::Value;

use crate::certificate::check_file::{MotionReader, TooFewStates, read_header};
use crate::certificate::statement::{against_file, against_times, claim};
use crate::certificate::{Certificate, FORMAT};
use crate::{Phase, Progress, StudyError, input_file};

/// The largest certificate, bytes: 256 MiB.
const LARGEST: u64 = 256 << 20;

/// The largest number of refuted or unproved claims in the table.
const SHOWN: usize = 10;

/// A certificate with the result of its verification.
#[derive(Debug, Clone, PartialEq)]
pub struct VerifiedCertificate {
    /// The certificate.
    pub certificate: Certificate,
    /// The result of the second proof.
    pub verification: Verification,
    /// The name of the motion file if it differs from the name in the certificate; that alone refutes nothing.
    pub other_name: Option<String>,
}

/// Verifies the certificate at `certificate` against the motion in the FOLD file at `motion`.
///
/// The second proof uses nothing of the first (`foldmotion_verify::Verifier`). Every field is compared with the file, the
/// frames, the topology or the second proof; only the name of the file is not part of the statement. It needs memory for
/// the sheet and two frames.
///
/// # Errors
/// [`StudyError::Certificate`] if the certificate cannot be read; otherwise as for `check_file`.
pub fn verify_file(
    motion: &Path,
    certificate: &Path,
    progress: Progress<'_>,
) -> Result<VerifiedCertificate, StudyError> {
    let certificate = read_certificate(certificate)?;
    let (file, sha256) = read_header(motion, progress)?;
    let name = motion.file_name().unwrap_or_default().to_string_lossy();
    let other_name = (name != certificate.file).then(|| name.into_owned());
    let done = |verification| VerifiedCertificate {
        certificate: certificate.clone(),
        verification,
        other_name: other_name.clone(),
    };
    let refuted = |refuted| Verification { refuted, ..Verification::default() };
    if sha256 != certificate.sha256 {
        let refutation = Refutation::new("sha256", &certificate.sha256, sha256);
        return Ok(done(refuted(vec![refutation])));
    }
    let refutations = against_file(&certificate, &file);
    if !refutations.is_empty() {
        return Ok(done(refuted(refutations)));
    }
    let claim = claim(&certificate);
    let mut input = MotionReader::open(motion, Phase::Verify, progress)?;
    let (mut verification, times) = prove(&file, &mut input, &claim)?;
    input.require_unchanged(&sha256)?;
    verification.refuted.extend(against_times(&certificate, &times));
    progress(Phase::Verify, 1.0);
    Ok(done(verification))
}

/// The second proof, and the times of the frames.
fn prove(
    file: &FoldFile,
    input: &mut MotionReader<'_>,
    claim: &CollisionReport,
) -> Result<(Verification, Vec<f64>), StudyError> {
    let mut verifier: Option<Verifier<'_>> = None;
    let mut times: Vec<f64> = Vec::new();
    let mut disorder = None;
    let read = file.frames(&mut *input, &mut |frame: Frame, order| -> Result<(), FoldError> {
        if times.last().is_some_and(|&before| before >= frame.time) {
            disorder = disorder.or(Some(times.len()));
        }
        times.push(frame.time);
        match &mut verifier {
            _ if disorder.is_some() => {}
            Some(verifier) => verifier.advance(frame),
            None => verifier = Some(Verifier::new(&file.sheet, frame, claim)),
        }
        if let Some(verifier) = &mut verifier
            && disorder.is_none()
        {
            verifier.claim(order, &|triangle| file.triangle_faces[triangle as usize]);
        }
        Ok(())
    });
    input.unless_stopped(read)?;
    if let Some(frame) = disorder {
        return Err(input.failure(&format!("frame {frame} is not later than the one before")));
    }
    let verifier = verifier.filter(|_| times.len() > 1);
    let verifier = verifier.ok_or_else(|| input.failure(&TooFewStates(times.len())))?;
    Ok((verifier.finish(), times))
}

pub(crate) fn read_certificate(path: &Path) -> Result<Certificate, StudyError> {
    let error = |message: String| StudyError::Certificate { path: path.to_owned(), message };
    let text = input_file::read_text(path, LARGEST)?;
    let not_a_certificate = |e: serde_json::Error| error(format!("not a certificate: {e}"));
    let given: Value = serde_json::from_str(&text).map_err(not_a_certificate)?;
    if let Some(reason) = foreign_format(&given) {
        return Err(error(reason));
    }
    let certificate: Certificate = serde_json::from_str(&text).map_err(not_a_certificate)?;
    let parsed = |text: &str| serde_json::from_str(text).unwrap_or(Value::Null);
    match unknown_key(&given, &parsed(&certificate.to_json())) {
        Some(key) => {
            Err(error(format!("the key `{key}` is unknown, so what it states cannot be proved")))
        }
        None => Ok(certificate),
    }
}

/// Why a certificate of another format is refused; `None` if it has the format of this program, or is not a certificate.
fn foreign_format(given: &Value) -> Option<String> {
    let remedy = "run `foldmotion check` on the motion again";
    match given.get("format") {
        Some(format) if *format == FORMAT => None,
        None if given.get("verdict").is_none() => None,
        Some(format) if *format != 1 => Some(format!(
            "the certificate has format {format}, but this program reads format {FORMAT}; {remedy}"
        )),
        _ => Some(format!(
            "the certificate has format 1, but this program reads format {FORMAT}. Certificates of format 1 (versions up to \
             0.1) could be touching for a sheet that passed through itself at an edge inside it, a crease or the \
             diagonal of a face, so they prove nothing about touching sheets; {remedy}"
        )),
    }
}

/// A key of the certificate that this program does not know.
fn unknown_key(given: &Value, known: &Value) -> Option<String> {
    match (given, known) {
        (Value::Object(given), Value::Object(known)) => given.iter().find_map(|(key, value)| {
            let Some(known) = known.get(key) else {
                return Some(key.clone());
            };
            unknown_key(value, known)
        }),
        (Value::Array(given), Value::Array(known)) => {
            given.iter().zip(known).find_map(|(g, k)| unknown_key(g, k))
        }
        _ => None,
    }
}

impl VerifiedCertificate {
    /// The exit status: 2 refuted, 3 not verified, 1 verified and penetrating, 0 verified and free or touching.
    pub fn status(&self) -> u8 {
        if !self.verification.refuted.is_empty() {
            2
        } else if !self.verification.unproved.is_empty() {
            3
        } else {
            self.certificate.status()
        }
    }

    fn result(&self) -> &'static str {
        match self.status() {
            2 => "REFUTED",
            3 if !self.verification.unproved.is_empty() => "NOT VERIFIED",
            _ => "VERIFIED",
        }
    }

    /// The result with its first evidence, on one line.
    pub fn line(&self) -> String {
        let (v, result) = (&self.verification, self.result());
        let stated = &self.certificate.verdict;
        match (v.refuted.first(), v.unproved.first()) {
            (Some(r), _) => {
                let Refutation { field, stated, found } = r;
                format!("{result}: {field}: stated {stated}; found {found}")
            }
            (None, Some(u)) => format!(
                "{result}: triangles {} and {} after frame {}: {}",
                u.faces[0], u.faces[1], u.frame, u.what
            ),
            (None, None) => format!("{result}: {stated}"),
        }
    }

    /// The table for the terminal.
    pub fn table(&self) -> String {
        let mut out = String::new();
        let (certificate, v) = (&self.certificate, &self.verification);
        // Writing into a string cannot fail.
        let _ =
            writeln!(out, "{}\n\n{}\nsha256 {}", self.line(), certificate.file, certificate.sha256);
        if let Some(name) = &self.other_name {
            let _ =
                writeln!(out, "note: the certificate names this file, but the motion is in {name}");
        }
        let _ = writeln!(
            out,
            "stated: {} (tolerance {} of the unit of length {:.6}; {} pairs penetrate, {} are undecided)",
            certificate.verdict,
            Number(certificate.tolerance),
            Number(certificate.unit_length),
            certificate.penetrations.len(),
            certificate.undecided.len()
        );
        if let Some(stopped) = &certificate.stopped {
            let _ = writeln!(out, "{}", stopped.line());
        }
        let _ = writeln!(
            out,
            "second proof: {} pairs of triangles, {} near, {} followed; {} to {} touch",
            v.pairs, v.near, v.followed, v.touching[0], v.touching[1]
        );
        for r in v.refuted.iter().take(SHOWN) {
            let _ = writeln!(out, "- {}: stated {}; found {}", r.field, r.stated, r.found);
        }
        for u in v.unproved.iter().take(SHOWN) {
            let _ = writeln!(
                out,
                "- triangles {} and {} after frame {}: {}",
                u.faces[0], u.faces[1], u.frame, u.what
            );
        }
        let more = v.refuted.len().saturating_sub(SHOWN) + v.unproved.len().saturating_sub(SHOWN);
        if more > 0 {
            let _ = writeln!(out, "- and {more} more");
        }
        let _ = writeln!(out, "{}", self.result());
        out
    }
}
