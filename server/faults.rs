//! Injected faults: a point in the code fails on the thread that a test has chosen.

use std::sync::{Mutex, PoisonError};

/// Threads, and the points at which they fail. Shared by all tests.
static ARMED: Mutex<Vec<(String, &str)>> = Mutex::new(Vec::new());

/// Makes the thread with this name fail once, when it reaches the point.
pub fn arm(thread: &str, point: &'static str) {
    ARMED.lock().unwrap_or_else(PoisonError::into_inner).push((thread.to_owned(), point));
}

/// Whether this thread fails here now.
pub fn strikes(point: &str) -> bool {
    let mut armed = ARMED.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::thread::current();
    let found = armed.iter().position(|(thread, at)| here.name() == Some(thread) && *at == point);
    found.map(|index| armed.swap_remove(index)).is_some()
}
