//! Injected faults: a session's thread fails at its next tick when a test wants it.

use std::sync::{Mutex, PoisonError};
use std::time::Duration;

#[derive(Clone, Copy, Debug)]
pub enum Fault {
    Panic,
    /// Longer than anything waits for a session.
    Hang,
}

/// Names of threads, and how they fail. Shared by all tests.
static ARMED: Mutex<Vec<(String, Fault)>> = Mutex::new(Vec::new());

/// Makes the thread of this session fail once.
pub fn arm(session: &str, fault: Fault) {
    ARMED.lock().unwrap_or_else(PoisonError::into_inner).push((format!("session {session}"), fault));
}

/// Fails here, if a test wants it.
pub fn strike() {
    let here = std::thread::current();
    let fault = {
        let mut armed = ARMED.lock().unwrap_or_else(PoisonError::into_inner);
        let found = armed.iter().position(|(thread, _)| here.name() == Some(thread));
        found.map(|index| armed.swap_remove(index).1)
    };
    match fault {
        None => {}
        Some(Fault::Panic) => panic!("injected panic"),
        Some(Fault::Hang) => std::thread::sleep(Duration::from_secs(14)),
    }
}
