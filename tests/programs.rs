//! A program outside of Ferry as sub-controller 2.

use std::sync::Arc;
use std::time::Duration;

use ferry::camera::ImageSource;
use ferry::geometry::Point2;
use ferry::scenario::{ControllerName, Scenario};
use ferry::trial::{
    Arena, Beginning, Deciding, Entry, Input, InputError, InputLog, LoggedBeginning, LoggedTick, Phase,
    REASON_BYTES_MOST, Seen, Source, Trial, replay,
};

use futures_util::{SinkExt, StreamExt};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::{Error, Message};

use crate::support::{Browser, Laboratory, gpu};

fn scenario(arena: &Arena) -> Scenario {
    Scenario::random(&arena.map, "posts", &arena.space, ControllerName::Program, 1, 4, 0).unwrap()
}

/// A place on the shortest path to the goal, or beyond it in the same direction.
fn ahead(arena: &Arena, from: Point2<f64>, goal: Point2<f64>, by_m: f64) -> Input {
    let path = arena.space.taut_path(from, goal).unwrap();
    let next = from + (path[1] - from).normalize() * by_m;
    Input::Go { x_m: next.x, y_m: next.y }
}

/// Asks `program` before each control step, until the trial ends.
fn run(
    trial: &mut Trial,
    camera: &mut dyn ImageSource,
    program: &mut dyn FnMut(&Trial, &Seen) -> Option<Input>,
) -> Vec<LoggedTick> {
    let mut ticks = Vec::new();
    while !trial.state().world.phase.is_final() {
        let source = if trial.step_is_due() {
            let seen = trial.see(camera).unwrap();
            if trial.question(&seen).is_some()
                && let Some(answer) = program(trial, &seen)
            {
                trial.apply(answer).unwrap();
            }
            Source::Seen(Box::new(seen))
        } else {
            Source::Camera(camera)
        };
        ticks.push(LoggedTick::from(&trial.tick(source).unwrap()));
    }
    ticks
}

#[test]
fn a_program_delivers_and_its_log_replays_without_it() {
    let arena = Arena::open("posts").unwrap();
    let mut camera = arena.camera(&gpu()).unwrap();
    let mut trial = Trial::new(scenario(&arena), arena.clone()).unwrap();
    let begun = Entry::Begin(Box::new(LoggedBeginning::of(&trial, Beginning::SetUp)));
    let mut asked = 0;
    let ticks = run(&mut trial, &mut camera, &mut |trial, seen| {
        asked += 1;
        let question = trial.question(seen).unwrap();
        assert_eq!(question.tool_m, trial.tool_m().xy());
        assert_eq!(trial.observation(seen).places().len(), 4);
        // A rule that knows the map: along the shortest path, two steps ahead.
        Some(ahead(&arena, question.tool_m, question.goal_m, 0.02))
    });
    assert_eq!(trial.state().world.phase, Phase::Delivered);
    let counters = trial.state().world.counters;
    assert!(counters.disturbances == 1 && counters.switches >= 2, "sub-controller 1 fetches the bead: {counters:?}");
    assert!(asked > 20 && asked < counters.steps, "asked {asked} times in {} steps", counters.steps);

    let entries = std::iter::once(begun).chain(ticks.into_iter().map(Entry::Tick)).collect();
    let log = InputLog { entries, torn_bytes: 0 };
    replay(&log, None, &mut |_| {}).unwrap();
    let mut make_camera = |arena: &Arena| Ok(Box::new(arena.camera(&gpu())?) as Box<dyn ImageSource>);
    let deciding = Deciding { make_camera: &mut make_camera, policies: Arc::default() };
    replay(&log, Some(deciding), &mut |_| {}).unwrap();
}

