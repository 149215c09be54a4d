//! Both potentials of a cell as quadratic forms in the frame of the patch, and the patch above a point of its plane.

use super::field::{Field, Owner, Placed, dot};
use super::ray::Node;

/// c + g·x + xᵀ h x, with h as xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy, Debug, Default)]
struct Quadratic {
    c: f64,
    g: [f64; 3],
    h: [f64; 6],
}

impl Quadratic {
    fn add_plane(&mut self, w: f64, excess: f64, [a, b, c]: [f64; 3]) {
        self.c += w * excess * excess;
        for (g, n) in self.g.iter_mut().zip([a, b, c]) {
            *g += 2.0 * w * excess * n;
        }
        let products = [a * a, b * b, c * c, 2.0 * a * b, 2.0 * a * c, 2.0 * b * c];
        self.h.iter_mut().zip(products).for_each(|(h, product)| *h += w * product);
    }

    fn add_sphere(&mut self, body: &Placed) {
        let (m, from) = (body.sphere_weight, body.from_centre);
        self.c += m * dot(&from, &from);
        (0..3).for_each(|i| self.g[i] += 2.0 * m * from[i]);
        (0..3).for_each(|i| self.h[i] += m);
    }

    fn minus(&self, other: &Self) -> Self {
        Self {
            c: self.c - other.c,
            g: std::array::from_fn(|i| self.g[i] - other.g[i]),
            h: std::array::from_fn(|i| self.h[i] - other.h[i]),
        }
    }
}

/// S_A and S_A − S_B where the active planes do not change; without B the patch lies in the plane.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Form {
    s: Quadratic,
    d: Option<Quadratic>,
}

impl Form {
    /// With these planes active, a bit each.
    pub fn new(field: &Field, active: u128) -> Self {
        let mut sums = [Quadratic::default(); 2];
        for (_, plane) in field.planes.iter().enumerate().filter(|(i, _)| active >> i & 1 == 1) {
            let body = usize::from(plane.owner == Owner::B);
            sums[body].add_plane(field.plane_weight(plane.owner), plane.excess, plane.normal);
        }
        for (sum, body) in sums.iter_mut().zip([Some(&field.a), field.b.as_ref()]) {
            body.into_iter().for_each(|body| sum.add_sphere(body));
        }
        Self { s: sums[0], d: field.b.is_some().then(|| sums[0].minus(&sums[1])) }
    }

    /// The point of the patch above (u, v), of weight 1; `None` where the patch is no graph.
    #[inline(always)]
    pub fn node(&self, [u, v]: [f64; 2]) -> Option<Node> {
        let (mut z, mut normal) = (0.0, [0.0; 2]);
        if let Some(Quadratic { c, g, h }) = &self.d {
            let slope = g[2] + h[4] * u + h[5] * v;
            let value = c + u * (g[0] + h[0] * u + h[3] * v) + v * (g[1] + h[1] * v);
            let discriminant = slope * slope - 4.0 * h[2] * value;
            if !(discriminant > 0.0) {
                return None;
            }
            let rise = discriminant.sqrt();
            z = if slope > 0.0 { -2.0 * value / (slope + rise) } else { (rise - slope) / (2.0 * h[2]) };
            let run = 1.0 / rise;
            let by_u = g[0] + 2.0 * h[0] * u + h[3] * v + h[4] * z;
            let by_v = g[1] + 2.0 * h[1] * v + h[3] * u + h[5] * z;
            normal = [by_u * run, by_v * run];
        }
        let Quadratic { c, g, h } = &self.s;
        let s =
            c + u * (g[0] + h[0] * u + h[3] * v + h[4] * z) + v * (g[1] + h[1] * v + h[5] * z) + z * (g[2] + h[2] * z);
        // The parabola of an arc may lie beyond the rim.
        let pressure = (1.0 - s.max(0.0).sqrt()).max(0.0);
        z.is_finite().then_some(Node { x: [u, v, z], weight: 1.0, pressure, normal })
    }
}
