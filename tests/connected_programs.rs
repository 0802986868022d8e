//! Programs that are connected to a server: in sessions, evaluations and comparisons, and with damaged messages.

use std::time::Duration;

use futures_util::{SinkExt, StreamExt};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::{Error, Message};

use crate::support::{Browser, Laboratory};

/// A program, connected as `name`.
async fn connect(laboratory: &Laboratory, name: &str) -> Browser {
    let address = format!("ws://{}/api/controllers/{name}?protocol=1", laboratory.address);
    let mut program = Browser::of(connect_async(address).await.unwrap().0);
    let hello = program.until("hello", |m| m["type"] == "hello").await;
    assert_eq!((&hello["protocol"], &hello["name"]), (&json!(1), &json!(name)));
    program
}

/// A page that carries on the map `open` with the program `mine`, running.
async fn open_page(laboratory: &Laboratory) -> Browser {
    let mut page = laboratory.browser().await;
    page.send(json!({"type": "load_scenario", "map": "open", "start_m": [-0.1, -0.35], "goal_m": [0.1, -0.35]})).await;
    page.send(json!({"type": "select_controller", "controller": "program", "program": "mine"})).await;
    page.send(json!({"type": "run"})).await;
    page
}

async fn observed(program: &mut Browser) -> Value {
    program.until("a question", |m| m["type"] == "observe").await
}

/// A question whose time has just begun: those before it are passed over.
async fn newly_observed(program: &mut Browser) -> Value {
    while tokio::time::timeout(Duration::from_millis(120), observed(program)).await.is_ok() {}
    observed(program).await
}

