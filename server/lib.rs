//! Ferry: a browser laboratory in which a UR5 carries a magnetic bead through an intestine.
//!
//! The laboratory itself is in the crates below: see `ARCHITECTURE.md`. The modules here, lowest floor first; a module imports
//! only from floors below it, and the test `tests/house.rs` walks the imports.
//!
//! - floor 0: [`boards`], [`export`]: the boards of challenges; models of the arm for other programs.
//! - floor 1: [`session`]: a session on a real clock.
//! - floor 2: [`protocol`]: wire types with a shape of their own.
//! - floor 3: [`http`]: axum routes and the WebSocket.
//! - floor 4: [`cli`]: assembling.

pub mod boards;
pub mod cli;
pub mod export;
#[cfg(test)]
mod faults;
pub mod http;
pub mod protocol;
pub mod session;
