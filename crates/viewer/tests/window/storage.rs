//! The settings of a window, kept in memory.

use std::collections::BTreeMap;

/// A storage that successive windows of a test share.
#[derive(Debug, Default)]
pub(crate) struct Storage(BTreeMap<String, String>);

impl Storage {
    /// A copy of the current state, for a window that may live as long as the program.
    pub(crate) fn shared(&self) -> &'static Self {
        Box::leak(Box::new(Self(self.0.clone())))
    }
}

impl eframe::Storage for Storage {
    fn get_string(&self, key: &str) -> Option<String> {
        self.0.get(key).cloned()
    }

    fn set_string(&mut self, key: &str, value: String) {
        self.0.insert(key.to_owned(), value);
    }

    fn remove_string(&mut self, key: &str) {
        self.0.remove(key);
    }

    fn flush(&mut self) {}
}
