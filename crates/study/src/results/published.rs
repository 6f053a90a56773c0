//! What became of the other files in a folder of results.

/// What became of the other files in a folder of results.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Published {
    /// Files of others that stayed under the name of one of the results.
    pub skipped: Vec<String>,
    /// Files made before that were removed.
    pub removed: Vec<String>,
    /// Files of others that have names of results.
    pub others: Vec<String>,
}

impl Published {
    /// In words, a line each.
    pub fn words(&self) -> Vec<String> {
        let lines = [
            (
                "left as they are and not written, because this command did not make them or they were changed since (--force \
                 replaces them)",
                &self.skipped,
            ),
            (
                "removed, because an earlier motion made them",
                &self.removed,
            ),
            ("left as they are, though not of this run", &self.others),
        ];
        let told = lines.into_iter().filter(|(_, names)| !names.is_empty());
        told.map(|(what, names)| format!("{what}: {}", list_names(names)))
            .collect()
    }
}

/// Names for a message, not too many.
pub fn list_names(names: &[String]) -> String {
    const MOST: usize = 8;
    let mut text = names.iter().take(MOST).cloned().collect::<Vec<_>>();
    if names.len() > MOST {
        text.push(format!("{} more", names.len() - MOST));
    }
    text.join(", ")
}
