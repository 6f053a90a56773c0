//! What happened to other files in the output folder.

/// What happened to other files in the output folder.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Published {
    /// Files of the user that were kept instead of results with the same name.
    pub skipped: Vec<String>,
    /// Earlier results that were removed.
    pub removed: Vec<String>,
    /// Files with names of results that this command did not write.
    pub others: Vec<String>,
}

impl Published {
    /// The messages for the user.
    pub fn words(&self) -> Vec<String> {
        let lines = [
            (
                "kept instead of new results, because this command did not make them or they were changed since (--force replaces \
                 them)",
                &self.skipped,
            ),
            ("removed, because they show an earlier motion", &self.removed),
            ("kept, although this run did not make them", &self.others),
        ];
        let messages = lines.into_iter().filter(|(_, names)| !names.is_empty());
        messages.map(|(what, names)| format!("{what}: {}", list_names(names))).collect()
    }
}

/// The first names of a list for a message, with the number of the others.
pub fn list_names(names: &[String]) -> String {
    const MOST: usize = 8;
    let mut text = names.iter().take(MOST).cloned().collect::<Vec<_>>();
    if names.len() > MOST {
        text.push(format!("{} more", names.len() - MOST));
    }
    text.join(", ")
}
