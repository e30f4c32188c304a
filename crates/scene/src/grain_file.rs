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

/// The content of a grain file.
///
/// The first line names the columns, in any order: x, y and z in m; vx, vy and vz in m/s, zero if absent; d in m.
/// Empty lines and lines that begin with # are skipped. In a plane scene y and vy may be left out and are else zero.
/// All grains are of one kind for now, so every d must be the scene's diameter.
#[derive(Clone, Debug, PartialEq)]
pub struct GrainFile {
    /// The grains in the order of the file.
    pub grains: Vec<StartingGrain>,
}

impl GrainFile {
    /// Reads a grain file; `diameter` is the scene's, at coarse level 0.
    ///
    /// # Errors
    /// When the file cannot be read, or a line of it is wrong.
    pub fn read(path: &Path, diameter: f64, space: Space) -> Result<GrainFile, SceneError> {
        GrainFile::parse(
            &path.display().to_string(),
            &read_text(path, LONGEST, "a grain file")?,
            diameter,
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
        diameter: f64,
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
        let grains = lines
            .map(|line| grain(&line, &columns, diameter, space))
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
    diameter: f64,
    space: Space,
) -> Result<StartingGrain, SceneError> {
    let mut values = [0.0; COLUMNS.len()];
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
        if column == 6 && (value / diameter - 1.0).abs().max(0.0) > 1e-6 {
            let what =
                format!("this grain's diameter is {value:?} m, the scene's is {diameter:?} m");
            return Err(line.error(
                span,
                what,
                "all grains are of one kind for now: make the two equal, or leave the column d out",
            ));
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
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn parse(text: &str) -> Result<Vec<StartingGrain>, SceneError> {
        GrainFile::parse("grains.csv", text, 0.00135, Space::Space).map(|file| file.grains)
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
                velocity: DVec3::new(4.0, 5.0, 6.0)
            }]
        );
        let plane = GrainFile::parse("p.csv", "x,z\n1,2", 1.0, Space::Plane).expect("in form");
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
            ("x,y,z,d\n1,2,3,1.36e-3\n", "one kind", Some((2, 7))),
        ] {
            let error = parse(text).expect_err(text);
            assert!(error.to_string().contains(message), "{error}");
            assert_eq!(error.line_column(), place, "{error}");
        }
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
