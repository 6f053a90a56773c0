//! `foldmotion paper` as a user sees it: parts, files, reuse, refusals.

#![expect(clippy::unwrap_used, reason = "a test fails where something is missing")]

mod common;

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use common::{assert_status, foldmotion, text};

fn paper(folder: &Path, only: &str) -> Output {
    foldmotion(folder, &["paper", "--out", "paper", "--only", only])
}

fn record(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("paper/paper.json")).unwrap()).unwrap()
}

#[test]
fn table_1_is_compared_with_the_papers_numbers_in_record_and_page() {
    let home = tempfile::tempdir().unwrap();
    let output = paper(home.path(), "table1");
    assert_status(&output, 0);
    let record = record(home.path());
    let rows = record["table1"].as_array().unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    assert_eq!(rows.len(), 9);
    for row in rows {
        let paper = &row["paper"];
        for key in ["max_residual", "mean_residual", "seconds"] {
            assert!(number(&row[key]) <= number(&paper[key]), "{row}");
        }
    }
    let bunny = &rows[8];
    assert_eq!(
        (&bunny["model"], &bunny["rows"], &bunny["columns"]),
        (&"bunny".into(), &100.into(), &5.into())
    );
    assert_eq!(bunny["paper"]["max_residual"], 7.24736e-11);
    assert_eq!(bunny["paper"]["seconds"], 56.024);
    assert_eq!(record["cases"].as_array().unwrap().len(), 36);
    assert!(record["cases"][0]["simulated"].is_null());
    let page = fs::read_to_string(home.path().join("paper/index.html")).unwrap();
    for words in ["7.247e-11", "56.024", "100 × 8", "Areas and volumes"] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("http://") && !page.contains("https://"), "the page needs no network");
}

#[test]
fn finished_parts_are_reused_and_damaged_ones_recomputed_with_the_same_bytes() {
    let home = tempfile::tempdir().unwrap();
    let file = |name: &str| fs::read(home.path().join("paper").join(name)).unwrap();
    let printed = |only: &str| text(&paper(home.path(), only).stdout);
    assert!(printed("fig10,fig1").contains("2 parts computed, 0 reused"));
    let (svg, png) = (file("fig10.svg"), file("fig10.png"));
    assert!(text(&svg).starts_with("<svg ") && png.starts_with(b"\x89PNG"));
    assert!(printed("fig1,fig10,fig10").contains("0 parts computed, 2 reused"));
    fs::remove_file(home.path().join("paper/fig10.svg")).unwrap();
    fs::write(home.path().join("paper/fig1.png"), "torn").unwrap();
    assert!(printed("table2,fig1,fig10").contains("2 parts computed, 0 reused"));
    assert_eq!((file("fig10.svg"), file("fig10.png")), (svg, png));
    let page = text(&file("index.html"));
    assert!(page.contains("id=\"fig1\"") && page.contains("id=\"fig10\""));
    assert!(printed("table1").contains("0 parts computed, 0 reused"));
    let figures = record(home.path())["figures"].as_array().unwrap().len();
    assert_eq!(figures, 2, "finished figures stay in the record");
}

#[test]
fn an_unknown_part_is_refused_with_the_list_of_parts_and_writes_no_files() {
    let home = tempfile::tempdir().unwrap();
    let output = paper(home.path(), "table1,fig11");
    assert_status(&output, 2);
    let message = text(&output.stderr);
    assert!(message.contains("\"fig11\"") && message.contains("fig10, unfoldings"), "{message}");
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 0);
}

#[test]
fn a_folder_that_cannot_be_written_is_refused() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("paper"), "a file").unwrap();
    let output = paper(home.path(), "table1");
    assert_status(&output, 3);
    assert!(text(&output.stderr).contains("choose another folder with --out"));
    assert_eq!(fs::read_to_string(home.path().join("paper")).unwrap(), "a file");
}
