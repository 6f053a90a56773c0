//! Every output of a run and of a motion file is read back by independent readers, and reproduced.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use foldmotion_study::scene::{
    CameraChoice, CameraScene, ColourChoice, HoldScene, OutputChoice, RecordScene, ThickenedScene,
};
use foldmotion_study::{Report, Reproduction, SceneSource, Study, record_file, reproduce_file};
use tempfile::TempDir;

const SMALL: [&str; 5] = [
    "record.size=[64, 48]",
    "record.fps=5.0",
    "record.seconds=[0.0, 1.0]",
    "record.hold=[0.2, 0.0, 0.4]",
    "motion.frames=20",
];

const ALL: &str = "record.outputs=[\"fold\", \"gif\", \"csv\", \"mp4\", \"png\", \"svg\", \"pdf\", \"glb\", \"obj\", \"stl\", \"html\", \"vtk\"]";

fn run(folder: &Path, set: &[&str]) -> Report {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/one-unit.toml");
    let mut source = SceneSource::read(&scene).unwrap();
    for assignment in SMALL.iter().chain(set) {
        source.set(assignment).unwrap();
    }
    Study::resolve(&source).unwrap().run(folder, &|_, _| true).unwrap()
}

/// A run with every output, in a folder of its own.
fn everything() -> (TempDir, PathBuf, Report) {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("unit");
    let report = run(&folder, &[ALL]);
    (home, folder, report)
}

fn again(file: &Path, motion: Option<&Path>, out: &Path) -> Reproduction {
    fs::create_dir_all(out).unwrap();
    reproduce_file(file, motion, Some(out), false, &|_, _| true).unwrap()
}

/// The pictures of a GIF, and the hundredths of a second they last together.
fn gif_pictures(path: &Path) -> (usize, u32) {
    let mut reader = gif::DecodeOptions::new().read_info(File::open(path).unwrap()).unwrap();
    assert_eq!((reader.width(), reader.height()), (64, 48));
    let (mut count, mut time) = (0, 0);
    while let Some(frame) = reader.read_next_frame().unwrap() {
        count += 1;
        time += u32::from(frame.delay);
    }
    (count, time)
}

/// The kinds of the boxes of an MP4, which fill it.
fn boxes(bytes: &[u8]) -> Vec<String> {
    let (mut at, mut kinds) = (0, Vec::new());
    while at < bytes.len() {
        let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        kinds.push(String::from_utf8(bytes[at + 4..at + 8].to_vec()).unwrap());
        at += length as usize;
    }
    assert_eq!(at, bytes.len());
    kinds
}

