//! The dashboard: one line in, one line out.

use super::Arm;
use super::controller::Controller;

/// The first line of a connection.
pub const GREETING: &str = "Connected: Universal Robots Dashboard Server";
/// A controller of the CB3 series: newer ones want to be put into remote control first.
pub const VERSION: [u32; 4] = [3, 15, 8, 0];
/// Longest line that is read.
pub const LINE_BYTES_MOST: usize = 1024;

/// Carries a line out. Returns the answer, without the line's end.
pub fn answer(line: &str, arm: &Arm, robot: &mut Controller) -> String {
    let line = line.trim();
    let name = line.to_ascii_lowercase();
    let program = robot.program_name().unwrap_or("<unnamed>").to_owned();
    match name.as_str() {
        "polyscopeversion" => {
            let [major, minor, patch, _] = VERSION;
            format!("URSoftware {major}.{minor}.{patch}.106339 (simulated by Ferry)")
        }
        "get robot model" => robot.model().name.clone(),
        "robotmode" => format!("Robotmode: {}", if arm.has_joints { "RUNNING" } else { "DISCONNECTED" }),
        "safetymode" => format!("Safetymode: {}", safety(robot)),
        "safetystatus" => format!("Safetystatus: {}", safety(robot)),
        "running" => format!("Program running: {}", robot.is_running()),
        "programstate" => format!("{} {program}", if robot.is_running() { "PLAYING" } else { "STOPPED" }),
        "get loaded program" => "No program loaded".to_owned(),
        "isprogramsaved" => format!("true {program}"),
        "stop" => {
            robot.end("the dashboard has stopped it");
            "Stopped".to_owned()
        }
        "unlock protective stop" => {
            robot.unlock();
            "Protective stop releasing".to_owned()
        }
        "close safety popup" => "closing safety popup".to_owned(),
        "close popup" => "closing popup".to_owned(),
        "power on" => "Powering on".to_owned(),
        "brake release" => "Brake releasing".to_owned(),
        "quit" | "exit" => "Disconnected".to_owned(),
        // No program is stored, and the arm cannot be switched off.
        "play" | "pause" | "power off" | "shutdown" => format!("Failed to execute: {name}"),
        _ if name.starts_with("popup ") => "showing popup".to_owned(),
        _ => format!("could not understand: '{line}'"),
    }
}

fn safety(robot: &Controller) -> &'static str {
    if robot.is_stopped() { "PROTECTIVE_STOP" } else { "NORMAL" }
}

/// Whether the connection ends after the answer to this line.
pub fn ends(line: &str) -> bool {
    matches!(line.trim().to_ascii_lowercase().as_str(), "quit" | "exit")
}
