//! Tests of the frame file: what was put in is read back by unpacking the blocks.

use std::io::Read;

use flate2::read::ZlibDecoder;
use proptest::prelude::*;

use super::*;
use crate::Fault;

/// A frame file taken apart by rules of its own, to hold the writer against.
pub(crate) struct Opened<'a> {
    header: &'a str,
    data: &'a [u8],
}

impl<'a> Opened<'a> {
    pub(crate) fn new(file: &'a [u8]) -> Self {
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let at = file.windows(mark.len()).position(|w| w == mark).unwrap();
        let end = b"\n</AppendedData>\n</VTKFile>\n";
        assert!(file.ends_with(end));
        Self {
            header: std::str::from_utf8(&file[..at]).unwrap(),
            data: &file[at + mark.len()..file.len() - end.len()],
        }
    }

    pub(crate) fn attribute(&self, tag: &str, name: &str) -> &'a str {
        let tag = &self.header[self.header.find(tag).unwrap()..];
        let tag = &tag[..tag.find('>').unwrap()];
        let key = format!(" {name}=\"");
        let value = &tag[tag.find(&key).unwrap() + key.len()..];
        &value[..value.find('"').unwrap()]
    }

    pub(crate) fn time(&self) -> f64 {
        let start = self.header.find("Name=\"TimeValue\"").unwrap();
        let text = &self.header[start..];
        let text = &text[text.find('>').unwrap() + 1..text.find('<').unwrap()];
        text.parse().unwrap()
    }

    fn u64_at(&self, at: usize) -> usize {
        u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap()) as usize
    }

    /// The bytes of a named array; `blocks` full and shorter ones are checked against the header.
    pub(crate) fn bytes(&self, name: &str, kind: &str, components: &str) -> Vec<u8> {
        let quoted = format!("Name=\"{name}\"");
        let line = self.header.lines().find(|l| l.contains(&quoted)).unwrap();
        assert!(line.contains(&format!("type=\"{kind}\"")), "{line}");
        assert!(
            line.contains(&format!("NumberOfComponents=\"{components}\"")),
            "{line}"
        );
        let offset = line.split("offset=\"").nth(1).unwrap();
        let offset: usize = offset.split('"').next().unwrap().parse().unwrap();
        let (blocks, size, last) = (
            self.u64_at(offset),
            self.u64_at(offset + 8),
            self.u64_at(offset + 16),
        );
        let mut at = offset + 24 + 8 * blocks;
        let mut bytes = Vec::new();
        for block in 0..blocks {
            let packed = self.u64_at(offset + 24 + 8 * block);
            let mut unpacked = Vec::new();
            ZlibDecoder::new(&self.data[at..at + packed])
                .read_to_end(&mut unpacked)
                .unwrap();
            let is_short = block + 1 == blocks && last > 0;
            assert_eq!(unpacked.len(), if is_short { last } else { size });
            bytes.extend(unpacked);
            at += packed;
        }
        bytes
    }

    fn u32s(&self, name: &str, kind: &str, components: &str) -> Vec<u32> {
        let bytes = self.bytes(name, kind, components);
        let (words, rest) = bytes.as_chunks::<4>();
        assert!(rest.is_empty());
        words.iter().map(|w| u32::from_le_bytes(*w)).collect()
    }

    fn i64s(&self, name: &str) -> Vec<i64> {
        let bytes = self.bytes(name, "Int64", "1");
        let (words, rest) = bytes.as_chunks::<8>();
        assert!(rest.is_empty());
        words.iter().map(|w| i64::from_le_bytes(*w)).collect()
    }
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|v| v.to_bits()).collect()
}

