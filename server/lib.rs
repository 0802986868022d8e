//! Ferry: a browser laboratory in which a UR5 carries a magnetic bead through an intestine.
//!
//! The crate `ferry_core` has the floors below: the trial and what it is made of. The modules here, lowest floor first. A
//! module imports only from floors below it; the test `tests/house.rs` walks the imports. `ARCHITECTURE.md` lists what each
//! must never know.
//!
//! - floor 7: [`files`]: bounded files.
//! - floor 8: [`program`], [`ur`], [`camera`], [`open`]: questions to a program; what the robot's controller says; images by a
//!   graphics device; files of what trials are made of.
//! - floor 9: [`jobs`], [`export`]: the queue of background jobs; models of the arm for other programs.
//! - floor 10: [`learn`], [`evaluate`], [`session`], [`boards`]: training; trials in bulk; a trial on a real clock; the
//!   boards of challenges.
//! - floor 11: [`recovery`]: disturbances from one moment, in bulk.
//! - floor 12: [`recording`], [`protocol`]: Rerun; every wire type.
//! - floor 13: [`http`], [`robot_server`]: axum routes and the WebSocket; the ports of a robot's controller.
//! - floor 14: [`cli`]: assembling.

/// Panics here when a test has requested it (see `faults`). Other builds contain nothing.
macro_rules! fault_point {
    ($name:literal) => {
        #[cfg(test)]
        if crate::faults::strikes($name) {
            panic!("injected: {}", $name);
        }
    };
}

pub mod boards;
pub mod camera;
pub mod cli;
pub mod evaluate;
pub mod export;
#[cfg(test)]
mod faults;
pub mod files;
pub mod http;
pub mod jobs;
pub mod learn;
pub mod open;
pub mod program;
pub mod protocol;
pub mod recording;
pub mod recovery;
mod robot_client;
pub mod robot_server;
pub mod session;
pub mod ur;
