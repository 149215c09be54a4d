//! Rock masses.

use crate::arrays::{rows, to_rows, vector};
use crate::errors::refused;
use crate::particle::planes;
use crate::records::structured;
use bytemuck::{Pod, Zeroable};
use potential_particles::Row;
use potential_particles::rock::{FaceOf, Joint, JointSet, RockMass, SliceSettings, slice_with_regions};
use pyo3::prelude::*;
use std::mem::offset_of;

/// A plane, a disc or a convex polygon along which rock has parted.
#[pyclass(name = "Joint", module = "potential_particles._core", frozen)]
pub struct PyJoint(Joint);

#[pymethods]
impl PyJoint {
    /// By a normal of any length.
    #[staticmethod]
    #[pyo3(signature = (point, normal, radius=f64::INFINITY))]
    fn of_normal(point: [f64; 3], normal: [f64; 3], radius: f64) -> Self {
        Self(Joint { point: point.into(), normal: normal.into(), radius, outline: None })
    }

    /// The convex polygon of corners (n, 3) in their order; ValueError where they are none's.
    #[staticmethod]
    fn of_corners(corners: &Bound<'_, PyAny>) -> PyResult<Self> {
        Joint::polygon(&rows::<3>(corners, "corners", "three numbers x, y, z")?).map(Self).map_err(refused)
    }

    /// Point, normal and radius.
    #[getter]
    fn parts(&self) -> ([f64; 3], [f64; 3], f64) {
        (self.0.point.into(), self.0.normal.into(), self.0.radius)
    }
}

/// The joints of a set, as a list of Joint: those that cross the line through centre along their mean normal within
/// reach of it.
///
/// dip, dip_direction: degrees, from horizontal and clockwise from north. spacing: mean, length; exponential: drawn
/// from that distribution. fisher: kappa of Fisher's distribution of normals. radius: of joints that are discs, whose
/// centres lie anywhere, length. The numbers drawn depend on seed alone.
#[pyfunction]
#[pyo3(signature = (dip, dip_direction, spacing, *, centre, reach, exponential=false, fisher=f64::INFINITY,
                    radius=f64::INFINITY, seed=0))]
#[allow(clippy::too_many_arguments)]
fn joint_set(
    dip: f64,
    dip_direction: f64,
    spacing: f64,
    centre: &Bound<'_, PyAny>,
    reach: f64,
    exponential: bool,
    fisher: f64,
    radius: f64,
    seed: u64,
) -> PyResult<Vec<PyJoint>> {
    let set = JointSet { exponential, fisher, radius, seed, ..JointSet::new(dip, dip_direction, spacing) };
    let joints = set.joints(vector::<3>(centre, "centre")?, reach).map_err(refused)?;
    Ok(joints.into_iter().map(PyJoint).collect())
}

/// What a domain was cut into.
#[pyclass(name = "RockMass", module = "potential_particles._core", frozen)]
pub struct PyRockMass(RockMass);

#[pymethods]
impl PyRockMass {
    #[getter]
    fn missing(&self) -> Vec<usize> {
        self.0.missing.clone()
    }

    #[getter]
    fn too_small(&self) -> usize {
        self.0.too_small
    }

    #[getter]
    fn unclosed(&self) -> usize {
        self.0.unclosed
    }

    /// How many joints have cut: all, unless progress ended it.
    #[getter]
    fn joints(&self) -> usize {
        self.0.joints
    }

    /// What it holds as structured arrays (blocks, faces, partners), and all corners (n, 3), face after face.
    fn arrays(&self, py: Python<'_>) -> PyResult<Arrays> {
        arrays(py, &self.0)
    }
}

type Arrays = (Py<PyAny>, Py<PyAny>, Py<PyAny>, Py<PyAny>);

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct BlockRecord {
    volume: f64,
    centroid: [f64; 3],
    inertia: [f64; 6],
    first_face: u64,
    face_count: u64,
    parent: u64,
    region: i64,
}

const OF_BLOCK: &[Row] = &[
    ("volume", "f8", 1, offset_of!(BlockRecord, volume), ""),
    ("centroid", "f8", 3, offset_of!(BlockRecord, centroid), ""),
    ("inertia", "f8", 6, offset_of!(BlockRecord, inertia), ""),
    ("first_face", "u8", 1, offset_of!(BlockRecord, first_face), ""),
    ("face_count", "u8", 1, offset_of!(BlockRecord, face_count), ""),
    ("parent", "u8", 1, offset_of!(BlockRecord, parent), ""),
    ("region", "i8", 1, offset_of!(BlockRecord, region), ""),
];

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct FaceRecord {
    /// 0: a plane of the domain, 1: a joint, 2: a plane of a region.
    of: u32,
    region: u32,
    index: u64,
    plane: [f64; 4],
    area: f64,
    jointed_area: f64,
    first_corner: u64,
    corner_count: u64,
    block: u64,
}

const OF_FACE: &[Row] = &[
    ("of", "u4", 1, offset_of!(FaceRecord, of), ""),
    ("region", "u4", 1, offset_of!(FaceRecord, region), ""),
    ("index", "u8", 1, offset_of!(FaceRecord, index), ""),
    ("plane", "f8", 4, offset_of!(FaceRecord, plane), ""),
    ("area", "f8", 1, offset_of!(FaceRecord, area), ""),
    ("jointed_area", "f8", 1, offset_of!(FaceRecord, jointed_area), ""),
    ("first_corner", "u8", 1, offset_of!(FaceRecord, first_corner), ""),
    ("corner_count", "u8", 1, offset_of!(FaceRecord, corner_count), ""),
    ("block", "u8", 1, offset_of!(FaceRecord, block), ""),
];

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct PartnersRecord {
    faces: [u64; 2],
    area: f64,
}

