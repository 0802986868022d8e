//! Faults: what a panic said, and those on purpose. In tests, a point in the code fails on the thread that a test has
//! named; nothing of that is in a build that is not a test of this library.

use std::any::Any;
#[cfg(test)]
use std::sync::{Mutex, PoisonError};

/// What a panic said.
pub fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("it panicked without a word").to_owned()
}

/// Threads, and the points at which they are to fail. Shared by all tests.
#[cfg(test)]
static ARMED: Mutex<Vec<(String, &str)>> = Mutex::new(Vec::new());

/// Has the thread of that name fail when it comes to the point; once.
#[cfg(test)]
pub fn arm(thread: &str, point: &'static str) {
    ARMED.lock().unwrap_or_else(PoisonError::into_inner).push((thread.to_owned(), point));
}

/// Whether this thread is to fail here, now.
#[cfg(test)]
pub fn strikes(point: &str) -> bool {
    let mut armed = ARMED.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::thread::current();
    let found = armed.iter().position(|(thread, at)| here.name() == Some(thread) && *at == point);
    found.map(|index| armed.swap_remove(index)).is_some()
}
