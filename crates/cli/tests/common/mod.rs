//! The binary, started as a user starts it.

use std::path::Path;
use std::process::{Command, Output};

pub(crate) fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_foldmotion"));
    command.args(arguments).current_dir(folder);
    command
}

pub(crate) fn foldmotion(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Checks the exit status; a failure shows stderr and stdout.
#[track_caller]
pub(crate) fn assert_status(output: &Output, status: i32) {
    let shown = [&output.stderr, &output.stdout].map(|bytes| text(bytes));
    assert_eq!(output.status.code(), Some(status), "{shown:?}");
}
