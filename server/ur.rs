//! What a CB3 controller of a UR5 says and understands, without sockets.
//!
//! - [`arm`]: the arm at a moment, as the controller reports it.
//! - [`rtde`]: frames of the Real-Time Data Exchange; recipes.
//! - [`dashboard`]: lines and their answers.
//!
//! Source: Universal Robots, "Real-Time Data Exchange (RTDE) Guide" and "Dashboard Server CB-Series".

pub mod arm;
pub mod dashboard;
pub mod rtde;

pub use arm::{Arm, Reports};
