//! Ferry: a browser laboratory in which a UR5 carries a magnetic bead through an intestine.
//!
//! The modules, lowest floor first. A module imports only from floors below it; the test
//! `tests/house.rs` walks the imports. `ARCHITECTURE.md` lists what each must never know.
//!
//! - floor 0: [`schema`], [`names`]: arrays in the description of the API; names of things that users add.
//! - floor 1: [`geometry`]: frames, poses, shapes.
//! - floor 2: [`image`], [`robot`], [`magnetics`], [`map`]: one subject each.
//! - floor 3: [`plant`]: arm, bead, contact, disturbance.
//! - floor 4: [`scenario`], [`tracking`], [`perception`]: set-up of a trial; position; percept.
//! - floor 5: [`policy`]: network, weights, manifest.
//! - floor 6: [`control`]: switching law, sub-controllers 1 and 2, limits.
//! - floor 7: [`trial`], [`files`]: one episode as a pure, deterministic loop; bounded files.
//! - floor 8: [`challenge`], [`program`], [`ur`], [`camera`], [`open`]: a trial for a person's hand: its score and ghosts; questions
//!   to a program; what the robot's controller says; images by a graphics device; files of what trials
//!   are made of.
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
pub mod challenge;
pub mod cli;
pub mod control;
pub mod evaluate;
pub mod export;
mod faults;
pub mod files;
pub mod geometry;
pub mod http;
pub mod image;
pub mod jobs;
pub mod learn;
pub mod magnetics;
pub mod map;
pub mod names;
pub mod open;
pub mod perception;
pub mod plant;
pub mod policy;
pub mod program;
pub mod protocol;
pub mod recording;
pub mod recovery;
pub mod robot;
mod robot_client;
pub mod robot_server;
pub mod scenario;
pub mod schema;
pub mod session;
pub mod tracking;
pub mod trial;
pub mod ur;
