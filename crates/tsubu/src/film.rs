//! Snapshots for frames and the animation: kept small by thinning, drawn when the run is over and its extent known.

use crate::trouble::Trouble;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tsubu::assemble::{Machine, Simulation, Snapshot};
use tsubu::model::{Damaged, Pose, Saved, Shell, Words};
use tsubu::picture::{Animation, Camera, Image, Radii, Scene3, Segment, View};
use tsubu::record::vtp::encode;
use tsubu::record::{
    Column, Faces, Frame, FrameWriter, RunFolder, frame_name, read_array, write_whole,
};

/// Most grains kept in memory for the animation, over all its pictures.
const MOST_KEPT: usize = 12_000_000;
/// Most pictures of an animation.
const MOST_PICTURES: usize = 240;

/// Seconds shown before a wall that waits for stillness is removed.
const LEAD: f64 = 0.1;

/// One picture to come.
struct Shot {
    /// Number of the frame that shows the same moment, if frames are written.
    frame: Option<usize>,
    time: f64,
    centres: Vec<[f32; 3]>,
    speeds: Vec<f32>,
    walls: Vec<[DVec3; 2]>,
    machines: Vec<Machine>,
}

/// Collects snapshots.
pub struct Film {
    shots: Vec<Shot>,
    radius: f32,
    /// Every how many-th snapshot is kept.
    keep: usize,
    seen: usize,
}

/// The grains of a snapshot as a frame has them.
struct Columns {
    points: Vec<[f32; 3]>,
    velocity: Vec<[f32; 3]>,
    radius: Vec<f32>,
    id: Vec<u32>,
}

impl Columns {
    fn of(snapshot: &Snapshot) -> Self {
        let grains = || snapshot.grains.iter();
        Self {
            points: grains().map(|g| g.position).collect(),
            velocity: grains().map(|g| g.velocity).collect(),
            radius: grains().map(|g| g.radius).collect(),
            id: grains().map(|g| g.identity).collect(),
        }
    }

