//! Ferry's laboratory as pure code: it reads no file and no clock, opens no socket and starts no thread, so the same trial
//! runs in a server, in a test and in a browser.
//!
//! The modules, lowest floor first. A module imports only from floors below it; the test
//! `tests/house.rs` walks the imports. `ARCHITECTURE.md` lists what each must never know.
//!
//! - floor 0: [`names`], [`panics`], `schema`: names of things that users add; messages of panics; arrays in the description
//!   of the API.
//! - floor 1: [`geometry`]: frames, poses, shapes.
//! - floor 2: [`image`], [`robot`], [`magnetics`], [`map`]: one subject each.
//! - floor 3: [`plant`]: arm, bead, contact, disturbance.
//! - floor 4: [`scenario`], [`tracking`], [`perception`]: set-up of a trial; position; percept.
//! - floor 5: [`policy`]: network, weights, manifest.
//! - floor 6: [`control`]: switching law, sub-controllers 1 and 2, limits.
//! - floor 7: [`trial`]: one episode as a pure, deterministic loop.
//! - floor 8: [`challenge`]: a trial for a person's hand: its score and ghosts.
//! - floor 9: [`session`]: a trial with its past and its pace, as a state machine that carries out an operator's commands.

pub mod challenge;
pub mod control;
pub mod facts;
pub mod geometry;
pub mod image;
pub mod magnetics;
pub mod map;
pub mod names;
pub mod panics;
pub mod perception;
pub mod plant;
pub mod policy;
pub mod robot;
pub mod scenario;
#[cfg(feature = "schema")]
pub mod schema;
pub mod session;
pub mod tracking;
pub mod trial;
