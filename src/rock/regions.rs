//! What convex regions make of a part that joints have left.

use crate::particle::polyhedron::{Polyhedron, Split};
use crate::rock::cutting::{Cuts, Part, Workbench};
use std::ops::Range;

/// A part, and the region that it lies in.
pub(super) type Placed = (Part, Option<usize>);

/// What lies in each region (the first, where several overlap), and the rest. `sizes`: how many planes each region has.
pub(super) fn parted(part: &Part, sizes: &[usize], cuts: &Cuts<'_>, bench: &mut Workbench) -> Vec<Placed> {
    let mut parts = vec![(part.clone(), None)];
    let mut first = cuts.first_of_regions();
    for (region, size) in sizes.iter().enumerate() {
        let range = first..first + size;
        parts = parts
            .into_iter()
            .flat_map(|(part, within)| match within {
                Some(_) => vec![(part, within)],
                None => parted_by_one(part, region, range.clone(), cuts, bench),
            })
            .collect();
        first += size;
    }
    parts
}

/// The same of one region, whose planes have the numbers `range`.
fn parted_by_one(
    part: Part,
    region: usize,
    range: Range<usize>,
    cuts: &Cuts<'_>,
    bench: &mut Workbench,
) -> Vec<Placed> {
    if range.clone().any(|number| cuts.height(number, &part.middle) >= part.radius) {
        return vec![(part, None)];
    }
    let (mut inside, mut beside) = (part.polyhedron.clone(), Vec::new());
    for number in range {
        let (n, height) = cuts.plane(number);
        let (mut below, mut beyond) = (Polyhedron::default(), Polyhedron::default());
        match inside.split(&mut bench.cutter, number, &n, height, [&mut below, &mut beyond]) {
            Split::Missed if n.dot(&inside.middle()) > height => return vec![(part, None)],
            Split::Missed => continue,
            Split::Unclosed => {
                bench.left_out.unclosed += 1;
                return vec![(part, None)];
            }
            Split::Parted => (),
        }
        let mut is_too_small = |part: &Polyhedron| {
            part.read_outlines(&mut bench.outlines);
            cuts.is_too_small(part, &bench.outlines)
        };
        let (no_inside, no_beyond) = (is_too_small(&below), is_too_small(&beyond));
        if no_inside || no_beyond {
            bench.left_out.too_small += 1;
        }
        if no_inside {
            return vec![(part, None)];
        }
        if !no_beyond {
            beside.push((Part::of(beyond), None));
            inside = below;
        }
    }
    beside.push((Part::of(inside), Some(region)));
    beside
}
