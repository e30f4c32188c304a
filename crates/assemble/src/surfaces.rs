//! From the shape of a wall to its surface: analytic shapes, meshes as grids of distances, as triangles or filled with grains.

use crate::build::Choices;
use std::path::Path;
use std::sync::Arc;
use tsubu_engine::Layout;
use tsubu_model::{Dim, Plane, Space, Surface};
use tsubu_scene::{Checked, MeshFile, MeshSurface, SceneError, Shape, Thin};
use tsubu_sdf as sdf;
use tsubu_sdf::mesh::{Mesh, Report, Verdict};
use tsubu_sdf::{
    DistanceGrid, ExactMesh, GrainBody, GrainBodyError, GrainBodyOptions, GridOptions,
};

/// Most bytes that one grid of distances or one body of grains may take.
const MOST_BYTES: u64 = 2 << 30;
/// Up to which distance a surface must know itself, in grain diameters: a grain is noted as near
/// within its reach, the skin and what a body moves meanwhile.
const BAND: f64 = 1.35;
/// The largest wall grain over a grain: of larger ones a layer leaves holes that a grain slips through.
const LARGEST_WALL_GRAIN: f64 = 2.0;

/// A surface, and what is to be said of it.
pub(crate) struct Made<D: Dim> {
    pub surface: Arc<dyn Surface<D>>,
    /// Number of wall grains of a body built of grains.
    pub wall_grains: Option<usize>,
}

impl<D: Dim> From<Arc<dyn Surface<D>>> for Made<D> {
    fn from(surface: Arc<dyn Surface<D>>) -> Self {
        Self {
            surface,
            wall_grains: None,
        }
    }
}

/// What building a surface needs to know beside its shape.
pub(crate) struct Shapes<'a> {
    pub checked: &'a Checked,
    pub choices: &'a Choices,
    /// Diameter of a (coarse) grain, m.
    pub diameter: f64,
}

/// A dimension with the shapes that it knows.
pub(crate) trait Shaped: Layout {
    /// The surface of a wall.
    fn surface(shapes: &Shapes, wall: usize) -> Result<Made<Self>, SceneError>;
}

impl Shaped for Plane {
    fn surface(shapes: &Shapes, wall: usize) -> Result<Made<Self>, SceneError> {
        let made = shapes.in_any_dimension(wall).unwrap_or_else(|| {
            let what = "this shape has no form in the plane";
            Err(shapes.trouble(wall, "shape", what, "write space: Space"))
        });
        made.map(Made::from)
    }
}

impl Shaped for Space {
    fn surface(shapes: &Shapes, wall: usize) -> Result<Made<Self>, SceneError> {
        if let Some(made) = shapes.in_any_dimension(wall) {
            return made.map(Made::from);
        }
        if let Shape::Mesh {
            mesh,
            surface: MeshSurface::Grains { radius, thin },
            thickness,
        } = &shapes.checked.scene.walls[wall].shape
        {
            let body = shapes.of_grains(wall, mesh, *radius, *thin, *thickness)?;
            return Ok(Made {
                wall_grains: Some(body.count()),
                surface: Arc::new(body),
            });
        }
        shapes.in_space(wall).map(Made::from)
    }
}

