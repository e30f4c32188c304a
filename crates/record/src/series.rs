//! `series.csv`: the course of a few numbers in time, one row per moment.
//!
//! The first row holds bare names (`time,kinetic_energy`) and every other one numbers, so any reader of CSV takes it.
//! Every number has the digits that give the same bits again when read exactly, as Python's `float` does.
//! Units stand beside the summary's other facts, see [`SeriesWriter::units`].

use std::fmt::Write as _;
use std::fs::{File, OpenOptions};
use std::io::{Read as _, Write as _};
use std::path::PathBuf;

use crate::{RecordError, RunFolder};

const NAME: &str = "series.csv";

/// Writes `series.csv` row by row.
///
/// A row is given to the system in one piece, so a kill of the program leaves whole rows;
/// when the disk fills up, a row cut short is taken back.
#[derive(Debug)]
pub struct SeriesWriter {
    file: File,
    path: PathBuf,
    units: Vec<(String, String)>,
    /// Bytes in the header and the whole rows so far.
    whole: u64,
}

impl SeriesWriter {
    /// Starts `series.csv` with `columns` as (name, unit); a name is letters, digits and `_`, a number has the unit "".
    pub fn create(folder: &RunFolder, columns: &[(&str, &str)]) -> Result<Self, RecordError> {
        let path = folder.path(NAME);
        check(columns).map_err(|what| RecordError::caller(what, &path))?;
        let file = OpenOptions::new()
            .append(true)
            .create_new(true)
            .open(&path)
            .map_err(|e| RecordError::machine("it could not be made", &path, e))?;
        Self::start(file, path, columns)
    }

    fn start(file: File, path: PathBuf, columns: &[(&str, &str)]) -> Result<Self, RecordError> {
        let units = columns.iter().map(|(n, u)| (n.to_string(), u.to_string()));
        let mut series = Self {
            file,
            path,
            units: units.collect(),
            whole: 0,
        };
        let names: Vec<_> = columns.iter().map(|(name, _)| *name).collect();
        series.line(names.join(","))?;
        Ok(series)
    }

    /// Takes up the series of a run that was stopped, as it was when it had `bytes` bytes; also gives the values so far,
    /// column by column. What came after is cut off.
    ///
    /// # Errors
    /// When the file is not there, is shorter, or has other columns.
    pub fn resume(
        folder: &RunFolder,
        columns: &[(&str, &str)],
        bytes: u64,
    ) -> Result<(Self, Vec<Vec<f64>>), RecordError> {
        let path = folder.path(NAME);
        check(columns).map_err(|what| RecordError::caller(what, &path))?;
        let cannot = |e| RecordError::machine("it could not be read", &path, e);
        let mut options = OpenOptions::new();
        let mut file = options
            .read(true)
            .append(true)
            .open(&path)
            .map_err(cannot)?;
        let mut text = String::new();
        (&mut file)
            .take(bytes)
            .read_to_string(&mut text)
            .map_err(cannot)?;
        let values = read_rows(&text, columns).filter(|_| text.len() as u64 == bytes);
        let Some(values) = values else {
            return Err(RecordError::arguments(
                "it is not the series that the checkpoint was written with",
                &path,
                "Put the file of this run back, or run the scene again.",
            ));
        };
        file.set_len(bytes)
            .map_err(|e| RecordError::machine("it could not be cut back", &path, e))?;
        let units = columns.iter().map(|(n, u)| (n.to_string(), u.to_string()));
        let series = Self {
            file,
            path,
            units: units.collect(),
            whole: bytes,
        };
        Ok((series, values))
    }

    /// Forces the rows so far to the disk, and gives their length in bytes, for a checkpoint.
    pub fn mark(&self) -> Result<u64, RecordError> {
        self.force()?;
        Ok(self.whole)
    }