#[test]
fn without_a_usable_answer_the_arm_holds() {
    let arena = Arena::open("posts").unwrap();
    let mut camera = arena.camera(&gpu()).unwrap();
    let mut refusal_after = |answer: Option<Input>| {
        let mut trial = Trial::new(scenario(&arena), arena.clone()).unwrap();
        let seen = trial.see(&mut camera).unwrap();
        if let Some(answer) = answer {
            trial.apply(answer).unwrap();
        }
        let before = trial.tool_m();
        let record = trial.tick(Source::Seen(Box::new(seen))).unwrap();
        // The answer is for one step.
        let second = (1..=32).map(|_| trial.tick(Source::Camera(&mut camera)).unwrap()).last().unwrap();
        assert_eq!(second.moment.refusal.as_deref(), Some("the program: it gave no answer"));
        (record.moment.refusal, (trial.tool_m() - before).norm())
    };
    let held = |(refusal, moved_m): (Option<String>, f64)| {
        assert!(moved_m < 1e-9);
        refusal.unwrap()
    };
    assert_eq!(held(refusal_after(None)), "the program: it gave no answer");
    let hold = Input::Hold { reason: "I see nothing".to_owned() };
    assert_eq!(held(refusal_after(Some(hold))), "the program: I see nothing");
    // A place far away is a direction.
    let Scenario { start_m, goal_m, .. } = scenario(&arena);
    let (refusal, moved_m) = refusal_after(Some(ahead(&arena, start_m.unwrap(), goal_m.unwrap(), 7.0)));
    assert!(refusal.is_none() && (0.008..0.0101).contains(&moved_m), "{refusal:?} {moved_m}");
}

#[test]
fn refused_answers_change_nothing() {
    let arena = Arena::open("posts").unwrap();
    let refused = |controller, answer: Input| {
        let mut trial = Trial::new(Scenario { controller, ..scenario(&arena) }, arena.clone()).unwrap();
        let before = (trial.state().world_hash(), trial.state().controller_hash());
        let error = trial.apply(answer).unwrap_err();
        assert_eq!((trial.state().world_hash(), trial.state().controller_hash()), before);
        assert!(trial.waiting_inputs().is_empty());
        (error.field(), error)
    };
    let go = |x_m| Input::Go { x_m, y_m: -0.3 };
    let (field, error) = refused(ControllerName::Program, go(f64::NAN));
    assert!(field == "target_m" && error.to_string() == "target_m is NaN, it must be finite", "{error}");
    let reason = "x".repeat(REASON_BYTES_MOST + 1);
    assert_eq!(
        refused(ControllerName::Program, Input::Hold { reason }),
        ("reason", InputError::LongReason { bytes: 201 })
    );
    let other = InputError::NotProgram(ControllerName::Errt);
    assert_eq!(refused(ControllerName::Errt, go(0.0)), ("type", other));
}

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
    let state = page.state("a delivery", |m| m["phase"] == "delivered").await;
    let standing = &state["program"];
    assert_eq!((&standing["name"], &standing["is_connected"]), (&json!("mine"), &json!(true)));
    // 20 cm at 4 cm/s take 5 s, and the last two centimetres are Ferry's.
    assert!(standing["answers"].as_u64().unwrap() >= 17, "{standing}");
    answering.abort();
    assert!(answering.await.unwrap_err().is_cancelled());

    page.send(json!({"type": "set_goal", "x_m": -0.1, "y_m": -0.35})).await;
    let state = page.state("a hold", |m| m["refusal"].is_string()).await;
    assert_eq!(state["refusal"], "the program: mine is not connected");
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
        let fits = |m: &Value| m["refusal"].as_str().is_some_and(|refusal| refusal.contains(text));
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
    page.state("a delivery by ERRT", |m| m["phase"] == "delivered").await;
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
        ended["branches"].as_array().unwrap().iter().map(|one| (&one["program"], &one["phase"])).collect();
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
    let is_held = |m: &Value| m["refusal"] == "the program: mine is not connected";
    assert_eq!(page.state("a hold", is_held).await["running"], true);
    // The session goes on with a program that answers well.
    page.send(json!({"type": "set_speed", "factor": 4})).await;
    let answering = tokio::spawn(go_straight(connect(&laboratory, "mine").await));
    page.state("a delivery", |m| m["phase"] == "delivered").await;
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
