//! The doctor: what a mesh is like, what was repaired, and what can be made of it.

use super::edges::Edges;
use super::shells::{EdgeReport, ShellReport, is_clean, shells};
use super::{Mesh, MeshError, Welded, double_area};
use crate::tree::Tree;
use crate::winding::Winding;
use glam::DVec3;

/// Places on the surface that are looked at from both sides.
const SAMPLES: usize = 2000;
/// A machine larger than this, in m, was read in the wrong unit more likely than not.
const LARGEST: f64 = 100.0;
/// A machine smaller than this, in m, likewise.
const SMALLEST: f64 = 1e-3;
/// Cells across the thinnest part.
const CELLS_ACROSS: f64 = 4.0;
/// Cells of margin counted for the memory of a grid.
const MARGIN: f64 = 8.0;

/// What can be made of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Closed, oriented, no overlap: distances and their signs are exact.
    Clean,
    /// Clean after welding and turning faces, which every surface made of the mesh does by itself.
    Repaired,
    /// Holes, overlaps or faces that disagree, but inside and outside can be told by winding numbers.
    Winding,
    /// No inside: usable as a wall, with a thickness.
    OpenSheet,
    /// Nothing to make a surface of.
    Refuse,
}

/// The doctor's report of one mesh; printed, it is a page to read.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Vertices before welding.
    pub vertices: usize,
    /// Triangles before welding.
    pub triangles: usize,
    /// Parts in the file.
    pub parts: usize,
    /// What welding within a millionth of the diagonal and orienting repaired; all below is after it.
    pub repaired: Welded,
    /// The connected pieces.
    pub shells: Vec<ShellReport>,
    /// What is wrong at edges.
    pub edges: EdgeReport,
    /// Lowest and highest corner in m.
    pub bounds: [DVec3; 2],
    /// Area in m².
    pub area: f64,
    /// Signed volume in m³ of all closed pieces.
    pub volume: f64,
    /// Share of the surface, 0 to 1, where one side is inside and the other outside by winding numbers.
    pub decided: f64,
    /// Thickness in m that 2 % of the area falls below, measured inward from the surface; `None` without an inside.
    pub thinnest: Option<f64>,
    /// What can be made of it.
    pub verdict: Verdict,
    /// Why it is refused.
    pub refused: Option<MeshError>,
}

/// A grid cell that suits a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellAdvice {
    /// Edge of a cell in m: a quarter of the thinnest part.
    pub cell: f64,
    /// Error of the distance in m that is to be expected at sharp edges, about half a cell.
    pub error_at_edges: f64,
    /// Memory of the grid in bytes, with a margin of 8 cells around.
    pub bytes: f64,
}

impl Report {
    /// Examines a mesh; never fails, a mesh that cannot be used is reported as such.
    pub fn of(mesh: &Mesh) -> Self {
        let mut report = Self {
            vertices: mesh.vertices.len(),
            triangles: mesh.triangles.len(),
            parts: mesh.parts.len(),
            repaired: Welded::default(),
            shells: Vec::new(),
            edges: EdgeReport::default(),
            bounds: [DVec3::ZERO; 2],
            area: 0.0,
            volume: 0.0,
            decided: 0.0,
            thinnest: None,
            verdict: Verdict::Refuse,
            refused: mesh.check().err(),
        };
        if report.refused.is_some() {
            return report;
        }
        let (mesh, repaired) = mesh.repaired();
        report.repaired = repaired;
        // All faces may have been needles.
        let Some(tree) = Tree::new(&mesh) else {
            report.refused = Some(MeshError::NoArea);
            return report;
        };
        (report.shells, report.edges) = shells(&mesh);
        report.bounds = mesh.bounds();
        report.area = mesh.area();
        report.volume = report
            .shells
            .iter()
            .filter(|s| s.closed)
            .map(|s| s.volume)
            .sum();
        let looked = Looked::at(&mesh, &tree);
        report.decided = looked.decided;
        report.thinnest = looked.thinnest;
        report.verdict = if is_clean(&report.shells, &report.edges) {
            if repaired.is_nothing() {
                Verdict::Clean
            } else {
                Verdict::Repaired
            }
        } else if looked.decided >= 0.9 {
            Verdict::Winding
        } else {
            Verdict::OpenSheet
        };
        report
    }

