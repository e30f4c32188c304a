//! Grains from a file: comma-separated columns x,y,z[,vx,vy,vz][,d] in SI, named in the first line.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use crate::error::{Place, SceneError, nearest};
use crate::scene::{Space, StartingGrain};
use crate::source::read_text;

/// The longest grain file that is read, in bytes; ten million grains fit.
const LONGEST: u64 = 1 << 30;

/// The columns a grain file may have.
const COLUMNS: [&str; 7] = ["x", "y", "z", "vx", "vy", "vz", "d"];

/// Number of the diameter among them.
const DIAMETER: usize = 6;

/// The content of a grain file.
///
/// The first line names the columns, in any order: x, y and z in m; vx, vy and vz in m/s, zero if absent; d in m.
/// Empty lines and lines that begin with # are skipped. In a plane scene y and vy may be left out and are else zero.
/// Every d is the diameter of one of the scene's populations; where they have several, the column is needed.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainFile {
    /// The grains in the order of the file.
    pub grains: Vec<StartingGrain>,
}

impl GrainFile {
    /// Reads a grain file; the diameters are those of the scene's populations, at coarse level 0.
    ///
    /// # Errors
    /// When the file cannot be read, or a line of it is wrong.
    pub fn read(path: &Path, diameters: &[f64], space: Space) -> Result<GrainFile, SceneError> {
        GrainFile::parse(
            &path.display().to_string(),
            &read_text(path, LONGEST, "a grain file")?,
            diameters,
            space,
        )
    }

    /// Reads the text of a grain file; `name` stands in messages where the file's name would.
    ///
    /// # Errors
    /// When a line of it is wrong.
    pub fn parse(
        name: &str,
        text: &str,
        diameters: &[f64],
        space: Space,
    ) -> Result<GrainFile, SceneError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut lines = text
            .lines()
            .enumerate()
            .map(|(i, text)| Line {
                name,
                number: i + 1,
                text,
            })
            .filter(|line| {
                !line.text.trim().is_empty() && !line.text.trim_start().starts_with('#')
            });
        let Some(header) = lines.next() else {
            return Err(whole(name, "this grain file is empty"));
        };
        let columns = columns(&header, space)?;
        if diameters.len() > 1 && !columns.contains(&DIAMETER) {
            let end = header.text.trim_end().len();
            let what = "the column d is missing: the scene has several populations";
            return Err(header.error(end..end, what, "add the diameter of each grain in m"));
        }
        let grains = lines
            .map(|line| grain(&line, &columns, diameters, space))
            .collect::<Result<Vec<_>, _>>()?;
        if grains.is_empty() {
            return Err(whole(
                name,
                "this grain file has no grains, only its header",
            ));
        }
        Ok(GrainFile { grains })
    }
}

fn whole(name: &str, what: &str) -> SceneError {
    SceneError::new(
        what,
        "write the header x,y,z and a line for each grain, in metres",
        Place::Whole(name.into()),
    )
}

struct Line<'a> {
    name: &'a str,
    number: usize,
    text: &'a str,
}

impl<'a> Line<'a> {
    /// The cells without the blanks around them, and where they stand.
    fn cells(&self) -> impl Iterator<Item = (Range<usize>, &'a str)> {
        let mut start = 0;
        self.text.split(',').map(move |cell| {
            let from = start + (cell.len() - cell.trim_start().len());
            start += cell.len() + 1;
            (from..from + cell.trim().len(), cell.trim())
        })
    }

