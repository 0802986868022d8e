//! Programs for a UR5 read Ferry's arm: the unmodified `ur_rtde` from PyPI.

use std::process::Command;

use serde_json::{Value, json};

use crate::support::{Browser, Ferry, ferry, tool};

/// Only this test uses this address.
const ADDRESS: &str = "127.0.28.100";

fn read(seconds: &str) -> Value {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/read_robot.py");
    let output = Command::new(tool("python")).args([script, ADDRESS, seconds]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout).unwrap();
    serde_json::from_str(printed.lines().last().unwrap()).unwrap()
}

async fn reading(seconds: &'static str) -> Value {
    tokio::task::spawn_blocking(move || read(seconds)).await.unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn ur_rtde_reads_the_arm_of_the_session_main() {
    let data = tempfile::tempdir().unwrap();
    let mut command = ferry(&["serve", "--bind", "127.0.0.1:0", "--robot-server", ADDRESS, "--data"]);
    let server = Ferry::start(command.arg(data.path()).stderr(std::process::Stdio::null()));
    let mut browser = Browser::at(server.address).await;
    let start = json!({"type": "load_scenario", "map": "open", "start_m": [-0.2, -0.35], "goal_m": [0.2, -0.35]});
    browser.send(start).await;
    browser.state("the start", |state| (number(&state["tool_m"][0]) + 0.2).abs() < 1e-3).await;

    let paused = reading("0.2").await;
    assert!(paused["version"].as_str().unwrap().starts_with("3.15."), "{paused}");
    assert_eq!((&paused["mode"], &paused["model"]), (&json!("Robotmode: RUNNING"), &json!("UR5")));
    assert_eq!((&paused["robot_mode"], &paused["safety_mode"]), (&json!(7), &json!(1)));
    assert_eq!((&paused["simulated_s"], &paused["protective_stop"]), (&json!(0.0), &json!(false)));
    assert!((number(&paused["tool"][0]) + 0.2).abs() < 1e-3, "{paused}");

    browser.send(json!({"type": "run"})).await;
    let running = reading("4").await;
    assert_eq!(running["reconnected"], true);
    // Not faster than real time. A busy machine is slower, and skips frames.
    let share = number(&running["simulated_s"]) / number(&running["seconds"]);
    assert!((0.2..1.1).contains(&share), "{running}");
    assert!(number(&running["frames"]) > 0.3 * 125.0 * number(&running["simulated_s"]), "{running}");
    assert!(number(&running["force"][2]) < 0.0, "the bead pulls the magnet down: {running}");

    browser.send(json!({"type": "pause"})).await;
    let state = browser.state("paused", |state| state["running"] == false && state["tick"].as_u64() > Some(100)).await;
    let last = reading("0.2").await;
    for receiver in 0..2 {
        for joint in 0..6 {
            let difference = number(&last["q"][receiver][joint]) - number(&state["joints_rad"][joint]);
            assert!(difference.abs() < 1e-6, "{last} {state}");
        }
    }
}

#[test]
fn other_addresses_than_loopback_must_be_meant() {
    let refused = ferry(&["serve", "--robot-server", "0.0.0.0"]).output().unwrap();
    assert!(!refused.status.success());
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(said.contains("--robot-server 0.0.0.0") && said.contains("--robot-server-insecure"), "{said}");
}
