//! Comments whose key or table is removed.

use toml_edit::{DocumentMut, Item, RawString, Table};

/// A comment above a key or header that was removed.
pub(super) struct DetachedComment {
    /// The position of the header that it stood under, in the order of headers.
    pub(super) position: isize,
    pub(super) comment: String,
}

pub(super) fn text_of(raw: Option<&RawString>) -> String {
    raw.and_then(RawString::as_str).unwrap_or_default().to_owned()
}

/// Whether whitespace contains a comment.
pub(super) fn has_comment(space: &str) -> bool {
    space.contains('#')
}

/// The part of the whitespace above a header that belongs to the table before it: up to the last empty line.
pub(super) fn part_of_previous(space: &str) -> &str {
    space.rfind("\n\n").map_or("", |end| &space[..end + 2])
}

/// Removes and returns the comments of a document without keys, followed by an empty line.
pub(super) fn take_all(document: &mut DocumentMut) -> String {
    let all = text_of(Some(document.trailing()));
    document.set_trailing("");
    match all.trim_end() {
        "" => String::new(),
        comments => format!("{comments}\n\n"),
    }
}

/// Puts each comment above the header that follows the one it stood under, or at the end of the document.
pub(super) fn reattach(document: &mut DocumentMut, detached: Vec<DetachedComment>) {
    for DetachedComment { position, comment } in detached.into_iter().rev() {
        let next = next_position(document.as_table(), position);
        if let Some(table) = next.and_then(|next| table_at(document.as_table_mut(), next)) {
            let own = text_of(table.decor().prefix());
            table.decor_mut().set_prefix(comment + &own);
        } else {
            let own = text_of(Some(document.trailing()));
            document.set_trailing(comment + &own);
        }
    }
}

/// The position of the first header after `position`.
fn next_position(table: &Table, position: isize) -> Option<isize> {
    headers(table).into_iter().filter_map(Table::position).filter(|&other| other > position).min()
}

/// The position of the last header at or below an item.
pub(super) fn last_position(item: &Item) -> Option<isize> {
    let of_table = |table: &Table| {
        let below = headers(table).into_iter().filter_map(Table::position);
        below.chain(table.position()).max()
    };
    match item {
        Item::Table(table) => of_table(table),
        Item::ArrayOfTables(tables) => tables.iter().filter_map(of_table).max(),
        _ => None,
    }
}

/// All tables below a table.
fn headers(table: &Table) -> Vec<&Table> {
    let mut found = Vec::new();
    for (_, item) in table {
        match item {
            Item::Table(inner) => {
                found.push(inner);
                found.extend(headers(inner));
            }
            Item::ArrayOfTables(tables) => {
                for inner in tables {
                    found.push(inner);
                    found.extend(headers(inner));
                }
            }
            _ => {}
        }
    }
    found
}

fn table_at(table: &mut Table, position: isize) -> Option<&mut Table> {
    if is_at(table, position) {
        return Some(table);
    }
    table.iter_mut().find_map(|(_, item)| match item {
        Item::Table(inner) => table_at(inner, position),
        Item::ArrayOfTables(tables) => {
            let mut inner = tables.iter_mut();
            inner.find_map(|inner| table_at(inner, position))
        }
        _ => None,
    })
}

/// Whether a table has its header at this position; implicit tables have none.
fn is_at(table: &Table, position: isize) -> bool {
    table.position() == Some(position) && !table.is_implicit()
}