#[test]
fn one_run_writes_every_output_and_other_readers_open_them() {
    let (_home, folder, report) = everything();
    for name in &report.files {
        assert!(folder.join(name).is_file(), "{name}");
    }
    let (pictures, centiseconds) = gif_pictures(&folder.join("motion.gif"));
    // A picture at t = 0, t = 1 and five on; holds of 0.2 s and 0.4 s.
    assert_eq!((pictures, centiseconds), (7, 7 * 20 + 60));
    let mp4 = fs::read(folder.join("motion.mp4")).unwrap();
    assert_eq!(boxes(&mp4), ["ftyp", "moov", "mdat"]);
    let frames = report.files.iter().filter(|n| n.starts_with("frames/"));
    // Each once, those that stand still again.
    assert_eq!(frames.clone().count(), 7 + 1 + 2);
    for name in frames {
        let file = std::io::BufReader::new(File::open(folder.join(name)).unwrap());
        let reader = png::Decoder::new(file).read_info().unwrap();
        assert_eq!((reader.info().width, reader.info().height), (64, 48));
    }
    let svg = fs::read_to_string(folder.join("figure.svg")).unwrap();
    let tree = roxmltree::Document::parse(&svg).unwrap();
    let words: Vec<&str> = tree.descendants().filter_map(|n| n.text()).collect();
    for word in ["t = 0, deployed", "t = 2, compact", "mountain", "closed form 1 × 0 × 0.5 m"] {
        assert!(words.iter().any(|w| w.contains(word)), "{word}: {words:?}");
    }
    let pdf = fs::read(folder.join("figure.pdf")).unwrap();
    assert!(pdf.starts_with(b"%PDF-1.7") && !pdf.windows(6).any(|w| w == b"/Image"));
    let glb = gltf::Gltf::open(folder.join("motion.glb")).unwrap();
    assert_eq!(glb.animations().count(), 1);
    let obj = fs::read_to_string(folder.join("state-0.5.obj")).unwrap();
    assert_eq!(obj.lines().filter(|l| l.starts_with("v ")).count(), 7);
    let stl = fs::read(folder.join("state-2.stl")).unwrap();
    let triangles = u32::from_le_bytes(stl[80..84].try_into().unwrap());
    assert_eq!(stl.len(), 84 + 50 * triangles as usize);
    let page = fs::read_to_string(folder.join("motion.html")).unwrap();
    for part in [&report.title, "Certificate", "closed form", "id=\"fold-file\""] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn every_file_of_a_run_is_reproduced_with_the_same_bytes() {
    let (home, folder, _) = everything();
    let out = home.path().join("again");
    for name in [
        "motion.gif",
        "motion.mp4",
        "frames/0003.png",
        "figure.svg",
        "figure.pdf",
        "motion.glb",
        "motion.html",
        "state-1.5.obj",
    ] {
        let made = again(&folder.join(name), None, &out);
        assert!(made.is_same && made.warnings.is_empty(), "{name}: {made:?}");
        let bytes = [&made.path, &folder.join(name)].map(|p| fs::read(p).unwrap());
        assert!(bytes[0] == bytes[1], "{name}");
    }
    let beside =
        reproduce_file(&folder.join("figure.svg"), None, None, false, &|_, _| true).unwrap();
    assert_eq!(beside.path, folder.join("figure-again.svg"));
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2, "nothing temporary is left");
}

#[test]
fn files_without_source_information_are_refused() {
    let (home, folder, _) = everything();
    let refusal = |file: &Path| {
        let error = reproduce_file(file, None, Some(home.path()), false, &|_, _| true).unwrap_err();
        assert_eq!(error.status(), 2, "{error}");
        error.to_string()
    };
    assert!(refusal(&folder.join("state-1.stl")).contains("for an stl file, use the obj"));
    assert!(refusal(&folder.join("report.json")).contains("no source information"));
    assert!(refusal(&folder.join("missing.gif")).contains("missing.gif"));
    let renamed = folder.join("first.png");
    fs::copy(folder.join("frames/0001.png"), &renamed).unwrap();
    assert!(refusal(&renamed).contains("frames/first.png"));
    // A file whose source information is truncated anywhere is refused.
    let obj = fs::read_to_string(folder.join("state-1.obj")).unwrap();
    let cut = folder.join("cut.obj");
    for lines in 0..6 {
        let head: Vec<&str> = obj.lines().take(lines).collect();
        fs::write(&cut, format!("{}\no sheet\n", head.join("\n"))).unwrap();
        refusal(&cut);
    }
}

#[test]
fn another_version_or_motion_is_reported() {
    let (home, folder, _) = everything();
    let obj = fs::read_to_string(folder.join("state-1.obj")).unwrap();
    let version = format!("version = \"{}\"", env!("CARGO_PKG_VERSION"));
    let other = obj.replace(&version, "version = \"0.0.1\"");
    assert!(other != obj);
    let file = folder.join("old.obj");
    fs::write(&file, other.replace("frames = 20", "frames = 22")).unwrap();
    let made = again(&file, None, home.path());
    assert!(!made.is_same);
    assert!(made.warnings[0].contains("0.0.1"), "{:?}", made.warnings);
    assert!(made.warnings[1].contains("SHA-256"), "{:?}", made.warnings);
}

