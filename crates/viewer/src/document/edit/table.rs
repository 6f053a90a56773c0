//! Edits of tables, and of the arrays and tables inside them.

use toml_edit::{Array, ArrayOfTables, InlineTable, Item};

use super::array::{self, ChangedRange};
use super::comments::{has_comment, last_position, part_of_previous, text_of};
use super::value::{Keys, Value};
use super::{EditContext, literal};

/// Writes the differences between two tables into `table`, which means `old`.
pub(super) fn edit(
    table: &mut toml_edit::Table,
    old: &Keys,
    new: &Keys,
    context: &mut EditContext<'_>,
) {
    for (key, _) in old.iter().filter(|(key, _)| new.get(key).is_none()) {
        remove(table, key, context);
    }
    for (key, value) in new.iter() {
        let before = old.get(key);
        if before == Some(value) {
            continue;
        }
        match table.get_mut(key) {
            Some(item) => edit_item(item, before, value, context),
            None => insert(table, key, value, new, context),
        }
    }
}

fn edit_item(
    item: &mut Item,
    before: Option<&Value>,
    value: &Value,
    context: &mut EditContext<'_>,
) {
    match (item, value) {
        (Item::Table(table), Value::Table(new)) => {
            let mut context = context.within(table);
            edit(table, &keys_in(before), new, &mut context);
        }
        (Item::ArrayOfTables(tables), Value::List(new)) if literal::is_list_of_tables(new) => {
            edit_tables(tables, list_in(before), new, context);
        }
        (Item::Value(written), value) => edit_value(written, before, value),
        (item, value) => *item = Item::Value(literal::literal(value)),
    }
}

/// Writes the differences between two values into `written`, which means `before`.
fn edit_value(written: &mut toml_edit::Value, before: Option<&Value>, value: &Value) {
    match (written, value) {
        (toml_edit::Value::InlineTable(table), Value::Table(new)) => {
            edit_inline(table, &keys_in(before), new);
        }
        (toml_edit::Value::Array(list), Value::List(new)) => {
            edit_list(list, list_in(before), new);
        }
        (written, value) => {
            let decor = written.decor().clone();
            *written = literal::in_place_of(written, value);
            *written.decor_mut() = decor;
        }
    }
}

fn edit_inline(table: &mut InlineTable, old: &Keys, new: &Keys) {
    let mut respaced = false;
    for (key, _) in old.iter().filter(|(key, _)| new.get(key).is_none()) {
        respaced |= table.remove(key).is_some();
    }
    for (key, value) in new.iter() {
        let before = old.get(key);
        if before == Some(value) {
            continue;
        }
        if let Some(written) = table.get_mut(key) {
            edit_value(written, before, value);
        } else {
            table.insert(key, literal::literal(value));
            respaced = true;
        }
    }
    if respaced && !has_comment(&table.to_string()) {
        let decor = table.decor().clone();
        table.fmt();
        *table.decor_mut() = decor;
    }
}

/// Writes the differences between two lists into `list`, which means `old`.
fn edit_list(list: &mut Array, old: &[Value], new: &[Value]) {
    if list.is_empty() || list.len() != old.len() {
        let decor = list.decor().clone();
        if let toml_edit::Value::Array(fresh) = literal::literal(&Value::List(new.to_vec())) {
            *list = fresh;
        }
        *list.decor_mut() = decor;
        return;
    }
    let change = ChangedRange::between(old, new);
    let shared = change.shared();
    for k in 0..shared {
        let index = change.old.start + k;
        if let Some(value) = list.get_mut(index) {
            edit_value(value, Some(&old[index]), &new[index]);
        }
    }
    if change.old.len() != change.new.len() {
        array::release_trailing_space(list);
    }
    for _ in shared..change.old.len() {
        array::remove(list, change.old.start + shared);
    }
    for (index, value) in change.inserted(new) {
        array::insert(list, index, literal::literal(value));
    }
}

/// Writes the differences between two lists of tables into `tables`, which mean `old` and have headers of their own.
fn edit_tables(
    tables: &mut ArrayOfTables,
    old: &[Value],
    new: &[Value],
    context: &mut EditContext<'_>,
) {
    let old = if tables.len() == old.len() { old } else { &[] };
    if old.is_empty() {
        let at = tables.get(0).and_then(toml_edit::Table::position);
        let fresh = new.iter().filter_map(Value::as_table);
        let fresh = fresh.map(|inner| literal::table(inner, at.unwrap_or(context.position)));
        *tables = fresh.collect();
        return;
    }
    let change = ChangedRange::between(old, new);
    let shared = change.shared();
    for k in 0..shared {
        let index = change.old.start + k;
        if let (Some(inner), Value::Table(old), Value::Table(new)) =
            (tables.get_mut(index), &old[index], &new[index])
        {
            let mut context = context.within(inner);
            edit(inner, old, new, &mut context);
        }
    }
    for _ in shared..change.old.len() {
        let removed = tables.remove(change.old.start + shared);
        keep_above(&removed, context);
    }
    for (index, value) in change.inserted(new) {
        let neighbour = tables.get(index.saturating_sub(1));
        let at = neighbour.and_then(toml_edit::Table::position);
        if let Value::Table(inner) = value {
            tables.insert(index, literal::table(inner, at.unwrap_or(context.position)));
        }
    }
}

