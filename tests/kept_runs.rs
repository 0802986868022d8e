//! Kept runs: what a rewind, a reset or another scenario leaves behind can be returned to.

use serde_json::{Value, json};

use crate::support::{Browser, Laboratory, files, read};

async fn step(browser: &mut Browser, ticks: u64, to: u64) -> Value {
    browser.send(json!({"type": "step", "ticks": ticks})).await;
    browser.state("the ticks", |m| m["tick"] == to).await
}

async fn runs(browser: &mut Browser, count: usize) -> Value {
    let fits = |m: &Value| m["type"] == "scene" && m["kept_runs"].as_array().unwrap().len() == count;
    browser.until("the kept runs", fits).await["kept_runs"].clone()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_rewind_a_reset_and_another_map_keep_what_they_leave() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    let end = step(&mut browser, 500, 500).await;

    // A rewind alone leaves nothing behind: the later ticks are still there.
    browser.send(json!({"type": "rewind", "tick": 250})).await;
    browser.state("the middle", |m| m["tick"] == 250).await;
    browser.send(json!({"type": "set_goal", "x_m": -0.2, "y_m": -0.37})).await;
    let kept = runs(&mut browser, 1).await;
    assert_eq!((&kept[0]["number"], &kept[0]["map"]), (&json!(1), &json!("posts")), "{kept}");
    assert_eq!((&kept[0]["sim_time_s"], &kept[0]["deliveries"]), (&json!(4.0), &json!(0)), "{kept}");
    let other = step(&mut browser, 125, 375).await;

    browser.send(json!({"type": "load_scenario", "map": "open"})).await;
    let kept = runs(&mut browser, 2).await;
    assert_eq!((&kept[1]["number"], &kept[1]["sim_time_s"]), (&json!(2), &json!(3.0)), "{kept}");

    // The first run, on its map, with its past.
    browser.send(json!({"type": "return_to", "run": 1})).await;
    browser.until("its map", |m| m["type"] == "scene" && m["map"] == "posts").await;
    browser.until("its first event", |m| m["type"] == "event" && m["again"] == true && m["tick"] == 0).await;
    let back = browser.state("its end", |m| m["tick"] == 500).await;
    assert_eq!((&back["world_hash"], &back["running"]), (&end["world_hash"], &json!(false)));
    assert_eq!(back["oldest_tick"], 0);
    browser.send(json!({"type": "rewind", "tick": 250})).await;
    browser.state("the middle of it", |m| m["tick"] == 250).await;

    // The second run is still kept; the empty trial on the other map is not.
    browser.send(json!({"type": "return_to", "run": 2})).await;
    let kept = runs(&mut browser, 1).await;
    assert_eq!(kept[0]["sim_time_s"], 4.0, "a rewound run is kept to its end: {kept}");
    let back = browser.state("the end of the other", |m| m["tick"] == 375).await;
    assert_eq!(back["world_hash"], other["world_hash"]);

    browser.send(json!({"type": "return_to", "run": 2})).await;
    let error = browser.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("no_run"), &json!("run")), "{error}");
    assert_eq!(browser.state("unchanged", |m| m["tick"] == 375).await["world_hash"], other["world_hash"]);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_kept_run_has_the_inputs_that_no_tick_had_carried() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    step(&mut browser, 100, 100).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.state("the goal", |m| m["goal_m"].is_array()).await;
    browser.send(json!({"type": "reset"})).await;
    runs(&mut browser, 1).await;
    browser.send(json!({"type": "return_to", "run": 1})).await;
    browser.state("its end", |m| m["tick"] == 100 && m["goal_m"].is_array()).await;
    browser.send(json!({"type": "rewind", "tick": 0})).await;
    browser.state("the start", |m| m["tick"] == 0).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    let kept = runs(&mut browser, 1).await;
    browser.send(json!({"type": "return_to", "run": kept[0]["number"]})).await;
    step(&mut browser, 5000, 5100).await;
    let (status, case) = lab.ask("GET", "/api/sessions/main/case.json", "").await;
    assert_eq!(status, 200, "{case}");
    assert_eq!(case["inputs"], json!([{"tick": 100, "input": {"set_goal": {"x_m": 0.12, "y_m": -0.33}}}]), "{case}");

    // The recording tells returned runs from the trial before.
    let data = lab.close().await;
    let file = files(&data.path().join("recordings"), "rrd").remove(0);
    let found = read(std::slice::from_ref(&file)).remove(0);
    let names: Vec<_> =
        found["trials"].as_array().unwrap().iter().map(|trial| trial[1].as_str().unwrap()[..1].to_owned()).collect();
    assert_eq!(names, ["1", "2", "3", "3", "4"], "{found}");
}

#[tokio::test(flavor = "multi_thread")]
async fn the_oldest_runs_are_dropped() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let mut kept = Value::Null;
    for number in 1..=10 {
        step(&mut browser, 40, 40).await;
        browser.send(json!({"type": "reset"})).await;
        let newest = |m: &Value| {
            m["type"] == "scene" && m["kept_runs"].as_array().unwrap().last().is_some_and(|run| run["number"] == number)
        };
        kept = browser.until("another run", newest).await["kept_runs"].clone();
    }
    let numbers: Vec<_> = kept.as_array().unwrap().iter().map(|run| run["number"].as_u64().unwrap()).collect();
    assert_eq!(numbers, [3, 4, 5, 6, 7, 8, 9, 10]);
    lab.close().await;
}
