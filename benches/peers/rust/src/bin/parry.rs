//! parry3d-f64: GJK, and EPA where the bodies meet. Ways: contact, intersection (yes or no), distance.
//!
//! A rounded body is its core, and a contact is looked for up to twice the radius: as rapier, parry's own simulation,
//! does.

use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::details::{
    closest_points_support_map_support_map_with_params, contact_support_map_support_map_with_params,
    intersection_test_support_map_support_map_with_params,
};
use parry3d_f64::query::gjk::{GJKResult, VoronoiSimplex};
use parry3d_f64::shape::ConvexPolyhedron;
use peers::scene::{Group, Placement};
use peers::server::{Answer, Contestant, serve};

#[derive(Clone, Copy, PartialEq)]
enum Way {
    Contact,
    Intersection,
    Distance,
}

struct Parry {
    way: Way,
    shape: ConvexPolyhedron,
    swept: f64,
    a: Vec<Pose>,
    b: Vec<Vec<Pose>>,
    /// The last direction of each pair, in the frame of A.
    directions: Vec<Option<Vector>>,
    simplex: VoronoiSimplex,
    answers: Vec<Answer>,
}

fn main() {
    serve(|group, way| {
        let way = match way {
            "contact" => Way::Contact,
            "intersection" => Way::Intersection,
            "distance" => Way::Distance,
            _ => return None,
        };
        Some(Box::new(Parry::new(group, way)))
    });
}

impl Parry {
    fn new(group: &Group, way: Way) -> Self {
        let corners: Vec<Vector> = group.corners.iter().map(|&corner| Vector::from(corner)).collect();
        let times = group.pairs[0].b.len();
        Self {
            way,
            shape: ConvexPolyhedron::from_convex_hull(&corners).expect("a hull"),
            swept: group.swept,
            a: group.pairs.iter().map(|pair| pose(&pair.a)).collect(),
            b: (0..times).map(|time| group.pairs.iter().map(|pair| pose(&pair.b[time])).collect()).collect(),
            directions: vec![None; group.pairs.len()],
            simplex: VoronoiSimplex::new(),
            answers: vec![Answer::Failed; group.pairs.len()],
        }
    }

    fn call(&mut self, a: &Pose, b: &Pose, direction: Option<Vector>) -> (Answer, Option<Vector>) {
        let relative = a.inv_mul(b);
        let (shape, simplex) = (&self.shape, &mut self.simplex);
        let reach = 2.0 * self.swept;
        let found = match self.way {
            Way::Contact => {
                contact_support_map_support_map_with_params(&relative, shape, shape, reach, simplex, direction)
            }
            Way::Distance => {
                let far = f64::MAX;
                closest_points_support_map_support_map_with_params(&relative, shape, shape, far, simplex, direction)
            }
            Way::Intersection => {
                let (meet, direction) =
                    intersection_test_support_map_support_map_with_params(&relative, shape, shape, simplex, direction);
                let nothing = Answer::Found { overlap: f64::NAN, point: [f64::NAN; 3], normal: [f64::NAN; 3] };
                return (if meet { nothing } else { Answer::Apart }, Some(direction));
            }
        };
        match found {
            GJKResult::ClosestPoints(on_a, on_b, normal) => {
                // Both points are in the frame of A.
                let overlap = reach - (on_b - on_a).dot(normal);
                let (point, world) = (a.transform_point(0.5 * (on_a + on_b)), a.transform_vector(normal));
                if self.way == Way::Contact && overlap < 0.0 {
                    return (Answer::Apart, Some(normal));
                }
                (Answer::Found { overlap, point: point.into(), normal: world.into() }, Some(normal))
            }
            GJKResult::NoIntersection(direction) if self.way == Way::Contact => (Answer::Apart, Some(direction)),
            _ => (Answer::Failed, None),
        }
    }
}

impl Contestant for Parry {
    fn pass(&mut self, time: usize, warm: bool) {
        for i in 0..self.a.len() {
            let (a, b) = (self.a[i], self.b[time][i]);
            let (answer, direction) = self.call(&a, &b, if warm { self.directions[i] } else { None });
            self.answers[i] = answer;
            self.directions[i] = direction;
        }
    }

    fn answers(&self) -> &[Answer] {
        &self.answers
    }
}

fn pose(placement: &Placement) -> Pose {
    let [w, x, y, z] = placement.orientation;
    Pose::from_parts(Vector::from(placement.position), Rotation::from_xyzw(x, y, z, w).normalize())
}
