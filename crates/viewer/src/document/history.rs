//! Undo and redo.

use std::collections::VecDeque;
use std::sync::Arc;

/// The largest number of steps that are kept.
const MAX_STEPS: usize = 500;
/// The largest size of the texts that are kept, bytes.
const MAX_BYTES: usize = 16 << 20;

/// A change of the text.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub(super) label: String,
    pub(super) before: Arc<str>,
    pub(super) after: Arc<str>,
}

/// The changes that can be undone and redone.
#[derive(Debug, Default)]
pub(super) struct History {
    done: VecDeque<Step>,
    undone: Vec<Step>,
    /// Whether the next change may be merged into the last step.
    open: bool,
}

impl History {
    /// Records a change. A change that `continues` the last one with the same label is merged into it.
    pub(super) fn record(&mut self, step: Step, continues: bool) {
        self.undone.clear();
        match self.done.back_mut() {
            Some(last) if continues && self.open && last.label == step.label => {
                last.after = step.after;
            }
            _ => self.done.push_back(step),
        }
        self.open = true;
        self.forget();
    }

    /// Ends the current step, so that the next change is not merged into it.
    pub(super) fn end_step(&mut self) {
        self.open = false;
    }

    pub(super) fn undo(&mut self) -> Option<&Step> {
        let step = self.done.pop_back()?;
        self.open = false;
        self.undone.push(step);
        self.undone.last()
    }

    pub(super) fn redo(&mut self) -> Option<&Step> {
        let step = self.undone.pop()?;
        self.open = false;
        self.done.push_back(step);
        self.done.back()
    }

    pub(super) fn last_done(&self) -> Option<&str> {
        self.done.back().map(|step| step.label.as_str())
    }

    pub(super) fn last_undone(&self) -> Option<&str> {
        self.undone.last().map(|step| step.label.as_str())
    }

    /// Replaces every text for which `rewritten` returns another.
    pub(super) fn rewrite(&mut self, rewritten: impl Fn(&str) -> Option<String>) {
        for step in self.done.iter_mut().chain(&mut self.undone) {
            for text in [&mut step.before, &mut step.after] {
                if let Some(new) = rewritten(text) {
                    *text = new.into();
                }
            }
        }
    }

    /// Removes the oldest steps. Neighbouring steps share a text, so only one text of each is counted.
    fn forget(&mut self) {
        let mut bytes: usize = self.done.iter().map(|step| step.before.len()).sum();
        while self.done.len() > MAX_STEPS || (bytes > MAX_BYTES && self.done.len() > 1) {
            if let Some(oldest) = self.done.pop_front() {
                bytes -= oldest.before.len();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn step(before: &str, after: &str) -> Step {
        Step { label: "edit".to_owned(), before: before.into(), after: after.into() }
    }

    #[test]
    fn the_history_is_bounded_in_steps_and_bytes() {
        let mut history = History::default();
        for k in 0..2 * MAX_STEPS {
            history.record(step(&k.to_string(), &(k + 1).to_string()), false);
        }
        assert_eq!(history.done.len(), MAX_STEPS);
        assert_eq!(&*history.undo().unwrap().after, (2 * MAX_STEPS).to_string());
        let large = "x".repeat(MAX_BYTES / 3);
        for _ in 0..9 {
            history.record(step(&large, &large), false);
        }
        assert_eq!(history.done.len(), 3);
        let huge = "x".repeat(2 * MAX_BYTES);
        history.record(step(&huge, ""), false);
        assert_eq!(history.done.len(), 1);
    }

    #[test]
    fn changes_are_merged_only_if_they_continue_the_last() {
        let mut history = History::default();
        history.record(step("a", "b"), true);
        history.record(step("b", "c"), true);
        assert_eq!(&*history.undo().unwrap().before, "a");
        assert!(history.undo().is_none());
        history.redo();
        history.record(step("c", "d"), true);
        history.end_step();
        history.record(step("d", "e"), true);
        for before in ["d", "c", "a"] {
            assert_eq!(&*history.undo().unwrap().before, before);
        }
    }
}
