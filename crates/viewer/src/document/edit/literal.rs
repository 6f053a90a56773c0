//! Scene values as TOML values.

use toml_edit::{Array, ArrayOfTables, InlineTable, Item, Table};

use super::value::{Keys, Value};

/// A nested list longer than this has one element per line.
const LONGEST_LINE: usize = 80;

/// A value in its shortest form.
pub(super) fn literal(value: &Value) -> toml_edit::Value {
    match value {
        Value::String(text) => string(text),
        Value::Integer(whole) => (*whole).into(),
        Value::Float(number) => float(*number),
        Value::Boolean(flag) => (*flag).into(),
        Value::List(values) => list(values).into(),
        Value::Table(keys) => {
            let pairs = keys.iter().map(|(key, value)| (key, literal(value)));
            pairs.collect::<InlineTable>().into()
        }
    }
}

/// A value that replaces `before`: if that was an integer, a float without a fraction is written as one.
pub(super) fn in_place_of(before: &toml_edit::Value, value: &Value) -> toml_edit::Value {
    const EXACT: f64 = 9e15;
    match value {
        Value::Float(number)
            if before.is_integer() && number.fract() == 0.0 && number.abs() < EXACT =>
        {
            (*number as i64).into()
        }
        _ => literal(value),
    }
}

/// An item of a table. A list of tables gets `[[headers]]` if `headers` allows them.
pub(super) fn item(value: &Value, headers: bool, position: isize) -> Item {
    match value {
        Value::List(values) if headers && is_list_of_tables(values) => {
            let tables = values.iter().filter_map(Value::as_table);
            let tables = tables.map(|inner| table(inner, position));
            Item::ArrayOfTables(tables.collect::<ArrayOfTables>())
        }
        other => Item::Value(literal(other)),
    }
}

pub(super) fn is_list_of_tables(values: &[Value]) -> bool {
    !values.is_empty() && values.iter().all(|v| v.as_table().is_some())
}

/// A table with its own header, after an empty line.
pub(super) fn table(values: &Keys, position: isize) -> Table {
    let mut table = Table::new();
    table.set_position(Some(position));
    table.decor_mut().set_prefix("\n");
    for (key, value) in values.iter() {
        table.insert(key, item(value, true, position));
    }
    table
}

/// A string on one line. JSON's escapes are valid in TOML except for DEL.
fn string(text: &str) -> toml_edit::Value {
    let plain = toml_edit::Value::from(text);
    if !plain.to_string().contains('\n') {
        return plain;
    }
    let line = serde_json::Value::from(text).to_string();
    line.replace('\u{7f}', "\\u007f").parse().unwrap_or(plain)
}

/// The shortest text that parses to the same number.
fn float(number: f64) -> toml_edit::Value {
    if number.is_nan() {
        return number.into();
    }
    let shortest = format!("{number:?}");
    shortest.parse().unwrap_or_else(|_| number.into())
}

fn list(values: &[Value]) -> Array {
    let mut list: Array = values.iter().map(literal).collect();
    let nested = values.iter().any(|v| matches!(v, Value::List(_) | Value::Table(_)));
    if nested && list.to_string().len() > LONGEST_LINE {
        for value in list.iter_mut() {
            value.decor_mut().set_prefix("\n    ");
        }
        list.set_trailing("\n");
        list.set_trailing_comma(true);
    }
    list
}
