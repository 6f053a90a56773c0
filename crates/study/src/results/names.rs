//! The names of result files.

/// The name of the motion file.
pub(crate) const MOTION: &str = "motion.fold";

/// The name of the folder of pictures.
pub(crate) const FRAMES: &str = "frames";

/// The name of the folder of frames for VTK.
pub(crate) const VTK: &str = "vtk";

/// The folders among the results.
pub(crate) const SUBFOLDERS: [&str; 2] = [FRAMES, VTK];

/// The name of the report.
pub(crate) const REPORT: &str = "report.json";

/// The name of the certificate.
pub(crate) const CERTIFICATE: &str = "certificate.json";

/// The files that a run may write, except pictures and states.
const NAMES: &[&str] = &[
    REPORT,
    MOTION,
    CERTIFICATE,
    "motion.gif",
    "motion.mp4",
    "motion.glb",
    "motion.pvd",
    "motion.html",
    "motion.csv",
    "plots.svg",
    "figure.svg",
    "figure.pdf",
];

/// Whether a run may write a file with this name.
pub(crate) fn is_of_a_run(name: &str) -> bool {
    NAMES.contains(&name) || is_picture(name) || is_vtk_frame(name) || is_state(name)
}

/// Whether `name` is that of a picture, such as `frames/0001.png`.
pub(crate) fn is_picture(name: &str) -> bool {
    is_numbered(name, FRAMES, ".png")
}

/// Whether `name` is that of a frame for VTK, such as `vtk/0001.vtp`.
pub(crate) fn is_vtk_frame(name: &str) -> bool {
    is_numbered(name, VTK, ".vtp")
}

fn is_numbered(name: &str, folder: &str, ending: &str) -> bool {
    let file = name.strip_prefix(folder).and_then(|n| n.strip_prefix('/'));
    let number = file.and_then(|n| n.strip_suffix(ending));
    number.is_some_and(|n| n.len() >= 4 && n.bytes().all(|b| b.is_ascii_digit()))
}

/// Whether `name` is that of a state, such as `state-0.5.obj`.
fn is_state(name: &str) -> bool {
    let rest = name.strip_prefix("state-");
    let time = rest.and_then(|n| n.strip_suffix(".obj").or(n.strip_suffix(".stl")));
    time.is_some_and(|time| time.parse::<f64>().is_ok())
}
