//! Turning faces so that neighbours agree and closed bodies face outward.

use super::edges::{Edges, Groups, Side};
use super::{Mesh, volume_of};
use crate::triangle::SolidAngle;
use crate::winding::Winding;
use glam::DVec3;
use std::f64::consts::PI;

/// Corners of a piece at which it is asked whether they lie inside the rest.
const ASKED: usize = 16;

impl Mesh {
    /// Makes faces that share an edge agree on the outside, within each piece by the majority of its
    /// area; then turns a closed mesh if its signed volume is negative, and after that each piece that
    /// still faces inward without lying inside the rest. Returns how many faces turned.
    ///
    /// Only edges of exactly two faces carry the agreement. A piece that cannot agree (a Möbius strip)
    /// stays as it was. A piece inside the rest that faces inward is a cavity and stays.
    pub fn orient(&mut self) -> usize {
        let before = self.triangles.clone();
        let edges = Edges::of(self);
        if !edges.balanced() {
            self.agree(&edges);
        }
        let edges = Edges::of(self);
        if edges.balanced() {
            if self.volume() < 0.0 {
                self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
            }
            self.turn_pieces(&edges);
        }
        let same = |(a, b): &(&[u32; 3], &[u32; 3])| a != b;
        before.iter().zip(&self.triangles).filter(same).count()
    }

    /// Turns pieces that face inward and are no cavities. The mesh is closed.
    fn turn_pieces(&mut self, edges: &Edges) {
        let mut groups = Groups::new(self.triangles.len());
        for sides in edges.each() {
            for pair in sides.windows(2) {
                groups.join(pair[0].triangle, pair[1].triangle);
            }
        }
        let mut pieces: std::collections::BTreeMap<u32, Vec<usize>> = Default::default();
        for (t, name) in groups.names().into_iter().enumerate() {
            pieces.entry(name).or_default().push(t);
        }
        if pieces.len() < 2 {
            return;
        }
        let winding = Winding::with_accuracy(self, 2.0);
        let mut turn: Vec<usize> = Vec::new();
        for piece in pieces.values() {
            let origin = self.vertices[self.triangles[piece[0]][0] as usize];
            let volume: f64 = piece
                .iter()
                .map(|&t| volume_of(self.corners(t), origin))
                .sum();
            let step = piece.len().div_ceil(ASKED);
            let free = |t: &usize| {
                self.winding_of_rest(&winding, piece, self.corners(*t)[0])
                    .abs()
                    < 0.5
            };
            if volume < 0.0 && piece.iter().step_by(step).any(free) {
                turn.extend(piece);
            }
        }
        for t in turn {
            self.triangles[t].swap(1, 2);
        }
    }

    /// The winding number of all triangles but these.
    fn winding_of_rest(&self, all: &Winding, piece: &[usize], x: DVec3) -> f64 {
        let mut own = SolidAngle::none();
        piece.iter().for_each(|&t| own.add(self.corners(t), x));
        all.at(x) - own.total() / (4.0 * PI)
    }

    fn agree(&mut self, edges: &Edges) {
        let count = self.triangles.len();
        let mut neighbours: Vec<[Option<(u32, bool)>; 3]> = vec![[None; 3]; count];
        for sides in edges.each() {
            if let [a, b] = *sides {
                link(&mut neighbours, a, b);
                link(&mut neighbours, b, a);
            }
        }
        let area = |t: usize| super::double_area(self.corners(t)).length();
        let areas: Vec<f64> = (0..count).map(area).collect();
        // For each face: unknown, or whether it must turn to agree with the first of its piece.
        let mut turn: Vec<Option<bool>> = vec![None; count];
        for start in 0..count {
            if turn[start].is_some() {
                continue;
            }
            turn[start] = Some(false);
            let (mut piece, mut next, mut agrees) = (vec![start], 0, true);
            while next < piece.len() {
                let t = piece[next];
                next += 1;
                let mine = turn[t] == Some(true);
                for (other, same_way) in neighbours[t].into_iter().flatten() {
                    let wanted = mine ^ same_way;
                    match turn[other as usize] {
                        None => {
                            turn[other as usize] = Some(wanted);
                            piece.push(other as usize);
                        }
                        Some(is) => agrees &= is == wanted,
                    }
                }
            }
            let turned: f64 = piece
                .iter()
                .filter(|&&t| turn[t] == Some(true))
                .map(|&t| areas[t])
                .sum();
            let all: f64 = piece.iter().map(|&t| areas[t]).sum();
            // The majority is right.
            let opposite = 2.0 * turned > all;
            for &t in &piece {
                if agrees && (turn[t] == Some(true)) != opposite {
                    self.triangles[t].swap(1, 2);
                }
            }
        }
    }
}

fn link(neighbours: &mut [[Option<(u32, bool)>; 3]], from: Side, to: Side) {
    let slots = &mut neighbours[from.triangle as usize];
    if let Some(free) = slots.iter_mut().find(|s| s.is_none()) {
        *free = Some((to.triangle, from.forward == to.forward));
    }
}

#[cfg(test)]
mod tests {
    use crate::mesh::samples;
    use glam::DVec3;

    #[test]
    fn turned_faces_turn_back() {
        let ball = samples::ball(1.0, 16);
        let mut mesh = ball.clone();
        for t in (0..mesh.triangles.len()).step_by(9) {
            mesh.triangles[t].swap(1, 2);
        }
        let turned = mesh.triangles.len().div_ceil(9);
        assert_eq!(mesh.orient(), turned);
        assert_eq!(mesh, ball);
    }

    #[test]
    fn an_inside_out_body_turns_and_a_cavity_stays() {
        let mut mesh = samples::cuboid(DVec3::ONE, 2);
        let volume = mesh.volume();
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        assert_eq!(mesh.orient(), mesh.triangles.len());
        assert!((mesh.volume() - volume).abs() < 1e-12);
        let mut hollow = samples::cuboid(DVec3::ONE, 2);
        let mut cavity = samples::cuboid(DVec3::splat(0.5), 2);
        cavity.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        samples::append(&mut hollow, &cavity);
        assert_eq!(hollow.orient(), 0);
        assert!((hollow.volume() - 0.875).abs() < 1e-12);
    }

    #[test]
    fn overlapping_pieces_are_turned_singly() {
        let mut two = samples::torus(1.0, 0.3, 30);
        let mut rod = samples::cuboid(glam::DVec3::new(4.0, 0.1, 0.1), 20);
        let volume = two.volume() + rod.volume();
        rod.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        samples::append(&mut two, &rod);
        assert_eq!(two.orient(), rod.triangles.len());
        assert!((two.volume() - volume).abs() < 1e-12);
    }

    #[test]
    fn a_moebius_strip_stays_as_it_is() {
        let mut strip = samples::moebius(30);
        let before = strip.clone();
        assert_eq!(strip.orient(), 0);
        assert_eq!(strip, before);
    }
}
