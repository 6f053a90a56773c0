//! Opening, editing, undoing, saving and moving scenes.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn rows(document: &mut Document, rows: i64, continues: bool) -> bool {
    let mut scene = document.scene().clone();
    scene.sheet.rows = Some(rows);
    document.change(scene, "rows", continues)
}

/// A scene file in its own temporary folder.
fn on_disk(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.toml");
    fs::write(&path, text).unwrap();
    (folder, path)
}

#[test]
fn a_new_scene_is_the_shelter_unmodified_and_without_a_file() {
    let mut document = Document::new();
    assert!(document.parse_error().is_none() && !document.is_modified());
    assert_eq!(document.scene().profile.model.as_deref(), Some("shelter"));
    assert_eq!(document.name(), "untitled.toml");
    assert!(matches!(document.save(), Err(SaveError::NoFile)));
}

#[test]
fn an_edit_is_undone_and_redone_and_undone_back_to_the_saved_text_is_unmodified() {
    let mut document = Document::open(&scenes().join("shelter-sii.toml")).unwrap();
    let (text, revision) = (document.text().to_owned(), document.revision());
    assert!(rows(&mut document, 9, false));
    assert!(document.is_modified() && document.revision() > revision);
    assert_eq!(document.can_undo(), Some("rows"));
    let edited = document.text().to_owned();
    assert_eq!(document.undo().as_deref(), Some("rows"));
    assert!(document.text() == text && !document.is_modified());
    assert_eq!(document.scene().sheet.rows, None);
    assert_eq!((document.can_undo(), document.can_redo()), (None, Some("rows")));
    assert_eq!(document.redo().as_deref(), Some("rows"));
    assert_eq!(document.text(), edited);
    assert_eq!(document.redo(), None);
}

#[test]
fn changes_that_continue_are_one_step_and_no_change_is_none() {
    let mut document = Document::new();
    for k in 0..5 {
        assert!(rows(&mut document, 10 + k, k > 0));
    }
    let revision = document.revision();
    assert!(rows(&mut document, 14, true));
    assert_eq!(document.revision(), revision);
    document.end_step();
    assert!(rows(&mut document, 20, true));
    document.undo();
    assert_eq!(document.scene().sheet.rows, Some(14));
    document.undo();
    assert_eq!(document.scene().sheet.rows, Some(7));
    assert!(!document.is_modified() && document.undo().is_none());
}

#[test]
fn a_scene_with_an_error_opens_with_its_text_and_the_error_says_where() {
    let (_folder, path) = on_disk("[sheet]\nrows = \"seven\"\n");
    let mut document = Document::open(&path).unwrap();
    let error = document.parse_error().unwrap().to_string();
    assert!(error.contains("a.toml:2"), "{error}");
    assert_eq!(document.text(), "[sheet]\nrows = \"seven\"\n");
    // A change that does not correct the error is refused; one that does is accepted.
    let mut scene = document.scene().clone();
    scene.sheet.columns = Some(3);
    assert!(!document.change(scene, "columns", false) && !document.is_modified());
    assert!(rows(&mut document, 3, false));
    assert!(document.parse_error().is_none());
    assert_eq!(document.text(), "[sheet]\nrows = 3\n");
}

#[test]
fn while_the_text_has_an_error_the_scene_is_the_last_that_had_none() {
    let mut document = Document::new();
    document.set_text("[sheet]\nrows = 3\n", false);
    document.set_text("[sheet\n", true);
    assert_eq!(document.scene().sheet.rows, Some(3));
    assert!(document.parse_error().is_some());
    assert!(!rows(&mut document, 4, false) && document.text() == "[sheet\n");
    assert_eq!(document.undo().as_deref(), Some("text"));
    assert!(document.parse_error().is_none() && !document.is_modified());
}

#[test]
fn only_what_cannot_be_read_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let unreadable =
        [folder.path().to_owned(), folder.path().join("none.toml"), folder.path().join("none.svg")];
    let binary = folder.path().join("binary.toml");
    fs::write(&binary, [0xff, 0xfe, 0x00]).unwrap();
    let large = folder.path().join("large.toml");
    fs::File::create(&large).unwrap().set_len(1 << 30).unwrap();
    for path in unreadable.iter().chain([&binary, &large]) {
        let error = Document::open(path).unwrap_err();
        assert!(matches!(error, StudyError::Read { .. }), "{error}");
    }
}

