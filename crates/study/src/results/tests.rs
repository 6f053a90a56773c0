//! Which files of an output folder are kept, replaced and removed.

use super::*;

fn write(results: &mut Results, name: &str, text: &str) {
    results
        .write(name, |out| {
            out.write_all(text.as_bytes()).unwrap();
            Ok(())
        })
        .unwrap();
}

fn open(folder: &Path) -> Results {
    Results::open(folder.into(), Command::Run, Some(REPORT)).unwrap()
}

/// Publishes as a run of the motion `of` does.
fn publish(results: Results, of: &str) -> Published {
    let is_stale = |file: &ManifestEntry| file.of.as_deref() != Some(of);
    results.publish(Some(of), &is_stale).unwrap()
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

const OLD_REPORT: &str = r#"{"version": "0.1.0", "engine": {}, "files": ["motion.gif"]}"#;

#[test]
fn published_results_replace_earlier_ones_and_keep_files_of_the_user() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("out/scene");
    let mut first = open(&folder);
    write(&mut first, "motion.gif", "old film");
    write(&mut first, CERTIFICATE, "old certificate");
    write(&mut first, REPORT, OLD_REPORT);
    publish(first, "old motion");
    for name in ["notes.txt", "figure.pdf"] {
        fs::write(folder.join(name), "mine").unwrap();
    }
    let mut second = open(&folder);
    write(&mut second, "motion.fold", "new motion");
    write(&mut second, REPORT, "new report");
    let published = publish(second, "new motion");
    assert_eq!(published.removed, [CERTIFICATE, "motion.gif"]);
    assert_eq!(published.others, ["figure.pdf"]);
    assert_eq!(text(&folder, REPORT), "new report");
    assert_eq!(text(&folder, "notes.txt"), "mine");
    assert_eq!(text(&folder, "figure.pdf"), "mine");
    assert!(!folder.join("motion.gif").exists(), "a film of another motion would mislead");
    assert!(!folder.join(CERTIFICATE).exists());
    assert_eq!(
        fs::read_dir(home.path().join("out")).unwrap().count(),
        1,
        "nothing temporary is left"
    );
}

#[test]
fn earlier_results_of_the_same_motion_stay_and_may_be_replaced_later() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    for name in ["motion.gif", "motion.mp4", "motion.gif"] {
        let mut results = open(&folder);
        results.require_clear(&|_| true).unwrap();
        write(&mut results, name, "a film");
        write(&mut results, REPORT, OLD_REPORT);
        assert_eq!(publish(results, "motion"), Published::default());
    }
    assert_eq!(text(&folder, "motion.mp4"), "a film");
    assert_eq!(text(&folder, "motion.gif"), "a film");
}

#[test]
fn files_that_no_earlier_run_made_are_named_and_kept_unless_forced() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    let mut first = open(&folder);
    write(&mut first, "motion.gif", "a film");
    write(&mut first, "plots.svg", "plots");
    publish(first, "motion");
    // One of its own is changed, one is new, one is of another command.
    fs::write(folder.join("motion.gif"), "an edited film").unwrap();
    fs::write(folder.join("figure.pdf"), "mine").unwrap();
    let mut record = Results::open((&folder).into(), Command::Record, None).unwrap();
    write(&mut record, "motion.mp4", "another film");
    record.publish(Some("motion"), &|_| false).unwrap();
    let names = ["figure.pdf", "motion.gif", "motion.mp4"];
    let error = open(&folder).require_clear(&|_| true).unwrap_err();
    assert_eq!(error.status(), 2);
    for word in names.iter().chain(&["--force", "foldmotion run"]) {
        assert!(error.to_string().contains(word), "{error}");
    }
    assert!(!error.to_string().contains("plots.svg"), "{error}");
    // Had they come while the run was computed.
    let mut late = open(&folder);
    for name in names {
        write(&mut late, name, "new");
    }
    let published = publish(late, "motion");
    assert_eq!(published.skipped, names);
    assert_eq!(text(&folder, "figure.pdf"), "mine");
    assert_eq!(text(&folder, "motion.gif"), "an edited film");
    assert_eq!(text(&folder, "motion.mp4"), "another film");
    let forced = Destination::from(&folder).replacing(true);
    let mut forced = Results::open(forced, Command::Run, Some(REPORT)).unwrap();
    forced.require_clear(&|_| true).unwrap();
    for name in names {
        write(&mut forced, name, "new");
    }
    assert_eq!(publish(forced, "motion"), Published::default());
    assert_eq!(text(&folder, "figure.pdf"), "new");
    // From then on they are the run's.
    open(&folder).require_clear(&|_| true).unwrap();
}

