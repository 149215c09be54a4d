//! The outline of a cell, cut into triangles whose sides are parabolas.

use super::faces::Corner;
use super::numbers::Limits;
use super::rim::parabola;
use super::triangle_rule::CurvedTriangle;

/// Buffers.
#[derive(Debug, Default)]
pub(super) struct Ears {
    sides: Vec<Corner>,
    left: Vec<Corner>,
    triangles: Vec<CurvedTriangle>,
}

/// Cuts an outline: from one of its corners, or from its middle, or ear by ear; `None` where nothing will do.
pub(super) fn cut(outline: &[Corner], ears: &mut Ears, mut give: impl FnMut(CurvedTriangle)) -> Option<()> {
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
    ears.sides.clear();
    ears.sides.extend_from_slice(outline);
    while ears.sides.len() <= Limits::SIDES {
        ears.left.clone_from(&ears.sides);
        ears.triangles.clear();
        if clip(&mut ears.left, &mut ears.triangles).is_some() {
            ears.triangles.iter().for_each(|triangle| give(*triangle));
            return Some(());
        }
        // Halves of sides are less bent.
        ears.left.clone_from(&ears.sides);
        ears.sides.clear();
        for (i, Corner { at, middle }) in ears.left.iter().enumerate() {
            let next = ears.left[(i + 1) % ears.left.len()].at;
            let [first, second] = [0.25, 0.75].map(|t| parabola([at, middle, &next], t));
            ears.sides.extend([Corner { at: *at, middle: first }, Corner { at: *middle, middle: second }]);
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners with the middles of straight sides, which `bend` moves.
    fn outline(corners: &[[f64; 2]], bend: impl Fn(usize) -> [f64; 2]) -> Vec<Corner> {
        let count = corners.len();
        let side = |i: usize| {
            let (at, next, by) = (corners[i], corners[(i + 1) % count], bend(i));
            Corner { at, middle: [0, 1].map(|c| 0.5 * (at[c] + next[c]) + by[c]) }
        };
        (0..count).map(side).collect()
    }

    /// The area within parabolas: that of the polygon, and 4/3 of the triangle of each with its chord (Archimedes).
    fn area_of(outline: &[Corner]) -> f64 {
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let next = |i: usize| outline[(i + 1) % outline.len()].at;
        let side = |i: usize| {
            let Corner { at: p, middle: m } = outline[i];
            let q = next(i);
            cross(p, q) + 4.0 / 3.0 * (cross(p, m) + cross(m, q) - cross(p, q))
        };
        0.5 * (0..outline.len()).map(side).sum::<f64>()
    }

    /// Triangles whose Jacobians are positive and whose areas add up cover the outline once.
    #[test]
    fn triangles_cover_the_outline_once() {
        let ring = |turn: f64, r: f64| [r * turn.cos(), r * turn.sin()];
        let arc = |from: f64, r: f64| (0..7).map(move |i| ring(from + 0.5 * f64::from(i), r));
        // Three quarters of a ring: no point sees all of it.
        let mut bent: Vec<[f64; 2]> = arc(0.0, 1.0).collect();
        bent.extend(arc(0.0, 0.8).collect::<Vec<_>>().into_iter().rev());
        let comb = [
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 3.0],
            [4.0, 3.0],
            [4.0, 1.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [2.0, 3.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [0.0, 3.0],
        ];
        let bow = [[0.0, 0.0], [1.0, 0.2], [2.0, 0.0]];
        let outlines = [
            outline(&bent, |_| [0.0; 2]),
            outline(&comb, |i| if i == 0 { [0.0, 0.3] } else { [0.0; 2] }),
            outline(&bow, |i| if i == 2 { [0.0, 0.6] } else { [0.0; 2] }),
            // A lens, and one side of it beside the other.
            vec![Corner { at: [0.0, 0.0], middle: [1.0, -0.4] }, Corner { at: [2.0, 0.0], middle: [1.0, 0.3] }],
            vec![Corner { at: [0.0, 0.0], middle: [1.0, 0.9] }, Corner { at: [2.0, 0.0], middle: [1.0, 1.0] }],
        ];
        for outline in &outlines {
            let (mut sum, mut count) = (0.0, 0);
            let done = cut(outline, &mut Ears::default(), |triangle| {
                assert!(triangle.is_regular());
                (sum, count) = (sum + triangle.area(), count + 1);
            });
            let area = area_of(outline);
            assert!(done.is_some() && count > 0 && (sum - area).abs() < 1e-12 * area, "{sum} {area} of {outline:?}");
        }
    }
}
