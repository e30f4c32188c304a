//! The frames of a run and the list by which ParaView opens them all, `frames.pvd`.

use std::fmt::Write as _;
use std::fs;
use std::io::ErrorKind;

use crate::faces::{Faces, encode_faces};
use crate::vtp::{Frame, encode};
use crate::{RecordError, RunFolder, write_whole};

const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
const TAIL: &str = "</Collection>\n</VTKFile>\n";

/// Writes `frames/frame_000000.vtp`, `…01.vtp`, … and after each one the list of them all.
///
/// The list names a frame only when that frame is on the disk whole,
/// so a running or killed case opens in ParaView at any moment.
#[derive(Debug)]
pub struct FrameWriter {
    folder: RunFolder,
    /// The lines of `frames.pvd`, one per frame, kept because the list is always written whole.
    lines: String,
    count: usize,
}

impl FrameWriter {
    /// Makes the folder `frames` in the folder of a run.
    pub fn new(folder: &RunFolder) -> Result<Self, RecordError> {
        let path = folder.path("frames");
        match fs::create_dir(&path) {
            Ok(()) => {}
            Err(e) if e.kind() == ErrorKind::AlreadyExists && path.is_dir() => {}
            Err(e) => {
                return Err(RecordError::machine(
                    "the folder of the frames could not be made",
                    &path,
                    e,
                ));
            }
        }
        Ok(Self {
            folder: folder.clone(),
            lines: String::new(),
            count: 0,
        })
    }

    /// Writes the frame at `time` (s), then the list with it.
    ///
    /// After an error the frame does not count: the list is as it was, and the next frame takes the same number.
    pub fn write(&mut self, time: f64, frame: &Frame) -> Result<(), RecordError> {
        self.write_with_bodies(time, frame, &Faces::default())
    }

    /// The same with the bodies of that moment as a second part, if there are any triangles.
    pub fn write_with_bodies(
        &mut self,
        time: f64,
        frame: &Frame,
        faces: &Faces,
    ) -> Result<(), RecordError> {
        let before = self.lines.len();
        let written = self.write_parts(time, frame, faces);
        if written.is_err() {
            self.lines.truncate(before);
        } else {
            self.count += 1;
        }
        written
    }

    fn write_parts(&mut self, time: f64, frame: &Frame, faces: &Faces) -> Result<(), RecordError> {
        let number = self.count;
        let name = format!("frames/frame_{number:06}.vtp");
        let path = self.folder.path(&name);
        write_whole(&path, &encode(time, frame, &path)?)?;
        self.list(time, 0, &name);
        if !faces.triangles.is_empty() {
            let name = format!("frames/bodies_{number:06}.vtp");
            let path = self.folder.path(&name);
            write_whole(&path, &encode_faces(time, faces, &path)?)?;
            self.list(time, 1, &name);
        }
        let list = format!("{HEAD}{}{TAIL}", self.lines);
        write_whole(&self.folder.path("frames.pvd"), list.as_bytes())
    }

    fn list(&mut self, time: f64, part: u32, name: &str) {
        // Writing to a String does not fail.
        writeln!(
            self.lines,
            "<DataSet timestep=\"{time:?}\" group=\"\" part=\"{part}\" file=\"{name}\"/>"
        )
        .ok();
    }

    /// How many frames are written and listed.
    pub fn count(&self) -> usize {
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Fault;
    use crate::scratch::{Scratch, names};
    use crate::vtp::Column;
    use crate::vtp::tests::Opened;

    /// The times and files of a list, taken apart line by line.
    fn listed(folder: &RunFolder) -> Vec<(f64, String)> {
        let text = fs::read_to_string(folder.path("frames.pvd")).unwrap();
        let inside = text.strip_prefix(HEAD).unwrap().strip_suffix(TAIL).unwrap();
        let value = |line: &str, key: &str| {
            let rest = line.split(&format!(" {key}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().to_string()
        };
        let entry = |line: &str| {
            assert!(
                line.starts_with("<DataSet ") && line.ends_with("/>"),
                "{line}"
            );
            (
                value(line, "timestep").parse().unwrap(),
                value(line, "file"),
            )
        };
        inside.lines().map(entry).collect()
    }

    fn grains(n: usize) -> Vec<[f32; 3]> {
        (0..n).map(|i| [i as f32, 0.5, -1.0]).collect()
    }

    #[test]
    fn the_list_names_every_frame_after_each_write() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let mut frames = FrameWriter::new(&folder).unwrap();
        for k in 0..5usize {
            let (points, radius) = (grains(k), vec![0.1; k]);
            let columns = [("radius", Column::Scalar(&radius))];
            let frame = Frame {
                points: &points,
                columns: &columns,
            };
            frames.write(0.1 * k as f64, &frame).unwrap();

            let list = listed(&folder);
            assert_eq!(list.len(), k + 1);
            for (i, (time, file)) in list.iter().enumerate() {
                assert_eq!(*file, format!("frames/frame_{i:06}.vtp"));
                let bytes = fs::read(folder.path(file)).unwrap();
                let opened = Opened::new(&bytes);
                assert_eq!(opened.time().to_bits(), time.to_bits());
                assert_eq!(opened.attribute("<Piece", "NumberOfPoints"), i.to_string());
            }
        }
        assert_eq!(frames.count(), 5);
        assert_eq!(names(&folder.path("frames")).len(), 5);
    }

    #[test]
    fn a_bad_frame_changes_nothing() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let mut frames = FrameWriter::new(&folder).unwrap();
        let bad = Frame {
            points: &[],
            columns: &[("id", Column::Id(&[1]))],
        };
        assert_eq!(frames.write(0.0, &bad).unwrap_err().fault(), Fault::Caller);
        assert!(names(&folder.path("frames")).is_empty());
        assert!(!folder.path("frames.pvd").exists());
    }

    /// The disk is full first for the frame, then for the list; both times the old list stays, and writing goes on.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_keeps_the_list_as_it_was() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let mut frames = FrameWriter::new(&folder).unwrap();
        let points = grains(3);
        let frame = Frame {
            points: &points,
            columns: &[],
        };
        frames.write(0.0, &frame).unwrap();
        for part in [
            "frames/.frame_000001.vtp.tsubu-part",
            ".frames.pvd.tsubu-part",
        ] {
            std::os::unix::fs::symlink("/dev/full", folder.path(part)).unwrap();
            let error = frames.write(1.0, &frame).unwrap_err();
            assert!(error.remedy().contains("Free some space"), "{error}");
            assert_eq!(listed(&folder), [(0.0, "frames/frame_000000.vtp".into())]);
        }
        frames.write(2.0, &frame).unwrap();
        assert_eq!(listed(&folder)[1], (2.0, "frames/frame_000001.vtp".into()));
    }

    #[test]
    fn a_file_in_the_way_is_an_error() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        fs::write(folder.path("frames"), "x").unwrap();
        assert_eq!(
            FrameWriter::new(&folder).unwrap_err().fault(),
            Fault::Machine
        );
    }
}