    fn error(
        &self,
        span: Range<usize>,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> SceneError {
        let text: Arc<str> = self.text.into();
        SceneError::new(
            what,
            remedy,
            Place::Part {
                name: self.name.into(),
                text,
                first_line: self.number,
                span,
            },
        )
    }
}

/// For each column of the file its number in [`COLUMNS`].
fn columns(header: &Line<'_>, space: Space) -> Result<Vec<usize>, SceneError> {
    let mut columns = Vec::new();
    for (span, cell) in header.cells() {
        let Some(column) = COLUMNS.iter().position(|known| *known == cell) else {
            if cell.parse::<f64>().is_ok() {
                return Err(header.error(
                    span,
                    "the first line holds numbers, not the names of the columns",
                    "put x,y,z above it",
                ));
            }
            let hint = nearest(cell, COLUMNS.into_iter())
                .map_or(String::new(), |near| format!("did you mean “{near}”? "));
            return Err(header.error(
                span,
                format!("unknown column “{cell}”"),
                format!("{hint}the columns are {}", COLUMNS.join(", ")),
            ));
        };
        if columns.contains(&column) {
            return Err(header.error(
                span,
                format!("the column “{cell}” is given twice"),
                "keep one of them",
            ));
        }
        columns.push(column);
    }
    let needed: &[usize] = if space == Space::Plane {
        &[0, 2]
    } else {
        &[0, 1, 2]
    };
    match needed.iter().find(|column| !columns.contains(column)) {
        Some(missing) => {
            let what = format!("the column “{}” is missing", COLUMNS[*missing]);
            Err(header.error(
                0..header.text.len(),
                what,
                "name the columns x,y,z[,vx,vy,vz][,d]",
            ))
        }
        None => Ok(columns),
    }
}

fn grain(
    line: &Line<'_>,
    columns: &[usize],
    diameters: &[f64],
    space: Space,
) -> Result<StartingGrain, SceneError> {
    let mut values = [0.0; COLUMNS.len()];
    let mut population = 0;
    let mut count = 0;
    for (span, cell) in line.cells() {
        let Some(column) = columns.get(count).copied() else {
            return Err(line.error(
                span,
                format!(
                    "more values than the {} columns of the header",
                    columns.len()
                ),
                "remove the value",
            ));
        };
        count += 1;
        let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
        let Some(value) = value else {
            let what = format!("“{cell}” is no finite number");
            return Err(line.error(
                span,
                what,
                "write a number in SI units without the unit, such as 1.35e-3",
            ));
        };
        if column == DIAMETER {
            let is_it = |of: &f64| (value / of - 1.0).abs() <= 1e-6;
            population = diameters.iter().position(is_it).ok_or_else(|| {
                let known: Vec<_> = diameters.iter().map(|of| format!("{of:?} m")).collect();
                let what = format!(
                    "this grain's diameter is {value:?} m, the scene's {}",
                    known.join(", ")
                );
                let remedy = "make the two equal, or add a population of this diameter to grains.populations";
                line.error(span.clone(), what, remedy)
            })?;
        }
        if space == Space::Plane && matches!(column, 1 | 4) && value != 0.0 {
            return Err(line.error(
                span,
                "a plane scene has no y, but this is not zero",
                "write 0, or space: Space in the scene",
            ));
        }
        values[column] = value;
    }
    if count < columns.len() {
        let end = line.text.trim_end().len();
        let what = format!(
            "{count} values for the {} columns of the header",
            columns.len()
        );
        return Err(line.error(end..end, what, "complete the line"));
    }
    let [x, y, z, vx, vy, vz, _] = values;
    Ok(StartingGrain {
        at: DVec3::new(x, y, z),
        velocity: DVec3::new(vx, vy, vz),
        population,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Result<Vec<StartingGrain>, SceneError> {
        GrainFile::parse("grains.csv", text, &[0.00135], Space::Space).map(|file| file.grains)
    }

    #[test]
    fn columns_in_any_order_with_blanks_and_notes() {
        let grains =
            parse("\u{feff}# packed\r\nz, x,y , vz,vx,vy,d\r\n\r\n3, 1 ,2,6,4,5,1.35e-3\r\n")
                .expect("in form");
        assert_eq!(
            grains,
            [StartingGrain {
                at: DVec3::new(1.0, 2.0, 3.0),
                velocity: DVec3::new(4.0, 5.0, 6.0),
                population: 0,
            }]
        );
        let plane = GrainFile::parse("p.csv", "x,z\n1,2", &[1.0], Space::Plane).expect("in form");
        assert_eq!(plane.grains[0].at, DVec3::new(1.0, 0.0, 2.0));
    }

    #[test]
    fn what_is_wrong_and_where() {
        for (text, message, place) in [
            ("", "is empty", None),
            ("x,y,z\n", "no grains", None),
            ("1,2,3\n", "not the names of the columns", Some((1, 1))),
            ("x,y\n1,2\n", "“z” is missing", Some((1, 1))),
            ("x,y,z,x\n", "given twice", Some((1, 7))),
            ("x,y,z,vxx\n", "did you mean “vx”?", Some((1, 7))),
            ("x,y,z\n1,2\n", "2 values for the 3 columns", Some((2, 4))),
            ("x,y,z\n1,2,3,4\n", "more values", Some((2, 7))),
            ("x,y,z\n\n1,2, a\n", "“a” is no finite number", Some((3, 6))),
            (
                "x,y,z\n1,2,NaN\n",
                "“NaN” is no finite number",
                Some((2, 5)),
            ),
            ("x,y,z\n1,2,\n", "“” is no finite number", Some((2, 5))),
            ("x,y,z,d\n1,2,3,1.36e-3\n", "population", Some((2, 7))),
        ] {
            let error = parse(text).expect_err(text);
            assert!(error.to_string().contains(message), "{error}");
            assert_eq!(error.line_column(), place, "{error}");
        }
    }

    #[test]
    fn the_diameter_says_whose_a_grain_is() {
        let two = [0.00135, 0.0008];
        let parse = |text: &str| GrainFile::parse("two.csv", text, &two, Space::Space);
        let grains = parse("x,y,z,d\n0,0,0,8e-4\n1,0,0,1.35e-3\n").expect("in form");
        let of: Vec<usize> = grains.grains.iter().map(|grain| grain.population).collect();
        assert_eq!(of, [1, 0]);
        let error = parse("x,y,z\n0,0,0\n").expect_err("no diameter");
        assert!(error.to_string().contains("column d is missing"), "{error}");
        assert_eq!(error.line_column(), Some((1, 6)));
    }

    proptest! {
        #[test]
        fn any_text_is_read_or_refused(text in "x,y,z(,d)?\n([-0-9.e, \n#]|.){0,40}", other in ".{0,40}") {
            for text in [text, other] {
                if let Err(error) = parse(&text) {
                    prop_assert!(!error.to_string().is_empty());
                }
            }
        }
    }
}
