//! Panic messages, and injected faults. In tests, a point in the code fails on the thread that a test has chosen; other
//! builds do not contain this code.

use std::any::Any;
#[cfg(test)]
use std::sync::{Mutex, PoisonError};

/// The message of a panic.
pub fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no panic message").to_owned()
}

/// Threads, and the points at which they fail. Shared by all tests.
#[cfg(test)]
static ARMED: Mutex<Vec<(String, &str)>> = Mutex::new(Vec::new());

/// Makes the thread with this name fail once, when it reaches the point.
#[cfg(test)]
pub fn arm(thread: &str, point: &'static str) {
    ARMED.lock().unwrap_or_else(PoisonError::into_inner).push((thread.to_owned(), point));
}

/// Whether this thread fails here now.
#[cfg(test)]
pub fn strikes(point: &str) -> bool {
    let mut armed = ARMED.lock().unwrap_or_else(PoisonError::into_inner);
    let here = std::thread::current();
    let found = armed.iter().position(|(thread, at)| here.name() == Some(thread) && *at == point);
    found.map(|index| armed.swap_remove(index)).is_some()
}
