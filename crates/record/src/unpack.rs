//! Numbers back out of a frame file of ours: for an animation that goes on after the run was stopped.

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::ZlibDecoder;

const MARK: &[u8] = b"<AppendedData encoding=\"raw\">\n_";

/// The single-precision numbers of an array of a frame, such as `Points`; `None` if the file is not there or is not as
/// [`FrameWriter`](crate::FrameWriter) writes it.
pub fn read_array(path: &Path, name: &str) -> Option<Vec<f32>> {
    array_in(&fs::read(path).ok()?, name)
}

/// The same of the bytes of a file.
pub fn array_in(file: &[u8], name: &str) -> Option<Vec<f32>> {
    let at = file.windows(MARK.len()).position(|w| w == MARK)?;
    let (header, data) = (
        std::str::from_utf8(&file[..at]).ok()?,
        &file[at + MARK.len()..],
    );
    let quoted = format!("Name=\"{name}\"");
    let line = header.lines().find(|line| line.contains(&quoted))?;
    if !line.contains("type=\"Float32\"") {
        return None;
    }
    let offset = line.split("offset=\"").nth(1)?.split('"').next()?;
    unpack(data, offset.parse().ok()?)
}

/// The array at an offset: the number of its blocks, their sizes, and the blocks.
fn unpack(data: &[u8], offset: usize) -> Option<Vec<f32>> {
    let word = |at: usize| -> Option<usize> {
        let eight = data
            .get(offset.checked_add(8 * at)?..)?
            .first_chunk::<8>()?;
        usize::try_from(u64::from_le_bytes(*eight)).ok()
    };
    let (blocks, size) = (word(0)?, word(1)?);
    let mut at = offset
        .checked_add(24)?
        .checked_add(blocks.checked_mul(8)?)?;
    let mut bytes = Vec::new();
    for block in 0..blocks {
        let end = at.checked_add(word(3 + block)?)?;
        // No block unpacks to more than its header says, whatever is in it.
        ZlibDecoder::new(data.get(at..end)?)
            .take(size as u64)
            .read_to_end(&mut bytes)
            .ok()?;
        at = end;
    }
    let numbers = bytes.chunks_exact(4);
    Some(
        numbers
            .map(|four| f32::from_le_bytes([four[0], four[1], four[2], four[3]]))
            .collect(),
    )
}
