//! The number of threads, from the command line.

pub(crate) fn parse_threads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(threads @ 1..=1024) => Ok(threads),
        _ => Err("expected a number between 1 and 1024".to_owned()),
    }
}