fn reads_back(time: f64, points: &[[f32; 3]], radius: &[f32], velocity: &[[f32; 3]], id: &[u32]) {
    let frame = Frame {
        points,
        columns: &[
            ("radius", Column::Scalar(radius)),
            ("velocity", Column::Vector(velocity)),
            ("id", Column::Id(id)),
        ],
    };
    let file = encode(time, &frame, Path::new("frame")).unwrap();
    let opened = Opened::new(&file);
    let n = points.len();
    assert_eq!(opened.time().to_bits(), time.to_bits());
    assert_eq!(opened.attribute("<Piece", "NumberOfPoints"), n.to_string());
    assert_eq!(opened.attribute("<Piece", "NumberOfVerts"), n.to_string());
    let points = bits(points.as_flattened());
    assert_eq!(opened.u32s("Points", "Float32", "3"), points);
    assert_eq!(opened.u32s("radius", "Float32", "1"), bits(radius));
    let velocity = bits(velocity.as_flattened());
    assert_eq!(opened.u32s("velocity", "Float32", "3"), velocity);
    assert_eq!(opened.u32s("id", "UInt32", "1"), id);
    let n = n as i64;
    assert_eq!(opened.i64s("connectivity"), (0..n).collect::<Vec<_>>());
    assert_eq!(opened.i64s("offsets"), (1..=n).collect::<Vec<_>>());
}

fn any_f32() -> impl Strategy<Value = f32> {
    any::<u32>().prop_map(f32::from_bits)
}

proptest! {
    #[test]
    fn any_columns_read_back_to_the_bit(
        time in any::<f64>().prop_filter("a time is finite", |t| t.is_finite()),
        grains in prop::collection::vec(
            ([any_f32(), any_f32(), any_f32()], any_f32(), [any_f32(), any_f32(), any_f32()], any::<u32>()),
            0..200,
        ),
    ) {
        let points: Vec<_> = grains.iter().map(|g| g.0).collect();
        let radius: Vec<_> = grains.iter().map(|g| g.1).collect();
        let velocity: Vec<_> = grains.iter().map(|g| g.2).collect();
        let id: Vec<_> = grains.iter().map(|g| g.3).collect();
        reads_back(time, &points, &radius, &velocity, &id);
    }
}

/// 16384 scalars fill one block exactly; the header then says that no block is shorter.
#[test]
fn blocks_full_short_and_absent_read_back() {
    for n in [0, 1, 16383, 16384, 16385, 40000] {
        let spread = |i: u32, k: u32| (i.wrapping_mul(2654435761).wrapping_add(k) as f32).sin();
        let vector = |i| [spread(i, 1), spread(i, 2), spread(i, 3)];
        let points: Vec<_> = (0..n).map(vector).collect();
        let velocity: Vec<_> = (0..n).map(|i| vector(i + 7)).collect();
        let radius: Vec<_> = (0..n).map(|i| spread(i, 4)).collect();
        let id: Vec<_> = (0..n).rev().collect();
        reads_back(0.25, &points, &radius, &velocity, &id);
    }
}

#[test]
fn names_are_escaped() {
    let frame = Frame {
        points: &[],
        columns: &[("a<b & \"c\"", Column::Id(&[]))],
    };
    let file = encode(0.0, &frame, Path::new("frame")).unwrap();
    let opened = Opened::new(&file);
    assert!(
        opened
            .header
            .contains("Name=\"a&lt;b &amp; &quot;c&quot;\"")
    );
}

/// Time and columns of a frame of one grain, and words of the error it gives.
type BadFrame<'a> = (f64, &'a [(&'a str, Column<'a>)], &'a str);

#[test]
fn a_frame_that_does_not_fit_itself_is_the_callers_fault() {
    let one: &[_] = &[[0.0; 3]];
    let bad: [BadFrame; 5] = [
        (f64::NAN, &[], "time of the frame is NaN"),
        (
            0.0,
            &[("r", Column::Scalar(&[]))],
            "'r' has 0 values for 1 grains",
        ),
        (
            0.0,
            &[("r", Column::Id(&[1, 2]))],
            "'r' has 2 values for 1 grains",
        ),
        (0.0, &[("", Column::Id(&[1]))], "cannot name a column"),
        (
            0.0,
            &[("r", Column::Id(&[1])), ("r", Column::Scalar(&[1.0]))],
            "'r' comes twice",
        ),
    ];
    for (time, columns, words) in bad {
        let frame = Frame {
            points: one,
            columns,
        };
        let error = encode(time, &frame, Path::new("frame")).unwrap_err();
        assert_eq!(error.fault(), Fault::Caller);
        assert!(error.to_string().contains(words), "{error}");
    }
}
