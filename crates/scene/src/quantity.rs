//! The values of the raw scene: quantities with units, bare numbers, pairs and triples; each refuses with a remedy.

use std::fmt;
use std::marker::PhantomData;

use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use crate::units::{self, Dimension};

/// What is wrong and what to do, in the one string that serde carries; see `ron_trouble`.
pub(crate) fn two_lines(what: impl fmt::Display, remedy: impl fmt::Display) -> String {
    format!("{what}\n{remedy}")
}

/// A dimension as a type.
pub(crate) trait Of {
    const DIMENSION: Dimension;
}

macro_rules! quantities {
    ($($name:ident)*) => {$(
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name;
        impl Of for $name {
            const DIMENSION: Dimension = Dimension::$name;
        }
    )*};
}

quantities!(Length Time Mass Density Pressure Velocity Acceleration Energy Stiffness Damping AngularVelocity Frequency);

/// A quantity of a dimension, in SI.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantity<D>(pub f64, PhantomData<D>);

/// Three quantities, or three numbers, as `(x, y, z)` or `[x, y, z]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triple<T>(pub [T; 3]);

/// Two quantities, as `(a, b)` or `[a, b]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<T>(pub [T; 2]);

/// Two values of different dimensions as `(a, b)` or `[a, b]`: a row of a table.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row<A, B>(pub A, pub B);

/// A finite number without dimension.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number(pub f64);

/// A whole number, not negative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole(pub u64);

impl<'de, D: Of> Deserialize<'de> for Quantity<D> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let value = reader.deserialize_any(QuantityVisitor(D::DIMENSION))?;
        Ok(Quantity(value, PhantomData))
    }
}

struct QuantityVisitor(Dimension);

impl QuantityVisitor {
    fn bare<E: Error>(&self, number: impl fmt::Debug) -> E {
        let name = self.0.name();
        let si = self.0.symbols().next().unwrap_or_default();
        let what = format!("a bare number where {name} is expected");
        E::custom(two_lines(
            what,
            format!(
                "write it with its unit and in quotes, as in \"{number:?} {si}\" or \"{}\"",
                self.0.example()
            ),
        ))
    }
}

impl Visitor<'_> for QuantityVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} such as \"{}\"", self.0.name(), self.0.example())
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        units::read(self.0, text).map_err(|error| E::custom(two_lines(error.what, error.remedy)))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f64, E> {
        Err(self.bare(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<f64, E> {
        Err(self.bare(number))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<f64, E> {
        Err(self.bare(number))
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        reader.deserialize_any(NumberVisitor)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a bare number such as 0.5")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Number, E> {
        Ok(Number(number as f64))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Number, E> {
        Ok(Number(number as f64))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Number, E> {
        if number.is_finite() {
            Ok(Number(number))
        } else {
            Err(E::custom(two_lines(
                format!("{number} is no usable number"),
                "write a finite number such as 0.5",
            )))
        }
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
        Err(E::custom(two_lines(
            format!("“{text}” is a text, but this number has no dimension"),
            "write a bare number without quotes and unit, such as 0.5",
        )))
    }
}

impl<'de> Deserialize<'de> for Whole {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let Number(number) = match reader.deserialize_any(WholeVisitor)? {
            Ok(whole) => return Ok(Whole(whole)),
            Err(other) => other,
        };
        let what = format!("{number:?} is not a whole number from 0 on");
        Err(R::Error::custom(two_lines(
            what,
            "write a whole number such as 2, without point and sign",
        )))
    }
}

struct WholeVisitor;

impl Visitor<'_> for WholeVisitor {
    type Value = Result<u64, Number>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a whole number such as 2")
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Self::Value, E> {
        Ok(Ok(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Self::Value, E> {
        Ok(u64::try_from(number).map_err(|_| Number(number as f64)))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Self::Value, E> {
        Ok(Err(Number(number)))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Self::Value, E> {
        NumberVisitor.visit_str(text).map(Err)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Triple<T> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let visitor = RowVisitor {
            row: "a triple of values (x, y, z)",
            parts: "x, y and z",
            remedy: "write (x, y, z)",
            item: PhantomData,
        };
        reader.deserialize_any(visitor).map(Triple)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Pair<T> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        let visitor = RowVisitor {
            row: "a pair of values (from, to)",
            parts: "two",
            remedy: "write both in brackets, parted by a comma",
            item: PhantomData,
        };
        reader.deserialize_any(visitor).map(Pair)
    }
}

impl<'de, A: Deserialize<'de>, B: Deserialize<'de>> Deserialize<'de> for Row<A, B> {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        reader.deserialize_any(TableRowVisitor(PhantomData))
    }
}

struct TableRowVisitor<A, B>(PhantomData<(A, B)>);

impl<'de, A: Deserialize<'de>, B: Deserialize<'de>> Visitor<'de> for TableRowVisitor<A, B> {
    type Value = Row<A, B>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a row of two values (a, b)")
    }

    fn visit_seq<I: SeqAccess<'de>>(self, mut items: I) -> Result<Row<A, B>, I::Error> {
        let wrong = |count: &str| {
            I::Error::custom(two_lines(
                format!("too {count} values: a row has two"),
                "write both in brackets, parted by a comma",
            ))
        };
        let first = items.next_element()?.ok_or_else(|| wrong("few"))?;
        let second = items.next_element()?.ok_or_else(|| wrong("few"))?;
        if items.next_element::<B>()?.is_some() {
            return Err(wrong("many"));
        }
        Ok(Row(first, second))
    }
}

/// Reads exactly N values.
struct RowVisitor<T, const N: usize> {
    /// What is expected, in messages.
    row: &'static str,
    parts: &'static str,
    remedy: &'static str,
    item: PhantomData<T>,
}

impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for RowVisitor<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.row)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<[T; N], A::Error> {
        let wrong = |count: &str| {
            let what = format!("too {count} values: {} are expected", self.parts);
            A::Error::custom(two_lines(what, self.remedy))
        };
        let mut row = Vec::with_capacity(N);
        while row.len() < N {
            row.push(items.next_element()?.ok_or_else(|| wrong("few"))?);
        }
        if items.next_element::<T>()?.is_some() {
            return Err(wrong("many"));
        }
        row.try_into().map_err(|_| wrong("few"))
    }
}
