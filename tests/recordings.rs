//! The recording of a closed session is complete and shows the arm moving, checked with Rerun's own tools.

use std::process::Command;

use serde_json::json;

use crate::support::{Laboratory, ferry, files, read, tool};

#[tokio::test(flavor = "multi_thread")]
async fn a_closed_recording_verifies_and_shows_the_arm_moving() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser
        .send(json!({"type": "load_scenario", "map": "posts", "start_m": [-0.25, -0.38], "goal_m": [0.12, -0.33]}))
        .await;
    browser.send(json!({"type": "step", "ticks": 600})).await;
    browser.until("600 ticks", |m| m["type"] == "state" && m["tick"] == 600).await;
    let (_, listed) = lab.ask("GET", "/api/recordings", "").await;
    assert_eq!(listed["recordings"].as_array().unwrap().len(), 1, "{listed}");
    let data = lab.close().await;

    let folder = data.path().join("recordings");
    let file = files(&folder, "rrd").remove(0);
    let verified = Command::new(tool("rerun")).args(["rrd", "verify"]).arg(&file).output().unwrap();
    assert!(verified.status.success(), "{}", String::from_utf8_lossy(&verified.stderr));
    let found = read(std::slice::from_ref(&file)).remove(0);
    assert!(found["tool_path_m"].as_f64() > Some(0.1), "{found}");
    // At high speed, not every control step has an image.
    assert!(found["camera_frames"].as_u64() >= Some(1), "{found}");
    for timeline in ["sim_time", "tick"] {
        assert!(found["timelines"].as_array().unwrap().contains(&json!(timeline)), "{found}");
    }
    for entity in [
        "/world/arm",
        "/world/bead",
        "/world/goal",
        "/workspace/tool_and_bead",
        "/camera",
        "/observation",
        "/tracking_error_mm",
        "/mode",
        "/phase",
        "/log",
    ] {
        assert!(found["entities"].as_array().unwrap().contains(&json!(entity)), "{entity}: {found}");
    }
    assert_eq!(found["blueprint_views"], json!(12), "{found}");

    // `ferry replay`, with the logged decisions and with the camera.
    let log = file.with_extension("ferry");
    for options in [&[][..], &["--camera"]] {
        let replayed = ferry(&[]).arg("replay").args(options).arg(&log).output().unwrap();
        let told = String::from_utf8_lossy(&replayed.stdout);
        assert!(replayed.status.success(), "{}", String::from_utf8_lossy(&replayed.stderr));
        assert!(told.contains("600 ticks (4.8 s) of 2 trials replayed"), "{told}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_list_says_what_is_being_written_and_what_is_not_ours() {
    let lab = Laboratory::open().await;
    std::fs::write(lab.data.path().join("recordings/mine.rrd"), b"RRF2").unwrap();
    lab.ask("POST", "/api/sessions", "").await;
    let live = async |lab: &Laboratory| {
        let (_, listed) = lab.ask("GET", "/api/recordings", "").await;
        let mut found: Vec<_> = listed["recordings"].as_array().unwrap().clone();
        found.sort_by_key(|one| one["session"].to_string());
        found
    };
    let found = live(&lab).await;
    let told = |field: &str| found.iter().map(|one| one[field].clone()).collect::<Vec<_>>();
    assert_eq!(told("session"), [json!("main"), json!("session-1"), json!(null)]);
    assert_eq!(told("live"), [json!(true), json!(true), json!(false)]);
    assert_eq!((&found[2]["id"], &found[2]["started"], &found[2]["bytes"]), (&json!("mine"), &json!(null), &json!(4)));
    let started: jiff::Timestamp = found[0]["started"].as_str().unwrap().parse().unwrap();
    let ago = jiff::Timestamp::now().duration_since(started);
    assert!(!ago.is_negative() && ago.as_secs() < 60, "started {ago:?} ago");

    lab.ask("DELETE", "/api/sessions/session-1", "").await;
    let closed = &live(&lab).await[1];
    assert_eq!(closed["live"], false, "{closed}");
    let file = lab.fetch("GET", &format!("/api/recordings/{}.rrd", closed["id"].as_str().unwrap()), &[]).await;
    assert_eq!(file.header("content-length"), Some(closed["bytes"].to_string().as_str()));
    assert_eq!(file.body.len() as u64, closed["bytes"].as_u64().unwrap());
    assert!(file.body.starts_with(b"RRF2"));
    let log = lab.bytes(&format!("/api/recordings/{}.ferry", closed["id"].as_str().unwrap())).await;
    assert_eq!(log.len() as u64, closed["log_bytes"].as_u64().unwrap());
    assert!(ferry::trial::InputLog::read(&log).is_ok());
    assert_eq!(lab.ask("GET", "/api/recordings/mine.ferry", "").await.0, 404);
    lab.close().await;
}
