//! The one place that talks to parry: a tree of triangles that answers for points, boxes and rays.

use crate::mesh::Mesh;
use crate::triangle::closest;
use glam::DVec3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::query::{PointQueryWithLocation, Ray, RayCast};
use parry3d_f64::shape::{TriMesh, TriMeshFlags};

/// Triangles under a tree of boxes. The mesh's [`Mesh::check`] must pass.
#[derive(Clone)]
pub(crate) struct Tree {
    triangles: TriMesh,
}

/// The closest point of all triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest {
    pub point: DVec3,
    pub triangle: u32,
    /// By the normal there; true only means something for a mesh with clean topology.
    pub behind: bool,
}

impl Tree {
    /// `None` for a mesh without triangles.
    pub fn new(mesh: &Mesh) -> Option<Self> {
        let (vertices, triangles) = (mesh.vertices.clone(), mesh.triangles.clone());
        let mut tree = TriMesh::new(vertices, triangles).ok()?;
        // Only the normals at edges and corners are asked for; an edge of three faces is no error to us.
        let _ = tree.set_flags(TriMeshFlags::ORIENTED);
        Some(Self { triangles: tree })
    }

    /// The closest point within `most` of x.
    pub fn closest(&self, x: DVec3, most: f64) -> Option<Closest> {
        self.triangles
            .project_local_point_and_get_location_with_max_dist(x, false, most)
            .map(|(projection, (triangle, _))| {
                // Ours is exact on corners and sides, where features are told apart.
                let point = closest(self.corners(triangle), x).0;
                let behind = projection.is_inside;
                Closest {
                    point,
                    triangle,
                    behind,
                }
            })
    }

    /// The triangles whose boxes meet the cube of half width `reach` around x.
    pub fn near(&self, x: DVec3, reach: f64, mut each: impl FnMut(u32)) {
        let cube = Aabb::new(x - DVec3::splat(reach), x + DVec3::splat(reach));
        for triangle in self.triangles.bvh().intersect_aabb(&cube) {
            each(triangle);
        }
    }

    /// How far from x along the unit vector `along` the first triangle lies.
    pub fn ray(&self, x: DVec3, along: DVec3) -> Option<f64> {
        self.triangles
            .cast_local_ray(&Ray::new(x, along), f64::MAX, false)
    }

    /// The corners of a triangle.
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        let t = self.triangles.triangle(triangle);
        [t.a, t.b, t.c]
    }
}