#[test]
fn a_crease_pattern_opens_as_a_scene_that_names_it_and_is_never_overwritten() {
    let mut document = Document::open(&scenes().join("imported/crane.fold")).unwrap();
    assert_eq!(document.text(), "[pattern]\nfile = \"crane.fold\"\n");
    assert_eq!((document.path(), document.is_modified()), (None, false));
    assert_eq!(document.name_to_save(), "crane.toml");
    assert!(foldmotion_study::Study::resolve(&document.source()).is_ok());
    let folder = tempfile::tempdir().unwrap();
    let pattern = folder.path().join("x.FOLD");
    assert!(matches!(document.save_as(&pattern), Err(SaveError::Ending { .. })));
    assert!(!pattern.exists());
}

#[test]
fn saving_writes_the_text_and_notices_what_another_program_wrote() {
    let (folder, path) = on_disk("[sheet]\nrows = 3 # three\n");
    let mut document = Document::open(&path).unwrap();
    assert!(rows(&mut document, 4, false));
    document.save().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "[sheet]\nrows = 4 # three\n");
    assert!(!document.is_modified());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);

    assert!(rows(&mut document, 5, true));
    fs::write(&path, "[sheet]\nrows = 30\n").unwrap();
    assert!(document.changed_on_disk());
    assert!(matches!(document.save(), Err(SaveError::Changed { .. })));
    assert_eq!(fs::read_to_string(&path).unwrap(), "[sheet]\nrows = 30\n");
    document.reload().unwrap();
    assert!(document.scene().sheet.rows == Some(30) && !document.is_modified());
    document.undo();
    assert!(document.scene().sheet.rows == Some(5) && document.is_modified());
    document.save().unwrap();

    fs::write(&path, "").unwrap();
    assert!(rows(&mut document, 6, false));
    document.save_over().unwrap();
    fs::remove_file(&path).unwrap();
    assert!(rows(&mut document, 7, false));
    document.save().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), document.text());
}

#[test]
fn a_file_that_cannot_be_written_leaves_the_scene_modified() {
    let (_folder, path) = on_disk("");
    let mut document = Document::open(&path).unwrap();
    assert!(rows(&mut document, 4, false));
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let error = document.save().unwrap_err().to_string();
    assert!(error.contains("read-only") && document.is_modified(), "{error}");
    let nowhere = path.with_file_name("no folder").join("a.toml");
    assert!(document.save_as(&nowhere).is_err());
    assert_eq!(document.path(), Some(&*path));
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let (folder, path) = on_disk("");
    let link = folder.path().join("link.toml");
    std::os::unix::fs::symlink(&path, &link).unwrap();
    let mut document = Document::open(&link).unwrap();
    assert!(rows(&mut document, 4, false));
    document.save().unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read_to_string(&path).unwrap(), document.text());
}

#[test]
fn a_scene_saved_elsewhere_names_the_same_files_even_after_undo() {
    let (folder, path) = on_disk("[profile]\nfile = \"curve.csv\" # drawn\n");
    fs::write(folder.path().join("curve.csv"), "0,0\n1,0\n").unwrap();
    let mut document = Document::open(&path).unwrap();
    assert!(rows(&mut document, 4, false));
    let below = folder.path().join("below");
    fs::create_dir(&below).unwrap();
    document.save_as(&below.join("b.toml")).unwrap();
    assert_eq!(document.scene().profile.file.as_deref(), Some("../curve.csv"));
    assert!(document.text().contains("# drawn") && !document.is_modified());
    document.undo();
    assert_eq!(document.text(), "[profile]\nfile = \"../curve.csv\" # drawn\n");
    document.redo();
    document.save_as(&folder.path().join("c.toml")).unwrap();
    assert_eq!(document.scene().profile.file.as_deref(), Some("curve.csv"));
    assert_eq!(document.name_of(&below.join("x.dxf")), "below/x.dxf");
}

#[test]
fn a_restored_scene_keeps_its_file_and_can_be_undone() {
    let (_folder, path) = on_disk("[sheet]\nrows = 3\n");
    let mut document =
        Document::restored(&path, Some(&path), "[sheet]\nrows = 3\n", "[sheet]\nrows = 4\n");
    assert!(document.is_modified() && document.scene().sheet.rows == Some(4));
    document.undo();
    assert!(!document.is_modified());
    document.redo();
    document.save().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "[sheet]\nrows = 4\n");
}
