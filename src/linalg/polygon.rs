//! Convex polygons cut by a line.

/// Fills `kept` with what a convex polygon, corners in order, has where a linear `height` is at most 0. `crossing`
/// makes the corner at a part of the side from one corner to the next, and is told whether the side leads out.
#[inline(always)]
pub(crate) fn clip<C: Copy>(
    corners: &[C],
    kept: &mut Vec<C>,
    height: impl Fn(&C) -> f64,
    crossing: impl Fn(&C, &C, f64, bool) -> C,
) {
    kept.clear();
    let Some(first) = corners.first() else { return };
    let mut here = height(first);
    for (i, corner) in corners.iter().enumerate() {
        let next = &corners[(i + 1) % corners.len()];
        let there = height(next);
        let (is_in, leads_in) = (here <= 0.0, there <= 0.0);
        if is_in {
            kept.push(*corner);
        }
        if is_in != leads_in {
            kept.push(crossing(corner, next, here / (here - there), is_in));
        }
        here = there;
    }
}
