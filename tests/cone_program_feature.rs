//! The cone-program back end answers where it was built in, and is refused by name where it was left out; the fast one
//! does without it.
//!
//!     cargo test --no-default-features --features capi --test cone_program_feature
#![allow(unsafe_code)]

use potential_particles::{BackEnd, DetectError, Kind, Particle, Pose, Settings, SettingsError, detect};

#[test]
fn the_cone_program_back_end_is_there_or_refused_by_name() {
    let ball = Particle::sphere(1.0).unwrap();
    let (left, right) = (Pose::at([0.0; 3]).unwrap(), Pose::at([1.5, 0.0, 0.0]).unwrap());
    let by = |back_end| detect(&ball, &left, &ball, &right, &Settings::default().with_back_end(back_end), None);
    assert_eq!(by(BackEnd::Fast).unwrap().kind, Kind::Overlapping);
    match by(BackEnd::ConeProgram) {
        Ok(contact) => {
            assert!(cfg!(feature = "cone-program") && contact.back_end == BackEnd::ConeProgram, "{contact:?}")
        }
        Err(error) => {
            let built_in = cfg!(feature = "cone-program");
            assert!(!built_in, "{error}");
            assert!(matches!(error, DetectError::Settings(SettingsError::NoConeProgram)), "{error}");
            assert!(error.to_string().contains("Cargo feature cone-program"), "{error}");
        }
    }
}

#[cfg(feature = "capi")]
#[test]
fn so_it_is_in_c() {
    use potential_particles::capi::*;
    use std::mem::MaybeUninit;
    use std::ptr;
    let expected = if cfg!(feature = "cone-program") { PP_OK } else { PP_NO_CONE_PROGRAM };
    unsafe {
        let mut ball = ptr::null_mut();
        assert_eq!(pp_particle_new(ptr::null(), 0, 0.0, 1.0, 1.0, &mut ball, ptr::null_mut(), 0), PP_OK);
        let mut settings = MaybeUninit::uninit();
        assert_eq!(pp_settings_default(settings.as_mut_ptr()), PP_OK);
        let settings = settings.assume_init().with_back_end(BackEnd::ConeProgram);
        let [left, right] = [0.0, 1.5].map(|x| pp_pose { position: [x, 0.0, 0.0], orientation: [1.0, 0.0, 0.0, 0.0] });
        let mut contact = MaybeUninit::uninit();
        let memory = ptr::null_mut();
        assert_eq!(pp_contact_detect(ball, &left, ball, &right, &settings, memory, contact.as_mut_ptr()), expected);
        let mut point = MaybeUninit::uninit();
        assert_eq!(pp_closest_point(ball, &left, ball, &right, PP_ON_A, &settings, point.as_mut_ptr()), expected);
        let sentence = std::ffi::CStr::from_ptr(pp_status_message(PP_NO_CONE_PROGRAM)).to_str().unwrap();
        assert!(sentence.contains("feature cone-program"), "{sentence}");
        pp_particle_free(ball);
    }
}
