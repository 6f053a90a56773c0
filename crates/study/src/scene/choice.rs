//! Choices by name in scene files, with errors that list the names.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{IntoDeserializer as _, Visitor};
use serde::{Deserialize, Deserializer};

/// A choice that is read by its name.
struct Named<T>(T);

impl<'de, T: for<'a> Deserialize<'a>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameVisitor(PhantomData)).map(Named)
    }
}

struct NameVisitor<T>(PhantomData<T>);

impl<T: for<'a> Deserialize<'a>> NameVisitor<T> {
    /// Looks up the choice called `word`. Other types of values are looked up by their text, for an error with the list of names.
    fn look_up<E: serde::de::Error>(word: &str) -> Result<T, E> {
        T::deserialize(word.into_deserializer()).map_err(|e: serde::de::value::Error| E::custom(e))
    }
}

impl<T: for<'a> Deserialize<'a>> Visitor<'_> for NameVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // For a list or a table: the error of an empty name has the list of names.
        match Self::look_up::<serde::de::value::Error>("") {
            Err(e) => {
                let text = e.to_string();
                let words = text.split_once("expected ").map_or("a word", |(_, words)| words);
                f.write_str(words)
            }
            Ok(_) => f.write_str("a word"),
        }
    }

    fn visit_str<E: serde::de::Error>(self, word: &str) -> Result<T, E> {
        Self::look_up(word)
    }

    fn visit_bool<E: serde::de::Error>(self, value: bool) -> Result<T, E> {
        Self::look_up(&value.to_string())
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<T, E> {
        Self::look_up(&value.to_string())
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<T, E> {
        Self::look_up(&value.to_string())
    }
}

/// The choice that `name` stands for in a scene file.
///
/// # Errors
/// A message with the names there are.
pub fn parse_choice<T: for<'a> Deserialize<'a>>(name: &str) -> Result<T, String> {
    NameVisitor::look_up(name).map_err(|e: serde::de::value::Error| e.to_string())
}

/// Reads an optional choice.
pub(crate) fn optional<'de, D, T>(deserializer: D) -> Result<Option<T>, D::Error>
where
    D: Deserializer<'de>,
    T: for<'a> Deserialize<'a>,
{
    Ok(Some(Named::deserialize(deserializer)?.0))
}

/// Reads a required choice.
pub(crate) fn required<'de, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: for<'a> Deserialize<'a>,
{
    Ok(Named::deserialize(deserializer)?.0)
}

/// Reads an optional list of choices.
pub(crate) fn list<'de, D, T>(deserializer: D) -> Result<Option<Vec<T>>, D::Error>
where
    D: Deserializer<'de>,
    T: for<'a> Deserialize<'a>,
{
    let words = Vec::<Named<T>>::deserialize(deserializer)?;
    Ok(Some(words.into_iter().map(|word| word.0).collect()))
}