    /// Adds a row, one value per column; a value that is no number is written as `NaN`, `inf` or `-inf`.
    pub fn row(&mut self, values: &[f64]) -> Result<(), RecordError> {
        if values.len() != self.units.len() {
            let what = format!(
                "a row has {} values for {} columns",
                values.len(),
                self.units.len()
            );
            return Err(RecordError::caller(what, &self.path));
        }
        let mut line = String::with_capacity(24 * values.len());
        for (i, value) in values.iter().enumerate() {
            let comma = if i > 0 { "," } else { "" };
            // The shortest digits that read back to the same bits, with an exponent where they would be many.
            // Writing to a String does not fail.
            write!(line, "{comma}{value:?}").ok();
        }
        self.line(line)
    }

    /// Name and unit of each column, in order, for the summary's `series_units`.
    pub fn units(&self) -> &[(String, String)] {
        &self.units
    }

    /// Forces every row to the disk.
    pub fn finish(self) -> Result<(), RecordError> {
        self.force()
    }

    fn force(&self) -> Result<(), RecordError> {
        self.file
            .sync_all()
            .map_err(|e| RecordError::machine("it could not be forced to the disk", &self.path, e))
    }

    fn line(&mut self, mut line: String) -> Result<(), RecordError> {
        line.push('\n');
        if let Err(cause) = self.file.write_all(line.as_bytes()) {
            // Best effort: the error to report is the first one.
            self.file.set_len(self.whole).ok();
            return Err(RecordError::machine(
                "a row could not be written",
                &self.path,
                cause,
            ));
        }
        self.whole += line.len() as u64;
        Ok(())
    }
}

/// The values of whole rows below a header with these names, by column; `None` if that is not what it is.
fn read_rows(text: &str, columns: &[(&str, &str)]) -> Option<Vec<Vec<f64>>> {
    let mut lines = text.strip_suffix('\n')?.split('\n');
    let names = lines.next()?.split(',');
    if !names.eq(columns.iter().map(|(name, _)| *name)) {
        return None;
    }
    let mut values = vec![Vec::new(); columns.len()];
    for line in lines {
        let mut cells = line.split(',');
        for column in &mut values {
            column.push(cells.next()?.parse().ok()?);
        }
        if cells.next().is_some() {
            return None;
        }
    }
    Some(values)
}

