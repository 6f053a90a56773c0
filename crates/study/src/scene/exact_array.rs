//! Lists of a fixed number of values in scene files. Serde alone would ignore additional values.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Error as _, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

/// A list of exactly `N` values.
struct Exact<T, const N: usize>([T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Exact<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Values(PhantomData))
    }
}

struct Values<T, const N: usize>(PhantomData<T>);

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Values<T, N> {
    type Value = Exact<T, N>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of exactly {N}")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut values = Vec::with_capacity(N);
        while let Some(value) = list.next_element()? {
            values.push(value);
        }
        let values = <[T; N]>::try_from(values).map_err(|values| {
            let count = values.len();
            A::Error::custom(format!("a list of {count} values, but exactly {N} are needed"))
        })?;
        Ok(Exact(values))
    }
}

/// Reads an optional list of `N` values.
pub(crate) fn one<'de, D, T, const N: usize>(deserializer: D) -> Result<Option<[T; N]>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    Ok(Option::<Exact<T, N>>::deserialize(deserializer)?.map(|list| list.0))
}

/// Reads an optional list of lists of `N` values.
pub(crate) fn many<'de, D, T, const N: usize>(
    deserializer: D,
) -> Result<Option<Vec<[T; N]>>, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    let lists = Option::<Vec<Exact<T, N>>>::deserialize(deserializer)?;
    Ok(lists.map(|lists| lists.into_iter().map(|list| list.0).collect()))
}
