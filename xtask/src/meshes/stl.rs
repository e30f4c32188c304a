//! Binary STL in mm: enough to write closed shells and, for the tests, to read them back.

use tsubu_model::Shell;

/// The file of some shells given in m. The same shells give the same bytes.
pub fn bytes(name: &str, shells: &[Shell]) -> Vec<u8> {
    let count: usize = shells.iter().map(|s| s.triangles.len()).sum();
    // A header that begins with "solid" would be taken for the text form.
    let mut out =
        format!("tsubu {name}, binary STL, mm, z up, from cargo xtask meshes").into_bytes();
    out.resize(80, b' ');
    out.extend((count as u32).to_le_bytes());
    for shell in shells {
        for triangle in &shell.triangles {
            let [a, b, c] = triangle.map(|k| shell.vertices[k as usize] * 1e3);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for x in [normal, a, b, c].into_iter().flat_map(|x| x.to_array()) {
                // Adding zero turns −0 into 0, so that equal corners have equal bytes.
                out.extend((x as f32 + 0.0).to_le_bytes());
            }
            out.extend([0, 0]);
        }
    }
    out
}

/// The triangles of a file, in mm; None if it is not whole.
#[cfg(test)]
pub fn triangles(bytes: &[u8]) -> Option<Vec<[[f32; 3]; 3]>> {
    let count = u32::from_le_bytes(bytes.get(80..84)?.try_into().ok()?) as usize;
    let records = bytes.get(84..)?;
    if records.len() != 50 * count {
        return None;
    }
    let number = |r: &[u8], k: usize| f32::from_le_bytes([r[k], r[k + 1], r[k + 2], r[k + 3]]);
    let corner = |r: &[u8], c: usize| [0, 1, 2].map(|a| number(r, 12 + 12 * c + 4 * a));
    Some(
        records
            .chunks_exact(50)
            .map(|r| [corner(r, 0), corner(r, 1), corner(r, 2)])
            .collect(),
    )
}