impl Shapes<'_> {
    fn trouble(
        &self,
        wall: usize,
        field: &str,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> SceneError {
        self.checked.problem(
            &format!("walls[{wall}].{field}"),
            what.into(),
            remedy.into(),
        )
    }

    fn misshapen<S>(&self, wall: usize, made: Result<S, sdf::Misshapen>) -> Result<S, SceneError> {
        made.map_err(|e| self.trouble(wall, "shape", e.to_string(), "change the shape"))
    }

    /// The shapes that plane and space share.
    fn in_any_dimension<D: Dim>(
        &self,
        wall: usize,
    ) -> Option<Result<Arc<dyn Surface<D>>, SceneError>> {
        let at = D::from_space;
        Some(match &self.checked.scene.walls[wall].shape {
            Shape::HalfSpace { point, outward } => {
                Ok(Arc::new(sdf::HalfSpace::<D>::new(at(*point), at(*outward))))
            }
            Shape::Ball { centre, radius } => self
                .misshapen(wall, sdf::Ball::<D>::new(at(*centre), *radius))
                .map(|s| Arc::new(s) as _),
            Shape::Cuboid { min, max } => self
                .misshapen(wall, sdf::Cuboid::<D>::new(at(*min), at(*max)))
                .map(|s| Arc::new(s) as _),
            _ => return None,
        })
    }

    fn in_space(&self, wall: usize) -> Result<Arc<dyn Surface<Space>>, SceneError> {
        Ok(match &self.checked.scene.walls[wall].shape {
            Shape::Cylinder { from, to, radius } => {
                Arc::new(self.misshapen(wall, sdf::Cylinder::new(*from, *to, *radius))?)
            }
            Shape::Tube {
                from,
                to,
                inner,
                outer,
            } => Arc::new(self.misshapen(wall, sdf::Tube::new(*from, *to, *inner, *outer))?),
            Shape::Cone {
                from,
                to,
                radii: [base, top],
                thickness,
            } => Arc::new(self.misshapen(
                wall,
                sdf::HollowCone::new(*from, *to, *base, *top, *thickness),
            )?),
            Shape::Screw {
                from,
                to,
                shaft,
                outer,
                pitch,
                thickness,
                hand,
            } => {
                let size = sdf::ScrewSize {
                    shaft: 0.5 * shaft,
                    outer: 0.5 * outer,
                    pitch: *pitch,
                    thickness: *thickness,
                };
                let hand = match hand {
                    tsubu_scene::Hand::Right => sdf::Hand::Right,
                    tsubu_scene::Hand::Left => sdf::Hand::Left,
                };
                Arc::new(self.misshapen(wall, sdf::Screw::new(*from, *to, size, hand))?)
            }
            Shape::Mesh {
                mesh,
                surface,
                thickness,
            } => self.of_mesh(wall, mesh, *surface, *thickness)?,
            // The others are built in any dimension.
            other => {
                let what = format!("{} cannot be built here", other.name());
                return Err(self.trouble(wall, "shape", what, "choose another shape"));
            }
        })
    }

    /// Reads the mesh of a wall; refuses one without an inside. With it what the doctor says, and
    /// where to hear more.
    fn read(
        &self,
        wall: usize,
        file: &MeshFile,
        thickness: Option<f64>,
    ) -> Result<(Mesh, Report, String), SceneError> {
        let mesh = read_mesh(self.checked, &format!("walls[{wall}].shape.file"), file)?;
        let report = Report::of(&mesh);
        let look = format!("`tsubu mesh {}` says more", file.path.display());
        if report.verdict == Verdict::OpenSheet && thickness.is_none() {
            let what = "this mesh is an open sheet: it has no inside";
            let remedy =
                format!("give it a thickness, as in thickness: \"2 mm\", or close it; {look}");
            return Err(self.trouble(wall, "shape.file", what, remedy));
        }
        Ok((mesh, report, look))
    }

    /// A body built of grains: the mesh filled with grains that are driven with it.
    pub(crate) fn of_grains(
        &self,
        wall: usize,
        file: &MeshFile,
        radius: f64,
        thin: Thin,
        thickness: Option<f64>,
    ) -> Result<GrainBody, SceneError> {
        let field = "shape.surface.radius";
        let most = LARGEST_WALL_GRAIN * 0.5 * self.diameter;
        if radius > most {
            let what = format!(
                "the wall grains have {:.2} times the radius of a grain, {:.4} mm: grains would slip through between them",
                radius / (0.5 * self.diameter),
                500.0 * self.diameter
            );
            let remedy = format!("write at most {:.4} mm, twice the grain's", most * 1e3);
            return Err(self.trouble(wall, field, what, remedy));
        }
        let (mesh, _, look) = self.read(wall, file, thickness)?;
        let options = GrainBodyOptions {
            thin: match thin {
                Thin::Leave => sdf::Thin::Leave,
                Thin::OneLayer => sdf::Thin::OneLayer,
            },
            thickness,
            most_bytes: MOST_BYTES,
            ..GrainBodyOptions::new(radius, BAND * self.diameter)
        };
        GrainBody::build(&mesh, &options).map_err(|error| {
            let (field, remedy) = match &error {
                GrainBodyError::Mesh(_) => ("shape.file", look),
                GrainBodyError::NoGrain { .. } => (
                    field,
                    format!("write a smaller radius, or thin: OneLayer; {look}"),
                ),
                _ => (field, format!("write a larger radius; {look}")),
            };
            self.trouble(wall, field, error.to_string(), remedy)
        })
    }

    fn of_mesh(
        &self,
        wall: usize,
        file: &MeshFile,
        surface: MeshSurface,
        thickness: Option<f64>,
    ) -> Result<Arc<dyn Surface<Space>>, SceneError> {
        let (mesh, report, look) = self.read(wall, file, thickness)?;
        let (cell, exact_edges) = match surface {
            MeshSurface::Exact => {
                let made = match thickness {
                    Some(thickness) => ExactMesh::wall(&mesh, thickness),
                    None => ExactMesh::body(&mesh),
                };
                let exact =
                    made.map_err(|e| self.trouble(wall, "shape.file", e.to_string(), look))?;
                return Ok(Arc::new(exact));
            }
            MeshSurface::Grid { cell, exact_edges } => (cell, exact_edges),
            // Built apart, since it has more to say.
            MeshSurface::Grains { .. } => (None, false),
        };
        let thinnest = thickness.or(report.thinnest);
        if let (Some(cell), Some(thinnest)) = (cell, thinnest)
            && cell > thinnest
        {
            let what = format!(
                "the cell of {:.3} mm is larger than the thinnest part of the mesh, {:.3} mm: the grid would lose it",
                cell * 1e3,
                thinnest * 1e3
            );
            let remedy = format!("write at most {:.3} mm, a quarter of it", thinnest * 250.0);
            return Err(self.trouble(wall, "shape.surface.cell", what, remedy));
        }
        // A quarter of what is thin, of the mesh or of a grain.
        let cell =
            cell.unwrap_or_else(|| 0.25 * thinnest.unwrap_or(f64::INFINITY).min(self.diameter));
        let options = GridOptions {
            thickness,
            most_bytes: MOST_BYTES,
            exact_edges,
            ..GridOptions::new(cell, BAND * self.diameter + 2.0 * cell)
        };
        let name = &self.checked.scene.walls[wall].name;
        let grid = self.choices.grid(&mesh, &options, name).map_err(|e| {
            self.trouble(
                wall,
                "shape",
                e.to_string(),
                format!("change the cell; {look}"),
            )
        })?;
        Ok(Arc::new(grid))
    }
}

