//! `summary.json`: what came out of a run, under names that stay the same.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::{RecordError, RunFolder, write_whole};

mod mean;

const NAME: &str = "summary.json";

/// The facts and measured values of a run, in the order they were given.
///
/// All stand side by side at the top of the file: a value as `{"value": 23.5, "uncertainty": 0.4, "unit": "deg"}`,
/// a fact as its text, number or list.
/// A name given again replaces the earlier entry in its place.
///
/// ```
/// let mut summary = tsubu_record::Summary::new();
/// summary.text("scene", "angle_of_repose").whole("seed", 7);
/// summary.measured("angle_of_repose", 23.5, Some(0.4), "deg");
/// summary.plain("threads", 2.0, "");
/// assert!(summary.to_json()?.contains("\"seed\": 7"));
/// # Ok::<(), tsubu_record::RecordError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    entries: Vec<(String, Entry)>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Entry {
    Value {
        value: Option<f64>,
        uncertainty: Option<f64>,
        unit: String,
        /// Says why `value` or `uncertainty` is null though it was given: JSON knows no NaN.
        #[serde(skip_serializing_if = "Option::is_none")]
        note: Option<String>,
    },
    Text(String),
    Whole(u64),
    List(Vec<String>),
    #[serde(serialize_with = "in_order")]
    Table(Vec<(String, String)>),
}

impl Summary {
    /// A summary that says nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// A measured value with its uncertainty, in the same unit; one that is not finite becomes null with a note.
    pub fn measured(
        &mut self,
        name: &str,
        value: f64,
        uncertainty: Option<f64>,
        unit: &str,
    ) -> &mut Self {
        let finite = |x: f64| x.is_finite().then_some(x);
        let mut notes = Vec::new();
        if !value.is_finite() {
            notes.push(format!("value was {value}"));
        }
        if let Some(u) = uncertainty.filter(|u| !u.is_finite()) {
            notes.push(format!("uncertainty was {u}"));
        }
        let entry = Entry::Value {
            value: finite(value),
            uncertainty: uncertainty.and_then(finite),
            unit: unit.into(),
            note: (!notes.is_empty()).then(|| notes.join(", ")),
        };
        self.put(name, entry)
    }

    /// A value without an uncertainty, as a number of threads or bytes per grain.
    pub fn plain(&mut self, name: &str, value: f64, unit: &str) -> &mut Self {
        self.measured(name, value, None, unit)
    }

    /// A fact in words, as the scene's name or the law's.
    pub fn text(&mut self, name: &str, text: &str) -> &mut Self {
        self.put(name, Entry::Text(text.into()))
    }

    /// A whole number that must not be rounded, as a seed.
    pub fn whole(&mut self, name: &str, number: u64) -> &mut Self {
        self.put(name, Entry::Whole(number))
    }

    /// A list of words, as the citations.
    pub fn list<T: AsRef<str>>(&mut self, name: &str, words: &[T]) -> &mut Self {
        let words = words.iter().map(|w| w.as_ref().to_string()).collect();
        self.put(name, Entry::List(words))
    }

    /// Words by name, as the units of the series' columns.
    pub fn table(&mut self, name: &str, rows: &[(String, String)]) -> &mut Self {
        self.put(name, Entry::Table(rows.to_vec()))
    }

    /// The text of the file.
    pub fn to_json(&self) -> Result<String, RecordError> {
        let mut text = serde_json::to_string_pretty(self)
            .map_err(|e| RecordError::caller(format!("no JSON: {e}"), NAME.as_ref()))?;
        text.push('\n');
        Ok(text)
    }

    /// Writes `summary.json` whole into the folder of a run; an earlier one is replaced.
    pub fn write(&self, folder: &RunFolder) -> Result<(), RecordError> {
        write_whole(&folder.path(NAME), self.to_json()?.as_bytes())
    }

