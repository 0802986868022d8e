//! The dashboard: one line in, one line out.

use super::Arm;

/// The first line of a connection.
pub const GREETING: &str = "Connected: Universal Robots Dashboard Server";
/// A controller of the CB3 series: newer ones want to be put into remote control first.
pub const VERSION: [u32; 4] = [3, 15, 8, 0];
/// Longest line that is read.
pub const LINE_BYTES_MOST: usize = 1024;

/// The answer to a line, without the line's end.
pub fn answer(line: &str, arm: &Arm) -> String {
    let line = line.trim();
    let name = line.to_ascii_lowercase();
    match name.as_str() {
        "polyscopeversion" => {
            let [major, minor, patch, _] = VERSION;
            format!("URSoftware {major}.{minor}.{patch}.106339 (simulated by Ferry)")
        }
        "get robot model" => "UR5".to_owned(),
        "robotmode" => format!("Robotmode: {}", if arm.has_joints { "RUNNING" } else { "DISCONNECTED" }),
        "safetymode" => "Safetymode: NORMAL".to_owned(),
        "safetystatus" => "Safetystatus: NORMAL".to_owned(),
        "running" => "Program running: false".to_owned(),
        "programstate" => "STOPPED <unnamed>".to_owned(),
        "get loaded program" => "No program loaded".to_owned(),
        "isprogramsaved" => "true <unnamed>".to_owned(),
        "quit" | "exit" => "Disconnected".to_owned(),
        "play" | "stop" | "pause" => format!("Failed to execute: {name}"),
        _ => format!("could not understand: '{line}'"),
    }
}

/// Whether the connection ends after the answer to this line.
pub fn ends(line: &str) -> bool {
    matches!(line.trim().to_ascii_lowercase().as_str(), "quit" | "exit")
}