fn check(columns: &[(&str, &str)]) -> Result<(), String> {
    if columns.is_empty() {
        return Err("a series needs a column".into());
    }
    for (i, (name, _)) in columns.iter().enumerate() {
        let is_word = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let starts_well = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
        if !(is_word && starts_well) {
            return Err(format!("{name:?} cannot name a column"));
        }
        if columns[..i].iter().any(|(other, _)| other == name) {
            return Err(format!("the column '{name}' comes twice"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use proptest::prelude::*;

    use super::*;
    use crate::Fault;
    use crate::scratch::Scratch;

    #[test]
    fn looks_like_this() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let columns = [("time", "s"), ("kinetic_energy", "J"), ("contacts", "")];
        let mut series = SeriesWriter::create(&folder, &columns).unwrap();
        series.row(&[0.0, 1.5, 12.0]).unwrap();
        series.row(&[0.001, 1.25e-7, f64::NAN]).unwrap();
        // Whole before `finish`: a run may be killed.
        let text = fs::read_to_string(folder.path(NAME)).unwrap();
        assert_eq!(
            text,
            "time,kinetic_energy,contacts\n0.0,1.5,12.0\n0.001,1.25e-7,NaN\n"
        );
        assert_eq!(
            series.units()[1],
            ("kinetic_energy".to_string(), "J".to_string())
        );
        series.finish().unwrap();
    }

    proptest! {
        #[test]
        fn any_values_read_back_to_the_bit(
            rows in prop::collection::vec(any::<[u64; 3]>(), 0..20),
        ) {
            let scratch = Scratch::new();
            let folder = scratch.run_folder();
            let mut series = SeriesWriter::create(&folder, &[("a", ""), ("b", ""), ("c", "")]).unwrap();
            let rows: Vec<_> = rows.into_iter().map(|row| row.map(f64::from_bits)).collect();
            for row in &rows {
                series.row(row).unwrap();
            }
            let text = fs::read_to_string(folder.path(NAME)).unwrap();
            prop_assert!(text.ends_with('\n'));
            prop_assert_eq!(text.lines().count(), 1 + rows.len());
            for (line, row) in text.lines().skip(1).zip(&rows) {
                let read: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
                prop_assert_eq!(read.len(), 3);
                for (read, value) in read.iter().zip(row) {
                    // What a NaN carries beside being one is not kept.
                    prop_assert!(read.to_bits() == value.to_bits() || read.is_nan() && value.is_nan());
                }
            }
        }
    }

    #[test]
    fn a_row_of_another_length_is_refused_and_leaves_no_trace() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let mut series = SeriesWriter::create(&folder, &[("a", ""), ("b", "")]).unwrap();
        for row in [&[][..], &[1.0], &[1.0, 2.0, 3.0]] {
            assert_eq!(series.row(row).unwrap_err().fault(), Fault::Caller);
        }
        assert_eq!(fs::read_to_string(folder.path(NAME)).unwrap(), "a,b\n");
    }

    /// Taken up at a mark, with a row and a piece of one behind it: no gap, no row twice.
    #[test]
    fn a_series_goes_on_from_a_checkpoint() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let columns = [("time", "s"), ("a", "")];
        let mut series = SeriesWriter::create(&folder, &columns).unwrap();
        let path = folder.path(NAME);
        let rows = [[0.0, -0.0], [0.1, f64::NAN], [0.2, f64::NEG_INFINITY]];
        series.row(&rows[0]).unwrap();
        series.row(&rows[1]).unwrap();
        let mark = series.mark().unwrap();
        series.row(&rows[2]).unwrap();
        let whole = fs::read(&path).unwrap();
        drop(series);
        fs::write(&path, [&whole[..], b"0.3"].concat()).unwrap();
        let (mut series, values) = SeriesWriter::resume(&folder, &columns, mark).unwrap();
        assert_eq!(values[0], [0.0, 0.1]);
        assert_eq!(values[1][0].to_bits(), (-0.0f64).to_bits());
        assert!(values[1][1].is_nan());
        series.row(&rows[2]).unwrap();
        assert_eq!(fs::read(&path).unwrap(), whole);
        for (columns, mark) in [
            (&columns[..1], mark),
            (&columns[..], mark - 1),
            (&columns[..], 1000),
            (&[("time", "s"), ("b", "")][..], mark),
        ] {
            let error = SeriesWriter::resume(&folder, columns, mark).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{error}");
            assert_eq!(fs::read(&path).unwrap(), whole, "a refusal changes nothing");
        }
    }

    #[test]
    fn bad_columns_make_no_file() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let bad: [&[(&str, &str)]; 6] = [
            &[],
            &[("", "")],
            &[("time [s]", "s")],
            &[("a,b", "")],
            &[("2a", "")],
            &[("a", ""), ("a", "")],
        ];
        for columns in bad {
            let error = SeriesWriter::create(&folder, columns).unwrap_err();
            assert_eq!(error.fault(), Fault::Caller, "{columns:?}");
        }
        assert!(!folder.path(NAME).exists());
    }

    #[test]
    fn an_existing_series_is_not_overwritten() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        fs::write(folder.path(NAME), "old").unwrap();
        let error = SeriesWriter::create(&folder, &[("a", "")]).unwrap_err();
        assert_eq!(error.fault(), Fault::Machine);
        assert_eq!(fs::read_to_string(folder.path(NAME)).unwrap(), "old");
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_told() {
        let file = OpenOptions::new().append(true).open("/dev/full").unwrap();
        let error = SeriesWriter::start(file, NAME.into(), &[("a", "")]).unwrap_err();
        assert_eq!(error.exit_code(), 4);
        assert!(error.remedy().contains("Free some space"), "{error}");
    }
}
