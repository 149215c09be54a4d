//! Nothing but a status crosses the boundary: the body of every function, within which panics are caught.

use super::status::{PP_INTERNAL_ERROR, PP_OK, pp_status};
use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::thread;

thread_local! {
    /// Whether this thread is inside a call of the C interface.
    static INSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Runs `body`; a panic becomes `PP_INTERNAL_ERROR`, an `Err` its status.
///
/// Outputs are written by `body` as its last step only, so that an early return leaves them
/// untouched; that is why unwinding through it is safe.
#[inline]
pub(super) fn fenced(body: impl FnOnce() -> Result<(), pp_status>) -> pp_status {
    silence_panics_inside();
    // Kept in a variable: in a shared library each access of a thread-local is a call.
    let outcome = INSIDE.with(|inside| {
        let outer = inside.replace(true);
        let outcome = catch_unwind(AssertUnwindSafe(body));
        inside.set(outer);
        outcome
    });
    match outcome {
        Ok(Ok(())) => PP_OK,
        Ok(Err(status)) => status,
        Err(_) => PP_INTERNAL_ERROR,
    }
}

/// Lets a panic inside a fence print nothing: the caller learns of it by its status, and a library does not write to
/// the caller's terminal.
///
/// Only the panic hook can do that, since it runs before any unwinding is caught. It is of the Rust runtime in this
/// shared library, which no other library shares; in a Rust program that uses this crate it is the program's. So
/// whatever hook there was still gets every panic from outside the fences.
#[inline]
fn silence_panics_inside() {
    static DONE: Once = Once::new();
    // A call from a destructor that runs in a panic may not set the hook: the next call will.
    if !DONE.is_completed() && !thread::panicking() {
        DONE.call_once(|| {
            let previous = panic::take_hook();
            panic::set_hook(Box::new(move |panic| {
                if !INSIDE.get() {
                    previous(panic);
                }
            }));
        });
    }
}

/// The body of a C function: its arguments are taken, an array as `rows[count]`, then the code finds them under their
/// own names and ends in a `Result`.
macro_rules! call {
    ([$($argument:ident $([$count:ident])?),*], $body:expr) => {
        $crate::capi::fence::fenced(|| {
            $(let $argument = $crate::capi::argument::take!($argument $([$count])?)?;)*
            $body
        })
    };
}
pub(super) use call;

/// The same where the code ends in an answer for an [`Output`](super::output::Output).
macro_rules! give {
    ($out:expr, [$($argument:ident $([$count:ident])?),*], $body:expr) => {
        $crate::capi::fence::call!([$($argument $([$count])?),*], {
            let body = || $body;
            // SAFETY: as the caller has promised.
            unsafe { $crate::capi::output::written($out, std::convert::identity, body) }
        })
    };
}
pub(super) use give;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::capi::PP_NULL_POINTER;
    use std::process::Command;

    /// In a process of its own, since what is printed is the point, and the hook is one for all.
    #[test]
    #[cfg_attr(miri, ignore = "starts a process")]
    fn a_panic_inside_prints_nothing_and_one_outside_does() {
        let this = std::env::current_exe().unwrap();
        let child = ["--exact", "capi::fence::tests::child", "--ignored", "--nocapture", "--test-threads=1"];
        let run = Command::new(this).args(child).output().unwrap();
        let printed = String::from_utf8_lossy(&run.stderr);
        assert!(run.status.success(), "{printed}");
        assert!(!printed.contains("from inside"), "{printed}");
        assert!(printed.contains("from outside"), "{printed}");
    }

    #[test]
    #[ignore = "run by the test above"]
    fn child() {
        assert_eq!(fenced(|| panic!("from inside")), PP_INTERNAL_ERROR);
        // The fence inside another leaves that one closed.
        let nested = || {
            assert_eq!(fenced(|| Err(PP_NULL_POINTER)), PP_NULL_POINTER);
            panic!("from inside, after another call")
        };
        assert_eq!(fenced(nested), PP_INTERNAL_ERROR);
        assert!(catch_unwind(|| panic!("from outside")).is_err());
    }
}
