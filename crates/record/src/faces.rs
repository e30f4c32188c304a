//! The bodies of one frame as a ParaView PolyData file of triangles: what moves among the grains.

use std::io;
use std::path::Path;

use crate::RecordError;
use crate::vtp::{Body, Column, head, tail};

/// Triangles of bodies where they are at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Faces<'a> {
    /// Corners, m.
    pub points: &'a [[f32; 3]],
    /// Three corners each, by their place in `points`.
    pub triangles: &'a [[u32; 3]],
    /// The number of the body that each triangle belongs to.
    pub bodies: &'a [u32],
}

/// The whole `.vtp` file; `place` is what an error is about.
pub fn encode_faces(time: f64, faces: &Faces, place: &Path) -> Result<Vec<u8>, RecordError> {
    check(time, faces).map_err(|what| RecordError::caller(what, place))?;
    pack(time, faces).map_err(|e| RecordError::machine("it could not be packed", place, e))
}

fn check(time: f64, faces: &Faces) -> Result<(), String> {
    if !time.is_finite() {
        return Err(format!("the time of the frame is {time}"));
    }
    if faces.bodies.len() != faces.triangles.len() {
        return Err(format!(
            "there are {} triangles and the bodies of {}",
            faces.triangles.len(),
            faces.bodies.len()
        ));
    }
    let most = faces.triangles.iter().flatten().max();
    match most {
        Some(&corner) if corner as usize >= faces.points.len() => Err(format!(
            "a triangle has corner {corner} of {}",
            faces.points.len()
        )),
        _ => Ok(()),
    }
}

fn pack(time: f64, faces: &Faces) -> io::Result<Vec<u8>> {
    let mut body = Body::new();
    let mut header = head(time, faces.points.len(), [0, faces.triangles.len()]);
    header.push_str("<CellData>\n");
    let bodies = Column::Id(faces.bodies).bytes();
    body.array(&mut header, "UInt32", "body", 1, &bodies)?;
    header.push_str("</CellData>\n<Points>\n");
    let points = Column::Vector(faces.points).bytes();
    body.array(&mut header, "Float32", "Points", 3, &points)?;
    header.push_str("</Points>\n<Polys>\n");
    let corners = faces.triangles.as_flattened().iter();
    let corners: Vec<u8> = corners.flat_map(|&c| i64::from(c).to_le_bytes()).collect();
    body.array(&mut header, "Int64", "connectivity", 1, &corners)?;
    let ends: Vec<u8> = (1..=faces.triangles.len() as i64)
        .flat_map(|k| (3 * k).to_le_bytes())
        .collect();
    body.array(&mut header, "Int64", "offsets", 1, &ends)?;
    header.push_str("</Polys>\n");
    Ok(tail(header, &body))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fault;
    use crate::vtp::tests::Opened;

    const POINTS: [[f32; 3]; 4] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.5],
    ];

    #[test]
    fn corners_triangles_and_bodies_are_read_back() {
        let faces = Faces {
            points: &POINTS,
            triangles: &[[0, 2, 1], [1, 2, 3]],
            bodies: &[7, 9],
        };
        let file = encode_faces(0.25, &faces, Path::new("x.vtp")).unwrap();
        let opened = Opened::new(&file);
        assert_eq!(opened.time(), 0.25);
        assert_eq!(opened.attribute("<Piece", "NumberOfPolys"), "2");
        assert_eq!(opened.attribute("<Piece", "NumberOfVerts"), "0");
        let whole = |bytes: Vec<u8>| -> Vec<i64> {
            bytes
                .chunks_exact(8)
                .map(|b| i64::from_le_bytes(b.try_into().unwrap()))
                .collect()
        };
        let corners = whole(opened.bytes("connectivity", "Int64", "1"));
        assert_eq!(corners, [0, 2, 1, 1, 2, 3]);
        assert_eq!(whole(opened.bytes("offsets", "Int64", "1")), [3, 6]);
        let bodies = opened.bytes("body", "UInt32", "1");
        assert_eq!(bodies, [7, 0, 0, 0, 9, 0, 0, 0]);
        let points = opened.bytes("Points", "Float32", "3");
        assert_eq!(points[11 * 4..], 1.5f32.to_le_bytes());
    }

    #[test]
    fn a_triangle_without_its_corner_or_body_is_refused() {
        for (triangles, bodies) in [(vec![[0, 1, 4]], vec![0]), (vec![[0, 1, 2]], vec![])] {
            let faces = Faces {
                points: &POINTS,
                triangles: &triangles,
                bodies: &bodies,
            };
            let error = encode_faces(0.0, &faces, Path::new("x.vtp")).unwrap_err();
            assert_eq!(error.fault(), Fault::Caller);
        }
    }
}
