//! Challenges over HTTP and the WebSocket: an attempt is played in real time, judged, and put on the board.

use ferry_camera::Camera;
use ferry_core::challenge::Challenge;
use ferry_core::geometry::Point2;
use ferry_core::scenario::ControllerName;
use serde_json::{Value, json};

use crate::support::{Browser, Laboratory, gpu};

const NAME: &str = "easy-2026-11-26";
/// Samples of a fifth of a second that the hand is ahead of the nearest one.
const AHEAD: usize = 4;

/// Follows the way of ERRT's tool until the delivery; returns the last state.
async fn play(browser: &mut Browser, challenge: &Challenge) -> Value {
    let mut camera = Camera::of(&gpu(), challenge.arena.static_scene()).unwrap();
    let way = challenge.ghost(ControllerName::Errt, &mut camera).unwrap().trace.samples;
    browser.send(json!({"type": "play_challenge", "challenge": challenge.name.to_string()})).await;
    browser.until("the scene", |m| m["type"] == "scene" && m["challenge"] == challenge.name.to_string()).await;
    browser.send(json!({"type": "run"})).await;
    let (mut next, mut nearest) = (1, 0);
    loop {
        let is_over = |m: &Value| m["attempt"]["is_delivered"] == true || m["attempt"]["is_time_up"] == true;
        let state = browser.state("a fifth of a second", |m| m["tick"].as_u64().unwrap() >= next || is_over(m)).await;
        if is_over(&state) {
            assert_eq!(state["attempt"]["is_delivered"], true, "{state}");
            return state;
        }
        assert_eq!(state["attempt"]["void"], Value::Null, "{state}");
        next = state["tick"].as_u64().unwrap() + 25;
        let [x_m, y_m] = [0, 1].map(|index| state["tool_m"][index].as_f64().unwrap());
        let off_m = |index: &usize| (way[*index].tool_m - Point2::new(x_m, y_m)).norm();
        let ahead = nearest..way.len().min(nearest + 4 * AHEAD);
        nearest = ahead.min_by(|a, b| off_m(a).total_cmp(&off_m(b))).unwrap();
        let place = way[way.len().min(nearest + AHEAD + 1) - 1].tool_m;
        browser.send(json!({"type": "steer", "x_m": place.x, "y_m": place.y})).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_attempt_that_was_played_counts_once_and_a_changed_one_does_not() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let seat_of = |hello: Value| hello["seat"].as_str().unwrap().to_owned();
    let seat = seat_of(browser.until("a greeting", |m| m["type"] == "hello").await);
    let challenge = Challenge::of(NAME.parse().unwrap()).unwrap();
    let post = |name: &str, body: Value| {
        let (path, body) = (format!("/api/challenges/{name}/attempts"), body.to_string());
        let lab = &lab;
        async move { lab.ask("POST", &path, &body).await }
    };
    let last = play(&mut browser, &challenge).await;
    assert_eq!(last["running"], false, "the session pauses at the delivery");

    let (status, report) = lab.ask("GET", "/api/sessions/main/attempt", "").await;
    assert_eq!((status, &report["challenge"]), (200, &json!(NAME)), "{report}");
    let attempt = report["attempt"].clone();
    assert_eq!(attempt["score"]["walls"], last["attempt"]["walls"]);
    assert!(report["remaining_m"].as_f64().unwrap() < 0.03, "{report}");
    let query =
        |player: &str, attempt: &Value| json!({"session": "main", "seat": seat, "player": player, "attempt": attempt});

    let edited = |pointer: &str, value: Value| {
        let mut edited = attempt.clone();
        *edited.pointer_mut(pointer).unwrap() = value;
        edited
    };
    let tick = attempt["score"]["tick"].as_u64().unwrap();
    for (forged, field) in [
        (edited("/log/inputs/0/input/steer/x_m", json!(0.01)), "attempt.log"),
        (edited("/log/scenario/seed", json!(1)), "attempt.log"),
        (edited("/log/about", json!("better")), "attempt.log"),
        (edited("/score/tick", json!(tick - 125)), "attempt.score.tick"),
        (edited("/world_hash", json!("0000000000000000")), "attempt.world_hash"),
    ] {
        let (status, problem) = post(NAME, query("Eve", &forged)).await;
        assert_eq!((status, &problem["field"]), (422, &json!(field)), "{problem}");
    }
    let (status, problem) = post("easy-other", query("Eve", &attempt)).await;
    assert_eq!((status, &problem["code"]), (422, &json!("other_challenge")), "{problem}");
    let (status, problem) = post(NAME, query("", &attempt)).await;
    assert_eq!((status, &problem["field"]), (422, &json!("player")), "{problem}");
    for name in ["A\u{200b}da", "\u{202e}adA", "\u{2066}Ada"] {
        let (status, problem) = post(NAME, query(name, &attempt)).await;
        assert_eq!((status, &problem["field"]), (422, &json!("player")), "{problem}");
    }
    // Another browser cannot post it, also when it has control.
    let mut eve = lab.browser().await;
    let other = seat_of(eve.until("a greeting", |m| m["type"] == "hello").await);
    assert_ne!(other, seat);
    browser.send(json!({"type": "release_control"})).await;
    eve.send(json!({"type": "take_control"})).await;
    eve.until("control", |m| m["type"] == "hello" && m["role"] == "operator").await;
    for key in [json!(other), json!("")] {
        let mut forged = query("Eve", &attempt);
        forged["seat"] = key;
        let (status, problem) = post(NAME, forged).await;
        assert_eq!((status, &problem["code"], &problem["field"]), (422, &json!("other_player"), &json!("seat")));
    }
    drop(eve);
    // Connected again, the player has the same seat.
    drop(browser);
    let mut browser = Browser::with(lab.address, &format!("?seat={seat}")).await;
    // The server may notice later that the other one has left.
    browser.send(json!({"type": "take_control"})).await;
    assert_eq!(seat_of(browser.until("a greeting", |m| m["type"] == "hello" && m["role"] == "operator").await), seat);
    let elsewhere = json!({"session": "other", "seat": seat, "player": "Eve", "attempt": attempt});
    let (status, problem) = post(NAME, elsewhere).await;
    assert_eq!((status, &problem["field"]), (422, &json!("session")), "{problem}");
    assert!(!lab.data.path().join("challenges").exists(), "a refused attempt leaves nothing");

    let (status, answer) = post(NAME, query("Ada", &attempt)).await;
    assert_eq!((status, &answer["place"], &answer["is_kept"]), (201, &json!(1), &json!(true)), "{answer}");
    assert_eq!(answer["total_s"], last["attempt"]["total_s"], "the page showed the same score");
    let (status, problem) = post(NAME, query("Eve", &attempt)).await;
    assert_eq!((status, &problem["code"]), (409, &json!("again")), "{problem}");

    let (_, board) = lab.ask("GET", &format!("/api/challenges/{NAME}"), "").await;
    assert_eq!((board["board"].as_array().unwrap().len(), &board["board"][0]["player"]), (1, &json!("Ada")), "{board}");
    let (_, ghosts) = lab.ask("GET", &format!("/api/challenges/{NAME}/ghosts"), "").await;
    let whose: Vec<_> = ghosts["ghosts"].as_array().unwrap().iter().map(|ghost| ghost["controller"].clone()).collect();
    assert_eq!(whose, ["rl", "errt", "attractor", "you"], "{ghosts}");
    assert_eq!(ghosts["ghosts"][3]["player"], "Ada");
    let (_, list) = lab.ask("GET", "/api/challenges", "").await;
    let all = list["challenges"].as_array().unwrap();
    assert!(all.iter().any(|one| one["name"] == NAME && one["entries"] == 1), "{list}");

    // Rewinding after the end changes nothing: the attempt is over.
    browser.send(json!({"type": "rewind", "tick": 0})).await;
    let state = browser.state("the start", |m| m["tick"] == 0).await;
    assert_eq!(state["attempt"]["is_delivered"], true, "{state}");
    // Another map ends the challenge.
    browser.send(json!({"type": "load_scenario", "map": "open"})).await;
    browser.state("no attempt", |m| m["attempt"].is_null()).await;
    let (status, problem) = lab.ask("GET", "/api/sessions/main/attempt", "").await;
    assert_eq!((status, &problem["code"]), (422, &json!("no_challenge")), "{problem}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_attempt_that_was_not_played_in_one_go_does_not_count() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let goal = json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33});
    for (commands, why) in [
        (vec![json!({"type": "run"}), json!({"type": "pause"})], "it was paused"),
        (vec![json!({"type": "step", "ticks": 10})], "it was paused"),
        (vec![json!({"type": "set_speed", "factor": 0.5})], "another speed was chosen"),
        (vec![json!({"type": "run"}), json!({"type": "rewind", "tick": 0})], "it was rewound"),
        (vec![goal], "something else than the magnet was moved or set"),
        (
            vec![json!({"type": "select_controller", "controller": "rl"})],
            "something else than the magnet was moved or set",
        ),
    ] {
        browser.send(json!({"type": "play_challenge", "challenge": NAME})).await;
        browser
            .state("a new attempt", |m| m["tick"] == 0 && m["attempt"]["void"].is_null() && !m["attempt"].is_null())
            .await;
        for command in &commands {
            browser.send(command.clone()).await;
            if command["type"] == "run" {
                browser.state("it runs", |m| m["tick"].as_u64().unwrap() > 3).await;
            }
        }
        let state = browser.state(why, |m| !m["attempt"]["void"].is_null()).await;
        assert_eq!(state["attempt"]["void"]["text"], why, "{commands:?}");
        // A reset begins the challenge again.
        browser.send(json!({"type": "reset"})).await;
        let fits = |m: &Value| m["tick"] == 0 && m["attempt"]["void"].is_null() && m["controller"] == "you";
        let state = browser.state("the same challenge again", fits).await;
        assert_eq!(state["attempt"]["is_delivered"], false, "{state}");
    }
    browser.send(json!({"type": "play_challenge", "challenge": "expert-1"})).await;
    let error = browser.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("malformed"), &json!("challenge")), "{error}");
    browser.send(json!({"type": "steer", "x_m": 0.0, "y_m": -0.3})).await;
    browser.state("still counting", |m| m["attempt"]["void"].is_null() && m["steer_m"].is_array()).await;
    lab.close().await;
}
