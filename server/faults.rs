//! Faults on purpose: in tests, a point in the code fails on the thread that a test has named. Nothing of it is in a
//! build that is not a test of this library.

use std::sync::{Mutex, PoisonError};

/// Threads, and the points at which they are to fail. Shared by all tests.
static ARMED: Mutex<Vec<(String, &str)>> = Mutex::new(Vec::new());

/// Has the thread of that name fail when it comes to the point; once.
pub fn arm(thread: &str, point: &'static str) {
    ARMED.lock().unwrap_or_else(PoisonError::into_inner).push((thread.to_owned(), point));
}

/// Whether this thread is to fail here, now.
pub fn strikes(point: &str) -> bool {
    let mut armed = ARMED.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::thread::current();
    let found = armed.iter().position(|(thread, at)| here.name() == Some(thread) && *at == point);
    found.map(|index| armed.swap_remove(index)).is_some()
}