/// Keeps the comments above a removed header that belong to the table before it.
fn keep_above(removed: &toml_edit::Table, context: &mut EditContext<'_>) {
    let above = text_of(removed.decor().prefix());
    let apart = part_of_previous(&above);
    if has_comment(apart) {
        context.within(removed).keep_comment(apart.to_owned());
    }
}

fn keys_in(value: Option<&Value>) -> Keys {
    value.and_then(Value::as_table).cloned().unwrap_or_default()
}

fn list_in(value: Option<&Value>) -> &[Value] {
    value.and_then(Value::as_list).unwrap_or_default()
}

/// Removes a key. The comments above it are moved to whatever follows.
fn remove(table: &mut toml_edit::Table, key: &str, context: &mut EditContext<'_>) {
    let next = next_value(table, key);
    let Some((removed, item)) = table.remove_entry(key) else {
        return;
    };
    match &item {
        Item::Table(inner) => return keep_above(inner, context),
        Item::ArrayOfTables(tables) => {
            return tables.iter().for_each(|inner| keep_above(inner, context));
        }
        _ => {}
    }
    let above = text_of(removed.leaf_decor().prefix());
    if !has_comment(&above) {
        return;
    }
    match next.and_then(|next| table.key_mut(&next)) {
        Some(mut next) => {
            let own = text_of(next.leaf_decor().prefix());
            next.leaf_decor_mut().set_prefix(above + &own);
        }
        None => context.keep_comment(above),
    }
}

/// The next key after `key` that has a value.
fn next_value(table: &toml_edit::Table, key: &str) -> Option<String> {
    let behind = table.iter().skip_while(|(other, _)| *other != key).skip(1);
    let mut values = behind.filter(|(_, item)| item.is_value());
    values.next().map(|(other, _)| other.to_owned())
}

/// Inserts a key after the one it follows in the order of a scene.
fn insert(
    table: &mut toml_edit::Table,
    key: &str,
    value: &Value,
    order: &Keys,
    context: &mut EditContext<'_>,
) {
    let before = order.iter().map(|(other, _)| other).take_while(|&other| other != key);
    let present: Vec<&str> = before.filter(|&other| table.contains_key(other)).collect();
    match value {
        Value::Table(keys) if context.root => {
            let header = present.iter().rev().find_map(|&other| last_position(&table[other]));
            let mut inner = literal::table(keys, header.unwrap_or(0));
            if header.is_none() && !has_values(table) {
                inner.decor_mut().set_prefix(take_head(table));
            }
            table.insert(key, Item::Table(inner));
        }
        _ => insert_value(table, key, value, context),
    }
    reorder(table, key, present.last().copied());
}

fn insert_value(table: &mut toml_edit::Table, key: &str, value: &Value, context: &EditContext<'_>) {
    let above = if context.root && !has_values(table) { take_head(table) } else { indent(table) };
    let item = literal::item(value, !table.is_dotted(), context.position);
    let headed = !item.is_value();
    table.insert(key, item);
    if headed {
        return;
    }
    if let Some(mut key) = table.key_mut(key) {
        key.leaf_decor_mut().set_prefix(above);
    }
    if table.is_implicit() {
        // The header appears with the first value and comes before those of the table's parts.
        table.set_implicit(false);
        let first = table.iter().filter_map(|(_, item)| last_position(item)).min();
        table.set_position(first.or(Some(context.position)));
    }
}

fn has_values(table: &toml_edit::Table) -> bool {
    table.iter().any(|(_, item)| item.is_value())
}

/// The indentation of the first value.
fn indent(table: &toml_edit::Table) -> String {
    let value = table.iter().find(|(_, item)| item.is_value());
    let key = value.and_then(|(key, _)| table.key(key));
    let space = text_of(key.and_then(|key| key.leaf_decor().prefix()));
    space.rfind('\n').map_or("", |end| &space[end + 1..]).to_owned()
}

/// Removes and returns the comments at the top of the file from the first header.
fn take_head(root: &mut toml_edit::Table) -> String {
    let tables = root.iter_mut().filter_map(|(_, item)| match item {
        Item::Table(table) if !table.is_dotted() => Some(table),
        _ => None,
    });
    let Some(first) = tables.min_by_key(|table| table.position().unwrap_or(isize::MAX)) else {
        return String::new();
    };
    let space = text_of(first.decor().prefix());
    let head = part_of_previous(&space).to_owned();
    let rest = space[head.len()..].trim_start_matches('\n');
    first.decor_mut().set_prefix(format!("\n{rest}"));
    head
}

/// Moves the last key behind `after`, or to the front.
fn reorder(table: &mut toml_edit::Table, key: &str, after: Option<&str>) {
    let mut keys: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    keys.pop();
    let index = after.and_then(|after| keys.iter().position(|other| other == after));
    keys.insert(index.map_or(0, |index| index + 1), key.to_owned());
    let rank = |key: &toml_edit::Key| keys.iter().position(|other| other == key.get());
    table.sort_values_by(|a, _, b, _| rank(a).cmp(&rank(b)));
}
