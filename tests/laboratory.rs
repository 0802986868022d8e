//! Routes, the WebSocket and refusals, from a browser's side.

use std::cell::Cell;
use std::time::Duration;

use futures_util::StreamExt;
use serde_json::{Value, json};
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Message;

use crate::support::Laboratory;

/// With a biased tracker, the switching law's distance differs from the true one. The state has both.
#[tokio::test(flavor = "multi_thread")]
async fn the_state_has_the_true_distance_and_the_tracked_one() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let mut parameters = lab.default_parameters().await;
    parameters["tracker_bias_x_m"] = json!(0.015);
    parameters["tracker_noise_m"] = json!(0.0);
    browser.send(json!({"type": "configure", "parameters": parameters})).await;
    browser.send(json!({"type": "step", "ticks": 20})).await;
    let state = browser.state("twenty ticks", |m| m["tick"] == 20).await;
    let [truth, tracked] = ["tracking_error_m", "tracked_error_m"].map(|field| state[field].as_f64().unwrap());
    assert!(truth < 1e-3 && (tracked - 0.015).abs() < 1e-3, "{state}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_goal_is_delivered_a_disturbance_fetched_and_a_refusal_changes_nothing() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let hello = browser.until("hello", |m| m["type"] == "hello").await;
    assert_eq!((&hello["role"], &hello["session"]), (&json!("operator"), &json!("main")));
    let scene = browser.until("scene", |m| m["type"] == "scene").await;
    assert_eq!(scene["map"], "posts");
    let idle = browser.state("the first state", |_| true).await;
    assert_eq!((&idle["running"], &idle["goal_m"]), (&json!(false), &Value::Null));

    for (goal, field, code) in [
        (json!({"type": "set_goal", "x_m": -0.2, "y_m": -0.305}), "goal", "in_wall"),
        (json!({"type": "set_goal", "x_m": 3.0, "y_m": -0.3}), "goal", "outside_workspace"),
        (json!({"type": "set_goal", "x_m": null, "y_m": -0.3}), "x_m", "malformed"),
        (json!({"type": "select_controller", "controller": "magic"}), "controller", "malformed"),
        (json!({"type": "load_scenario", "map": "nowhere"}), "map", "map_refused"),
        (json!({"type": "set_speed", "factor": 1e9}), "factor", "out_of_range"),
        (json!({"type": "rewind", "tick": 5, "to": 1}), "to", "malformed"),
        (json!({"type": "fly"}), "type", "malformed"),
    ] {
        browser.send(goal.clone()).await;
        let error = browser.error().await;
        assert_eq!((&error["field"], &error["code"]), (&json!(field), &json!(code)), "{goal} {error}");
    }
    browser.send_text("{\"type\":\"set_goal\",\"x_m\":1e999,\"y_m\":0}").await;
    assert_eq!(browser.error().await["code"], "malformed");
    let (_, after) = lab.ask("GET", "/api/sessions/main/state", "").await;
    assert_eq!(after["world_hash"], idle["world_hash"]);

    browser.send(json!({"type": "load_scenario", "map": "posts", "seed": 3, "start_m": [-0.25, -0.38]})).await;
    browser.state("the start", |m| m["tool_m"][0].as_f64().unwrap() < -0.2499).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "set_speed", "factor": 16})).await;
    browser.send(json!({"type": "run"})).await;
    browser.state("the bead on its way", |m| m["leg_steps"].as_u64() > Some(8)).await;
    for _ in 0..40 {
        browser.send(json!({"type": "drag", "x_m": -0.24, "y_m": -0.5})).await;
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    browser.send(json!({"type": "release"})).await;
    browser.state("sub-controller 1", |m| m["mode"] == 1).await;
    browser.state("sub-controller 2", |m| m["mode"] == 2).await;
    let done = browser.state("delivery", |m| m["deliveries"] == 1).await;
    let off = |i: usize| done["bead_m"][i].as_f64().unwrap() - done["goal_m"][i].as_f64().unwrap();
    assert!(off(0).hypot(off(1)) <= 0.02, "{done}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn one_browser_operates_and_a_closed_page_releases_the_bead() {
    let lab = Laboratory::open().await;
    let mut first = lab.browser().await;
    first.until("hello", |m| m["role"] == "operator").await;
    let mut second = lab.browser().await;
    second.until("hello", |m| m["type"] == "hello" && m["role"] == "viewer").await;
    second.send(json!({"type": "run"})).await;
    assert_eq!(second.error().await["code"], "not_operator");
    second.send(json!({"type": "take_control"})).await;
    first.until("the request", |m| m["type"] == "hello" && m["asked"] == true).await;

    first.send(json!({"type": "run"})).await;
    first.send(json!({"type": "drag", "x_m": 0.0, "y_m": -0.5})).await;
    second.state("the hand", |m| !m["hand_m"].is_null()).await;
    drop(first);
    // The two messages arrive in either order.
    let (released, turn) = (Cell::new(false), Cell::new(false));
    let both = |m: &Value| {
        released.set(released.get() || m["type"] == "state" && m["hand_m"].is_null());
        turn.set(turn.get() || m["type"] == "hello" && m["role"] == "operator");
        released.get() && turn.get()
    };
    second.until("the release and control", both).await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_session_can_be_stepped_and_rewound() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "set_goal", "x_m": 0.1, "y_m": -0.5})).await;
    browser.send(json!({"type": "step", "ticks": 500})).await;
    let then = browser.state("500 ticks", |m| m["tick"] == 500).await;
    browser.send(json!({"type": "step", "ticks": 125})).await;
    browser.state("625 ticks", |m| m["tick"] == 625).await;
    browser.send(json!({"type": "rewind", "tick": 500})).await;
    let again = browser.state("500 ticks again", |m| m["tick"] == 500).await;
    assert_eq!(then["world_hash"], again["world_hash"]);
    assert_eq!(again["newest_tick"], 594, "the future is kept until something changes");
    browser.send(json!({"type": "reset"})).await;
    browser.state("the start", |m| m["tick"] == 0 && m["newest_tick"] == 0).await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn routes_answer_and_foreign_pages_are_refused() {
    let lab = Laboratory::open().await;
    assert_eq!(lab.ask("GET", "/healthz", "").await, (200, json!("ok\n")));
    let (status, page) = lab.ask_text("GET", "/", "", &[]).await;
    assert!(status == 200 && page.contains("<title>Ferry</title>"));
    assert!(lab.ask_text("GET", "/metrics", "", &[]).await.1.contains("ferry_sessions 1"));
    let (_, maps) = lab.ask("GET", "/api/maps", "").await;
    assert!(maps["maps"].as_array().unwrap().contains(&json!("colon")));
    for path in ["/api/sessions/main/camera.png", "/api/sessions/main/observation.png", "/api/maps/posts"] {
        assert_eq!(lab.ask("GET", path, "").await.0, 200, "{path}");
    }
    for path in [
        "/nowhere",
        "/api/nowhere",
        "/api/sessions/missing",
        "/api/maps/..%2fCargo.toml",
        "/api/recordings/..%2f..%2fx.rrd",
    ] {
        let (status, problem) = lab.ask("GET", path, "").await;
        assert_eq!((status, &problem["status"]), (404, &json!(404)), "{path}: {problem}");
    }
    let (status, made) = lab.ask("POST", "/api/sessions", "{\"map\":\"open\"}").await;
    assert_eq!((status, &made["map"]), (201, &json!("open")));
    assert_eq!(lab.ask("POST", "/api/sessions", "{} and more").await.0, 400);
    assert_eq!(lab.ask("DELETE", "/api/sessions/main", "").await.0, 409);
    let own = format!("/api/sessions/{}", made["id"].as_str().unwrap());
    let (mut guest, _) = connect_async(format!("ws://{}{own}/live", lab.address)).await.unwrap();
    assert_eq!(lab.ask("DELETE", &own, "").await.0, 204);
    assert_eq!(lab.ask("GET", &own, "").await.0, 404);
    let sent_away = async { while let Some(Ok(_)) = guest.next().await {} };
    tokio::time::timeout(Duration::from_secs(5), sent_away).await.expect("a deleted session closes its sockets");
    let (status, problem) = lab.ask("POST", "/api/sessions", "{\"seed\":-1}").await;
    assert_eq!((status, &problem["field"]), (400, &json!("seed")));
    assert_eq!(lab.ask_text("GET", "/healthz", "", &[("host", "example.org")]).await.0, 421);
    assert_eq!(lab.ask_text("GET", "/healthz", "", &[("origin", "http://example.org")]).await.0, 403);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn stopping_closes_browsers_with_1001() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.until("hello", |m| m["type"] == "hello").await;
    lab.close().await;
    let closed = async {
        while let Some(message) = browser.socket.next().await {
            if let Ok(Message::Close(frame)) = message {
                return frame.map(|frame| u16::from(frame.code));
            }
        }
        None
    };
    assert_eq!(tokio::time::timeout(Duration::from_secs(5), closed).await.unwrap(), Some(1001));
}

