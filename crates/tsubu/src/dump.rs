//! Text dumps of LAMMPS and LIGGGHTS, read moment by moment.
//!
//! A moment is a block of `ITEM:` sections, as `dump … custom` writes them. The columns may stand in any order and be more
//! than are used: `id`, `x y z` (or the unwrapped `xu yu zu`) and, if they are there, `type` and `vx vy vz`.

use glam::DVec3;
use std::fmt;
use std::io::BufRead;

/// One atom of a dump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Atom {
    /// Its number in the dump, from 1.
    pub id: u64,
    /// Its type; 1 if the dump says none.
    pub kind: u32,
    /// Its centre in m.
    pub position: DVec3,
    /// Its velocity in m/s; zero if the dump says none.
    pub velocity: DVec3,
}

/// All atoms at one step, in order of their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DumpMoment {
    /// The step.
    pub step: u64,
    /// The atoms.
    pub atoms: Vec<Atom>,
}

/// A dump that is not one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DumpError {
    /// Line, from 1.
    pub line: usize,
    /// What is wrong there.
    pub what: String,
}

impl fmt::Display for DumpError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.what)
    }
}

impl std::error::Error for DumpError {}

/// The moments of a dump, one after another.
///
/// ```
/// let text = "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n\
///             ITEM: ATOMS id x y z vx vy vz\n7 0.1 0.2 0.3 0 0 -2\n";
/// let moments: Result<Vec<_>, _> = tsubu::dump::Dump::new(text.as_bytes()).collect();
/// let moments = moments?;
/// assert_eq!((moments[0].step, moments[0].atoms[0].velocity.z), (100, -2.0));
/// # Ok::<(), tsubu::dump::DumpError>(())
/// ```
pub struct Dump<R> {
    lines: std::io::Lines<R>,
    line: usize,
    /// True once an error was given: nothing sensible follows.
    over: bool,
}

impl<R: BufRead> Dump<R> {
    /// Reads from here on.
    pub fn new(reader: R) -> Self {
        Self {
            lines: reader.lines(),
            line: 0,
            over: false,
        }
    }

    fn wrong<T>(&self, what: impl Into<String>) -> Result<T, DumpError> {
        Err(DumpError {
            line: self.line,
            what: what.into(),
        })
    }

    fn next_line(&mut self) -> Result<Option<String>, DumpError> {
        self.line += 1;
        match self.lines.next() {
            None => Ok(None),
            Some(Ok(text)) => Ok(Some(text)),
            Some(Err(cause)) => self.wrong(format!(
                "cannot be read as text ({cause}); a packed dump has to be unpacked first"
            )),
        }
    }

    fn demand_line(&mut self) -> Result<String, DumpError> {
        match self.next_line()? {
            Some(text) => Ok(text),
            None => self.wrong("the dump ends within a moment"),
        }
    }

    fn number<T: std::str::FromStr>(&self, text: &str, name: &str) -> Result<T, DumpError> {
        match text.trim().parse() {
            Ok(number) => Ok(number),
            Err(_) => self.wrong(format!("expected {name}, found `{}`", text.trim())),
        }
    }

    /// The next moment; `None` at the end of the dump.
    fn moment(&mut self) -> Result<Option<DumpMoment>, DumpError> {
        let (mut step, mut count) = (None, None);
        loop {
            let Some(text) = self.next_line()? else {
                return match step {
                    None => Ok(None),
                    Some(_) => self.wrong("the dump ends within a moment"),
                };
            };
            let Some(item) = text.trim_end().strip_prefix("ITEM: ") else {
                if text.trim().is_empty() && step.is_none() {
                    continue;
                }
                return self.wrong(format!(
                    "expected a line `ITEM: …`, found `{}`",
                    text.trim()
                ));
            };
            if item == "TIMESTEP" {
                let text = self.demand_line()?;
                step = Some(self.number(&text, "a step")?);
            } else if item == "NUMBER OF ATOMS" {
                let text = self.demand_line()?;
                count = Some(self.number(&text, "a number of atoms")?);
            } else if item.starts_with("BOX BOUNDS") {
                for _ in 0..3 {
                    self.demand_line()?;
                }
            } else if let Some(columns) = item.strip_prefix("ATOMS") {
                let (Some(step), Some(count)) = (step, count) else {
                    return self.wrong("atoms before their step and number");
                };
                let atoms = self.atoms(columns, count)?;
                return Ok(Some(DumpMoment { step, atoms }));
            } else {
                // UNITS and TIME, each with a line that says nothing new.
                self.demand_line()?;
            }
        }
    }

