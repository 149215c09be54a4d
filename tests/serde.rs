//! The feature `serde`: what is written down is read back to the last bit, and what no constructor would take is
//! refused.

use potential_particles::rock;
use potential_particles::shapes::{self, Rounding};
use potential_particles::{
    BackEnd, Contact, Formulation, Kind, PairState, Particle, Plane, Pose, Role, Section, Settings, closest_point,
    detect,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn there_and_back<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let text = serde_json::to_string(value).expect("written");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn cube() -> Particle {
    let mut planes = Vec::new();
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let mut row = [0.0, 0.0, 0.0, 0.9];
            row[axis] = sign;
            planes.push(there_and_back(&Plane::from(row)));
        }
    }
    Particle::new(&planes, 0.1, 0.1, 1.2).expect("a cube")
}

#[test]
fn everything_comes_back() {
    let cube = cube();
    let here = Pose::new([0.1, 0.2, 0.3], [2.0, 0.1, 0.2, 0.3]).unwrap();
    for (distance, formulation) in [(1.7, Formulation::Midway), (1.7, Formulation::Closest), (2.5, Formulation::Midway)]
    {
        let there = Pose::new([0.0, 0.1, distance], [1.0, 0.0, 0.0, 1.0 / 3.0]).unwrap();
        let settings = Settings::default()
            .with_formulation(formulation)
            .with_gap_tolerance(1.0 / 3e11)
            .with_carry_tolerance(1e-9 / 3.0);
        assert_eq!(there_and_back(&here), here);
        assert_eq!(there_and_back(&there), there);
        assert_eq!(there_and_back(&settings), settings);
        let mut state = PairState::default();
        assert_eq!(there_and_back(&state).into_raw(), state.into_raw());
        let contact = detect(&cube, &here, &cube, &there, &settings, Some(&mut state)).unwrap();
        assert_eq!(there_and_back(&state).into_raw(), state.into_raw());
        let back = there_and_back(&contact);
        assert_eq!(back, contact);
        if contact.kind == Kind::Overlapping {
            let area = |contact: &Contact| Section::from(contact).area(&cube, &here, &cube, &there, 1e-6).unwrap();
            assert_eq!(area(&back), area(&contact));
        }
        assert!(closest_point(&cube, &here, &cube, &there, Role::A, &settings).unwrap().is_some());
    }
}

#[test]
fn names_are_those_of_the_documentation() {
    assert_eq!(serde_json::to_string(&Kind::Overlapping).unwrap(), r#""overlapping""#);
    assert_eq!(serde_json::to_string(&BackEnd::ConeProgram).unwrap(), r#""cone_program""#);
    assert_eq!(
        serde_json::from_str::<BackEnd>(r#""conic""#).unwrap(),
        BackEnd::ConeProgram,
        "its name in earlier files"
    );
    let settings: Settings = serde_json::from_str(r#"{"formulation": "closest"}"#).unwrap();
    assert_eq!(settings, Settings::default().with_formulation(Formulation::Closest));
}

#[test]
fn particles_shapes_and_rock_come_back() {
    let particle = cube();
    let back = there_and_back(&particle);
    assert!(back.planes().eq(particle.planes()) && back.shadow_radius() == particle.shadow_radius());
    let shape = shapes::prism(5, 1.0, 2.0, &Rounding::default()).unwrap();
    let back = there_and_back(&shape);
    assert!(back.mass == shape.mass && back.orientation == shape.orientation && back.centroid == shape.centroid);
    let sides = particle.planes().collect::<Vec<_>>();
    let mass = rock::slice(&sides, &[rock::Joint::new([0.0; 3], 30.0, 40.0).unwrap()], &Default::default()).unwrap();
    assert_eq!(format!("{:?}", there_and_back(&mass)), format!("{mass:?}"));
}

#[test]
fn what_no_constructor_takes_is_refused() {
    let particle = r#"{"planes": [], "r": 0.1, "k": 2.0, "shadow_radius": 1.0}"#;
    let error = serde_json::from_str::<Particle>(particle).unwrap_err().to_string();
    assert!(error.contains("k=2"), "{error}");
    let pose = r#"{"position": [0, 0, 0], "orientation": [0, 0, 0, 0]}"#;
    let error = serde_json::from_str::<Pose>(pose).unwrap_err().to_string();
    assert!(error.contains("orientation"), "{error}");
    let error = serde_json::from_str::<Settings>(r#"{"weight_on_a": 2.0}"#).unwrap_err().to_string();
    assert!(error.contains("weight_on_a=2"), "{error}");
    assert!(serde_json::from_str::<Settings>(r#"{"tolerance": 1e-9}"#).is_err());
    assert!(serde_json::from_str::<Formulation>(r#""half way""#).is_err());
}
