//! OBJ files: faces of any number of corners, cut into triangles; materials and normals are ignored.

use super::{MOST_BYTES, MOST_FACETS, Mesh, MeshError, Part, check_corner, check_unit};
use glam::DVec3;

/// Reads the bytes of an OBJ file whose numbers are in units of `metres_per_unit` m.
///
/// # Errors
/// [`MeshError`]; facets are counted from 1 after polygons are cut into triangles.
pub fn parse_obj(bytes: &[u8], metres_per_unit: f64) -> Result<Mesh, MeshError> {
    check_unit(metres_per_unit)?;
    if bytes.len() as u64 > MOST_BYTES {
        return Err(MeshError::TooLarge {
            bytes: bytes.len() as u64,
        });
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(MeshError::Empty);
    }
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    // A material says nothing about shape: whatever file is named, it is not opened.
    let (models, _) = tobj::load_obj_buf(&mut &bytes[..], &options, |_| {
        Ok((Vec::new(), Default::default()))
    })
    .map_err(|e| MeshError::Obj {
        reason: e.to_string(),
    })?;
    let facets: u64 = models.iter().map(|m| m.mesh.indices.len() as u64 / 3).sum();
    if facets > MOST_FACETS {
        return Err(MeshError::TooManyFacets { facets });
    }
    let mut soup = Vec::with_capacity(facets as usize);
    let mut parts = Vec::new();
    for model in &models {
        let (positions, first) = (&model.mesh.positions, soup.len());
        for triangle in model.mesh.indices.chunks_exact(3) {
            let facet = soup.len() + 1;
            let mut corners = [DVec3::ZERO; 3];
            for (corner, &index) in corners.iter_mut().zip(triangle) {
                let at = 3 * index as usize;
                let Some(&[x, y, z]) = positions.get(at..at + 3) else {
                    return Err(MeshError::Index {
                        facet,
                        index,
                        vertices: positions.len() / 3,
                    });
                };
                *corner = DVec3::new(x, y, z) * metres_per_unit;
                check_corner(*corner, facet)?;
            }
            soup.push(corners);
        }
        parts.push(Part {
            name: model.name.clone(),
            first,
            count: soup.len() - first,
        });
    }
    Mesh::from_soup(&soup, parts)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const CUBE: &str = "o cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf -7 -6 -2 -3\nf 3/1 4/1 8/1 7/1\nf 4 1 5 8\n";

    #[test]
    fn squares_and_negative_indices_make_a_cube() {
        let cube = parse_obj(CUBE.as_bytes(), 0.1).unwrap();
        assert_eq!((cube.vertices.len(), cube.triangles.len()), (8, 12));
        assert!((cube.volume() - 1e-3).abs() < 1e-15);
        assert_eq!(cube.parts[0].name, "cube");
    }

    #[test]
    fn errors_are_said() {
        let wrong = |text: String| parse_obj(text.as_bytes(), 1.0).unwrap_err();
        assert_eq!(wrong(String::new()), MeshError::Empty);
        assert_eq!(wrong("v 0 0 0\n".into()), MeshError::Empty);
        assert!(matches!(
            wrong(CUBE.replace("f 4 1 5 8", "f 4 1 5 80")),
            MeshError::Obj { .. }
        ));
        assert!(matches!(
            wrong(CUBE.replace("v 1 1 1", "v 1 nan 1")),
            MeshError::NotFinite { .. }
        ));
        assert!(matches!(
            wrong(CUBE.replace("v 1 1 1", "v 1 1e99 1")),
            MeshError::Huge { .. }
        ));
    }

    proptest! {
        #[test]
        fn damaged_text_gives_an_answer(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8), cut in 0.0..1.2f64) {
            let mut bytes = CUBE.as_bytes().to_vec();
            for (at, value) in changes {
                let at = at.index(bytes.len());
                bytes[at] = value;
            }
            bytes.truncate((cut * bytes.len() as f64) as usize);
            if let Ok(mesh) = parse_obj(&bytes, 1.0) {
                let indices_hold = !matches!(mesh.check(), Err(MeshError::Index { .. }));
                prop_assert!(indices_hold);
            }
        }

        #[test]
        fn words_in_any_order_give_an_answer(words in prop::collection::vec("v|f|o|g|l|p|vn|vt|s|usemtl|mtllib|-?[0-9]{1,12}|[0-9]{1,3}/[0-9]{0,3}/[0-9]{1,3}|\n", 0..60)) {
            let _ = parse_obj(words.join(" ").as_bytes(), 1.0);
        }
    }
}
