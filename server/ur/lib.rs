//! What a CB3 controller of a UR5 and its clients say to each other.
//!
//! - [`arm`]: the arm at a moment, as the controller reports it.
//! - [`command`], [`mover`]: motions, and the joints that they lead to, tick by tick.
//! - [`script`], [`control_script`]: programs that are sent to the robot.
//! - [`model`]: the arm that the controller takes its own for.
//! - [`controller`], [`robot`]: who is connected, what runs, the protective stop; shared by the session and the sockets.
//! - [`news`], [`refusals`]: what the session reports of them, and what clients are told.
//! - [`rtde`]: frames of the Real-Time Data Exchange; recipes.
//! - [`dashboard`]: lines and their answers.
//! - [`server`]: the ports.
//!
//! And the other side, for a robot outside of Ferry:
//! - [`peer`]: what Ferry asks for by RTDE, and how it reads and writes it.
//! - [`twin`]: what the robot reports, and whether it follows Ferry's controllers.
//! - [`drive_script`]: the program on the robot that follows them.
//! - [`client`]: the connection.
//!
//! Source: Universal Robots, "Real-Time Data Exchange (RTDE) Guide" and "Dashboard Server CB-Series".

pub mod arm;
pub mod client;
pub mod command;
pub mod control_script;
pub mod controller;
pub mod dashboard;
pub mod drive_script;
pub mod inputs;
pub mod model;
pub mod mover;
pub mod news;
pub mod peer;
pub mod refusals;
pub mod registers;
pub mod robot;
pub mod rtde;
pub mod script;
pub mod server;
pub mod twin;

pub use arm::Arm;
pub use controller::Standing;
pub use robot::Robot;
pub use twin::{Twin, TwinStanding};
