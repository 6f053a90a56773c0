//! Lists: elements at either end that stay, stay as they are written.

use std::ops::Range;

use toml_edit::{Array, ArrayOfTables};

use super::comments::{apart, has_comment, text_of};
use super::value::Value;
use super::{Place, literal, table};

/// Which elements change: these of the old list become those of the new one.
struct Change {
    old: Range<usize>,
    new: Range<usize>,
}

impl Change {
    fn between(old: &[Value], new: &[Value]) -> Self {
        let shorter = old.len().min(new.len());
        let start = (0..shorter).take_while(|&i| old[i] == new[i]).count();
        let end = (0..shorter - start)
            .take_while(|&i| old[old.len() - 1 - i] == new[new.len() - 1 - i])
            .count();
        Self {
            old: start..old.len() - end,
            new: start..new.len() - end,
        }
    }

    /// How many elements are changed in place.
    fn shared(&self) -> usize {
        self.old.len().min(self.new.len())
    }

    /// The elements that come, each with its index.
    fn inserted<'a>(&self, new: &'a [Value]) -> impl Iterator<Item = (usize, &'a Value)> + use<'a> {
        let start = self.new.start + self.shared();
        (start..).zip(&new[start..self.new.end.max(start)])
    }
}

/// Changes the elements of a list that says `old`.
pub(super) fn edit(list: &mut Array, old: &[Value], new: &[Value]) {
    if list.is_empty() || list.len() != old.len() {
        let decor = list.decor().clone();
        if let toml_edit::Value::Array(fresh) = literal::literal(&Value::List(new.to_vec())) {
            *list = fresh;
        }
        *list.decor_mut() = decor;
        return;
    }
    let change = Change::between(old, new);
    let shared = change.shared();
    for k in 0..shared {
        let index = change.old.start + k;
        if let Some(value) = list.get_mut(index) {
            table::edit_value(value, Some(&old[index]), &new[index]);
        }
    }
    if change.old.len() != change.new.len() {
        loosen_end(list);
    }
    for _ in shared..change.old.len() {
        remove(list, change.old.start + shared);
    }
    for (index, value) in change.inserted(new) {
        insert(list, index, literal::literal(value));
    }
}

/// Hands the space behind the last element to the list.
fn loosen_end(list: &mut Array) {
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

/// Removes an element; the one that becomes the first stands where that stood.
fn remove(list: &mut Array, index: usize) {
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

/// Inserts an element, spaced as its neighbours are.
fn insert(list: &mut Array, index: usize, mut value: toml_edit::Value) {
    let lead = prefix(list, 0).unwrap_or_default();
    let between = match prefix(list, index.saturating_sub(1).max(1)) {
        Some(space) => bare(&space),
        None if lead.contains('\n') => bare(&lead),
        None => " ".to_owned(),
    };
    let own = if index == 0 {
        bare(&lead)
    } else {
        between.clone()
    };
    value.decor_mut().set_prefix(own);
    value.decor_mut().set_suffix("");
    if index == 0 && !has_comment(&lead) {
        set_prefix(list, 0, &between);
    }
    list.insert_formatted(index, value);
}

/// The space without its comments.
fn bare(space: &str) -> String {
    if !has_comment(space) {
        return space.to_owned();
    }
    let indent = space.rfind('\n').map_or("", |end| &space[end + 1..]);
    format!("\n{indent}")
}

/// Changes the tables of a list that says `old`, each under its header.
pub(super) fn edit_tables(
    tables: &mut ArrayOfTables,
    old: &[Value],
    new: &[Value],
    place: &mut Place<'_>,
) {
    let old = if tables.len() == old.len() { old } else { &[] };
    if old.is_empty() {
        let at = tables.get(0).and_then(toml_edit::Table::position);
        let fresh = new.iter().filter_map(Value::as_table);
        let fresh = fresh.map(|inner| literal::table(inner, at.unwrap_or(place.position)));
        *tables = fresh.collect();
        return;
    }
    let change = Change::between(old, new);
    let shared = change.shared();
    for k in 0..shared {
        let index = change.old.start + k;
        if let (Some(inner), Value::Table(old), Value::Table(new)) =
            (tables.get_mut(index), &old[index], &new[index])
        {
            let mut place = place.within(inner);
            table::edit(inner, old, new, &mut place);
        }
    }
    for _ in shared..change.old.len() {
        let removed = tables.remove(change.old.start + shared);
        keep_above(&removed, place);
    }
    for (index, value) in change.inserted(new) {
        let neighbour = tables.get(index.saturating_sub(1));
        let at = neighbour.and_then(toml_edit::Table::position);
        if let Value::Table(inner) = value {
            tables.insert(index, literal::table(inner, at.unwrap_or(place.position)));
        }
    }
}

/// Keeps the comments above a removed header that do not belong to it.
pub(super) fn keep_above(removed: &toml_edit::Table, place: &mut Place<'_>) {
    let above = text_of(removed.decor().prefix());
    let apart = apart(&above);
    if has_comment(apart) {
        place.within(removed).keep(apart.to_owned());
    }
}
