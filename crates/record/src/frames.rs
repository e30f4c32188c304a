//! The frames of a run and the list by which ParaView opens them all, `frames.pvd`.

use std::fmt::Write as _;
use std::fs;
use std::io::ErrorKind;

use crate::faces::{Faces, encode_faces};
use crate::vtp::{Frame, encode};
use crate::{RecordError, RunFolder, write_whole};

const HEAD: &str = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
const LIST: &str = "frames.pvd";
/// How the line of a frame's grains differs from that of its bodies.
const GRAINS_PART: &str = " part=\"0\" ";
const TAIL: &str = "</Collection>\n</VTKFile>\n";

/// The path of the grains of a frame in the folder of a run.
pub fn frame_name(number: usize) -> String {
    format!("frames/frame_{number:06}.vtp")
}

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

    /// Takes up the list of a run that was stopped, after its first `count` frames; those after them are removed.
    ///
    /// # Errors
    /// When the list is not there, or names fewer frames.
    pub fn resume(folder: &RunFolder, count: usize) -> Result<Self, RecordError> {
        let mut frames = Self::new(folder)?;
        let path = folder.path(LIST);
        let cannot = |e| RecordError::machine("it could not be read", &path, e);
        let text = if count == 0 && !path.exists() {
            String::new()
        } else {
            fs::read_to_string(&path).map_err(cannot)?
        };
        let inside = text.strip_prefix(HEAD).unwrap_or_default();
        for line in inside.lines().filter(|line| line.starts_with("<DataSet ")) {
            frames.count += usize::from(line.contains(GRAINS_PART));
            if frames.count > count {
                break;
            }
            frames.lines.push_str(line);
            frames.lines.push('\n');
        }
        if frames.count < count {
            let what = format!(
                "it names {} frames, and the checkpoint was written after {count}",
                frames.count
            );
            let remedy = "Put the frames of this run back, or run the scene again.";
            return Err(RecordError::arguments(what, &path, remedy));
        }
        frames.count = count;
        frames.remove_later(count)?;
        let list = format!("{HEAD}{}{TAIL}", frames.lines);
        write_whole(&path, list.as_bytes())?;
        Ok(frames)
    }

    /// Removes the files of frames from this number on.
    fn remove_later(&self, count: usize) -> Result<(), RecordError> {
        let path = self.folder.path("frames");
        let cannot = |e| RecordError::machine("old frames could not be removed", &path, e);
        for entry in fs::read_dir(&path).map_err(cannot)? {
            let entry = entry.map_err(cannot)?;
            let name = entry.file_name();
            let number = name.to_str().and_then(|name| {
                let (kind, rest) = name.split_once('_')?;
                let ours = kind == "frame" || kind == "bodies";
                rest.strip_suffix(".vtp")?
                    .parse::<usize>()
                    .ok()
                    .filter(|_| ours)
            });
            if number.is_some_and(|number| number >= count) {
                fs::remove_file(entry.path()).map_err(cannot)?;
            }
        }
        Ok(())
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
        let name = frame_name(number);
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
        write_whole(&self.folder.path(LIST), list.as_bytes())
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

    /// Killed after six frames, taken up after the fourth: as if the last two had never been, and the numbers come back.
    #[test]
    fn a_list_goes_on_from_a_checkpoint() {
        let scratch = Scratch::new();
        let folder = scratch.run_folder();
        let write = |frames: &mut FrameWriter, k: usize| {
            let (points, radius) = (grains(k + 1), vec![0.1 * k as f32; k + 1]);
            let columns = [("radius", Column::Scalar(&radius))];
            let frame = Frame {
                points: &points,
                columns: &columns,
            };
            let corners = grains(3);
            let faces = Faces {
                points: &corners,
                triangles: &[[0, 1, 2]],
                bodies: &[7],
            };
            frames
                .write_with_bodies(0.1 * k as f64, &frame, &faces)
                .unwrap();
        };
        let mut frames = FrameWriter::new(&folder).unwrap();
        (0..6).for_each(|k| write(&mut frames, k));
        let whole = fs::read_to_string(folder.path(LIST)).unwrap();
        let mut frames = FrameWriter::resume(&folder, 4).unwrap();
        assert_eq!((frames.count(), listed(&folder).len()), (4, 8));
        assert_eq!(names(&folder.path("frames")).len(), 8);
        (4..6).for_each(|k| write(&mut frames, k));
        assert_eq!(fs::read_to_string(folder.path(LIST)).unwrap(), whole);
        let error = FrameWriter::resume(&folder, 7).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert!(error.to_string().contains("6 frames"), "{error}");
        let path = folder.path(frame_name(3));
        let points = crate::read_array(&path, "Points").unwrap();
        assert_eq!(points.as_chunks::<3>().0, grains(4));
        assert_eq!(
            crate::read_array(&path, "radius").unwrap(),
            vec![0.1 * 3f32; 4]
        );
        assert!(crate::read_array(&path, "id").is_none());
        let mut bytes = fs::read(&path).unwrap();
        for at in (0..bytes.len()).rev() {
            bytes.truncate(at);
            fs::write(&path, &bytes).unwrap();
            // Whatever is left, an answer.
            crate::read_array(&path, "Points");
        }
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
