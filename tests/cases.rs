//! Cases kept from the page: recorded inputs are applied again and must end as expected.

use std::ops::ControlFlow;
use std::path::Path;

use ferry::trial::{Arena, Case};
use serde_json::json;

use crate::support::{Laboratory, ferry, gpu};

fn kept() -> Vec<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn run(case: &Case) -> ferry::trial::CaseOutcome {
    let arena = case.arena().unwrap();
    let mut camera = arena.camera(&gpu()).unwrap();
    case.run(&arena, &mut camera, &mut |_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn every_kept_case_ends_as_expected() {
    let paths = kept();
    assert!(paths.len() >= 3, "{paths:?}");
    for path in paths {
        let case = Case::open(path.to_str().unwrap()).unwrap();
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
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 300})).await;
    browser.send(json!({"type": "drag", "x_m": 0.0, "y_m": -0.45, "lift": true})).await;
    browser.send(json!({"type": "step", "ticks": 100})).await;
    browser.send(json!({"type": "release"})).await;
    browser.send(json!({"type": "step", "ticks": 1})).await;
    browser.until("401 ticks", |m| m["type"] == "state" && m["tick"] == 401).await;
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
    let arena = Arena::open("posts").unwrap();
    let outcome = case
        .run(&arena, &mut arena.camera(&gpu()).unwrap(), &mut |record| {
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
