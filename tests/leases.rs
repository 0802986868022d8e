//! Named sessions, their operators, and sessions without browsers.

use std::time::Duration;

use serde_json::{Value, json};
use tokio_tungstenite::connect_async;

use crate::support::{Browser, Laboratory, gpu};

#[tokio::test(flavor = "multi_thread")]
async fn sessions_open_by_name_up_to_the_limit() {
    let lab = Laboratory::open_with(gpu(), None, |settings| settings.sessions = 3).await;
    for name in ["anna", "group-7", "anna"] {
        let (status, page) = lab.ask("GET", &format!("/s/{name}"), "").await;
        assert!(status == 200 && page.as_str().unwrap().contains("<title>Ferry</title>"), "{name}");
    }
    let (_, listed) = lab.ask("GET", "/api/sessions", "").await;
    let ids: Vec<_> = listed["sessions"].as_array().unwrap().iter().map(|session| session["id"].clone()).collect();
    assert_eq!(ids, [json!("anna"), json!("group-7"), json!("main")]);
    let (status, problem) = lab.ask("GET", "/s/one-too-many", "").await;
    assert_eq!((status, &problem["code"]), (429, &json!("too_many_sessions")));
    assert_eq!(lab.ask("POST", "/api/sessions", "").await.0, 429);
    for bad in ["Anna", "a.b", "session-9", "a%2fb", &"x".repeat(33)] {
        let (status, problem) = lab.ask("GET", &format!("/s/{bad}"), "").await;
        assert_eq!((status, &problem["code"]), (404, &json!("bad_name")), "{bad}");
    }
    // Sessions are independent.
    let (socket, _) = connect_async(format!("ws://{}/api/sessions/anna/live", lab.address)).await.unwrap();
    let mut anna = Browser::of(socket);
    let hello = anna.until("hello", |m| m["type"] == "hello").await;
    assert_eq!((&hello["session"], &hello["role"]), (&json!("anna"), &json!("operator")));
    anna.send(json!({"type": "step", "ticks": 7})).await;
    anna.state("seven ticks", |m| m["tick"] == 7).await;
    assert_eq!(lab.ask("GET", "/api/sessions/group-7/state", "").await.1["tick"], 0);
    assert_eq!(lab.ask("DELETE", "/api/sessions/group-7", "").await.0, 204);
    assert_eq!(lab.ask("GET", "/s/another", "").await.0, 200);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_unwatched_session_is_parked_and_can_be_replaced() {
    let lab = Laboratory::open_with(gpu(), None, |settings| {
        settings.sessions = 2;
        settings.park_after = Duration::from_millis(300);
    })
    .await;
    lab.ask("GET", "/s/anna", "").await;
    let (socket, _) = connect_async(format!("ws://{}/api/sessions/anna/live", lab.address)).await.unwrap();
    let mut anna = Browser::of(socket);
    anna.send(json!({"type": "run"})).await;
    anna.state("a second", |m| m["tick"].as_u64() > Some(125)).await;
    assert_eq!(lab.ask("GET", "/s/bert", "").await.0, 429, "watched sessions stay");
    drop(anna);
    let parked = async {
        loop {
            let (_, listed) = lab.ask("GET", "/api/sessions", "").await;
            let anna = listed["sessions"][0].clone();
            if anna["parked"] == true && anna["running"] == false {
                return anna;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    let anna = tokio::time::timeout(Duration::from_secs(10), parked).await.expect("it is parked and pauses");
    assert_eq!(anna["id"], "anna");
    assert_eq!(lab.ask("GET", "/s/bert", "").await.0, 200);
    assert_eq!(lab.ask("GET", "/api/sessions/anna", "").await.0, 404);
    let (_, listed) = lab.ask("GET", "/api/recordings", "").await;
    let of_anna = listed["recordings"].as_array().unwrap().iter().filter(|part| part["session"] == "anna");
    assert_eq!(of_anna.count(), 1, "its recording stays: {listed}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_command_of_an_earlier_lease_is_refused_and_changes_nothing() {
    let lab = Laboratory::open().await;
    let mut first = lab.browser().await;
    let hello = first.until("hello", |m| m["role"] == "operator").await;
    let epoch = hello["epoch"].as_u64().unwrap();
    first.send(json!({"type": "step", "ticks": 1, "epoch": epoch})).await;
    first.state("a tick", |m| m["tick"] == 1).await;
    let mut second = lab.browser().await;
    second.until("hello", |m| m["role"] == "viewer").await;
    second.send(json!({"type": "take_control"})).await;
    first.until("asked", |m| m["asked"] == true).await;
    first.send(json!({"type": "release_control"})).await;
    let next = second.until("its turn", |m| m["role"] == "operator").await;
    assert!(next["epoch"].as_u64() > Some(epoch));
    second.send(json!({"type": "release_control"})).await;
    first.until("free", |m| m["type"] == "hello" && m["operator_present"] == false).await;
    first.send(json!({"type": "take_control"})).await;
    first.until("its turn again", |m| m["role"] == "operator").await;
    // A late command of the first lease.
    first.send(json!({"type": "step", "ticks": 1, "epoch": epoch})).await;
    let error = first.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("stale_epoch"), &json!("epoch")), "{error}");
    assert_eq!(lab.ask("GET", "/api/sessions/main/state", "").await.1["tick"], 1);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_operator_keeps_control() {
    let lab = Laboratory::open().await;
    let mut first = lab.browser().await;
    first.until("hello", |m| m["role"] == "operator").await;
    let mut second = lab.browser().await;
    second.until("hello", |m| m["role"] == "viewer").await;
    second.send(json!({"type": "take_control"})).await;
    let asks = second.until("its request", |m| m["asks"] == true).await;
    assert!(asks["answer_within_s"].as_f64() > Some(25.0), "{asks}");
    first.until("asked", |m| m["asked"] == true).await;
    first.send(json!({"type": "keep_control"})).await;
    first.until("no request", |m| m["asked"] == false).await;
    let over = second.until("the end of its request", |m| m["asks"] == false).await;
    assert_eq!((&over["role"], &over["answer_within_s"]), (&json!("viewer"), &Value::Null));
    second.send(json!({"type": "take_control"})).await;
    let error = second.error().await;
    let wait_s = error["values"]["wait_s"].as_u64();
    assert!(error["code"] == "kept" && (50..=60).contains(&wait_s.unwrap()), "{error}");
    second.send(json!({"type": "keep_control"})).await;
    assert_eq!(second.error().await["code"], "not_operator");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_silent_hand_is_released_and_the_session_pauses() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "run"})).await;
    let began = std::time::Instant::now();
    browser.send(json!({"type": "drag", "x_m": 0.0, "y_m": -0.45})).await;
    browser.state("the hand", |m| !m["hand_m"].is_null()).await;
    // Refused messages do not count as a sign of life.
    browser.send(json!({"type": "drag", "x_m": null, "y_m": 0})).await;
    let error =
        browser.until("the release of a silent hand", |m| m["type"] == "error" && m["code"] == "hand_silent").await;
    assert!(began.elapsed() > Duration::from_secs(5), "{error}");
    let (_, state) = lab.ask("GET", "/api/sessions/main/state", "").await;
    assert_eq!((&state["hand_m"], &state["running"]), (&Value::Null, &json!(false)), "{state}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_drawing_is_checked_without_being_added() {
    let lab = Laboratory::open().await;
    let rooms = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-300 210 580 330\">\
                 <path d=\"M0 210V350M0 390V540\" stroke=\"#000\" stroke-width=\"10\"/></svg>";
    let (status, check) = lab.ask("POST", "/api/map-checks", rooms).await;
    assert_eq!((status, &check["walls"], &check["regions"]), (200, &json!(2), &json!(1)), "{check}");
    let near = |value: &Value, m: f64| (value.as_f64().unwrap() - m).abs() < 0.003;
    let [door] = &check["passages"].as_array().unwrap()[..] else { panic!("{check}") };
    assert!(near(&door["width_m"], 0.04) && near(&door["x_m"], 0.0) && near(&door["y_m"], -0.37), "{door}");
    assert_eq!(check["outlines"].as_array().unwrap().len(), 2);
    assert!(near(&check["workspace"]["x_min_m"], -0.3) && check["positioner"] == "arm");
    let (status, problem) = lab.ask("POST", "/api/map-checks", "<svg").await;
    assert_eq!((status, &problem["code"], &problem["field"]), (422, &json!("map_refused"), &json!("map")));
    let (_, list) = lab.ask("GET", "/api/maps", "").await;
    assert_eq!(list["maps"], json!(ferry_core::map::Map::shipped_names()));
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn uploaded_maps_are_stored_listed_and_deleted() {
    let lab = Laboratory::open().await;
    let drawing = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-300 210 580 330\">\
                   <rect x=\"-20\" y=\"300\" width=\"40\" height=\"30\"/></svg>";
    lab.ask("GET", "/s/anna", "").await;
    let (socket, _) = connect_async(format!("ws://{}/api/sessions/anna/live", lab.address)).await.unwrap();
    let mut anna = Browser::of(socket);
    anna.state("the state", |_| true).await;
    let (status, made) = lab.ask("POST", "/api/maps", drawing).await;
    assert_eq!((status, &made["name"]), (201, &json!("map-1")), "{made}");
    let is_list = |m: &Value| m["list"] == "maps";
    let knows = |m: &Value| is_list(m) && m["items"].as_array().unwrap().contains(&json!("map-1"));
    anna.until("a paused session receives it", knows).await;
    let (status, problem) = lab.ask("POST", "/api/maps", "<svg").await;
    assert_eq!((status, &problem["code"], &problem["field"]), (422, &json!("map_refused"), &json!("map")));
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "load_scenario", "map": "map-1"})).await;
    let scene = browser.until("its scene", |m| m["type"] == "scene" && m["map"] == "map-1").await;
    assert_eq!(scene["walls"].as_array().unwrap().len(), 1);
    let (status, sent) = lab.ask("GET", "/api/maps/map-1", "").await;
    assert!(status == 200 && sent == drawing);
    assert!(lab.data.path().join("maps/map-1.svg").exists());
    assert_eq!(lab.ask("DELETE", "/api/maps/map-1", "").await.0, 204);
    anna.until("the map's removal", |m| is_list(m) && !knows(m)).await;
    assert_eq!(lab.ask("DELETE", "/api/maps/posts", "").await.0, 404);
    assert!(!lab.data.path().join("maps/map-1.svg").exists());
    browser.send(json!({"type": "step", "ticks": 5})).await;
    browser.state("who has it goes on", |m| m["tick"] == 5).await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_browsers_of_a_session_are_limited() {
    let lab = Laboratory::open().await;
    let address = format!("ws://{}/api/sessions/main/live", lab.address);
    let mut all = Vec::new();
    for _ in 0..128 {
        all.push(connect_async(&address).await.unwrap().0);
    }
    assert!(connect_async(&address).await.is_err());
    drop(all.pop());
    let again = async {
        while connect_async(&address).await.is_err() {
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(10), again).await.expect("a free place");
    // Browsers that do not read do not delay the others.
    let mut operator = Browser::of(all.swap_remove(0));
    operator.send(json!({"type": "step", "ticks": 40})).await;
    let stepped = operator.state("forty ticks", |m| m["tick"] == 40);
    tokio::time::timeout(Duration::from_secs(5), stepped).await.expect("the server goes on");
    lab.close().await;
}