    fn atoms(&mut self, columns: &str, count: usize) -> Result<Vec<Atom>, DumpError> {
        let names: Vec<&str> = columns.split_whitespace().collect();
        let place = |name: &str| names.iter().position(|n| *n == name);
        let three = |a: &str, b: &str, c: &str| Some([place(a)?, place(b)?, place(c)?]);
        let Some(id) = place("id") else {
            return self.wrong("the atoms have no column `id`: add it to the dump command");
        };
        let Some(x) = three("x", "y", "z").or_else(|| three("xu", "yu", "zu")) else {
            return self.wrong("the atoms have no columns `x y z`: add them to the dump command");
        };
        let (kind, v) = (place("type"), three("vx", "vy", "vz"));
        let mut atoms = Vec::with_capacity(count.min(1 << 24));
        for _ in 0..count {
            let text = self.demand_line()?;
            let words: Vec<&str> = text.split_whitespace().collect();
            if words.len() < names.len() {
                return self.wrong(format!(
                    "expected {} columns, found {}",
                    names.len(),
                    words.len()
                ));
            }
            let real = |at: usize| -> Result<f64, DumpError> {
                let value: f64 = self.number(words[at], names[at])?;
                if value.is_finite() {
                    Ok(value)
                } else {
                    self.wrong(format!("{} is not finite", names[at]))
                }
            };
            let vector = |at: [usize; 3]| -> Result<DVec3, DumpError> {
                Ok(DVec3::new(real(at[0])?, real(at[1])?, real(at[2])?))
            };
            atoms.push(Atom {
                id: self.number(words[id], "an id")?,
                kind: kind.map_or(Ok(1), |at| self.number(words[at], "a type"))?,
                position: vector(x)?,
                velocity: v.map_or(Ok(DVec3::ZERO), vector)?,
            });
        }
        atoms.sort_by_key(|atom| atom.id);
        if let Some(two) = atoms.windows(2).find(|two| two[0].id == two[1].id) {
            return self.wrong(format!("two atoms have the id {}", two[0].id));
        }
        Ok(atoms)
    }
}

impl<R: BufRead> Iterator for Dump<R> {
    type Item = Result<DumpMoment, DumpError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.over {
            return None;
        }
        let moment = self.moment();
        self.over = !matches!(moment, Ok(Some(_)));
        moment.transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str =
        "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n";

    fn read(text: &str) -> Result<Vec<DumpMoment>, DumpError> {
        Dump::new(text.as_bytes()).collect()
    }

    #[test]
    fn columns_in_any_order_and_sections_that_say_nothing_are_read() {
        let text = format!(
            "ITEM: UNITS\nsi\n{HEAD}ITEM: ATOMS vz type zu yu xu id vx vy radius \n1 2 3 2 1 9 0 0 5\n4 1 6 5 4 3 0 0 5\n\
             ITEM: TIMESTEP\n6\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z\n"
        );
        let moments = read(&text).unwrap();
        assert_eq!((moments[0].step, moments[1].step), (5, 6));
        let [a, b] = moments[0].atoms[..] else {
            panic!("two atoms")
        };
        assert_eq!((a.id, a.position), (3, DVec3::new(4.0, 5.0, 6.0)));
        assert_eq!((b.kind, b.velocity), (2, DVec3::new(0.0, 0.0, 1.0)));
        assert!(moments[1].atoms.is_empty());
    }

    #[test]
    fn what_is_wrong_is_told_with_its_line() {
        let atoms = |rows: &str| format!("{HEAD}ITEM: ATOMS id x y z\n{rows}");
        for (text, line, word) in [
            (
                format!("{HEAD}ITEM: ATOMS id xs ys zs\n1 0 0 0\n2 0 0 0\n"),
                9,
                "x y z",
            ),
            (atoms("1 0 0 0\n2 0 zero 0\n"), 11, "zero"),
            (atoms("1 0 0 0\n2 0 nan 0\n"), 11, "finite"),
            (atoms("1 0 0 0\n1 0 0 0\n"), 11, "id 1"),
            (atoms("1 0 0 0\n"), 11, "ends"),
            (atoms("1 0 0\n2 0 0 0\n"), 10, "columns"),
            ("x,y,z\n".to_owned(), 1, "ITEM"),
        ] {
            let error = read(&text).unwrap_err();
            assert_eq!(error.line, line, "{error}");
            assert!(error.what.contains(word), "{error}");
        }
    }
}