impl Choices {
    /// The grid from the folder of earlier grids, or built now and kept there.
    fn grid(
        &self,
        mesh: &Mesh,
        options: &GridOptions,
        name: &str,
    ) -> Result<DistanceGrid, sdf::GridError> {
        let key = DistanceGrid::key(mesh, options);
        let kept = self
            .grids
            .as_ref()
            .map(|folder| folder.join(format!("{key:016x}.grid")));
        // A file that does not read is one that has to be made anew.
        if let Some(grid) = kept
            .as_ref()
            .and_then(|file| std::fs::read(file).ok())
            .and_then(|bytes| DistanceGrid::from_bytes(&bytes).ok())
        {
            return Ok(grid);
        }
        let silent = |_: &str, _: f64| {};
        let tell = self.watch.as_ref().map_or(&silent as &_, |watch| &*watch.0);
        let grid = DistanceGrid::build(mesh, options, &|share| tell(name, share))?;
        if let Some(file) = kept {
            // A run does not need the file: where it cannot be written, the next run builds again.
            let _ = keep(&file, &grid.to_bytes());
        }
        Ok(grid)
    }
}

fn keep(file: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let draft = file.with_extension(format!("draft-{}", std::process::id()));
    std::fs::write(&draft, bytes)?;
    std::fs::rename(&draft, file)
}

/// Reads a file of triangles; trouble is told at `path` of the scene.
pub(crate) fn read_mesh(
    checked: &Checked,
    path: &str,
    file: &MeshFile,
) -> Result<Mesh, SceneError> {
    Mesh::read(&file.path, file.unit).map_err(|e| {
        let what = format!("{}: {e}", file.path.display());
        checked.problem(
            path,
            what,
            "check the path and what `tsubu mesh FILE` says of it",
        )
    })
}
