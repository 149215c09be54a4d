//! A domain, cut by one joint after the other.

use super::numbers::{FEW_PARTS, Limits, PIECES};
use crate::particle::plane::Plane;
use crate::rock::block::Block;
use crate::rock::cutting::{Cuts, Part, Workbench};
use crate::rock::domain::{Oriented, enclosed, faces, unit_planes};
use crate::rock::error::RockError;
use crate::rock::expected::expected_blocks;
use crate::rock::joint::Joint;
use crate::rock::parallel_cut::{self, Round};
use crate::rock::regions::parted;
use crate::rock::settings::SliceSettings;

/// What a domain was cut into.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RockMass {
    /// The blocks, whose volumes sum to that of the domain. Of what a joint cuts in two, what lies below it comes
    /// first, then what lies beyond, each with all that later joints make of it: neighbours are often near in this
    /// order.
    pub blocks: Vec<Block>,
    /// Joints that cut no block.
    pub missing: Vec<usize>,
    /// How many cuts were left out because of the limits, or as a part would have been no thicker than the rounding of
    /// its corners.
    pub too_small: usize,
    /// How many blocks were left whole where the parts of a cut would not have closed, by rounding.
    pub unclosed: usize,
    /// How many of the joints have cut: all, unless it was ended before.
    pub joints: usize,
}

/// Cuts a convex domain {x : n_i·x ≤ d_i for all planes} by joints, in their order. A joint cuts each block that it
/// meets in two; a disc or polygon cuts all of a block that it reaches, as in the paper.
///
/// # Errors
/// A domain that is empty or open, a plane or joint without a normal or whose numbers are not finite, an invalid limit,
/// more blocks than allowed.
pub fn slice(domain: &[Plane], joints: &[Joint], settings: &SliceSettings) -> Result<RockMass, RockError> {
    slice_with_regions(domain, joints, &[], settings, |_, _| true)
}

/// The same with convex regions, which cut the blocks that they meet after all joints: a tunnel, a bench, or what a
/// domain that is not convex leaves out. A block is then cut plane by plane into what lies in the region, in the first
/// one of several, and the parts beside it, which keep its [`Block::parent`]. Parts smaller than the settings allow are
/// not made: one in the region stays with what is beside it, one beside it with what is in the region.
///
/// `progress` is called before the first joint, and again after every few, with the number of joints that have cut and
/// of blocks that there are; where it returns false, the joints that are left do not cut ([`RockMass::joints`]), and
/// the regions still do.
///
/// # Errors
/// As of [`slice()`], and an invalid plane of a region.
pub fn slice_with_regions(
    domain: &[Plane],
    joints: &[Joint],
    regions: &[Vec<Plane>],
    settings: &SliceSettings,
    mut progress: impl FnMut(usize, usize) -> bool,
) -> Result<RockMass, RockError> {
    settings.validate()?;
    let outer = unit_planes(domain).map_err(RockError::NoPlane)?;
    let (origin, polyhedron) = enclosed(&outer)?;
    let planes = faces(&outer, joints, regions, &origin)?;
    let local: Vec<Joint> =
        joints.iter().zip(&planes[domain.len()..]).map(|(joint, (_, n, _))| joint.about(&origin, *n)).collect();
    if !settings.leaves_out() {
        let outer: Vec<Oriented> = planes[..domain.len()].iter().map(|(_, n, height)| (*n, *height)).collect();
        let expected = expected_blocks(&polyhedron, &outer, &local);
        if expected > settings.most_blocks as f64 {
            return Err(RockError::TooManyExpected { expected, most: settings.most_blocks });
        }
    }
    let cuts = Cuts::new(&polyhedron, &planes, local, domain.len(), settings);
    let sizes: Vec<usize> = regions.iter().map(Vec::len).collect();
    let block = |parent, part: &Part, region, bench: &mut Workbench| {
        part.polyhedron.read_outlines(&mut bench.outlines);
        let (face, shared) = (|number| cuts.face(number), |joint, corners: &[_]| cuts.shared_area(joint, corners));
        Block { parent, region, ..Block::of(&bench.outlines, &part.middle, &origin, face, shared) }
    };
    let finish = |parent, part: &Part, bench: &mut Workbench, blocks: &mut Vec<Block>| {
        if sizes.is_empty() {
            blocks.push(block(parent, part, None, bench));
        } else {
            let parts = parted(part, &sizes, &cuts, bench);
            blocks.extend(parts.iter().map(|(part, region)| block(parent, part, *region, bench)));
        }
    };
    let mut parts = vec![Part::of(polyhedron)];
    let mut mass = RockMass { blocks: Vec::new(), missing: Vec::new(), too_small: 0, unclosed: 0, joints: 0 };
    loop {
        let goes_on = mass.joints < joints.len() && progress(mass.joints, parts.len());
        let mut length = if goes_on { round_length(mass.joints, joints.len(), parts.len(), settings) } else { 0 };
        loop {
            let range = mass.joints..mass.joints + length;
            let most =
                if length > 1 { settings.most_blocks.min(parts.len() + 4 * PIECES) } else { settings.most_blocks };
            if goes_on && range.end < joints.len() {
                let keep = |_, part: &Part, _: &mut Workbench, parts: &mut Vec<Part>| parts.push(part.clone());
                if let Ok(round) = parallel_cut::cut(settings.threads, &parts, &cuts, range, most, keep) {
                    mass.note(&round, length);
                    parts = round.chunks.into_iter().flat_map(|chunk| chunk.results).collect();
                    break;
                }
            } else if let Ok(round) = parallel_cut::cut(settings.threads, &parts, &cuts, range, most, finish) {
                mass.note(&round, length);
                mass.blocks = Vec::with_capacity(round.chunks.iter().map(|chunk| chunk.results.len()).sum());
                let mut first = 0;
                for chunk in round.chunks {
                    let numbered = |block: Block| Block { parent: first + block.parent, ..block };
                    mass.blocks.extend(chunk.results.into_iter().map(numbered));
                    first += chunk.pieces;
                }
                return Ok(mass);
            }
            if length <= 1 {
                return Err(RockError::TooManyBlocks { joint: mass.joints, most: settings.most_blocks });
            }
            length /= 2;
        }
    }
}

impl RockMass {
    /// Takes note of what a round of so many joints has left out.
    fn note<T>(&mut self, round: &Round<T>, joints: usize) {
        self.joints += joints;
        self.missing.extend(&round.missing);
        self.too_small += round.left_out.too_small;
        self.unclosed += round.left_out.unclosed;
    }
}

/// How many joints of `all` the next round has, after `done` of them have made so many parts: the number of blocks
/// grows as the cube of that of the joints, unless these all belong to one set.
fn round_length(done: usize, all: usize, parts: usize, settings: &SliceSettings) -> usize {
    let by_count = (all / Limits::ROUNDS).max(1);
    let by_pieces = if parts < FEW_PARTS * settings.threads.max(1) {
        0
    } else {
        let grown = (1.0 + PIECES as f64 / parts as f64).cbrt();
        ((grown - 1.0) * done as f64) as usize
    };
    by_count.max(by_pieces).min(all - done)
}