#[test]
fn pictures_of_a_longer_film_are_removed_and_other_files_are_kept() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("unit");
    run(&folder, &["record.outputs=[\"png\", \"obj\"]"]);
    fs::write(folder.join("frames/mine.txt"), "mine").unwrap();
    let long = fs::read_dir(folder.join("frames")).unwrap().count();
    run(&folder, &["record.outputs=[\"png\"]", "record.hold=0.0"]);
    let short = fs::read_dir(folder.join("frames")).unwrap().count();
    assert_eq!([long, short], [11, 8]);
    assert!(folder.join("state-1.obj").exists(), "it shows the same motion");
    fs::write(folder.join("frames/9999.png"), "mine").unwrap();
    let other = ["record.outputs=[]", "motion.frames=22"];
    let published = run(&folder, &other).published;
    assert!(published.removed.contains(&"frames/0001.png".to_owned()));
    assert!(!folder.join("state-1.obj").exists());
    assert_eq!(published.others, ["frames/9999.png"]);
    let left: Vec<_> = fs::read_dir(folder.join("frames")).unwrap().collect();
    assert_eq!(left.len(), 2, "only what is not ours is left");
    fs::remove_dir_all(folder.join("frames")).unwrap();
    run(&folder, &["record.outputs=[\"png\"]"]);
    run(&folder, &other);
    assert!(!folder.join("frames").exists());
}

#[test]
fn outputs_do_not_depend_on_the_threads_nor_on_each_other() {
    let (_home, folder, report) = everything();
    let alone = tempfile::tempdir().unwrap();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
    let other = alone.path().join("unit");
    let second = pool.unwrap().install(|| run(&other, &[ALL]));
    assert_eq!(report.files, second.files);
    for name in report.files.iter().filter(|n| *n != "report.json") {
        let bytes = [&folder, &other].map(|f| fs::read(f.join(name)).unwrap());
        assert!(bytes[0] == bytes[1], "{name}");
    }
}

/// A FOLD file of another program: a square that folds along its diagonal in three frames without times.
const SQUARE: &str = r#"{"file_spec": 1.1, "file_title": "a square", "frame_classes": ["creasePattern"], "frame_unit": "mm",
"vertices_coords": [[0, 0], [10, 0], [10, 10], [0, 10]],
"edges_vertices": [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2]], "edges_assignment": ["B", "B", "B", "B", "V"],
"faces_vertices": [[0, 1, 2], [0, 2, 3]],
"file_frames": [
{"frame_parent": 0, "frame_inherit": true},
{"frame_parent": 0, "frame_inherit": true, "vertices_coords": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [5, 5, 7.0710678118654755]]},
{"frame_parent": 0, "frame_inherit": true, "vertices_coords": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [9, 1, 1]]}]}"#;

fn square(home: &Path) -> PathBuf {
    let path = home.join("square.fold");
    fs::write(&path, SQUARE).unwrap();
    path
}

fn small(outputs: &[OutputChoice]) -> RecordScene {
    RecordScene {
        outputs: Some(outputs.to_vec()),
        size: Some([64, 48]),
        fps: Some(5.0),
        hold: Some(HoldScene::Each(0.0)),
        ..RecordScene::default()
    }
}

#[test]
fn any_fold_motion_is_recorded_in_metres_and_reproduced() {
    let home = tempfile::tempdir().unwrap();
    let motion = square(home.path());
    let record = RecordScene {
        colour: Some(ColourChoice::Strain),
        camera: Some(CameraScene::Preset(CameraChoice::Turntable)),
        thickened: Some(ThickenedScene::By(0.5)),
        transparent: Some(true),
        caption: Some(true),
        ..small(&[
            OutputChoice::Gif,
            OutputChoice::Mp4,
            OutputChoice::Png,
            OutputChoice::Svg,
            OutputChoice::Pdf,
            OutputChoice::Glb,
            OutputChoice::Obj,
            OutputChoice::Stl,
            OutputChoice::Html,
        ])
    };
    let folder = home.path().join("out");
    let recorded = record_file(&motion, &record, &folder, &|_, _| true).unwrap();
    assert!(!recorded.is_checked);
    // One stage of 5 s, from planar to compact.
    assert_eq!(gif_pictures(&folder.join("motion.gif")).0, 26);
    let obj = fs::read_to_string(folder.join("state-1.obj")).unwrap();
    let numbers = obj.lines().filter(|l| l.starts_with("v "));
    let largest = numbers
        .flat_map(|l| l.split(' ').skip(1))
        .map(|n| n.parse::<f64>().unwrap())
        .fold(0.0, f64::max);
    assert!((largest - 0.01).abs() < 1e-12, "10 mm are 0.01 m: {largest}");
    let svg = fs::read_to_string(folder.join("figure.svg")).unwrap();
    assert!(svg.contains("t = 1.25") && svg.contains("largest bar strain, %"));
    for name in
        ["motion.gif", "figure.pdf", "motion.glb", "motion.html", "state-1.obj", "frames/0002.png"]
    {
        // The motion is in the parent folder; for pictures it is specified.
        let named = name.contains('/').then_some(motion.as_path());
        let made = again(&folder.join(name), named, &home.path().join("again"));
        assert!(made.is_same && made.warnings.is_empty(), "{name}: {made:?}");
    }
}

