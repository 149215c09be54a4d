//! The C interface called from Rust, small enough for Miri, which checks every access to memory:
//!
//!     cargo +nightly miri test --test ffi
//!
//! (with MIRIFLAGS=-Zmiri-disable-isolation where the clock is wanted). Everything else about it: tests/c.
#![allow(unsafe_code)]

use potential_particles::capi::*;
use std::mem::MaybeUninit;
use std::ptr;

const CUBE: [[f64; 4]; 6] = [
    [1.0, 0.0, 0.0, 0.4],
    [-1.0, 0.0, 0.0, 0.4],
    [0.0, 1.0, 0.0, 0.4],
    [0.0, -1.0, 0.0, 0.4],
    [0.0, 0.0, 1.0, 0.4],
    [0.0, 0.0, -1.0, 0.4],
];

fn cube(k: f64) -> *mut pp_particle {
    let mut out = ptr::null_mut();
    let status = unsafe { pp_particle_new(CUBE.as_ptr().cast(), 6, 0.1, k, 0.9, &mut out, ptr::null_mut(), 0) };
    assert_eq!(status, PP_OK);
    out
}

fn pose(x: f64, y: f64, z: f64) -> pp_pose {
    pp_pose { position: [x, y, z], orientation: [1.0, 0.1, 0.2, 0.3] }
}

#[test]
fn a_contact_is_found_and_everything_is_given_back() {
    let (a, b) = (cube(0.1), cube(0.0));
    let mut memory = pp_memory::default();
    for step in 0..3 {
        let (at_a, at_b) = (pose(0.0, 0.0, 0.0), pose(0.2, 0.1, 0.93 - 0.01 * f64::from(step)));
        // Outputs may be uninitialised: they are only written.
        let mut contact = MaybeUninit::<pp_contact>::uninit();
        let status = unsafe { pp_contact_detect(a, &at_a, b, &at_b, ptr::null(), &mut memory, contact.as_mut_ptr()) };
        assert_eq!(status, PP_OK);
        let contact = unsafe { contact.assume_init() };
        assert_eq!(contact.kind, PP_OVERLAPPING);
        let mut area = MaybeUninit::uninit();
        let status = unsafe { pp_contact_area(a, &at_a, b, &at_b, &contact, 1e-2, area.as_mut_ptr()) };
        assert_eq!(status, PP_OK);
        assert!(unsafe { area.assume_init() } > 0.0);
    }
    unsafe {
        pp_particle_free(a);
        pp_particle_free(b);
        pp_particle_free(ptr::null_mut());
    }
}

#[test]
fn one_particle_may_be_both_and_the_same_pose_too() {
    let body = cube(0.1);
    let at = pose(1e7, 2.0, 3.0);
    let mut contact = MaybeUninit::<pp_contact>::uninit();
    let status = unsafe { pp_contact_detect(body, &at, body, &at, ptr::null(), ptr::null_mut(), contact.as_mut_ptr()) };
    assert_eq!(status, PP_OK);
    assert_eq!(unsafe { contact.assume_init() }.kind, PP_OVERLAPPING);
    unsafe { pp_particle_free(body) };
}

#[test]
fn messages_fit_any_buffer() {
    for size in [0_usize, 1, 2, 20, PP_MESSAGE_SIZE] {
        let mut buffer = vec![0x5A_u8; size];
        let mut out = ptr::null_mut();
        let status = unsafe {
            pp_particle_new(CUBE.as_ptr().cast(), 6, f64::NAN, 0.1, 0.9, &mut out, buffer.as_mut_ptr().cast(), size)
        };
        assert_eq!(status, PP_BAD_ROUNDING_RADIUS);
        assert!(size == 0 || buffer.contains(&0), "the message of {size} bytes has no end");
    }
}

#[test]
fn what_can_be_asked_of_a_particle() {
    let body = cube(0.2);
    let at = pose(0.0, 0.0, 0.0);
    unsafe {
        let mut f = MaybeUninit::uninit();
        let mut gradient = MaybeUninit::<[f64; 3]>::uninit();
        let point = [0.1, 0.2, 0.6];
        assert_eq!(
            pp_particle_potential(body, &at, point.as_ptr(), f.as_mut_ptr(), gradient.as_mut_ptr().cast()),
            PP_OK
        );
        assert!(f.assume_init().is_finite() && gradient.assume_init().iter().all(|g| g.is_finite()));
        let mut count = MaybeUninit::uninit();
        assert_eq!(pp_particle_corners(body, ptr::null_mut(), 0, count.as_mut_ptr()), PP_BUFFER_TOO_SMALL);
        let count = count.assume_init();
        let mut corners = vec![0.0; 3 * count];
        let mut again = 0;
        assert_eq!(pp_particle_corners(body, corners.as_mut_ptr(), count, &mut again), PP_OK);
        assert_eq!(again, count);
        let (mut lower, mut upper) = ([0.0; 3], [0.0; 3]);
        assert_eq!(pp_particle_box(body, &at, lower.as_mut_ptr(), upper.as_mut_ptr()), PP_OK);
        assert!(lower.iter().zip(&upper).all(|(low, high)| low < high));
        pp_particle_free(body);
    }
}

#[test]
fn threads_share_a_particle() {
    struct Shared(*mut pp_particle);
    // SAFETY: particles never change after creation.
    unsafe impl Sync for Shared {}
    let body = Shared(cube(0.1));
    std::thread::scope(|scope| {
        for thread in 0..3 {
            let body = &body;
            scope.spawn(move || {
                let (at_a, at_b) = (pose(0.0, 0.0, 0.0), pose(0.1, 0.0, 0.9 + 0.01 * f64::from(thread)));
                let mut contact = MaybeUninit::<pp_contact>::uninit();
                let settings = ptr::null();
                let memory = ptr::null_mut();
                let status =
                    unsafe { pp_contact_detect(body.0, &at_a, body.0, &at_b, settings, memory, contact.as_mut_ptr()) };
                assert_eq!(status, PP_OK);
            });
        }
    });
    unsafe { pp_particle_free(body.0) };
}
