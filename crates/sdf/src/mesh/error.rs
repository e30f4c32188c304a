//! What can be wrong with a mesh file, said with the place and the remedy.

use std::fmt;

/// Why a mesh was not read or not accepted.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshError {
    /// The file could not be opened or read.
    Unreadable {
        /// The path as given.
        path: String,
        /// What the operating system said.
        reason: String,
    },
    /// Neither `.stl` nor `.obj`.
    Format {
        /// The path as given.
        path: String,
    },
    /// More bytes than [`MOST_BYTES`](crate::mesh::MOST_BYTES).
    TooLarge {
        /// Size found.
        bytes: u64,
    },
    /// More facets than [`MOST_FACETS`](crate::mesh::MOST_FACETS).
    TooManyFacets {
        /// Number found, or the number at which reading stopped.
        facets: u64,
    },
    /// No facet at all.
    Empty,
    /// A binary STL that ends early.
    Truncated {
        /// Facets that its header announces.
        announced: u64,
        /// Whole facets that its length has room for.
        present: u64,
    },
    /// An ASCII STL breaks off or says something else than expected.
    Text {
        /// Line, from 1.
        line: usize,
        /// The word found there.
        found: String,
        /// What could have stood there.
        expected: &'static str,
    },
    /// An OBJ file that the reader refuses.
    Obj {
        /// What it said.
        reason: String,
    },
    /// A corner is NaN or infinite.
    NotFinite {
        /// Facet, from 1.
        facet: usize,
    },
    /// A corner lies further than [`FURTHEST`](crate::mesh::FURTHEST) from the origin.
    Huge {
        /// Facet, from 1.
        facet: usize,
        /// The largest coordinate in m.
        metres: f64,
    },
    /// A triangle names a vertex that is not there.
    Index {
        /// Facet, from 1.
        facet: usize,
        /// The vertex asked for.
        index: u32,
        /// How many there are.
        vertices: usize,
    },
    /// The length unit is not a positive finite number of metres.
    Unit {
        /// The number given.
        metres_per_unit: f64,
    },
    /// Every facet has zero area.
    NoArea,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        use crate::mesh::{FURTHEST, MOST_BYTES, MOST_FACETS};
        match self {
            Self::Unreadable { path, reason } => {
                write!(f, "cannot read the mesh {path}: {reason}")
            }
            Self::Format { path } => write!(
                f,
                "{path} is neither .stl nor .obj; export the body as STL (binary is smaller) or OBJ"
            ),
            Self::TooLarge { bytes } => write!(
                f,
                "the mesh file has {bytes} bytes, at most {MOST_BYTES} are read; export it with a coarser tolerance"
            ),
            Self::TooManyFacets { facets } => write!(
                f,
                "the mesh has {facets} facets or more, at most {MOST_FACETS} are read; export it with a coarser tolerance"
            ),
            Self::Empty => write!(f, "the mesh holds no facet; export the solid again"),
            Self::Truncated { announced, present } => write!(
                f,
                "the STL announces {announced} facets but holds {present}: it was cut off; copy or export it again"
            ),
            Self::Text {
                line,
                found,
                expected,
            } => write!(
                f,
                "line {line} of the STL: found `{found}`, expected {expected}; export it again, as binary if text keeps failing"
            ),
            Self::Obj { reason } => write!(
                f,
                "the OBJ file cannot be read: {reason}; export it again or as STL"
            ),
            Self::NotFinite { facet } => write!(
                f,
                "facet {facet} has a corner that is NaN or infinite; delete that facet or export the body again"
            ),
            Self::Huge { facet, metres } => write!(
                f,
                "facet {facet} has a corner {metres:e} m from the origin, more than {FURTHEST:e} m; is the length unit right?"
            ),
            Self::Index {
                facet,
                index,
                vertices,
            } => write!(
                f,
                "facet {facet} names vertex {index} but there are {vertices}; the mesh was put together wrongly"
            ),
            Self::Unit { metres_per_unit } => write!(
                f,
                "the length unit is {metres_per_unit} m; give a positive number, 0.001 for a file in mm"
            ),
            Self::NoArea => write!(
                f,
                "every facet has zero area: nothing can be touched; export the body again"
            ),
        }
    }
}

impl std::error::Error for MeshError {}