    /// The sides of the box in m.
    pub fn size(&self) -> DVec3 {
        self.bounds[1] - self.bounds[0]
    }

    /// A remark if the box is over 100 m or under 1 mm: which unit would make it a likely machine.
    ///
    /// The units are tried on the numbers as if they had been read as metres, and as millimetres.
    pub fn unit_doubt(&self) -> Option<String> {
        let size = self.size().max_element();
        if self.refused.is_some() || (SMALLEST..=LARGEST).contains(&size) {
            return None;
        }
        let units = [("mm", 1e-3), ("cm", 1e-2), ("inch", 0.0254), ("m", 1.0)];
        // Too small: the numbers were metres and have been taken for mm.
        let (number, read) = if size > LARGEST {
            (size, "m")
        } else {
            (size * 1e3, "mm")
        };
        let likely: Vec<String> = units
            .iter()
            .filter(|(name, metres)| *name != read && (0.01..=30.0).contains(&(number * metres)))
            .map(|(name, metres)| format!("{} m if its numbers are {name}", short(number * metres)))
            .collect();
        let which = if size > LARGEST {
            "over 100 m"
        } else {
            "under 1 mm"
        };
        let rather = if likely.is_empty() {
            "check the length unit".into()
        } else {
            format!(
                "if the file was read as {read}, it is rather {}",
                likely.join(", or ")
            )
        };
        Some(format!(
            "the largest side is {} m, {which}: {rather}",
            short(size)
        ))
    }

    /// The grid cell to start from: a quarter of the thinnest part, so that both its faces and its
    /// middle are seen. `None` for a mesh without an inside, whose cell follows from the thickness given.
    pub fn cell_advice(&self) -> Option<CellAdvice> {
        let cell = self.thinnest? / CELLS_ACROSS;
        let nodes = self.size() / cell + DVec3::splat(2.0 * MARGIN + 1.0);
        Some(CellAdvice {
            cell,
            error_at_edges: 0.5 * cell,
            bytes: 4.0 * nodes.x * nodes.y * nodes.z,
        })
    }
}

/// What is seen from both sides of points spread evenly over the area.
struct Looked {
    decided: f64,
    thinnest: Option<f64>,
}

impl Looked {
    fn at(mesh: &Mesh, tree: &Tree) -> Self {
        let balanced = Edges::of(mesh).balanced();
        let winding = Winding::new(mesh);
        let area = mesh.area();
        // Off the surface by a little, so that a ray does not meet the face that it starts from.
        let off = 1e-6 * mesh.diagonal();
        let (mut decided, mut thickness) = (0usize, Vec::new());
        let (mut t, mut passed) = (0, 0.0);
        for k in 0..SAMPLES {
            let wanted = (k as f64 + 0.5) / SAMPLES as f64 * area;
            let mut here = 0.5 * double_area(mesh.corners(t)).length();
            while passed + here < wanted && t + 1 < mesh.triangles.len() {
                passed += here;
                t += 1;
                here = 0.5 * double_area(mesh.corners(t)).length();
            }
            let corners = mesh.corners(t);
            let x = spread(corners, k);
            let normal = double_area(corners).normalize_or_zero();
            let (front, back) = (winding.at(x + normal * off), winding.at(x - normal * off));
            let (least, most) = (front.abs().min(back.abs()), front.abs().max(back.abs()));
            // A whole winding number needs no margin; beside a hole it must be well away from ½.
            let clear = if balanced {
                least < 0.5 && most > 0.5
            } else {
                least < 0.25 && most > 0.75
            };
            // Where two shells overlap, a face inside the other has an inside on both sides: it decides nothing against.
            if clear || least > 0.75 {
                decided += 1;
            }
            if clear {
                let inward = if back.abs() > front.abs() {
                    -normal
                } else {
                    normal
                };
                if let Some(far) = tree.ray(x + inward * off, inward) {
                    thickness.push(far + off);
                }
            }
        }
        thickness.sort_unstable_by(f64::total_cmp);
        Self {
            decided: decided as f64 / SAMPLES as f64,
            thinnest: thickness.get(thickness.len() / 50).copied(),
        }
    }
}

