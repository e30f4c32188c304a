//! The rows of `series.csv`, kept as columns for the figures.

use crate::trouble::Trouble;
use tsubu::assemble::Simulation;
use tsubu::model::Words;
use tsubu::record::{RunFolder, SeriesWriter};

/// Rows written and kept.
pub struct Rows {
    writer: SeriesWriter,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
}

impl Rows {
    /// Looks once, writes the header and the first row.
    pub fn start(folder: &RunFolder, run: &mut dyn Simulation) -> Result<Self, Trouble> {
        let readings = run.look();
        let header: Vec<(&str, &str)> = std::iter::once(("time", "s"))
            .chain(readings.iter().map(|r| (&*r.name, r.unit)))
            .collect();
        let writer = SeriesWriter::create(folder, &header)?;
        let names: Vec<String> = header.iter().map(|(name, _)| (*name).to_owned()).collect();
        let mut rows = Self {
            writer,
            columns: vec![Vec::new(); names.len()],
            names,
        };
        rows.put(run.time(), readings.iter().map(|r| r.value))?;
        Ok(rows)
    }

    /// Takes up the rows of a run that was stopped.
    pub fn resume(folder: &RunFolder, words: &mut Words) -> Result<Self, Trouble> {
        words.take_part("rows")?;
        let bytes = words.take_whole()?;
        let mut named = Vec::new();
        for _ in 0..words.take_count(2)? {
            named.push((words.take_text()?, words.take_text()?));
        }
        let header: Vec<(&str, &str)> = named.iter().map(|(n, u)| (&**n, &**u)).collect();
        let (writer, columns) = SeriesWriter::resume(folder, &header, bytes)?;
        Ok(Self {
            writer,
            names: named.into_iter().map(|(name, _)| name).collect(),
            columns,
        })
    }

    /// Where they are, for a checkpoint; forced to the disk.
    pub fn save(&self, words: &mut Words) -> Result<(), Trouble> {
        words.put_part("rows");
        words.put_whole(self.writer.mark()?);
        words.put_whole(self.names.len() as u64);
        for (name, unit) in self.writer.units() {
            words.put_text(name);
            words.put_text(unit);
        }
        Ok(())
    }

    /// Looks and writes a row.
    pub fn add(&mut self, run: &mut dyn Simulation) -> Result<(), Trouble> {
        let readings = run.look();
        self.put(run.time(), readings.iter().map(|r| r.value))
    }

    fn put(&mut self, time: f64, values: impl Iterator<Item = f64>) -> Result<(), Trouble> {
        let row: Vec<f64> = std::iter::once(time).chain(values).collect();
        self.writer.row(&row)?;
        for (column, value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        Ok(())
    }

    /// A column by name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let at = self.names.iter().position(|n| *n == name)?;
        Some(&self.columns[at])
    }

    /// Units by column, for the summary.
    pub fn units(&self) -> Vec<(String, String)> {
        self.writer.units().to_vec()
    }

    /// Closes the file.
    pub fn finish(self) -> Result<(), Trouble> {
        Ok(self.writer.finish()?)
    }
}
