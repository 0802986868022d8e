//! Programs for a UR5 read and command Ferry's arm: the unmodified `ur_rtde` from PyPI.

use std::process::Command;

use serde_json::{Value, json};

use crate::support::{Browser, Ferry, ferry, tool};

/// Runs a script of this repository, without blocking. Returns what it prints last.
async fn python(script: &'static str, arguments: Vec<String>) -> String {
    let run = move || {
        let script = format!("{}/{script}", env!("CARGO_MANIFEST_DIR"));
        let output = Command::new(tool("python")).arg(script).args(arguments).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{printed}{}", String::from_utf8_lossy(&output.stderr));
        printed.lines().last().unwrap().to_owned()
    };
    tokio::task::spawn_blocking(run).await.unwrap()
}

async fn reading(address: &str, seconds: &str) -> Value {
    let printed = python("tests/read_robot.py", vec![address.to_owned(), seconds.to_owned()]).await;
    serde_json::from_str(&printed).unwrap()
}

/// A server whose robot has an address of its own, and a browser at its page.
async fn started(address: &str, data: &std::path::Path) -> (Ferry, Browser) {
    let mut command = ferry(&["serve", "--bind", "127.0.0.1:0", "--robot-server", address, "--data"]);
    let server = Ferry::start(command.arg(data).stderr(std::process::Stdio::null()));
    let browser = Browser::at(server.address).await;
    (server, browser)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn ur_rtde_reads_the_arm_of_the_session_main() {
    const ADDRESS: &str = "127.0.28.100";
    let data = tempfile::tempdir().unwrap();
    let (_server, mut browser) = started(ADDRESS, data.path()).await;
    let start = json!({"type": "load_scenario", "map": "open", "start_m": [-0.2, -0.35], "goal_m": [0.2, -0.35]});
    browser.send(start).await;
    browser.state("the start", |state| (number(&state["tool_m"][0]) + 0.2).abs() < 1e-3).await;

    let paused = reading(ADDRESS, "0.2").await;
    assert!(paused["version"].as_str().unwrap().starts_with("3.15."), "{paused}");
    assert_eq!((&paused["mode"], &paused["model"]), (&json!("Robotmode: RUNNING"), &json!("UR5")));
    assert_eq!((&paused["robot_mode"], &paused["safety_mode"]), (&json!(7), &json!(1)));
    assert_eq!((&paused["simulated_s"], &paused["protective_stop"]), (&json!(0.0), &json!(false)));
    assert!((number(&paused["tool"][0]) + 0.2).abs() < 1e-3, "{paused}");

    browser.send(json!({"type": "run"})).await;
    let running = reading(ADDRESS, "4").await;
    assert_eq!(running["reconnected"], true);
    // Not faster than real time. A busy machine is slower, and skips frames.
    let share = number(&running["simulated_s"]) / number(&running["seconds"]);
    assert!((0.2..1.1).contains(&share), "{running}");
    assert!(number(&running["frames"]) > 0.3 * 125.0 * number(&running["simulated_s"]), "{running}");
    assert!(number(&running["force"][2]) < 0.0, "the bead pulls the magnet down: {running}");

    browser.send(json!({"type": "pause"})).await;
    let state = browser.state("paused", |state| state["running"] == false && state["tick"].as_u64() > Some(100)).await;
    let last = reading(ADDRESS, "0.2").await;
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

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn ur_rtde_commands_the_arm_within_the_limits_until_the_operator_takes_it() {
    const ADDRESS: &str = "127.0.28.101";
    let data = tempfile::tempdir().unwrap();
    let (_server, mut browser) = started(ADDRESS, data.path()).await;
    let start = json!({"type": "load_scenario", "map": "open", "start_m": [-0.1, -0.35]});
    browser.send(start).await;
    browser.state("the start", |state| (number(&state["tool_m"][0]) + 0.1).abs() < 1e-3).await;
    let drive = tokio::spawn(python("tests/drive_robot.py", vec![ADDRESS.to_owned()]));
    browser.whenever("a client", |m| m["robot"]["program"] == "rtde_control").await;
    browser.whenever("it has left", |m| m["type"] == "state" && m["robot"]["clients"] == json!([])).await;
    let did: Value = serde_json::from_str(&drive.await.unwrap()).unwrap();
    assert_eq!((&did["runs"], &did["state"]), (&json!(true), &json!("PLAYING rtde_control")), "{did}");
    for motion in ["moveL", "moveJ", "moveJ_IK", "servoJ", "custom"] {
        assert!(did[motion][0] == true && number(&did[motion][1]) < 2e-4, "{motion}: {did}");
    }
    assert!((number(&did["speedL"][2]) - 0.03).abs() < 1e-3 && number(&did["stopped"]) < 1e-6, "{did}");
    assert!(did["asynchronous"][0] == 0 && (number(&did["asynchronous"][1]) - 0.02).abs() < 1e-3, "{did}");
    assert_eq!(did["steady"], json!([true, true]), "{did}");
    // Below the walls' tops it stops, and only the dashboard frees it.
    assert!(did["low"][0] == false && did["low"][2] == true && number(&did["low"][1]) >= 0.09, "{did}");
    assert_eq!(did["stopped_state"], json!(["Safetymode: PROTECTIVE_STOP", true, false]), "{did}");
    assert!(did["freed"][0] == "Safetymode: NORMAL" && did["freed"][2] == true, "{did}");
    assert!(did["far"][0] == false && did["far"][1] == false && number(&did["far"][2]) < 2e-4, "{did}");
    assert_eq!(
        (&did["again"], &did["stopScript"]),
        (&json!([true, true]), &json!([false, "STOPPED <unnamed>"])),
        "{did}"
    );
    assert_eq!((&did["reconnected"], &did["receivers"]), (&json!([true, true]), &json!(0.0)), "{did}");

    // The page tells what was refused. The arm is still the robot's until the operator takes it.
    let state = browser.state("the present", |_| true).await;
    assert_eq!((&state["controller"], &state["running"]), (&json!("robot"), &json!(true)));
    let refused = state["robot"]["refused"].as_array().unwrap();
    assert!(refused.iter().any(|one| one["why"].as_str().unwrap().contains("above the table")), "{refused:?}");
    let pace = tokio::spawn(python("tests/pace_robot.py", vec![ADDRESS.to_owned(), "6".to_owned()]));
    browser.state("it moves", |state| state["robot"]["command"] == "servoj").await;
    browser.send(json!({"type": "select_controller", "controller": "errt"})).await;
    let taken = |m: &Value| {
        m["type"] == "event" && m["what"]["text"].as_str().unwrap().contains("the operator has taken the arm")
    };
    browser.until("it is taken", taken).await;
    let before = browser.state("without a program", |state| state["robot"]["program"].is_null()).await;
    browser.whenever("it has left", |m| m["type"] == "state" && m["robot"]["clients"] == json!([])).await;
    pace.await.unwrap();
    let after = browser.state("the present", |state| state["tick"].as_u64() > before["tick"].as_u64()).await;
    assert_eq!((&after["controller"], &after["robot"]["program"]), (&json!("errt"), &Value::Null));
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn ur_rtde_turns_the_tool_with_block_bead_and_camera() {
    const ADDRESS: &str = "127.0.28.104";
    let data = tempfile::tempdir().unwrap();
    let (server, mut browser) = started(ADDRESS, data.path()).await;
    let page = format!("http://{}", server.address);
    let mut turned = async |map: &str, part: &str| {
        browser.send(json!({"type": "load_scenario", "map": map, "start_m": [0.0, -0.35]})).await;
        browser.state("the start", |state| number(&state["tool_m"][0]).abs() < 1e-3).await;
        let turn = tokio::spawn(python("tests/turn_robot.py", vec![ADDRESS.to_owned(), page.clone(), part.to_owned()]));
        browser.whenever("a client", |m| m["robot"]["program"] == "rtde_control").await;
        browser.whenever("it has left", |m| m["type"] == "state" && m["robot"]["clients"] == json!([])).await;
        serde_json::from_str::<Value>(&turn.await.unwrap()).unwrap()
    };
    let did = turned("open", "arc").await;
    assert!(did["aside"] == true && did["safe"] == 1, "{did}");
    for (motion, turned_rad) in [("moveJ", 0.5), ("back", -0.5)] {
        assert!(did[motion][0] == true && (number(&did[motion][1]) - turned_rad).abs() < 1e-2, "{motion}: {did}");
    }
    assert_eq!([&did["servoJ"][0], &did["servoJ"][1]], [true, true], "{did}");
    let bead_beside_m = [&did["moveJ"][2], &did["back"][2], &did["servoJ"][2]].map(number);
    assert!(bead_beside_m.iter().all(|&m| m < 0.03), "{did}");

    // Seen from above, joint 6 turns clockwise, and the picture's content the other way.
    let did = turned("posts", "quarter").await;
    assert!(did["quarter"] == true && did["safe"] == 1, "{did}");
    let same = |quarters: &str| number(&did["same"][quarters]);
    assert!(same("1") > 0.97 && ["0", "2", "3"].iter().all(|other| same(other) < 0.9), "{did}");
}

/// The example in the documentation delivers the bead, with what the robot, the camera and the tracker say.
async fn deliver(address: &str, map: &str, start_m: [f64; 2], goal_m: [f64; 2]) {
    let data = tempfile::tempdir().unwrap();
    let (server, mut browser) = started(address, data.path()).await;
    browser.send(json!({"type": "load_scenario", "map": map, "start_m": start_m, "goal_m": goal_m})).await;
    browser.state("the start", |state| (number(&state["tool_m"][0]) - start_m[0]).abs() < 1e-3).await;
    let ferry = format!("http://{}", server.address);
    let example = tokio::spawn(python("python/examples/robot_delivery.py", vec![address.to_owned(), ferry]));
    let state = browser.whenever("it is delivered", |m| m["type"] == "state" && m["deliveries"] == 1).await;
    assert_eq!(state["controller"], "robot");
    assert!(example.await.unwrap().starts_with("delivered"));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_program_for_a_ur5_delivers_the_bead_between_posts() {
    deliver("127.0.28.102", "posts", [-0.25, -0.38], [0.12, -0.33]).await;
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn a_program_for_a_ur5_delivers_the_bead_through_the_colon() {
    deliver("127.0.28.103", "colon", [0.19, -0.28], [-0.24, -0.27]).await;
}