#[test]
fn other_files_in_the_folder_of_a_motion_are_kept() {
    let (_home, folder, _) = everything();
    let before = fs::read(folder.join("motion.gif")).unwrap();
    let record = small(&[OutputChoice::Svg]);
    let motion = folder.join("motion.fold");
    let recorded = record_file(&motion, &record, &folder, &|_, _| true).unwrap();
    assert_eq!(recorded.files, ["figure.svg"]);
    assert!(recorded.is_checked, "its certificate lies beside it");
    for name in ["report.json", "motion.fold", "certificate.json", "frames/0001.png"] {
        assert!(folder.join(name).exists(), "{name}");
    }
    assert_eq!(fs::read(folder.join("motion.gif")).unwrap(), before);
}

#[test]
fn outputs_that_a_motion_cannot_have_are_refused_with_flag_and_value() {
    let home = tempfile::tempdir().unwrap();
    let motion = square(home.path());
    let folder = home.path().join("out");
    let refusal = |record: RecordScene, words: &[&str]| {
        let error = record_file(&motion, &record, &folder, &|_, _| true).unwrap_err();
        assert_eq!(error.status(), 2);
        let text = error.to_string();
        for word in words {
            assert!(text.contains(word), "{word:?} is missing in: {text}");
        }
        assert!(!folder.exists());
    };
    refusal(small(&[OutputChoice::Fold]), &["--outputs", "\"fold\"", "foldmotion run"]);
    refusal(small(&[OutputChoice::Csv]), &["--outputs", "csv"]);
    let at =
        |times: &[f64]| RecordScene { at: Some(times.to_vec()), ..small(&[OutputChoice::Svg]) };
    refusal(at(&[0.5, 1.0]), &["--at", "0.5", "t = 1 to 2"]);
    refusal(at(&[2.5]), &["--at", "2.5"]);
    refusal(at(&[2.0, 1.0]), &["--at", "rising"]);
    let wide = RecordScene { size: Some([5000, 48]), ..small(&[OutputChoice::Mp4]) };
    refusal(wide, &["--size", "5000", "mp4"]);
    let profile = RecordScene { profile: Some(true), ..small(&[OutputChoice::Svg]) };
    refusal(profile, &["--profile", "run the scene"]);
}

#[test]
fn a_motion_without_crease_pattern_shows_bending_but_no_strain() {
    let home = tempfile::tempdir().unwrap();
    let path = home.path().join("bent.fold");
    let bent = r#"{"vertices_coords": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [5, 5, 7]], "faces_vertices": [[0, 1, 2], [0, 2, 3]],
        "file_frames": [{"frame_parent": 0, "frame_inherit": true},
            {"frame_parent": 0, "frame_inherit": true, "vertices_coords": [[0, 0, 0], [10, 0, 0], [10, 10, 0], [5, 5, 8]]}]}"#;
    fs::write(&path, bent).unwrap();
    let folder = home.path().join("out");
    let with = |colour| RecordScene {
        colour: Some(colour),
        ..small(&[OutputChoice::Gif, OutputChoice::Svg, OutputChoice::Glb])
    };
    let strain = record_file(&path, &with(ColourChoice::Strain), &folder, &|_, _| true);
    let text = strain.unwrap_err().to_string();
    assert!(text.contains("--colour") && text.contains("crease pattern"), "{text}");
    record_file(&path, &with(ColourChoice::Bending), &folder, &|_, _| true).unwrap();
}
