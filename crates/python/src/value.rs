//! Values of Python as values of a scene file.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::error::bad_input;

/// The deepest nesting of a scene's values.
const DEEPEST: usize = 32;

/// The table of a dictionary.
pub(crate) fn table(values: &Bound<'_, PyDict>) -> PyResult<Table> {
    table_at("", values, 0)
}

/// The value of the key path `key`: numbers, strings, booleans, lists, dictionaries, and arrays of NumPy.
pub(crate) fn value(key: &str, object: &Bound<'_, PyAny>) -> PyResult<Value> {
    value_at(key, object, 0)
}

fn table_at(key: &str, values: &Bound<'_, PyDict>, depth: usize) -> PyResult<Table> {
    let mut table = Table::new();
    for (name, object) in values {
        let Ok(name) = name.extract::<String>() else {
            return Err(bad_input(values.py(), format!("{key}: {name} is no name of a key")));
        };
        let path = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
        // TOML has no null: a key without a value keeps its default.
        if !object.is_none() {
            table.insert(name, value_at(&path, &object, depth + 1)?);
        }
    }
    Ok(table)
}

fn value_at(key: &str, object: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    let refused = |message: String| Err(bad_input(object.py(), format!("{key}: {message}")));
    if depth > DEEPEST {
        return refused("nested too deeply".to_owned());
    }
    if object.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(object.extract()?));
    }
    if object.is_instance_of::<PyInt>() {
        return match object.extract() {
            Ok(number) => Ok(Value::Integer(number)),
            Err(_) => refused(format!("{object} is too large")),
        };
    }
    if object.is_instance_of::<PyFloat>() {
        let number: f64 = object.extract()?;
        return if number.is_finite() {
            Ok(Value::Float(number))
        } else {
            refused(format!("{number} is not a finite number"))
        };
    }
    if object.is_instance_of::<PyString>() {
        return Ok(Value::String(object.extract()?));
    }
    if let Ok(values) = object.cast::<PyDict>() {
        return Ok(Value::Table(table_at(key, values, depth)?));
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let items = object.try_iter()?.enumerate();
        let items = items.map(|(i, item)| value_at(&format!("{key}.{i}"), &item?, depth + 1));
        return Ok(Value::Array(items.collect::<PyResult<_>>()?));
    }
    // Arrays and scalars of NumPy.
    if object.hasattr("dtype")? && object.hasattr("tolist")? {
        return value_at(key, &object.call_method0("tolist")?, depth + 1);
    }
    if object.hasattr("__fspath__")? {
        return value_at(key, &object.call_method0("__fspath__")?, depth + 1);
    }
    let kind = object.get_type().name()?;
    refused(format!("a {kind} cannot be a value of a scene"))
}
