//! The recording of a closed session is complete and shows the arm moving, checked with Rerun's own tools. The list
//! says what recordings show; they are named and deleted.

use std::cell::Cell;
use std::process::Command;
use std::time::Duration;

use serde_json::{Value, json};

use crate::support::{Laboratory, ferry, files, gpu, read, tool};

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
    for timeline in ["recording_time", "sim_time", "tick"] {
        assert!(found["timelines"].as_array().unwrap().contains(&json!(timeline)), "{found}");
    }
    // 1 is *paused*. The trials do not overlap on the time line with which the viewer opens.
    assert_eq!(found["opens"], json!({"timeline": "recording_time", "play_state": 1}), "{found}");
    assert_eq!(found["trials"], json!([[0.0, "1: posts, attractor"], [0.008, "2: posts, attractor"]]), "{found}");
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
    assert!(ferry_core::trial::InputLog::read(&log).is_ok());
    assert_eq!(lab.ask("GET", "/api/recordings/mine.ferry", "").await.0, 404);
    lab.close().await;
}

/// Polls the list until it shows what is wanted.
async fn listed(lab: &Laboratory, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
    for _ in 0..200 {
        let (_, listed) = lab.ask("GET", "/api/recordings", "").await;
        let found = listed["recordings"].as_array().unwrap().iter().find(|&one| fits(one)).cloned();
        if let Some(found) = found {
            return found;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("{what} is not listed")
}

#[tokio::test(flavor = "multi_thread")]
async fn the_list_says_what_a_recording_shows() {
    let lab = Laboratory::open().await;
    let of_main = |one: &Value| one["session"] == "main";
    let empty = listed(&lab, "a session that has not run", |one| of_main(one) && one["content"].is_object()).await;
    assert_eq!(empty["content"]["maps"], json!([]), "{empty}");
    let mut browser = lab.browser().await;
    for (controller, goal_m) in [("attractor", [-0.2, -0.38]), ("errt", [-0.21, -0.38])] {
        let scenario = json!({"type": "load_scenario", "map": "posts", "controller": controller,
            "start_m": [-0.25, -0.38], "goal_m": goal_m});
        browser.send(scenario).await;
        browser.send(json!({"type": "step", "ticks": 2000})).await;
        // The last state may come before the event.
        let (delivered, ended) = (Cell::new(false), Cell::new(false));
        let both = |m: &Value| {
            delivered.set(delivered.get() || (m["type"] == "event" && m["kind"] == "delivered"));
            ended.set(ended.get() || (m["type"] == "state" && m["tick"] == 2000));
            delivered.get() && ended.get()
        };
        browser.until("a delivery and 2000 ticks", both).await;
    }
    let is_complete = |one: &Value| of_main(one) && one["content"]["duration_s"] == 32.0;
    let found = listed(&lab, "a session of 4000 ticks", is_complete).await;
    let content = json!({"maps": ["posts"], "controllers": ["attractor", "errt"], "delivered": 2, "not_delivered": 0,
        "duration_s": 32.0});
    assert_eq!((&found["content"], &found["title"]), (&content, &json!(null)));
    // Later trials begin after earlier ones on the time line.
    let data = lab.close().await;
    let file = files(&data.path().join("recordings"), "rrd").remove(0);
    let found = read(std::slice::from_ref(&file)).remove(0);
    let trials = json!([[0.0, "1: posts, attractor"], [0.008, "2: posts, attractor"], [16.016, "3: posts, errt"]]);
    assert_eq!(found["trials"], trials);
    assert!(file.with_extension("about.json").exists());
}

#[tokio::test(flavor = "multi_thread")]
async fn recordings_are_named_and_deleted() {
    let lab = Laboratory::open().await;
    let folder = lab.data.path().join("recordings");
    std::fs::write(folder.join("mine.rrd"), b"RRF2").unwrap();
    let main = listed(&lab, "main", |one| one["session"] == "main").await;
    let path = |id: &str| format!("/api/recordings/{id}");
    let own = path(main["id"].as_str().unwrap());
    for (body, title) in [
        (json!({"title": "  Colon, second try "}), json!("Colon, second try")),
        (json!({"title": "ä".repeat(80)}), json!("ä".repeat(80))),
        (json!({"title": " "}), json!(null)),
        (json!({"title": "again"}), json!("again")),
        (json!({"title": null}), json!(null)),
    ] {
        let (status, renamed) = lab.ask("PATCH", &own, &body.to_string()).await;
        assert_eq!((status, &renamed["title"], &renamed["id"]), (200, &title, &main["id"]), "{renamed}");
        listed(&lab, "the title", |one| one["id"] == main["id"] && one["title"] == title).await;
    }
    for (body, status, field) in [
        (json!({"title": "ä".repeat(81)}), 422, json!("title")),
        (json!({"title": "a\nb"}), 422, json!("title")),
        (json!({"title": 1}), 400, json!("title")),
        (json!({"title": "a", "live": false}), 400, json!("live")),
        (json!({}), 400, json!(".")),
    ] {
        let (found, problem) = lab.ask("PATCH", &own, &body.to_string()).await;
        assert_eq!((found, &problem["field"]), (status, &field), "{body}: {problem}");
    }
    for method in ["PATCH", "DELETE"] {
        for missing in ["none", "mine.rrd", "..%2frecordings%2fmine"] {
            let (status, problem) = lab.ask(method, &path(missing), "{\"title\":\"a\"}").await;
            assert_eq!((status, &problem["code"]), (404, &json!("not_found")), "{method} {missing}: {problem}");
        }
    }
    let (status, problem) = lab.ask("DELETE", &own, "").await;
    assert_eq!((status, &problem["code"]), (409, &json!("being_written")), "{problem}");

    lab.ask("PATCH", &path("mine"), "{\"title\":\"of another program\"}").await;
    assert_eq!(lab.ask("DELETE", &path("mine"), "").await.0, 204);
    assert_eq!(lab.ask("DELETE", &path("mine"), "").await.0, 404);
    assert_eq!(lab.ask("GET", &path("mine.rrd"), "").await.0, 404);
    lab.ask("POST", "/api/sessions", "").await;
    lab.ask("DELETE", "/api/sessions/session-1", "").await;
    let closed = listed(&lab, "a finished one", |one| one["session"] == "session-1" && one["live"] == false).await;
    assert_eq!(lab.ask("DELETE", &path(closed["id"].as_str().unwrap()), "").await.0, 204);
    let left = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let own_id = main["id"].as_str().unwrap();
    let others: Vec<_> = left.filter(|name| !name.starts_with(own_id)).collect();
    assert!(others.is_empty(), "{others:?}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn changes_of_recordings_need_the_token() {
    let token = ferry::http::Token::generate().unwrap();
    let lab = Laboratory::open_with(gpu(), Some(token.as_str()), |_| ()).await;
    std::fs::write(lab.data.path().join("recordings/mine.rrd"), b"RRF2").unwrap();
    for method in ["PATCH", "DELETE"] {
        let (status, problem) = lab.ask(method, "/api/recordings/mine", "{\"title\":\"a\"}").await;
        assert_eq!((status, &problem["code"]), (401, &json!("no_token")), "{method}");
    }
    let bearer = format!("Bearer {}", token.as_str());
    let (status, _) = lab.ask_with("DELETE", "/api/recordings/mine", "", &[("authorization", &bearer)]).await;
    assert_eq!(status, 204);
    lab.close().await;
}
