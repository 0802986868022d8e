//! Cases kept from the page: recorded inputs are applied again and must end as expected.

use std::ops::ControlFlow;
use std::path::Path;

use ferry_camera::Camera;
use ferry_core::trial::{Arena, Case};
use ferry_files::open;
use serde_json::{Value, json};

use crate::support::{Browser, Laboratory, ferry, gpu};

fn kept() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn run(case: &Case) -> ferry_core::trial::CaseOutcome {
    let arena = open::arena_of(case).unwrap();
    let mut camera = Camera::of(&gpu(), arena.static_scene()).unwrap();
    case.run(&arena, &mut camera, &mut |_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn every_kept_case_ends_as_expected() {
    let paths = kept();
    assert!(paths.len() >= 3, "{paths:?}");
    for path in paths {
        let case = open::case(path.to_str().unwrap()).unwrap();
        assert!(case.expect.is_some(), "{} expects nothing", path.display());
        let outcome = run(&case);
        assert!(outcome.meets(&case), "{}: expected {:?}, found {outcome:?}", path.display(), case.expect);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_drag_becomes_a_case_that_repeats_it() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (status, problem) = lab.ask("GET", "/api/sessions/main/case.json", "").await;
    assert_eq!(
        (status, &problem["code"], &problem["field"]),
        (422, &json!("nothing_carried"), &json!("tick")),
        "{problem}"
    );

    browser.send(json!({"type": "load_scenario", "map": "posts", "start_m": [-0.25, -0.38], "seed": 5})).await;
    // While paused, and after a rewind.
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.34})).await;
    browser.send(json!({"type": "step", "ticks": 200})).await;
    browser.send(json!({"type": "rewind", "tick": 0})).await;
    drag(&mut browser).await;
    let (status, text) = lab.ask("GET", "/api/sessions/main/case.json", "").await;
    assert_eq!(status, 200, "{text}");
    let case: Case = serde_json::from_value(text.clone()).unwrap();
    let named: Vec<&str> = text["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|timed| timed["input"].as_object().unwrap().keys().next().unwrap().as_str())
        .collect();
    assert_eq!(named, ["set_goal", "set_goal", "drag", "place"], "{text}");
    assert_eq!(case.expect.unwrap().deliveries, 1);

    // The case starts from the session's state and continues to its end.
    let mut at_401 = None;
    let arena = Arena::shipped("posts").unwrap();
    let outcome = case
        .run(&arena, &mut Camera::of(&gpu(), arena.static_scene()).unwrap(), &mut |record| {
            if record.tick == 401 {
                at_401 = Some(format!("{:016x}", record.world.total()));
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    let (_, state) = lab.ask("GET", "/api/sessions/main/state", "").await;
    assert_eq!(json!(at_401.unwrap()), state["world_hash"]);
    assert!(outcome.meets(&case) && outcome.refused.is_empty(), "{outcome:?}");
    assert_eq!((outcome.counters.deliveries, outcome.counters.disturbances), (1, 1));

    // A controller that does not deliver fails the case.
    let mut hopeless = case.clone();
    hopeless.expect.as_mut().unwrap().by_tick = 500;
    assert!(!run(&hopeless).meets(&hopeless));

    // The case can be rendered.
    let path = lab.data.path().join("case.json");
    std::fs::write(&path, text.to_string()).unwrap();
    let drawn = ferry(&[])
        .args(["render", "--scenario"])
        .arg(&path)
        .arg("--out")
        .arg(lab.data.path().join("case.svg"))
        .output()
        .unwrap();
    assert!(drawn.status.success(), "{}", String::from_utf8_lossy(&drawn.stderr));
    assert!(String::from_utf8_lossy(&drawn.stdout).contains("delivered"));
}

/// Goes on for 401 ticks with a drag. Returns the last state.
async fn drag(browser: &mut Browser) -> Value {
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 300})).await;
    browser.send(json!({"type": "drag", "x_m": 0.0, "y_m": -0.45, "lift": true})).await;
    browser.send(json!({"type": "step", "ticks": 100})).await;
    browser.send(json!({"type": "release"})).await;
    browser.send(json!({"type": "step", "ticks": 1})).await;
    browser.state("401 ticks", |m| m["tick"] == 401).await
}

/// A trial of 401 ticks with a drag, as a test case, and its last state.
async fn dragged(lab: &Laboratory, browser: &mut Browser) -> (String, Value) {
    browser.send(json!({"type": "load_scenario", "map": "posts", "start_m": [-0.25, -0.38], "seed": 5})).await;
    let end = drag(browser).await;
    let (status, text) = lab.ask_text("GET", "/api/sessions/main/case.json", "", &[]).await;
    assert_eq!(status, 200, "{text}");
    (text, end)
}

async fn step_to_401(browser: &mut Browser, ticks: u64) -> Value {
    browser.send(json!({"type": "step", "ticks": ticks})).await;
    browser.state("401 ticks", |m| m["tick"] == 401).await["world_hash"].clone()
}

#[tokio::test(flavor = "multi_thread")]
async fn an_opened_case_repeats_its_inputs_also_after_a_rewind_and_a_reset() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (text, end) = dragged(&lab, &mut browser).await;
    browser.send(json!({"type": "load_scenario", "map": "open"})).await;
    browser.until("another map", |m| m["type"] == "scene" && m["map"] == "open" && m["case"].is_null()).await;

    browser.send(json!({"type": "open_case", "case": text})).await;
    let scene = browser.until("the case", |m| m["type"] == "scene" && !m["case"].is_null()).await;
    assert_eq!((&scene["map"], &scene["seed"]), (&json!("posts"), &json!(5)));
    let case = &scene["case"];
    assert_eq!((&case["inputs"], &case["last_tick"], &case["deliveries"]), (&json!(3), &json!(400), &json!(1)));
    assert_eq!(case["about"], "attractor on posts, with disturbances by hand.");
    // Inputs of tick 0 come at once.
    browser.state("its goal", |m| m["tick"] == 0 && m["goal_m"] == json!([0.12, -0.33, 0.0])).await;
    assert_eq!(step_to_401(&mut browser, 401).await, end["world_hash"]);
    // Saved again, it is the same case.
    let (_, again) = lab.ask_text("GET", "/api/sessions/main/case.json", "", &[]).await;
    assert_eq!(again, text);

    // Back into the drag: the hand goes on holding.
    browser.send(json!({"type": "rewind", "tick": 350})).await;
    let middle = browser.state("the middle", |m| m["tick"].as_u64().unwrap() < 401).await;
    assert!(!middle["hand_m"].is_null(), "{middle}");
    assert_eq!(step_to_401(&mut browser, 401 - middle["tick"].as_u64().unwrap()).await, end["world_hash"]);

    browser.send(json!({"type": "reset"})).await;
    browser.state("the start", |m| m["tick"] == 0 && !m["goal_m"].is_null()).await;
    assert_eq!(step_to_401(&mut browser, 401).await, end["world_hash"]);

    browser.send(json!({"type": "load_scenario", "map": "posts"})).await;
    browser.until("no case", |m| m["type"] == "scene" && m["case"].is_null()).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn impossible_inputs_of_an_opened_case_are_left_out_and_reported() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let scenario = serde_json::to_value(ferry_core::scenario::Scenario::idle("posts", 1)).unwrap();
    let outside = json!({"set_goal": {"x_m": 5.0, "y_m": 0.0}});
    let inputs =
        json!([{"tick": 10, "input": outside}, {"tick": 10, "input": outside}, {"tick": 10, "input": "clear_goal"}]);
    // More than other messages need, and longer than what the scene says about it.
    let about = "long ".repeat(20_000);
    let case = json!({"about": about, "scenario": scenario, "inputs": inputs}).to_string();
    browser.send(json!({"type": "open_case", "case": case})).await;
    let scene = browser.until("the case", |m| m["type"] == "scene" && !m["case"].is_null()).await;
    assert_eq!(scene["case"]["about"].as_str().unwrap().chars().count(), 200);
    assert!(scene["case"]["deliveries"].is_null(), "{}", scene["case"]);
    browser.send(json!({"type": "step", "ticks": 11})).await;
    let says = |m: &Value, words| m["what"]["text"].as_str().unwrap().contains(words);
    let event = browser.until("a report", |m| m["type"] == "event" && says(m, "test case: 2 inputs")).await;
    assert!(event["tick"] == 10 && says(&event, "outside the workspace"), "{event}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_case_with_its_own_drawing_opens_where_the_map_is_unknown() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (status, svg) = lab.ask_text("GET", "/api/maps/posts", "", &[]).await;
    assert_eq!(status, 200);
    let (status, added) = lab.ask("POST", "/api/maps?name=mine", &svg).await;
    assert_eq!((status, &added["name"]), (201, &json!("mine")), "{added}");
    let case = |name: &str, svg: &str| {
        let scenario = serde_json::to_value(ferry_core::scenario::Scenario::idle(name, 1)).unwrap();
        json!({"about": "", "scenario": scenario, "map": {"name": name, "svg": svg}}).to_string()
    };
    for name in ["mine", "elsewhere"] {
        browser.send(json!({"type": "open_case", "case": case(name, &svg)})).await;
        browser.until(name, |m| m["type"] == "scene" && m["map"] == name).await;
    }
    let (_, other) = lab.ask_text("GET", "/api/maps/open", "", &[]).await;
    for (text, code, field) in [
        (case("mine", &other), "other_drawing", "map.name"),
        (case("posts", &other), "other_drawing", "map.name"),
        (case("not a name", &svg), "map_refused", "map"),
        (case("new", "<svg/>"), "map_refused", "map"),
    ] {
        browser.send(json!({"type": "open_case", "case": text})).await;
        let error = browser.error().await;
        assert_eq!((&error["code"], &error["field"]), (&json!(code), &json!(field)), "{error}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_case_is_refused_and_changes_nothing() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (text, end) = dragged(&lab, &mut browser).await;
    let case: Value = serde_json::from_str(&text).unwrap();
    let with = |path: &str, value: Value| {
        let mut other = case.clone();
        *other.pointer_mut(path).unwrap() = value;
        other.to_string()
    };
    for (text, code, field) in [
        (text[..1].to_owned(), "bad_case", None),
        (String::new(), "bad_case", None),
        ("{}".to_owned(), "bad_case", Some("about")),
        (with("/scenario/seed", json!(-1)), "bad_case", Some("scenario.seed")),
        (with("/inputs/1/tick", json!("soon")), "bad_case", Some("inputs[1].tick")),
        (with("/inputs/1/tick", json!(u64::MAX)), "bad_case", Some("inputs: tick")),
        (with("/scenario/map", json!("nowhere")), "map_refused", Some("map")),
        (with("/scenario/parameters/friction", json!(7.0)), "parameter_out_of_range", Some("friction")),
        (with("/scenario/start_m", json!([5.0, 5.0])), "outside_workspace", Some("start_m")),
    ] {
        browser.send(json!({"type": "open_case", "case": text})).await;
        let error = browser.error().await;
        assert_eq!((&error["code"], error["field"].as_str()), (&json!(code), field), "{error}");
    }
    let (_, state) = lab.ask("GET", "/api/sessions/main/state", "").await;
    assert_eq!((&state["tick"], &state["world_hash"]), (&json!(401), &end["world_hash"]));
    // Only the operator may open one.
    let mut viewer = lab.browser().await;
    viewer.send(json!({"type": "open_case", "case": text})).await;
    assert_eq!(viewer.error().await["code"], "not_operator");
}
