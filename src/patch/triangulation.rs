//! The outline of a cell, cut into triangles whose sides are parabolas.

use super::faces::Corner;
use super::rim::parabola;
use super::triangle_rule::CurvedTriangle;

/// Most sides of an outline, halved or not, that is cut ear by ear.
const MOST_SIDES: usize = 48;

/// Cuts an outline: from one of its corners, or from its middle, or ear by ear; `None` where nothing will do.
pub(super) fn cut(outline: &[Corner], ears: &mut Vec<Corner>, mut give: impl FnMut(CurvedTriangle)) -> Option<()> {
    let count = outline.len();
    let corner = |i: usize| &outline[i % count];
    if count == 2 {
        let halves = lens(outline);
        if halves.iter().all(CurvedTriangle::is_regular) {
            halves.into_iter().for_each(give);
            return Some(());
        }
    }
    for apex in 0..count {
        let triangle = |i: usize| {
            let [a, b, c] = [corner(apex), corner(apex + i), corner(apex + i + 1)];
            let first = (i == 1).then_some(a.middle);
            let last = (i + 2 == count).then_some(c.middle);
            CurvedTriangle::new([a.at, b.at, c.at], [first, Some(b.middle), last])
        };
        if count > 2 && (1..count - 1).all(|i| triangle(i).is_regular()) {
            (1..count - 1).for_each(|i| give(triangle(i)));
            return Some(());
        }
    }
    let middle = [0, 1].map(|c| outline.iter().map(|k| k.at[c] + k.middle[c]).sum::<f64>() / (2 * count) as f64);
    let triangle =
        |i: usize| CurvedTriangle::new([middle, corner(i).at, corner(i + 1).at], [None, Some(corner(i).middle), None]);
    if (0..count).all(|i| triangle(i).is_regular()) {
        (0..count).for_each(|i| give(triangle(i)));
        return Some(());
    }
    let mut sides = outline.to_vec();
    while sides.len() <= MOST_SIDES {
        ears.clear();
        ears.extend_from_slice(&sides);
        let mut triangles = Vec::new();
        if clip(ears, &mut triangles).is_some() {
            triangles.into_iter().for_each(give);
            return Some(());
        }
        let count = sides.len();
        sides = (0..2 * count)
            .map(|i| {
                let (Corner { at, middle }, next) = (sides[i / 2], sides[(i / 2 + 1) % count].at);
                let t = if i % 2 == 0 { 0.25 } else { 0.75 };
                Corner { at: if i % 2 == 0 { at } else { middle }, middle: parabola([&at, &middle, &next], t) }
            })
            .collect();
    }
    None
}

/// Cuts off the corner across which the way is shortest, until nothing is left.
fn clip(outline: &mut Vec<Corner>, triangles: &mut Vec<CurvedTriangle>) -> Option<()> {
    while outline.len() > 2 {
        let count = outline.len();
        let mut best: Option<(f64, usize, CurvedTriangle)> = None;
        for i in 0..count {
            let [before, here, after] = [count - 1, 0, 1].map(|step| outline[(i + step) % count]);
            let last = (count == 3).then_some(after.middle);
            let ear =
                CurvedTriangle::new([before.at, here.at, after.at], [Some(before.middle), Some(here.middle), last]);
            let across = (after.at[0] - before.at[0]).powi(2) + (after.at[1] - before.at[1]).powi(2);
            if best.is_some_and(|(least, ..)| across >= least) || !ear.is_regular() {
                continue;
            }
            let round = [before.at, before.middle, here.at, here.middle, after.at];
            let others = (2..count - 1).map(|step| outline[(i + step) % count]);
            let mut others = others.flat_map(|corner| [corner.at, corner.middle]);
            let side = [outline[(i + 1) % count].middle];
            if count == 3 || !others.any(|point| is_inside(&round, &point)) && !is_inside(&round, &side[0]) {
                best = Some((across, i, ear));
            }
        }
        let (_, i, ear) = best?;
        triangles.push(ear);
        if count == 3 {
            return Some(());
        }
        let before = (i + count - 1) % count;
        let (p, q) = (outline[before].at, outline[(i + 1) % count].at);
        outline[before].middle = [0, 1].map(|c| 0.5 * (p[c] + q[c]));
        outline.remove(i);
    }
    None
}

/// Whether a point lies inside a polygon: by the number of its sides above.
fn is_inside(polygon: &[[f64; 2]], [u, v]: &[f64; 2]) -> bool {
    let count = polygon.len();
    let crosses = |i: &usize| {
        let ([a, b], [c, d]) = (polygon[*i], polygon[(i + 1) % count]);
        (a > *u) != (c > *u) && *v < b + (d - b) * (u - a) / (c - a)
    };
    (0..count).filter(crosses).count() % 2 == 1
}

/// A cell with two corners, in two triangles on either side of the line between the middles of its sides.
fn lens(outline: &[Corner]) -> [CurvedTriangle; 2] {
    let [a, b] = [outline[0], outline[1]];
    let quarter = |from: &Corner, to: &Corner, t: f64| Some(parabola([&from.at, &from.middle, &to.at], t));
    [
        CurvedTriangle::new([a.at, a.middle, b.middle], [quarter(&a, &b, 0.25), None, quarter(&b, &a, 0.75)]),
        CurvedTriangle::new([b.at, b.middle, a.middle], [quarter(&b, &a, 0.25), None, quarter(&a, &b, 0.75)]),
    ]
}
