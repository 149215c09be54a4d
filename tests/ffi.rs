//! The C interface called from Rust, small enough for Miri, which checks every access to memory:
//!
//!     cargo +nightly miri test --test ffi
//!
//! (with MIRIFLAGS=-Zmiri-disable-isolation where the clock is wanted). Everything else about it: tests/c.
#![allow(unsafe_code)]

use potential_particles::capi::*;
use potential_particles::{Flags, Kind};
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

const EMPTY: pp_pair_state = pp_pair_state { solution: [0.0; 8], last_contact: [0.0; 40] };

#[test]
fn a_contact_is_found_and_everything_is_given_back() {
    let (a, b) = (cube(0.1), cube(0.0));
    let mut state = EMPTY;
    for step in 0..3 {
        let (at_a, at_b) = (pose(0.0, 0.0, 0.0), pose(0.2, 0.1, 0.93 - 0.01 * f64::from(step)));
        // Outputs may be uninitialised: they are only written.
        let mut contact = MaybeUninit::<pp_contact>::uninit();
        let status = unsafe { pp_contact_detect(a, &at_a, b, &at_b, ptr::null(), &mut state, contact.as_mut_ptr()) };
        assert_eq!(status, PP_OK);
        let contact = unsafe { contact.assume_init() };
        assert_eq!(contact.kind as i32, PP_OVERLAPPING);
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
    assert_eq!(unsafe { contact.assume_init() }.kind as i32, PP_OVERLAPPING);
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
                let state = ptr::null_mut();
                let status =
                    unsafe { pp_contact_detect(body.0, &at_a, body.0, &at_b, settings, state, contact.as_mut_ptr()) };
                assert_eq!(status, PP_OK);
            });
        }
    });
    unsafe { pp_particle_free(body.0) };
}

/// The arrays of a batch are touched where they may be and nowhere else, by one thread or two.
#[test]
fn a_batch_reads_and_writes_its_arrays() {
    let (a, b) = (cube(0.1), cube(0.0));
    let particles = [a.cast_const(), b, a, ptr::null()];
    let poses = [pose(0.0, 0.0, 0.0), pose(0.2, 0.1, 0.93), pose(3.0, 0.0, 0.0), pose(0.0, 0.0, 1.0)];
    let pairs: Vec<[u32; 2]> = (0..150).map(|n| [[0, 1], [0, 2], [1, 3], [2, 9]][n % 4]).collect();
    for threads in [1, 2] {
        let mut states = vec![EMPTY; pairs.len()];
        let mut contacts = vec![MaybeUninit::<pp_contact>::uninit(); pairs.len()];
        let mut statuses = vec![MaybeUninit::<pp_status>::uninit(); pairs.len()];
        let status = unsafe {
            pp_contact_detect_batch(
                particles.as_ptr(),
                poses.as_ptr(),
                particles.len(),
                pairs.as_ptr().cast(),
                pairs.len(),
                ptr::null(),
                threads,
                states.as_mut_ptr(),
                contacts.as_mut_ptr().cast(),
                statuses.as_mut_ptr().cast(),
            )
        };
        assert_eq!(status, PP_OK);
        for (n, status) in statuses.iter().enumerate() {
            let status = unsafe { status.assume_init() };
            assert_eq!(status, [PP_OK, PP_OK, PP_NULL_POINTER, PP_BAD_INDEX][n % 4]);
            if status == PP_OK {
                let contact = unsafe { contacts[n].assume_init() };
                assert_eq!(contact.kind as i32, [PP_OVERLAPPING, PP_SEPARATED][n % 4]);
            }
        }
    }
    unsafe {
        pp_particle_free(a);
        pp_particle_free(b);
    }
}

/// The same with contacts that are carried on; a state is bytes taken for another type.
#[test]
fn a_batch_carries_contacts_on() {
    let body = cube(0.1);
    let (particles, pairs) = ([body.cast_const(), body], [0_u32, 1]);
    let mut state = EMPTY;
    let mut settings = MaybeUninit::<pp_settings>::uninit();
    assert_eq!(unsafe { pp_settings_default(settings.as_mut_ptr()) }, PP_OK);
    let settings = unsafe { settings.assume_init() }.with_carry_tolerance(1e-9);
    for step in 0..3 {
        let poses = [pose(0.0, 0.0, 0.0), pose(0.2, 0.1, 0.93 - 1e-7 * f64::from(step))];
        let (mut contact, mut status) = (MaybeUninit::<pp_contact>::uninit(), MaybeUninit::<pp_status>::uninit());
        let called = unsafe {
            pp_contact_detect_batch(
                particles.as_ptr(),
                poses.as_ptr(),
                2,
                pairs.as_ptr(),
                1,
                &settings,
                1,
                &mut state,
                contact.as_mut_ptr(),
                status.as_mut_ptr(),
            )
        };
        assert_eq!((called, unsafe { status.assume_init() }), (PP_OK, PP_OK));
        assert_eq!(unsafe { contact.assume_init() }.flags.contains(Flags::CARRIED), step > 0);
    }
    unsafe { pp_particle_free(body) };
}

#[test]
fn a_contact_with_a_wall_is_written() {
    let body = cube(0.1);
    let at = pose(0.0, 0.0, 0.45);
    let (point, normal) = ([0.0; 3], [0.0, 0.0, 1.0]);
    let vertices: [f64; 9] = [-1.0, -1.0, 0.0, 2.0, -1.0, 0.0, -1.0, 2.0, 0.0];
    let (settings, state) = (ptr::null(), &mut EMPTY.clone());
    unsafe {
        let mut wall = MaybeUninit::<pp_flat_contact>::uninit();
        let status = pp_contact_plane(body, &at, point.as_ptr(), normal.as_ptr(), settings, state, wall.as_mut_ptr());
        assert_eq!(status, PP_OK);
        let mut facet = MaybeUninit::<pp_flat_contact>::uninit();
        assert_eq!(pp_contact_triangle(body, &at, vertices.as_ptr(), settings, state, facet.as_mut_ptr()), PP_OK);
        let (wall, facet) = (wall.assume_init(), facet.assume_init());
        assert!(wall.kind == Kind::Overlapping && facet.kind == Kind::Overlapping);
        assert!((wall.s - facet.s).abs() <= wall.gap + facet.gap);
        let mut area = MaybeUninit::uninit();
        assert_eq!(pp_flat_contact_area(body, &at, &facet, 1e-6, area.as_mut_ptr()), PP_OK);
        assert!(area.assume_init() > 0.0);
        pp_particle_free(body);
    }
}

#[test]
fn a_closest_point_is_written() {
    let body = cube(0.1);
    let (at_a, at_b) = (pose(0.0, 0.0, 0.0), pose(0.2, 0.1, 0.93));
    let mut point = MaybeUninit::<pp_closest>::uninit();
    let status = unsafe { pp_closest_point(body, &at_a, body, &at_b, PP_ON_A, ptr::null(), point.as_mut_ptr()) };
    assert_eq!(status, PP_OK);
    let point = unsafe { point.assume_init() };
    assert!(point.s < 1.0 && point.gap < 1e-9);
    unsafe { pp_particle_free(body) };
}
