//! Edits of arrays: unchanged elements at either end keep their formatting.

use std::ops::Range;

use toml_edit::Array;

use super::comments::{has_comment, text_of};
use super::value::Value;

/// The elements that differ between two lists.
pub(super) struct ChangedRange {
    /// Indices of the elements of the old list that change.
    pub(super) old: Range<usize>,
    /// Indices of the elements of the new list that they become.
    pub(super) new: Range<usize>,
}

impl ChangedRange {
    pub(super) fn between(old: &[Value], new: &[Value]) -> Self {
        let shorter = old.len().min(new.len());
        let start = (0..shorter).take_while(|&i| old[i] == new[i]).count();
        let end = (0..shorter - start)
            .take_while(|&i| old[old.len() - 1 - i] == new[new.len() - 1 - i])
            .count();
        Self { old: start..old.len() - end, new: start..new.len() - end }
    }

    /// The number of elements that are changed in place.
    pub(super) fn shared(&self) -> usize {
        self.old.len().min(self.new.len())
    }

    /// The elements that are inserted, each with its index.
    pub(super) fn inserted<'a>(
        &self,
        new: &'a [Value],
    ) -> impl Iterator<Item = (usize, &'a Value)> + use<'a> {
        let start = self.new.start + self.shared();
        (start..).zip(&new[start..self.new.end.max(start)])
    }
}

/// Moves the whitespace after the last element to the end of the list.
pub(super) fn release_trailing_space(list: &mut Array) {
    if list.trailing_comma() {
        return;
    }
    let Some(last) = list.len().checked_sub(1).and_then(|i| list.get_mut(i)) else {
        return;
    };
    let space = text_of(last.decor().suffix());
    last.decor_mut().set_suffix("");
    list.set_trailing_comma(space.contains('\n'));
    let own = text_of(Some(list.trailing()));
    list.set_trailing(space + &own);
}

fn prefix(list: &Array, index: usize) -> Option<String> {
    list.get(index).map(|value| text_of(value.decor().prefix()))
}

fn set_prefix(list: &mut Array, index: usize, space: &str) {
    if let Some(value) = list.get_mut(index) {
        value.decor_mut().set_prefix(space);
    }
}

/// Removes an element. If it was the first, the next one takes over the whitespace before it.
pub(super) fn remove(list: &mut Array, index: usize) {
    let first = (index == 0).then(|| prefix(list, 0)).flatten();
    list.remove(index);
    if let (Some(first), Some(own)) = (first, prefix(list, 0))
        && !has_comment(&own)
    {
        set_prefix(list, 0, &first);
    }
    if list.is_empty() && !has_comment(&text_of(Some(list.trailing()))) {
        list.clear();
        list.set_trailing("");
        list.set_trailing_comma(false);
    }
}

/// Inserts an element with the spacing of its neighbours.
pub(super) fn insert(list: &mut Array, index: usize, mut value: toml_edit::Value) {
    let lead = prefix(list, 0).unwrap_or_default();
    let between = match prefix(list, index.saturating_sub(1).max(1)) {
        Some(space) => bare(&space),
        None if lead.contains('\n') => bare(&lead),
        None => " ".to_owned(),
    };
    let own = if index == 0 { bare(&lead) } else { between.clone() };
    value.decor_mut().set_prefix(own);
    value.decor_mut().set_suffix("");
    if index == 0 && !has_comment(&lead) {
        set_prefix(list, 0, &between);
    }
    list.insert_formatted(index, value);
}

/// The whitespace without its comments.
fn bare(space: &str) -> String {
    if !has_comment(space) {
        return space.to_owned();
    }
    let indent = space.rfind('\n').map_or("", |end| &space[end + 1..]);
    format!("\n{indent}")
}
