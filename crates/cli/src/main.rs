//! The program `foldmotion`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(foldmotion_cli::run(std::env::args_os()))
}
