//! Triangles as a text STL, the only kind that every version of LIGGGHTS reads.

use glam::DVec3;
use std::fmt::Write as _;

/// The file, in m.
pub fn text(triangles: &[[DVec3; 3]], name: &str) -> String {
    let mut text = format!("solid {name}\n");
    for [a, b, c] in triangles {
        let n = (*b - *a).cross(*c - *a).normalize_or_zero();
        let _ = writeln!(
            text,
            "facet normal {:e} {:e} {:e}\nouter loop",
            n.x, n.y, n.z
        );
        for x in [a, b, c] {
            let _ = writeln!(text, "vertex {:e} {:e} {:e}", x.x, x.y, x.z);
        }
        text += "endloop\nendfacet\n";
    }
    let _ = writeln!(text, "endsolid {name}");
    text
}
