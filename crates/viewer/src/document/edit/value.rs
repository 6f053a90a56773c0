//! The keys and values of a scene, in the order of a scene.

use foldmotion_study::Scene;
use toml_edit::{DocumentMut, Item, TableLike};

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    String(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    List(Vec<Self>),
    Table(Keys),
}

/// Keys with their values, in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Keys(Vec<(String, Value)>);

impl Keys {
    /// The keys of a scene; an empty list of steps is omitted.
    pub(super) fn of(scene: &Scene) -> Option<Self> {
        let text = toml::to_string(scene).ok()?;
        let mut document: DocumentMut = text.parse().ok()?;
        if scene.motion.step.is_empty()
            && let Some(motion) = document.get_mut("motion").and_then(Item::as_table_like_mut)
        {
            motion.remove("step");
        }
        Self::of_table(document.as_table())
    }

    fn of_table(table: &dyn TableLike) -> Option<Self> {
        let pairs = table.iter();
        let pairs = pairs.map(|(key, item)| Some((key.to_owned(), Value::of_item(item)?)));
        pairs.collect::<Option<_>>().map(Self)
    }

    pub(super) fn get(&self, key: &str) -> Option<&Value> {
        self.iter().find(|(other, _)| *other == key).map(|(_, value)| value)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(key, value)| (key.as_str(), value))
    }
}

impl Value {
    fn of_item(item: &Item) -> Option<Self> {
        if let Item::ArrayOfTables(tables) = item {
            let tables = tables.iter().map(|table| Keys::of_table(table).map(Self::Table));
            return tables.collect::<Option<_>>().map(Self::List);
        }
        match item.as_value() {
            Some(value) => Self::of_value(value),
            None => Keys::of_table(item.as_table_like()?).map(Self::Table),
        }
    }

    fn of_value(value: &toml_edit::Value) -> Option<Self> {
        Some(match value {
            toml_edit::Value::String(text) => Self::String(text.value().clone()),
            toml_edit::Value::Integer(whole) => Self::Integer(*whole.value()),
            toml_edit::Value::Float(number) => Self::Float(*number.value()),
            toml_edit::Value::Boolean(flag) => Self::Boolean(*flag.value()),
            toml_edit::Value::Array(list) => {
                Self::List(list.iter().map(Self::of_value).collect::<Option<_>>()?)
            }
            toml_edit::Value::InlineTable(table) => Self::Table(Keys::of_table(table)?),
            // A scene contains no dates.
            toml_edit::Value::Datetime(_) => return None,
        })
    }

    pub(super) fn as_table(&self) -> Option<&Keys> {
        match self {
            Self::Table(keys) => Some(keys),
            _ => None,
        }
    }

    pub(super) fn as_list(&self) -> Option<&[Self]> {
        match self {
            Self::List(values) => Some(values),
            _ => None,
        }
    }
}
