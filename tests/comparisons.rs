//! Moments and comparisons of a session.

use std::cell::RefCell;

use serde_json::{Value, json};

use crate::support::{Browser, Laboratory};

/// Carries the bead for four seconds, displaces it, and continues for four more. Pauses at tick 1000.
async fn disturbed(browser: &mut Browser) -> Value {
    browser.send(json!({"type": "load_scenario", "map": "posts", "seed": 3, "start_m": [-0.25, -0.38]})).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 500})).await;
    browser.send(json!({"type": "disturb", "disturbance": {"displace": {"x_m": -0.24, "y_m": -0.5}}})).await;
    browser.send(json!({"type": "step", "ticks": 500})).await;
    browser.state("tick 1000", |m| m["tick"] == 1000).await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_comparison_runs_every_controller_while_the_session_is_paused() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let now = disturbed(&mut browser).await;
    browser.send(json!({"type": "fork", "tick": 250})).await;
    let done = |m: &Value| m["type"] == "comparison" && m["running"] == false;
    let comparison = browser.until("the comparison", done).await;
    assert_eq!((&comparison["tick"], &comparison["failed"]), (&json!(250), &Value::Null));
    let branches = comparison["branches"].as_array().unwrap();
    let names: Vec<&str> = branches.iter().map(|branch| branch["controller"].as_str().unwrap()).collect();
    assert_eq!(names, ["rl", "errt", "attractor"]);
    for branch in branches {
        assert_eq!(
            (&branch["done"], &branch["phase"]["code"]),
            (&json!(true), &json!("delivered")),
            "{}",
            branch["controller"]
        );
        assert!(branch["delivered_tick"].as_u64() > Some(500), "{}", branch["controller"]);
        assert!(branch["switches"].as_u64() >= Some(2), "the displaced bead is fetched");
        assert!(branch["tracking_error_mean_m"].as_f64() > Some(0.0));
    }
    // The branch of the session's controller repeats the session; the others do not.
    let at_1000 = |branch: &Value| branch["samples"][(1000 - 250) / 5 - 1].clone();
    let [(tool, bead)] = [(&now["tool_m"], &now["bead_m"])];
    let truth = json!([tool[0], tool[1], bead[0], bead[1]]);
    assert_eq!(at_1000(&branches[2]), truth);
    assert_ne!(at_1000(&branches[1]), truth);
    let (_, after) = lab.ask("GET", "/api/sessions/main/state", "").await;
    assert_eq!((&after["world_hash"], &after["tick"]), (&now["world_hash"], &json!(1000)));

    // A single controller; a browser that connects later receives the comparison and the events.
    browser.send(json!({"type": "fork", "tick": 1000, "controllers": ["errt"]})).await;
    browser.until("the second comparison", |m| done(m) && m["tick"] == 1000).await;
    let mut late = lab.browser().await;
    let goal = late.until("the goal's event", |m| m["type"] == "event" && m["kind"] == "goal").await;
    assert_eq!(goal["tick"], 0);
    let received = late.until("the comparison", |m| m["type"] == "comparison").await;
    assert_eq!((&received["branches"][0]["controller"], &received["branches"][1]), (&json!("errt"), &Value::Null));
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn undone_events_are_not_sent_and_events_while_paused_can_be_explained() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    disturbed(&mut browser).await;
    // Rewound, and this time without a displacement.
    browser.send(json!({"type": "rewind", "tick": 250})).await;
    browser.send(json!({"type": "step", "ticks": 400})).await;
    browser.state("tick 650", |m| m["tick"] == 650).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.1, "y_m": -0.33})).await;
    browser.until("the goal", |m| m["type"] == "event" && m["tick"] == 650).await;
    let mut late = lab.browser().await;
    let received = RefCell::new(Vec::new());
    late.until("the last event", |m| {
        if m["type"] == "event" {
            received.borrow_mut().push((m["tick"].as_u64().unwrap(), m["kind"].as_str().unwrap().to_owned()));
        }
        m["type"] == "event" && m["tick"] == 650
    })
    .await;
    let received: Vec<_> = received.into_inner().into_iter().filter(|(_, kind)| kind != "session").collect();
    assert_eq!(received, [(0, "goal".to_owned()), (650, "goal".to_owned())]);
    // No control step starts at that tick: the previous one is explained.
    let (status, moment) = lab.ask("GET", "/api/sessions/main/moments/650", "").await;
    assert_eq!((status, &moment["tick"]), (200, &json!(625)), "{moment}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn impossible_comparisons_are_refused() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    for (tick, code) in [(0, "no_goal"), (1, "out_of_range")] {
        browser.send(json!({"type": "fork", "tick": tick})).await;
        let error = browser.error().await;
        assert_eq!((&error["code"], &error["field"]), (&json!(code), &json!("tick")), "{error}");
    }
    browser.send(json!({"type": "fork", "tick": 0, "controllers": ["magic"]})).await;
    assert_eq!(browser.error().await["field"], "controllers[0]");
    // The server must not wait for it when it stops.
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "fork", "tick": 0})).await;
    browser.until("the start of a comparison", |m| m["type"] == "comparison").await;
    let stopped = std::time::Instant::now();
    lab.close().await;
    assert!(stopped.elapsed().as_secs_f64() < 2.0, "{:?}", stopped.elapsed());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_switch_gives_its_reason() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    disturbed(&mut browser).await;
    let mut late = lab.browser().await;
    let switch = late.until("a switch", |m| m["type"] == "event" && m["kind"] == "switch").await;
    let tick = switch["tick"].as_u64().unwrap();
    let path = format!("/api/sessions/main/moments/{tick}");
    let (status, moment) = lab.ask("GET", &path, "").await;
    assert_eq!(status, 200, "{moment}");
    assert_eq!((&moment["tick"], &moment["mode"]), (&json!(tick), &json!(1)));
    assert_eq!(moment["switched"], true);
    assert!(moment["error_m"].as_f64() > moment["threshold_m"].as_f64(), "{moment}");
    let reason = moment["reason"]["text"].as_str().unwrap();
    assert!(switch["what"]["text"].as_str().unwrap().ends_with(reason), "{switch} {reason}");
    assert_eq!(moment["overlay"]["tick"], tick);
    // Any tick is answered by the control step before it; ticks that are not kept return 404.
    let (_, same) = lab.ask("GET", &format!("/api/sessions/main/moments/{}", tick + 3), "").await;
    assert_eq!(same["tick"], tick);
    let (status, problem) = lab.ask("GET", "/api/sessions/main/moments/1001", "").await;
    assert_eq!((status, &problem["code"], &problem["field"]), (404, &json!("not_held"), &json!("tick")));

    // The pictures belong to that moment.
    for (name, width_px, height_px) in [("camera", 480, 480), ("observation", 168, 84)] {
        let bytes = lab.bytes(&format!("{path}/{name}.png")).await;
        let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        assert_eq!((reader.info().width, reader.info().height), (width_px, height_px), "{name}");
    }
    lab.close().await;
}