/// Answers every question: straight to the goal.
async fn go_straight(mut program: Browser) {
    loop {
        let asked = observed(&mut program).await;
        assert_eq!(asked["image"]["size_px"], 480);
        program.send(json!({"type": "act", "request": asked["request"], "target_m": asked["goal_m"]})).await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_connected_program_carries_the_bead() {
    let laboratory = Laboratory::open().await;
    let mut program = connect(&laboratory, "mine").await;
    let mut page = open_page(&laboratory).await;
    let answering = tokio::spawn(async move {
        let start = program.until("a leg", |m| m["type"] == "start").await;
        assert_eq!((&start["trial"], &start["map"]), (&json!("main"), &json!("open")));
        assert!(start["parameters"]["transport_speed_m_s"].is_number());
        go_straight(program).await;
    });
    let state = page.state("a delivery", |m| m["phase"]["code"] == "delivered").await;
    let standing = &state["program"];
    assert_eq!((&standing["name"], &standing["is_connected"]), (&json!("mine"), &json!(true)));
    // 20 cm at 4 cm/s take 5 s, and the last two centimetres are Ferry's.
    assert!(standing["answers"].as_u64().unwrap() >= 17, "{standing}");
    answering.abort();
    assert!(answering.await.unwrap_err().is_cancelled());

    page.send(json!({"type": "set_goal", "x_m": -0.1, "y_m": -0.35})).await;
    let state = page.state("a hold", |m| m["refusal"].is_object()).await;
    assert_eq!(state["refusal"]["text"], "the program: mine is not connected");
    let (_, listed) = laboratory.ask("GET", "/api/controllers", "").await;
    assert_eq!(listed["programs"][0]["is_connected"], false);
    // Under the same name it goes on.
    let mut again = connect(&laboratory, "mine").await;
    assert_eq!(observed(&mut again).await["goal_m"], json!([-0.1, -0.35]));
    laboratory.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_arm_holds_when_a_program_is_slow_or_wrong() {
    let laboratory = Laboratory::open().await;
    let mut program = connect(&laboratory, "mine").await;
    let mut page = open_page(&laboratory).await;
    let refused = async |page: &mut Browser, text: &str| {
        let fits = |m: &Value| m["refusal"]["text"].as_str().is_some_and(|refusal| refusal.contains(text));
        page.state(text, fits).await
    };
    refused(&mut page, "the program: mine gave no answer within 100 ms").await;
    for (message, field, text) in [
        (json!({"type": "act", "request": 0}), "target_m", "mine sent a message that cannot be used"),
        (json!({"type": "jump"}), "type", "mine sent a message that cannot be used"),
        (json!({"type": "act", "request": 1 << 40, "target_m": [0, 0]}), "request", "mine gave no answer"),
    ] {
        let mut message = message;
        let asked = newly_observed(&mut program).await;
        if message["request"] == 0 {
            message["request"] = asked["request"].clone();
        }
        program.send(message).await;
        assert_eq!(program.error().await["field"], field);
        refused(&mut page, text).await;
    }
    let asked = newly_observed(&mut program).await;
    program.send(json!({"type": "hold", "request": asked["request"], "reason": "I see nothing"})).await;
    refused(&mut page, "the program: mine: I see nothing").await;
    // A step that the limits refuse.
    let asked = newly_observed(&mut program).await;
    program.send(json!({"type": "act", "request": asked["request"], "target_m": [1e300, -0.35]})).await;
    let state = page.state("an answer", |m| m["program"]["answers"].as_u64() >= Some(2)).await;
    assert!(state["running"] == true && state["program"]["missed"].as_u64() >= Some(1), "{state}");
    // The session still takes commands while it waits.
    page.send(json!({"type": "pause"})).await;
    page.state("a pause", |m| m["running"] == false).await;
    page.send(json!({"type": "step", "ticks": 40})).await;
    tokio::time::sleep(Duration::from_millis(400)).await;
    page.send(json!({"type": "select_controller", "controller": "errt"})).await;
    page.send(json!({"type": "run"})).await;
    page.state("a delivery by ERRT", |m| m["phase"]["code"] == "delivered").await;
    laboratory.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_program_is_evaluated_and_compared_beside_ferrys_controllers() {
    let laboratory = Laboratory::open().await;
    let query = |change: Value| {
        let mut query = json!({"controllers": ["attractor", "program"], "maps": ["open"], "disturbances": [1],
            "episodes": 3, "seed": 5, "program": "mine"});
        query.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
        query.to_string()
    };
    let (status, problem) = laboratory.ask("POST", "/api/evaluations", &query(json!({}))).await;
    assert_eq!((status, &problem["field"]), (422, &json!("program")), "{problem}");
    assert_eq!(problem["detail"], "program is \"mine\", which is not connected");

    let answering = tokio::spawn(go_straight(connect(&laboratory, "mine").await));
    let report = async |query: String| {
        let (status, made) = laboratory.ask("POST", "/api/evaluations", &query).await;
        assert_eq!(status, 201, "{made}");
        let path = format!("/api/evaluations/{}", made["id"].as_str().unwrap());
        loop {
            let (_, report) = laboratory.ask("GET", &path, "").await;
            if !["waiting", "running"].contains(&report["stage"].as_str().unwrap()) {
                return report;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    let done = report(query(json!({}))).await;
    assert_eq!(done["stage"], "done", "{done}");
    let row = |index: usize| (done["rows"][index]["controller"].clone(), done["rows"][index]["delivered"].clone());
    assert_eq!([row(0), row(1)], [(json!("attractor"), json!(3)), (json!("mine"), json!(3))]);
    assert_eq!((&done["comparisons"][0]["against"], &done["comparisons"][0]["both"]), (&json!("mine"), &json!(3)));
    assert_eq!(done["cells"][1]["program"], "mine");

    // A comparison goes on from a moment under the session's program, too.
    let mut page = laboratory.browser().await;
    page.send(json!({"type": "load_scenario", "map": "open", "start_m": [-0.1, -0.35], "goal_m": [0.1, -0.35]})).await;
    page.send(json!({"type": "select_controller", "controller": "program", "program": "mine"})).await;
    page.send(json!({"type": "fork", "tick": 0, "controllers": ["errt", "program"]})).await;
    let ended = page.until("the comparison", |m| m["type"] == "comparison" && m["running"] == false).await;
    assert_eq!(ended["failed"], Value::Null);
    let branches: Vec<_> =
        ended["branches"].as_array().unwrap().iter().map(|one| (&one["program"], &one["phase"]["code"])).collect();
    assert_eq!(branches, [(&Value::Null, &json!("delivered")), (&json!("mine"), &json!("delivered"))]);

    // An evaluation whose program leaves fails, and says so.
    let long = query(json!({"controllers": ["program"], "episodes": 1000}));
    let (_, made) = laboratory.ask("POST", "/api/evaluations", &long).await;
    let path = format!("/api/evaluations/{}", made["id"].as_str().unwrap());
    tokio::time::sleep(Duration::from_secs(1)).await;
    answering.abort();
    loop {
        let (_, report) = laboratory.ask("GET", &path, "").await;
        match report["stage"].as_str().unwrap() {
            "failed" => break assert_eq!(report["message"], "mine is not connected"),
            stage => assert!(["waiting", "running"].contains(&stage), "{report}"),
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    laboratory.close().await;
}

/// A message of a program, or one that was damaged.
fn damaged(rng: &mut ChaCha8Rng) -> String {
    let whole = [
        r#"{"type":"act","request":1,"target_m":[0.1,-0.3]}"#,
        r#"{"type":"hold","request":1,"reason":"it thinks"}"#,
        r#"{"type":"act","request":18446744073709551615,"target_m":[1e308,-1e308]}"#,
        "[[[[[[[[",
        "",
    ];
    let parts =
        ["{", "}", "[", "]", "\"", ":", ",", "NaN", "null", "-", "1e999", "é", "\u{0}", "type", "act", "\\ud800"];
    let mut text = whole[rng.random_range(0..whole.len())].replace(":1,", &format!(":{},", rng.random_range(1..900)));
    for _ in 0..rng.random_range(0..4) {
        let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
        let at = places[rng.random_range(0..places.len())];
        if rng.random() {
            text.insert_str(at, parts[rng.random_range(0..parts.len())]);
        } else {
            text.truncate(at);
        }
    }
    text
}

/// Sends damaged messages as fast as the server reads them. Returns how many it has refused.
async fn send_damaged(program: Browser, count: u64, seed: u64) -> u64 {
    let (mut to, mut from) = program.socket.split();
    let sending = async move {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        for _ in 0..count {
            let text = damaged(&mut rng);
            let message = if rng.random_range(0..50) == 0 { Message::binary(text) } else { Message::text(text) };
            to.send(message).await.unwrap();
        }
        to.send(Message::Close(None)).await.unwrap();
    };
    let counting = async move {
        let mut refused = 0;
        while let Some(Ok(message)) = from.next().await {
            if let Message::Text(text) = message {
                let message: Value = serde_json::from_str(&text).unwrap();
                refused += u64::from(message["type"] == "error");
                assert!(message["type"] != "error" || message["message"].as_str().is_some_and(|text| !text.is_empty()));
            }
        }
        refused
    };
    tokio::join!(sending, counting).1
}

#[tokio::test(flavor = "multi_thread")]
async fn a_hundred_thousand_damaged_messages_do_no_harm() {
    // The server reads 500 messages per second of each.
    const PROGRAMS: u64 = 20;
    const EACH: u64 = 5000;
    let laboratory = Laboratory::open().await;
    let mut programs = vec![connect(&laboratory, "mine").await];
    for number in 1..PROGRAMS {
        programs.push(connect(&laboratory, &format!("other-{number}")).await);
    }
    // It is asked meanwhile.
    let mut page = open_page(&laboratory).await;
    page.send(json!({"type": "set_speed", "factor": 0.25})).await;
    let sending: Vec<_> =
        programs.into_iter().zip(1..).map(|(program, seed)| tokio::spawn(send_damaged(program, EACH, seed))).collect();
    let mut refused = 0;
    for one in sending {
        refused += one.await.unwrap();
    }
    assert!(refused > PROGRAMS * EACH / 2, "{refused}");
    let is_held = |m: &Value| m["refusal"]["text"] == "the program: mine is not connected";
    assert_eq!(page.state("a hold", is_held).await["running"], true);
    // The session goes on with a program that answers well.
    page.send(json!({"type": "set_speed", "factor": 4})).await;
    let answering = tokio::spawn(go_straight(connect(&laboratory, "mine").await));
    page.state("a delivery", |m| m["phase"]["code"] == "delivered").await;
    answering.abort();
    laboratory.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn connections_are_refused_by_field() {
    let laboratory = Laboratory::open().await;
    let _first = connect(&laboratory, "mine").await;
    for (path, status, text) in [
        ("mine?protocol=1", 409, "a program with the name \"mine\" is connected already"),
        ("mine?protocol=2", 422, "protocol is 2, this server has 1"),
        ("mine", 400, "missing field `protocol`"),
        ("rl?protocol=1", 422, "\"rl\" cannot be the name of a program"),
        ("M%20x?protocol=1", 422, "\"M x\" cannot be the name of a program"),
    ] {
        let address = format!("ws://{}/api/controllers/{path}", laboratory.address);
        let Err(Error::Http(refused)) = connect_async(address).await else { panic!("{path} is refused") };
        let body = String::from_utf8(refused.body().clone().unwrap_or_default()).unwrap();
        let detail = serde_json::from_str::<Value>(&body).unwrap()["detail"].as_str().unwrap().to_owned();
        assert!(refused.status().as_u16() == status && detail.contains(text), "{path}: {} {detail}", refused.status());
    }
    let mut page = laboratory.browser().await;
    page.send(json!({"type": "select_controller", "controller": "program", "program": "other"})).await;
    let error = page.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("no_program"), &json!("program")));
    laboratory.close().await;
}