/// A point of the triangle; successive k spread over it.
fn spread([a, b, c]: [DVec3; 3], k: usize) -> DVec3 {
    // Multiples of irrational numbers leave no gaps and no clusters.
    let (mut s, mut t) = (
        (k as f64 * 0.754_877_666_246_692_8).fract(),
        (k as f64 * 0.569_840_290_998_053_3).fract(),
    );
    if s + t > 1.0 {
        (s, t) = (1.0 - s, 1.0 - t);
    }
    a + (b - a) * s + (c - a) * t
}

/// A number with three digits.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let digits = 2 - x.abs().log10().floor() as i32;
    if (-1..=6).contains(&digits) {
        format!("{x:.*}", digits.max(0) as usize)
    } else {
        format!("{x:.2e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::samples;

    #[test]
    fn a_clean_body_is_called_clean_and_measured() {
        let report = Report::of(&samples::cuboid(DVec3::new(0.2, 0.1, 0.006), 6));
        assert_eq!(report.verdict, Verdict::Clean);
        assert_eq!(report.shells.len(), 1);
        assert!((report.volume - 1.2e-4).abs() < 1e-12);
        let thin = report.thinnest.unwrap();
        assert!((thin - 0.006).abs() < 1e-6, "{thin}");
        let advice = report.cell_advice().unwrap();
        assert!((advice.cell - 0.0015).abs() < 1e-6);
        assert_eq!(report.unit_doubt(), None);
        assert!(report.to_string().contains("clean"), "{report}");
    }

    #[test]
    fn faults_are_counted_and_named() {
        let mut soup = samples::ball(0.1, 20);
        soup.triangles.remove(400);
        soup.triangles.remove(30);
        let report = Report::of(&soup);
        assert_eq!(report.verdict, Verdict::Winding);
        assert_eq!((report.edges.open, report.edges.loops), (6, 2));

        let mut inside_out = samples::torus(0.1, 0.03, 30);
        inside_out.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        let report = Report::of(&inside_out);
        assert_eq!(report.verdict, Verdict::Repaired);
        assert_eq!(report.repaired.turned, inside_out.triangles.len());

        let sheet = samples::sheet(5, 5, |i, j| DVec3::new(i as f64, j as f64, 0.0));
        let report = Report::of(&sheet);
        assert_eq!(report.verdict, Verdict::OpenSheet);
        assert!(report.to_string().contains("thickness"), "{report}");

        // Every face twice, seen from both sides: there is no inside.
        let mut doubled = samples::cuboid(DVec3::ONE, 3);
        let back: Vec<_> = doubled
            .triangles
            .iter()
            .map(|&[a, b, c]| [a, c, b])
            .collect();
        doubled.triangles.extend(back);
        assert_eq!(Report::of(&doubled).verdict, Verdict::OpenSheet);

        let report = Report::of(&Mesh::default());
        assert_eq!(report.verdict, Verdict::Refuse);
        assert!(report.to_string().contains("no facet"), "{report}");
    }

    #[test]
    fn overlapping_shells_are_usable_through_winding_numbers() {
        let mut two = samples::cuboid(DVec3::splat(0.2), 4);
        samples::append(
            &mut two,
            &samples::moved(samples::cuboid(DVec3::splat(0.2), 4), DVec3::splat(0.07)),
        );
        let report = Report::of(&two);
        assert_eq!(report.verdict, Verdict::Winding);
        assert_eq!(report.shells.len(), 2);
        assert!(report.shells.iter().all(|s| s.closed && !s.inside_out()));
    }

    #[test]
    fn a_wrong_unit_is_noticed() {
        let as_metres = Report::of(&samples::cuboid(DVec3::new(675.0, 205.0, 205.0), 2));
        let doubt = as_metres.unit_doubt().unwrap();
        assert!(doubt.contains("0.675 m if its numbers are mm"), "{doubt}");
        let as_mm = Report::of(&samples::cuboid(DVec3::splat(2e-4), 2));
        assert!(
            as_mm
                .unit_doubt()
                .unwrap()
                .contains("0.200 m if its numbers are m")
        );
    }
}