#[test]
fn a_file_with_the_same_bytes_is_no_conflict() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    let mut run = open(&folder);
    write(&mut run, CERTIFICATE, "a certificate");
    publish(run, "motion");
    let mut check = Results::open((&folder).into(), Command::Check, None).unwrap();
    write(&mut check, CERTIFICATE, "a certificate");
    check.publish(Some("motion"), &|_| false).unwrap();
    open(&folder).require_clear(&|_| true).unwrap();
}

#[test]
fn without_a_manifest_the_report_of_a_run_lists_its_files_and_other_reports_are_kept() {
    let home = tempfile::tempdir().unwrap();
    for name in ["motion.gif", "plots.svg"] {
        fs::write(home.path().join(name), "old").unwrap();
    }
    fs::write(home.path().join(REPORT), OLD_REPORT).unwrap();
    let refused = |names: &[&str]| {
        let results = open(home.path());
        let error = results.require_clear(&|_| true).unwrap_err().to_string();
        names.iter().all(|name| error.contains(name)) && !error.contains("motion.gif")
    };
    assert!(refused(&["plots.svg"]));
    fs::write(home.path().join(REPORT), r#"{"of": "mine"}"#).unwrap();
    fs::remove_file(home.path().join("motion.gif")).unwrap();
    assert!(refused(&["plots.svg", REPORT]));
}

#[test]
fn a_manifest_that_names_files_of_other_folders_removes_none() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    fs::create_dir(&folder).unwrap();
    fs::write(home.path().join("mine.txt"), "mine").unwrap();
    let list = r#"{"files": [{"name": "../mine.txt", "by": "run", "sha256": null, "of": null}]}"#;
    fs::write(folder.join(MANIFEST), list).unwrap();
    assert_eq!(publish(open(&folder), "motion"), Published::default());
    assert_eq!(text(home.path(), "mine.txt"), "mine");
}

#[test]
fn folders_of_killed_runs_are_removed_and_those_of_running_ones_are_kept() {
    let home = tempfile::tempdir().unwrap();
    // No system gives a process this number.
    let dead = home.path().join(".scene.partial-4294967295");
    let other = home.path().join(".other.partial-4294967295");
    let living = home.path().join(".scene.partial-1");
    let locked = home.path().join(".scene.partial-4294967294");
    for folder in [&dead, &other, &living, &locked] {
        fs::create_dir(folder).unwrap();
        fs::write(folder.join(MOTION), "half a motion").unwrap();
    }
    let lock = abandoned::lock(&locked);
    drop(open(&home.path().join("scene")));
    assert!(!dead.exists());
    assert!(other.exists() && living.exists() && locked.exists());
    drop(lock);
    drop(open(&home.path().join("scene")));
    assert!(!locked.exists());
}

#[test]
fn dropped_results_leave_earlier_ones_unchanged() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    let mut first = open(&folder);
    write(&mut first, REPORT, "earlier");
    publish(first, "motion");
    let mut failed = open(&folder);
    write(&mut failed, REPORT, "never");
    drop(failed);
    assert_eq!(text(&folder, REPORT), "earlier");
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
}

#[test]
fn a_file_with_the_name_of_the_output_folder_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("scene");
    fs::write(&folder, "a file").unwrap();
    let error = Results::open((&folder).into(), Command::Run, None).unwrap_err();
    assert!(error.to_string().contains("it is a file"), "{error}");
    assert_eq!(fs::read_to_string(&folder).unwrap(), "a file");
}