#[tokio::test(flavor = "multi_thread")]
async fn a_release_leaves_no_trace_of_the_hand() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let drag = |x_m: f64, y_m: f64, lift: bool| json!({"type": "drag", "x_m": x_m, "y_m": y_m, "lift": lift});
    browser.send(json!({"type": "load_scenario", "map": "colon", "start_m": [0.0, -0.475]})).await;
    browser.state("the colon", |m| m["tool_m"][0].as_f64().unwrap().abs() < 1e-6).await;
    // Deep in a wall, while paused: placed at the nearest free position.
    browser.send(drag(0.0, -0.3, false)).await;
    browser.state("the hand", |m| !m["hand_m"].is_null()).await;
    browser.send(json!({"type": "release"})).await;
    let put = browser.state("no hand", |m| m["hand_m"].is_null() && m["bead_m"][1].as_f64() > Some(-0.474)).await;
    assert!(put["bead_m"][1].as_f64().unwrap() < -0.4, "{put}");

    // Lifted over a wall while running, and released there.
    browser.send(json!({"type": "run"})).await;
    browser.send(drag(0.0, -0.3, true)).await;
    browser.state("over the wall", |m| m["bead_m"][1].as_f64() > Some(-0.31)).await;
    browser.send(json!({"type": "release"})).await;
    browser.state("back in the channel", |m| m["hand_m"].is_null() && m["bead_m"][1].as_f64().unwrap() < -0.4).await;

    // After a rewind to a moment when the hand held the bead, running releases it.
    browser.send(drag(0.1, -0.48, false)).await;
    let held = browser.state("held for a while", |m| !m["hand_m"].is_null()).await;
    let tick = held["tick"].as_u64().unwrap() + 63;
    browser.state("later", |m| m["tick"].as_u64() > Some(tick)).await;
    browser.send(json!({"type": "release"})).await;
    browser.send(json!({"type": "rewind", "tick": tick})).await;
    let then = browser.state("that moment", |m| m["running"] == false && m["tick"].as_u64().unwrap() <= tick).await;
    assert!(!then["hand_m"].is_null(), "{then}");
    // A refused input changes nothing, the hand included.
    browser.send(json!({"type": "set_goal", "x_m": 9.0, "y_m": 9.0})).await;
    browser.error().await;
    let after = browser.state("as it was", |m| m["tick"] == then["tick"]).await;
    assert_eq!((&after["hand_m"], &after["world_hash"]), (&then["hand_m"], &then["world_hash"]));
    browser.send(json!({"type": "step", "ticks": 1})).await;
    browser.state("a tick on", |m| m["tick"].as_u64() > then["tick"].as_u64() && m["hand_m"].is_null()).await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn kicks_are_applied_by_command_and_by_script() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let kick = |x_n_s: f64| json!({"impulse": {"x_n_s": x_n_s, "y_n_s": 0.0}});
    browser.send(json!({"type": "disturb", "disturbance": kick(1.0)})).await;
    let error = browser.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("disturbance_out_of_range"), &json!("x_n_s")), "{error}");
    browser.send(json!({"type": "disturb", "disturbance": kick(3e-4)})).await;
    browser.send(json!({"type": "step", "ticks": 10})).await;
    let state = browser.state("kicked", |m| m["tick"] == 10).await;
    assert_eq!(state["disturbances"], 1);
    assert!(state["tracking_error_m"].as_f64() > Some(0.01), "{state}");

    let never = json!([{"at": {"step": 0}, "disturbance": kick(3e-4)}]);
    browser.send(json!({"type": "load_scenario", "map": "open", "script": never})).await;
    let error = browser.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("bad_script"), &json!("script")), "{error}");
    assert!(error["message"].as_str().unwrap().contains("script[0]"), "{error}");

    // On a stage without an arm, and with a script.
    let script = json!([{"at": {"tick": 5}, "disturbance": kick(3e-4)}]);
    let load = json!({"type": "load_scenario", "map": "open", "positioner": "planar_stage", "script": script});
    browser.send(load).await;
    browser.until("the stage", |m| m["type"] == "scene" && m["positioner"] == "planar_stage").await;
    browser.send(json!({"type": "step", "ticks": 10})).await;
    let state = browser.state("struck", |m| m["tick"] == 10 && m["disturbances"] == 1).await;
    assert!(state["joints_rad"].is_null(), "{state}");
    // After a rewind and after a reset the kick is applied again.
    for back in [json!({"type": "rewind", "tick": 0}), json!({"type": "reset"})] {
        browser.send(back).await;
        browser.state("before it", |m| m["tick"] == 0 && m["disturbances"] == 0).await;
        browser.send(json!({"type": "step", "ticks": 10})).await;
        browser.state("struck again", |m| m["tick"] == 10 && m["disturbances"] == 1).await;
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_goal_given_up_does_not_stop_the_fetch() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    // So slow that the leg's 150 steps end before the tool reaches the goal.
    let mut parameters = lab.default_parameters().await;
    parameters["transport_speed_m_s"] = json!(0.01);
    let load = json!({"type": "load_scenario", "map": "open", "start_m": [-0.25, -0.4], "goal_m": [0.25, -0.4], "parameters": parameters});
    browser.send(load).await;
    browser.send(json!({"type": "step", "ticks": 5000})).await;
    browser.state("given up", |m| m["phase"]["code"] == "stopped").await;
    // Paused: the release puts the bead there at once.
    browser.send(json!({"type": "drag", "x_m": 0.1, "y_m": -0.3})).await;
    browser.send(json!({"type": "release"})).await;
    browser.send(json!({"type": "step", "ticks": 600})).await;
    let fetched = browser.state("fetched", |m| m["mode"] == 2 && m["switches"] == 2).await;
    assert!(fetched["phase"]["code"] == "transporting" && fetched["leg_steps"].as_u64().unwrap() < 20, "{fetched}");
    lab.close().await;
}
