//! One frame as a ParaView PolyData file (`.vtp`): appended raw data in zlib blocks.
//!
//! The layout is that of VTK's XML reader: the header names every array and its offset;
//! after the mark `_` each array is `[blocks, block size, size of a shorter last block or 0, packed size of each block]`
//! as little-endian u64, then the packed blocks.
//! Every grain is a vertex cell of its own, so points show at once and a threshold keeps or drops single grains.

use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;

use crate::RecordError;

/// Bytes in a block before packing; VTK unpacks one block at a time.
const BLOCK: usize = 1 << 16;

/// Lower levels hardly shrink coordinates, higher ones take much longer for little more.
const LEVEL: u32 = 3;

/// The values of one quantity, one per grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column<'a> {
    /// One number per grain, as a radius.
    Scalar(&'a [f32]),
    /// Three numbers per grain, as a velocity.
    Vector(&'a [[f32; 3]]),
    /// One whole number per grain, as an identity or a kind.
    Id(&'a [u32]),
}

/// What is known of the grains at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame<'a> {
    /// Centres of the grains, m.
    pub points: &'a [[f32; 3]],
    /// Quantities by name; each has as many values as there are points.
    pub columns: &'a [(&'a str, Column<'a>)],
}

impl Column<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Id(values) => values.len(),
        }
    }

    fn kind(&self) -> (&'static str, usize) {
        match self {
            Self::Scalar(_) => ("Float32", 1),
            Self::Vector(_) => ("Float32", 3),
            Self::Id(_) => ("UInt32", 1),
        }
    }

    pub(crate) fn bytes(&self) -> Vec<u8> {
        match self {
            Self::Scalar(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
            Self::Vector(values) => {
                let numbers = values.as_flattened();
                numbers.iter().flat_map(|v| v.to_le_bytes()).collect()
            }
            Self::Id(values) => values.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }
}

/// The whole `.vtp` file of a frame at `time` (s); `place` is what an error is about.
pub fn encode(time: f64, frame: &Frame, place: &Path) -> Result<Vec<u8>, RecordError> {
    check(time, frame).map_err(|what| RecordError::caller(what, place))?;
    let grains = frame.points.len();
    let count = i64::try_from(grains)
        .map_err(|_| RecordError::caller("too many grains for a frame", place))?;
    pack_all(time, frame, count)
        .map_err(|e| RecordError::machine("it could not be packed", place, e))
}

fn check(time: f64, frame: &Frame) -> Result<(), String> {
    if !time.is_finite() {
        return Err(format!("the time of the frame is {time}"));
    }
    for (i, (name, column)) in frame.columns.iter().enumerate() {
        if name.is_empty() || name.chars().any(char::is_control) {
            return Err(format!("{name:?} cannot name a column"));
        }
        if frame.columns[..i].iter().any(|(other, _)| other == name) {
            return Err(format!("the column '{name}' comes twice"));
        }
        if column.len() != frame.points.len() {
            return Err(format!(
                "the column '{name}' has {} values for {} grains",
                column.len(),
                frame.points.len()
            ));
        }
    }
    Ok(())
}

fn pack_all(time: f64, frame: &Frame, count: i64) -> io::Result<Vec<u8>> {
    let mut body = Body::new();
    let mut header = head(time, frame.points.len(), [frame.points.len(), 0]);
    header.push_str("<PointData>\n");
    for (name, column) in frame.columns {
        let (kind, components) = column.kind();
        body.array(
            &mut header,
            kind,
            &escaped(name),
            components,
            &column.bytes(),
        )?;
    }
    header.push_str("</PointData>\n<Points>\n");
    let points = Column::Vector(frame.points).bytes();
    body.array(&mut header, "Float32", "Points", 3, &points)?;
    header.push_str("</Points>\n<Verts>\n");
    let cells: Vec<u8> = (0..count).flat_map(i64::to_le_bytes).collect();
    body.array(&mut header, "Int64", "connectivity", 1, &cells)?;
    let ends: Vec<u8> = (1..=count).flat_map(i64::to_le_bytes).collect();
    body.array(&mut header, "Int64", "offsets", 1, &ends)?;
    header.push_str("</Verts>\n");
    Ok(tail(header, &body))
}

/// The beginning of a file up to its one piece: so many points, vertex cells and triangles.
pub(crate) fn head(time: f64, points: usize, [vertices, triangles]: [usize; 2]) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n\
         <PolyData>\n\
         <FieldData>\n\
         <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{time:?}</DataArray>\n\
         </FieldData>\n\
         <Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{vertices}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"{triangles}\">\n"
    )
}

/// The whole file from its header, which ends within the piece, and the packed arrays.
pub(crate) fn tail(mut header: String, body: &Body) -> Vec<u8> {
    header.push_str("</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
    let mut file = header.into_bytes();
    file.extend_from_slice(&body.packed);
    file.extend_from_slice(b"\n</AppendedData>\n</VTKFile>\n");
    file
}

/// The appended data so far, and the packer, which is made once and used for every block.
pub(crate) struct Body {
    packed: Vec<u8>,
    packer: ZlibEncoder<Vec<u8>>,
}

impl Body {
    pub(crate) fn new() -> Self {
        Self {
            packed: Vec::new(),
            packer: ZlibEncoder::new(Vec::new(), Compression::new(LEVEL)),
        }
    }

    /// Appends an array and names it, with its offset, in the header.
    pub(crate) fn array(
        &mut self,
        header: &mut String,
        kind: &str,
        name: &str,
        components: usize,
        bytes: &[u8],
    ) -> io::Result<()> {
        let offset = self.packed.len();
        writeln!(
            header,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>"
        )
        .map_err(io::Error::other)?;
        let blocks = bytes
            .chunks(BLOCK)
            .map(|block| {
                self.packer.write_all(block)?;
                self.packer.reset(Vec::new())
            })
            .collect::<io::Result<Vec<_>>>()?;
        let shorter_last = bytes.len() % BLOCK;
        let sizes = blocks.iter().map(Vec::len);
        for number in [blocks.len(), BLOCK, shorter_last].into_iter().chain(sizes) {
            self.packed.extend((number as u64).to_le_bytes());
        }
        for block in &blocks {
            self.packed.extend_from_slice(block);
        }
        Ok(())
    }
}

fn escaped(name: &str) -> String {
    name.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
#[path = "vtp_tests.rs"]
pub(crate) mod tests;