    fn named(&self) -> [(&str, Column<'_>); 3] {
        [
            ("velocity", Column::Vector(&self.velocity)),
            ("radius", Column::Scalar(&self.radius)),
            ("id", Column::Id(&self.id)),
        ]
    }
}

/// Writes the grains of one moment into a file of its own, outside the list of frames.
pub fn write_alone(path: &Path, snapshot: &Snapshot) -> Result<(), Trouble> {
    let grains = Columns::of(snapshot);
    let frame = Frame {
        points: &grains.points,
        columns: &grains.named(),
    };
    let bytes = encode(snapshot.time, &frame, path)?;
    Ok(write_whole(path, &bytes)?)
}

/// Writes a ParaView frame: the grains, and the bodies that have triangles.
pub fn write_frame(
    frames: &mut FrameWriter,
    snapshot: &Snapshot,
    machines: &[Machine],
) -> Result<(), Trouble> {
    let (mut corners, mut triangles, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
    for machine in machines {
        let Some(shell) = &machine.shell else {
            continue;
        };
        let first = corners.len() as u32;
        let place = |x: &DVec3| machine.pose.to_world(*x).as_vec3().to_array();
        corners.extend(shell.vertices.iter().map(place));
        triangles.extend(shell.triangles.iter().map(|t| t.map(|c| c + first)));
        bodies.resize(triangles.len(), machine.number as u32);
    }
    let columns = Columns::of(snapshot);
    let faces = Faces {
        points: &corners,
        triangles: &triangles,
        bodies: &bodies,
    };
    let grains = Frame {
        points: &columns.points,
        columns: &columns.named(),
    };
    Ok(frames.write_with_bodies(snapshot.time, &grains, &faces)?)
}

impl Film {
    /// Nothing yet.
    pub fn new() -> Self {
        Self {
            shots: Vec::new(),
            radius: 0.0,
            keep: 1,
            seen: 0,
        }
    }

    /// What a checkpoint holds of it: the grains of a picture are those of its frame, and without frames there are none.
    pub fn save(&self, words: &mut Words) {
        words.put_part("film");
        words.put_number(f64::from(self.radius));
        words.put_whole(self.keep as u64);
        words.put_whole(self.seen as u64);
        let known = || {
            self.shots
                .iter()
                .filter_map(|shot| Some((shot, shot.frame?)))
        };
        words.put_whole(known().count() as u64);
        for (shot, frame) in known() {
            words.put_whole(frame as u64);
            words.put_number(shot.time);
            words.put_whole(shot.walls.len() as u64);
            shot.walls
                .as_flattened()
                .iter()
                .for_each(|x| words.put_vector(*x));
            words.put_whole(shot.machines.len() as u64);
            for machine in &shot.machines {
                words.put_whole(machine.number as u64);
                machine.pose.save(words);
            }
        }
    }

    /// Takes it back, the grains from the frames. A picture whose frame is gone is left out.
    pub fn resume(
        folder: &RunFolder,
        machines: &[Machine],
        words: &mut Words,
    ) -> Result<Self, Damaged> {
        words.take_part("film")?;
        let mut film = Self {
            radius: words.take_number()? as f32,
            keep: words.take_whole()?.max(1) as usize,
            seen: words.take_whole()? as usize,
            ..Self::new()
        };
        for _ in 0..words.take_count(4)? {
            let frame = words.take_whole()? as usize;
            let time = words.take_number()?;
            let mut walls = Vec::new();
            for _ in 0..words.take_count(6)? {
                walls.push([words.take_vector()?, words.take_vector()?]);
            }
            let mut there = Vec::new();
            for _ in 0..words.take_count(22)? {
                let number = words.take_whole()? as usize;
                let mut pose = Pose::default();
                pose.restore(words)?;
                let machine = machines.iter().find(|machine| machine.number == number);
                there.extend(machine.map(|machine| Machine {
                    pose,
                    ..machine.clone()
                }));
            }
            let path = folder.path(frame_name(frame));
            let threes = |name| Some(read_array(&path, name)?.as_chunks::<3>().0.to_vec());
            let (Some(centres), Some(velocities)) = (threes("Points"), threes("velocity")) else {
                continue;
            };
            let speed = |v: &[f32; 3]| glam::Vec3::from(*v).length();
            film.shots.push(Shot {
                frame: Some(frame),
                time,
                centres,
                speeds: velocities.iter().map(speed).collect(),
                walls,
                machines: there,
            });
        }
        Ok(film)
    }

    /// Keeps a snapshot, or not, so that the whole stays within bounds and evenly spaced; `frame` is the number of the frame
    /// that shows it too.
    pub fn add(&mut self, run: &dyn Simulation, snapshot: &Snapshot, frame: Option<usize>) {
        let due = self.seen.is_multiple_of(self.keep);
        self.seen += 1;
        if !due {
            return;
        }
        self.radius = snapshot.grains.first().map_or(0.0, |g| g.radius);
        let far = DVec3::splat(1e3);
        self.shots.push(Shot {
            frame,
            time: snapshot.time,
            centres: snapshot.grains.iter().map(|g| g.position).collect(),
            speeds: snapshot
                .grains
                .iter()
                .map(|g| glam::Vec3::from(g.velocity).length())
                .collect(),
            walls: run.outlines(-far, far),
            machines: run.machines(),
        });
        if self.shots.len() > MOST_PICTURES || self.shots.len() * snapshot.grains.len() > MOST_KEPT
        {
            let mut number = 0;
            self.shots.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.keep *= 2;
        }
    }

    /// Draws the animation and a poster of the last moment; `None` if there was nothing to show.
    pub fn draw(
        &self,
        folder: &RunFolder,
        zero: Option<f64>,
    ) -> Result<Option<(PathBuf, PathBuf)>, Trouble> {
        // What comes before the wall goes is long and of no interest: a moment of it is enough.
        let from = zero.map_or(f64::NEG_INFINITY, |zero| zero - LEAD);
        let shots: Vec<&Shot> = self.shots.iter().filter(|s| s.time >= from).collect();
        if shots.iter().all(|s| s.centres.is_empty()) {
            return Ok(None);
        }
        let after: Vec<&Shot> = shots
            .iter()
            .copied()
            .filter(|s| zero.is_none_or(|zero| s.time >= zero))
            .collect();
        let (low, high) = self.extent(&after);
        let fastest = usual_top_speed(&after);
        let size = high - low;
        let width = 640usize;
        let height =
            ((width as f64 * (size.z / size.x.max(1e-12))) as usize + 90).clamp(240, 720) / 2 * 2;
        let path = folder.path("animation.gif");
        let mut animation = Animation::create(&path, width, height, Duration::from_millis(60))?;
        let mut last = None;
        for shot in shots {
            let image = self.picture(shot, low, high, fastest, (width, height), zero);
            animation.push(&image)?;
            last = Some(image);
        }
        let path = animation.finish()?;
        let poster = folder.path("figures/last.png");
        if let Some(image) = last {
            image.save_png(&poster)?;
        }
        Ok(Some((path, poster)))
    }

    fn picture(
        &self,
        shot: &Shot,
        low: DVec3,
        high: DVec3,
        fastest: f32,
        size: (usize, usize),
        zero: Option<f64>,
    ) -> Image {
        let single = |x: DVec3| x.as_vec3().to_array();
        // Walls are drawn as the lines in which they cross the picture's box.
        let clip = |x: DVec3| x.clamp(low, high);
        let mut segments: Vec<Segment> = shot
            .walls
            .iter()
            .map(|[a, b]| [clip(*a), clip(*b)])
            .filter(|[a, b]| a != b)
            .map(|[a, b]| Segment {
                from: single(a),
                to: single(b),
            })
            .collect();
        // A machine that moves is shown whole among the grains behind its axis: those before it, and the
        // walls that stand still, would hide it.
        let cut = shot.machines.iter().find(|m| m.moves && m.shell.is_some());
        let cut = cut.map(|m| (m.pose.pivot + m.pose.shift).y as f32);
        let (centres, speeds): (Vec<[f32; 3]>, Vec<f32>) = shot
            .centres
            .iter()
            .zip(&shot.speeds)
            .filter(|(centre, _)| cut.is_none_or(|y| centre[1] >= y))
            .unzip();
        let mut faces = Vec::new();
        for machine in &shot.machines {
            let Some(shell) = &machine.shell else {
                continue;
            };
            if machine.moves {
                let corner = |c: u32| single(machine.pose.to_world(shell.vertices[c as usize]));
                faces.extend(shell.triangles.iter().map(|t| t.map(corner)));
            } else {
                segments.extend(edges(shell).map(|[a, b]| Segment {
                    from: single(a),
                    to: single(b),
                }));
            }
        }
        let scene = Scene3 {
            centres: &centres,
            radii: Radii::Same(self.radius),
            values: &speeds,
            quads: &[],
            segments: &segments,
            faces: &faces,
        };
        let time = match zero {
            Some(zero) if shot.time >= zero => format!(
                "{:.2} s after {}",
                shot.time - zero,
                if cut.is_some() {
                    "the start"
                } else {
                    "release"
                }
            ),
            Some(_) => "settling".to_owned(),
            None => format!("{:.4} s", shot.time),
        };
        let view = View {
            width: size.0,
            height: size.1,
            range: (0.0, fastest),
            label: "speed (m/s)",
            time: &time,
        };
        scene.draw(&Camera::front(single(low), single(high)), &view)
    }

    /// The box that holds nearly all grains of all pictures: a stray grain does not shrink the heap.
    fn extent(&self, shots: &[&Shot]) -> (DVec3, DVec3) {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for shot in shots {
            for axis in 0..3 {
                let mut values: Vec<f32> = shot
                    .centres
                    .iter()
                    .map(|c| c[axis])
                    .filter(|v| v.is_finite())
                    .collect();
                if values.is_empty() {
                    continue;
                }
                values.sort_unstable_by(f32::total_cmp);
                let skip = values.len() / 500;
                low[axis] = low[axis].min(f64::from(values[skip]));
                high[axis] = high[axis].max(f64::from(values[values.len() - 1 - skip]));
            }
        }
        // A machine that moves is shown whole.
        let moving = shots.iter().flat_map(|s| &s.machines).filter(|m| m.moves);
        for machine in moving {
            for &x in machine.shell.iter().flat_map(|s| &s.vertices) {
                let x = machine.pose.to_world(x);
                (low, high) = (low.min(x), high.max(x));
            }
        }
        let room = DVec3::splat(1.2 * f64::from(self.radius));
        (low - room, high + room)
    }
}

/// The edges of a shell at which its faces meet at more than 30°: what a draughtsman would draw.
fn edges(shell: &Shell) -> impl Iterator<Item = [DVec3; 2]> {
    let key = |x: DVec3| x.to_array().map(f64::to_bits);
    // The ends of an edge by their bits: where they are, and the normals of the faces that meet there.
    type Meeting = ([DVec3; 2], Vec<DVec3>);
    let mut met: BTreeMap<[[u64; 3]; 2], Meeting> = BTreeMap::new();
    for t in &shell.triangles {
        let [a, b, c] = t.map(|k| shell.vertices[k as usize]);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let ends = if key(p) < key(q) { [p, q] } else { [q, p] };
            let entry = met.entry(ends.map(key)).or_insert((ends, Vec::new()));
            entry.1.push(normal);
        }
    }
    met.into_values()
        .filter(|(_, normals)| {
            let first = normals[0];
            normals.len() == 1 || normals.iter().any(|n| n.dot(first) < 0.866)
        })
        .map(|(ends, _)| ends)
}

/// 98 % of grains are slower than this in the fastest picture.
fn usual_top_speed(shots: &[&Shot]) -> f32 {
    let top = |shot: &&Shot| {
        let mut speeds: Vec<f32> = shot
            .speeds
            .iter()
            .copied()
            .filter(|v| v.is_finite())
            .collect();
        speeds.sort_unstable_by(f32::total_cmp);
        speeds.get(speeds.len() * 98 / 100).copied().unwrap_or(0.0)
    };
    shots.iter().map(top).fold(0.0, f32::max).max(1e-6)
}
