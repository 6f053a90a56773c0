//! The space that files take on a disk.

use crate::scene::OutputChoice;

/// Bytes of the files of a recording, by output.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Space(Vec<(OutputChoice, u64)>);

impl Space {
    /// The bytes of all outputs.
    pub(crate) fn total(&self) -> u64 {
        self.0.iter().map(|(_, bytes)| bytes).sum()
    }

    /// Adds `bytes` to an output.
    pub(crate) fn add(&mut self, output: OutputChoice, bytes: u64) {
        let mut known = self.0.iter_mut();
        match known.find(|(known, _)| *known == output) {
            Some((_, sum)) => *sum += bytes,
            None => self.0.push((output, bytes)),
        }
    }

    /// The outputs with their bytes.
    #[cfg(all(test, feature = "mp4"))]
    pub(crate) fn each(&self) -> impl Iterator<Item = (OutputChoice, u64)> {
        self.0.iter().copied()
    }

    /// Advice on how to make the files smaller: reduce or omit the largest output.
    pub(crate) fn remedy(&self) -> String {
        let Some((output, _)) = self.0.iter().max_by_key(|(_, bytes)| *bytes) else {
            return "free space".to_owned();
        };
        let name = output.name();
        let mut remedy = format!("omit {name} from record.outputs");
        if [OutputChoice::Gif, OutputChoice::Mp4, OutputChoice::Png].contains(output) {
            remedy += ", or make record.size, record.fps or record.seconds smaller";
        }
        remedy
    }

    /// The outputs with their sizes in words, the largest first.
    pub(crate) fn words(&self) -> String {
        let mut sizes = self.0.clone();
        sizes.sort_by_key(|&(output, bytes)| (std::cmp::Reverse(bytes), output));
        let words =
            sizes.iter().map(|&(output, bytes)| format!("{} {}", output.name(), size_words(bytes)));
        words.collect::<Vec<_>>().join(", ")
    }
}

/// A number of bytes in words, such as `1.5 MB`.
pub(crate) fn size_words(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}