    fn put(&mut self, name: &str, entry: Entry) -> &mut Self {
        match self.entries.iter_mut().find(|(known, _)| known == name) {
            Some((_, old)) => *old = entry,
            None => self.entries.push((name.into(), entry)),
        }
        self
    }
}

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        in_order(&self.entries, serializer)
    }
}

/// A list of pairs as a JSON object that keeps their order.
fn in_order<T: Serialize, S: Serializer>(
    pairs: &[(String, T)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(pairs.len()))?;
    for (name, value) in pairs {
        map.serialize_entry(name, value)?;
    }
    map.end()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use proptest::prelude::*;
    use serde_json::{Value, json};

    use super::*;
    use crate::scratch::{Scratch, names};

    fn read(summary: &Summary) -> Value {
        serde_json::from_str(&summary.to_json().unwrap()).unwrap()
    }

    #[test]
    fn every_kind_of_entry_has_its_shape() {
        let mut summary = Summary::new();
        summary
            .text("scene", "a \"quoted\" heap\n粒")
            .whole("seed", u64::MAX)
            .list("citations", &["Hertz1882"])
            .table("series_units", &[("time".into(), "s".into())])
            .measured("angle_of_repose", 23.5, Some(0.25), "deg")
            .plain("threads", 2.0, "");
        assert_eq!(
            read(&summary),
            json!({
                "scene": "a \"quoted\" heap\n粒",
                "seed": u64::MAX,
                "citations": ["Hertz1882"],
                "series_units": {"time": "s"},
                "angle_of_repose": {"value": 23.5, "uncertainty": 0.25, "unit": "deg"},
                "threads": {"value": 2.0, "uncertainty": null, "unit": ""},
            })
        );
    }

    #[test]
    fn what_is_not_finite_becomes_null_and_says_so() {
        let mut summary = Summary::new();
        summary.measured("a", f64::NAN, Some(f64::INFINITY), "m");
        summary.measured("b", 1.0, Some(f64::NAN), "m");
        assert_eq!(
            read(&summary),
            json!({
                "a": {"value": null, "uncertainty": null, "unit": "m", "note": "value was NaN, uncertainty was inf"},
                "b": {"value": 1.0, "uncertainty": null, "unit": "m", "note": "uncertainty was NaN"},
            })
        );
    }

    #[test]
    fn order_is_kept_and_a_name_stands_once() {
        let mut summary = Summary::new();
        summary.text("z", "1").text("a", "2").text("z", "3");
        assert_eq!(
            summary.to_json().unwrap(),
            "{\n  \"z\": \"3\",\n  \"a\": \"2\"\n}\n"
        );
    }

    #[test]
    fn writes_itself_whole_and_again() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let mut summary = Summary::new();
        summary.write(&folder).unwrap();
        summary.plain("threads", 4.0, "");
        summary.write(&folder).unwrap();
        let text = fs::read_to_string(folder.path(NAME)).unwrap();
        assert_eq!(text, summary.to_json().unwrap());
        assert_eq!(names(folder.root()), [".tsubu-run", NAME]);
    }

    proptest! {
        #[test]
        fn any_value_gives_json_that_reads_back_to_the_bit(value in any::<u64>().prop_map(f64::from_bits), name in ".*", unit in ".*") {
            let mut summary = Summary::new();
            summary.plain(&name, value, &unit);
            let read = read(&summary);
            prop_assert_eq!(read[&name]["unit"].as_str(), Some(unit.as_str()));
            prop_assert_eq!(read[&name]["value"].is_null(), !value.is_finite());
            if value.is_finite() {
                // The digits are read by the standard library, which rounds exactly.
                let text = summary.to_json().unwrap();
                let digits = text.split("\"value\": ").last().unwrap();
                let digits = digits.split(',').next().unwrap();
                prop_assert_eq!(digits.parse::<f64>().unwrap().to_bits(), value.to_bits());
            }
        }
    }
}