const OF_PARTNERS: &[Row] = &[
    ("faces", "u8", 2, offset_of!(PartnersRecord, faces), ""),
    ("area", "f8", 1, offset_of!(PartnersRecord, area), ""),
];

fn arrays(py: Python<'_>, mass: &RockMass) -> PyResult<Arrays> {
    let (mut blocks, mut faces, mut first_corner) = (Vec::with_capacity(mass.blocks.len()), Vec::new(), 0);
    for (number, block) in mass.blocks.iter().enumerate() {
        let i = block.inertia();
        blocks.push(BlockRecord {
            volume: block.volume,
            centroid: block.centroid.into(),
            inertia: [i.m11, i.m22, i.m33, i.m12, i.m23, i.m13],
            first_face: faces.len() as u64,
            face_count: block.faces.len() as u64,
            parent: block.parent as u64,
            region: block.region.map_or(-1, |region| region as i64),
        });
        for face in &block.faces {
            let (of, region, index) = match face.of {
                FaceOf::Domain(plane) => (0, 0, plane),
                FaceOf::Joint(joint) => (1, 0, joint),
                FaceOf::Region { region, plane } => (2, region, plane),
            };
            let (n, corner_count) = (face.plane.normal, block.corners_of(face).len() as u64);
            faces.push(FaceRecord {
                of,
                // Fewer regions than 2^32 fit into memory.
                region: region as u32,
                index: index as u64,
                plane: [n.x, n.y, n.z, face.plane.offset],
                area: face.area,
                jointed_area: face.jointed_area,
                first_corner,
                corner_count,
                block: number as u64,
            });
            first_corner += corner_count;
        }
    }
    let place = |[block, face]: [usize; 2]| blocks[block].first_face + face as u64;
    let partners: Vec<PartnersRecord> =
        mass.partners().iter().map(|pair| PartnersRecord { faces: pair.faces.map(place), area: pair.area }).collect();
    let corners: Vec<[f64; 3]> = mass.blocks.iter().flat_map(|block| &block.corners).map(|&at| at.into()).collect();
    Ok((
        structured(py, &blocks, OF_BLOCK)?,
        structured(py, &faces, OF_FACE)?,
        structured(py, &partners, OF_PARTNERS)?,
        to_rows(py, corners.into_iter()).into_any().unbind(),
    ))
}

/// A convex domain {a x + b y + c z <= d}, planes (n, 4), cut by joints in their order, as a RockMass.
///
/// A joint cuts each block that it meets in two, but for parts of less than least_volume, thinner than least_thickness
/// in the mean (2V/A), whose largest ball has a diameter below least_width, or whose extent along an axis is above
/// largest_aspect times that. regions: convex regions as lists of planes, such as a tunnel, which cut the blocks that
/// they meet after all joints. progress: a function of the numbers of joints that have cut and of blocks, which returns
/// whether to go on. The result does not depend on threads. ValueError: a domain that is empty or open, or more than
/// most_blocks.
#[pyfunction]
#[pyo3(signature = (domain, joints, *, regions=vec![], least_volume=0.0, least_thickness=0.0, least_width=0.0,
                    largest_aspect=f64::INFINITY, most_blocks=1_000_000, threads=1, progress=None))]
#[allow(clippy::too_many_arguments)]
fn slice(
    py: Python<'_>,
    domain: &Bound<'_, PyAny>,
    joints: Vec<PyRef<'_, PyJoint>>,
    regions: Vec<Bound<'_, PyAny>>,
    least_volume: f64,
    least_thickness: f64,
    least_width: f64,
    largest_aspect: f64,
    most_blocks: usize,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyRockMass> {
    let domain = planes(domain)?;
    let regions = regions.iter().map(planes).collect::<PyResult<Vec<_>>>()?;
    let joints: Vec<Joint> = joints.iter().map(|joint| joint.0.clone()).collect();
    let settings = SliceSettings { least_volume, least_thickness, least_width, largest_aspect, most_blocks, threads };
    let mut raised = None;
    let told = |joints: usize, blocks: usize| {
        let Some(progress) = &progress else { return true };
        Python::attach(|py| progress.call1(py, (joints, blocks))?.is_truthy(py)).unwrap_or_else(|error| {
            raised = Some(error);
            false
        })
    };
    let cut = py.detach(|| slice_with_regions(&domain, &joints, &regions, &settings, told));
    match raised {
        Some(error) => Err(error),
        None => Ok(PyRockMass(cut.map_err(refused)?)),
    }
}

pub fn add(parent: &Bound<'_, PyModule>) -> PyResult<()> {
    let module = PyModule::new(parent.py(), "_slicing")?;
    module.add_class::<PyJoint>()?;
    module.add_class::<PyRockMass>()?;
    module.add_function(wrap_pyfunction!(joint_set, &module)?)?;
    module.add_function(wrap_pyfunction!(slice, &module)?)?;
    parent.add_submodule(&module)
}
