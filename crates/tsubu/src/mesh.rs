//! `tsubu mesh`: the doctor looks at a file of triangles.

use crate::arguments::MeshWish;
use crate::trouble::Trouble;
use tsubu::sdf::mesh::{Mesh, Report, Verdict};

/// `tsubu mesh FILE`.
pub fn mesh(wish: &MeshWish) -> Result<u8, Trouble> {
    let mesh = Mesh::read(&wish.file, wish.unit.0)
        .map_err(|e| Trouble::Arguments(format!("{}: {e}", wish.file.display())))?;
    let report = Report::of(&mesh);
    say!("{}", wish.file.display());
    say!("{report}");
    Ok(if report.verdict == Verdict::Refuse {
        2
    } else {
        0
    })
}
