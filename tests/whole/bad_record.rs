//! Bad values of `[record]`, and lists with a wrong number of values, are refused with the key, the line and the value.

use std::path::Path;

use foldmotion_study::SceneSource;

use super::bad_input::{GOOD, refusal, refuses_all};

#[test]
fn values_of_record_are_refused_by_key_line_and_value() {
    let cases: &[(&str, &[&str])] = &[
        ("[record]\nsize = [0, 480]", &["record.size = [0, 480]"]),
        ("[record]\nsize = [480, 100000]", &["record.size"]),
        ("[record]\nfps = 0.0", &["record.fps = 0.0"]),
        ("[record]\nseconds = [1.0, -1.0]", &["record.seconds"]),
        ("[record]\nhold = nan", &["record.hold = nan"]),
        ("[record]\noutputs = [\"film\"]", &["scene.toml:10"]),
        (
            "[record]\noutputs = [\"mp4\"]\nsize = [8, 8]",
            &["scene.toml:11", "record.size = [8, 8]", "mp4"],
        ),
        ("[record]\nat = []", &["scene.toml:10", "record.at = []"]),
        ("[record]\nat = [1.0, 0.5]", &["record.at", "rising"]),
        ("[record]\nat = [-0.5]", &["record.at = [-0.5]"]),
        ("[record]\nhold = [1.0, 2.0]", &["scene.toml:10", "three"]),
        ("[record]\ncolour = \"red\"", &["scene.toml:10", "strain"]),
        ("[record]\nloop = \"twice\"", &["scene.toml:10", "back-and-forth"]),
        ("[record]\ncamera = \"below\"", &["scene.toml:10", "turntable"]),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 91.0 }",
            &["scene.toml:10", "record.camera", "elevation"],
        ),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, width = 0.0 }",
            &["scene.toml:10", "record.camera", "width"],
        ),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, width = inf }",
            &["scene.toml:10", "record.camera", "width"],
        ),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, centre = [0.0, nan, 0.0] }",
            &["scene.toml:10", "record.camera", "centre"],
        ),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, centre = [0.0, 0.0] }",
            &["scene.toml:10", "camera must be"],
        ),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, turn = nan }",
            &["record.camera", "turn"],
        ),
        ("[record]\nthickened = true", &["record.thickened = true", "material.thickness"]),
        ("[record]\nthickened = -1.0", &["record.thickened = -1.0", "positive"]),
    ];
    refuses_all(cases);
}

#[test]
fn lists_of_a_fixed_length_accept_neither_fewer_nor_more_values() {
    let points = ["[0.0, 0.0, 5.0, 1.0]", "[0.0, 0.0, \"x\"]", "[0.0]"];
    for point in points {
        for key in ["control_points", "points"] {
            let text = GOOD.replace("control_points", key).replace("[0.0, 0.0]", point);
            let message = refusal(&text);
            assert!(message.contains("scene.toml:2"), "{point}: {message}");
        }
    }
    let extra = refusal(&GOOD.replace("[0.0, 0.0]", points[0]));
    assert!(extra.contains("a list of 4 values, but exactly 2"), "{extra}");
    refuses_all(&[
        ("[record]\nsize = [96, 72, 7]", &["scene.toml:10", "exactly 2"]),
        ("[record]\nseconds = [1.0, 1.0, 1.0]", &["scene.toml:10", "exactly 2"]),
        ("[record]\nhold = [1.0, 1.0, 1.0, 1.0]", &["scene.toml:10", "three"]),
        (
            "[record]\ncamera = { azimuth = 0.0, elevation = 0.0, centre = [0.0, 0.0, 0.0, 0.0] }",
            &["scene.toml:10", "camera must be"],
        ),
    ]);
    let mut source = SceneSource::new(Path::new("scene.toml"), GOOD.to_owned());
    source.set("record.size=[96, 72, 7]").unwrap();
    let message = source.scene().unwrap_err().to_string();
    assert!(message.contains("exactly 2"), "{message}");
}
