//! The names of results.

/// The name under which the motion stands.
pub(crate) const MOTION: &str = "motion.fold";

/// The folder of pictures among the results.
pub(crate) const FRAMES: &str = "frames";

/// The name under which the report stands.
pub(crate) const REPORT: &str = "report.json";

/// The name under which the certificate of a motion stands.
pub(crate) const CERTIFICATE: &str = "certificate.json";

/// Files a run may write, beside pictures and states.
const NAMES: &[&str] = &[
    REPORT,
    MOTION,
    CERTIFICATE,
    "motion.gif",
    "motion.mp4",
    "motion.glb",
    "motion.html",
    "motion.csv",
    "plots.svg",
    "figure.svg",
    "figure.pdf",
];

/// Whether a run may write a file of this name.
pub(crate) fn is_of_a_run(name: &str) -> bool {
    NAMES.contains(&name) || is_picture(name) || is_state(name)
}

/// `frames/0001.png` and so on.
pub(crate) fn is_picture(name: &str) -> bool {
    let file = name.strip_prefix(FRAMES).and_then(|n| n.strip_prefix('/'));
    let number = file.and_then(|n| n.strip_suffix(".png"));
    number.is_some_and(|n| n.len() >= 4 && n.bytes().all(|b| b.is_ascii_digit()))
}

/// `state-0.5.obj` and so on.
fn is_state(name: &str) -> bool {
    let rest = name.strip_prefix("state-");
    let time = rest.and_then(|n| n.strip_suffix(".obj").or(n.strip_suffix(".stl")));
    time.is_some_and(|time| time.parse::<f64>().is_ok())
}
