//! The lists of a server and the points of a training, as messages of a session's WebSocket.

use std::collections::BTreeMap;
use std::time::Duration;

use serde_json::{Value, json};
use tokio_tungstenite::connect_async;

use crate::support::{Browser, Laboratory, gpu};

const LISTS: [(&str, &str); 9] = [
    ("maps", "maps"),
    ("policies", "policies"),
    ("trainings", "trainings"),
    ("evaluations", "evaluations"),
    ("recoveries", "recoveries"),
    ("programs", "controllers"),
    ("challenges", "challenges"),
    ("jobs", "jobs"),
    ("paces", "jobs"),
];
const DRAWING: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-300 210 580 330\">\
                       <rect x=\"-20\" y=\"300\" width=\"40\" height=\"30\"/></svg>";

/// The lists that come within a time that is long enough for all changes before.
async fn lists(browser: &mut Browser) -> Vec<Value> {
    let mut came = Vec::new();
    let all = async {
        loop {
            came.push(browser.whenever("a list", |m| m["type"] == "catalog").await);
        }
    };
    let _: Result<(), _> = tokio::time::timeout(Duration::from_millis(1500), all).await;
    came
}

fn names(lists: &[Value]) -> Vec<&str> {
    lists.iter().map(|list| list["list"].as_str().unwrap()).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_browser_gets_each_list_once_with_the_items_of_its_resource() {
    let lab = Laboratory::open().await;
    for _ in 0..2 {
        let mut browser = lab.browser().await;
        let first = browser.until("anything", |_| true).await;
        let second = browser.until("anything", |_| true).await;
        assert_eq!((&first["type"], &second["type"]), (&json!("hello"), &json!("scene")));
        let came = lists(&mut browser).await;
        let mut all: Vec<_> = names(&came);
        all.sort_unstable();
        let mut known = LISTS.map(|(list, _)| list);
        known.sort_unstable();
        assert_eq!(all, known);
        let by_name: BTreeMap<_, _> = names(&came).into_iter().zip(&came).collect();
        for (list, resource) in LISTS {
            let (_, answer) = lab.ask("GET", &format!("/api/{resource}"), "").await;
            assert_eq!(by_name[list]["items"], answer[list], "{list}");
        }
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_list_is_sent_again_to_all_when_it_has_changed_and_only_then() {
    let lab = Laboratory::open().await;
    lab.ask("GET", "/s/anna", "").await;
    let anna = format!("ws://{}/api/sessions/anna/live", lab.address);
    let mut browsers = [lab.browser().await, Browser::of(connect_async(anna).await.unwrap().0)];
    for browser in &mut browsers {
        assert_eq!(lists(browser).await.len(), LISTS.len());
    }
    for (_, resource) in LISTS {
        lab.ask("GET", &format!("/api/{resource}"), "").await;
    }
    let [operator, _] = &mut browsers;
    operator.send(json!({"type": "set_goal", "x_m": 0.1, "y_m": -0.33})).await;
    operator.send(json!({"type": "step", "ticks": 50})).await;
    for browser in &mut browsers {
        assert_eq!(names(&lists(browser).await), [""; 0], "nothing has changed");
    }

    assert_eq!(lab.ask("POST", "/api/maps?name=mine", DRAWING).await.0, 201);
    for browser in &mut browsers {
        let came = lists(browser).await;
        assert_eq!(names(&came), ["maps"]);
        assert_eq!(came[0]["items"].as_array().unwrap().last(), Some(&json!("mine")));
    }
    let address = format!("ws://{}/api/controllers/mine?protocol=1", lab.address);
    let program = Browser::of(connect_async(address).await.unwrap().0);
    for browser in &mut browsers {
        let came = lists(browser).await;
        assert_eq!(names(&came), ["programs"]);
        assert_eq!(
            (&came[0]["items"][0]["name"], &came[0]["items"][0]["is_connected"]),
            (&json!("mine"), &json!(true))
        );
    }
    drop(program);
    for browser in &mut browsers {
        let came = lists(browser).await;
        assert_eq!((names(&came), &came[0]["items"][0]["is_connected"]), (vec!["programs"], &json!(false)));
    }
    assert_eq!(lab.ask("DELETE", "/api/maps/mine", "").await.0, 204);
    for browser in &mut browsers {
        assert_eq!(names(&lists(browser).await), ["maps"]);
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_evaluation_is_followed_to_its_end_without_a_request() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let asked = json!({"controllers": ["attractor"], "maps": ["open"], "disturbances": [0], "episodes": 2, "seed": 1});
    assert_eq!(lab.ask("POST", "/api/evaluations", &asked.to_string()).await.0, 201);
    let is_done = |m: &Value| m["list"] == "evaluations" && m["items"][0]["stage"] == "done";
    let done = browser.until("the end", is_done).await;
    assert_eq!(done["items"][0]["cells"][0]["done"], 2);
    assert_eq!(lab.ask("GET", "/api/evaluations", "").await.1["evaluations"], done["items"]);
    lab.close().await;
}

/// A paused training with three points, as a server finds it.
fn keep_training(folder: &std::path::Path) {
    let point = |update: u64| {
        let spread = json!({"count": 1, "sum": 0.5, "squares": 0.25});
        json!({"update": update, "steps": 10 * update, "episodes": update, "reward": spread, "loss": spread,
            "gradient": spread, "reached": 1, "collided": 0, "examined": null})
    };
    let query = json!({"map": "u-turn", "name": "mine", "seed": 7, "settings": {"updates": 500}});
    let record = json!({"query": query, "updates_total": 500, "stage": "Paused", "elapsed_s": 3.0,
        "points": [point(100), point(200), point(300)], "examined": null, "policy": null, "reader": 1});
    let folder = folder.join("trainings/training-1");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("map.svg"), ferry_core::map::Map::shipped("u-turn").unwrap().svg()).unwrap();
    std::fs::write(folder.join("training.json"), record.to_string()).unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn the_points_of_a_training_come_once_on_each_connection_that_asks() {
    let lab = Laboratory::open_with(gpu(), None, |settings| keep_training(&settings.data)).await;
    let _operator = lab.browser().await;
    let answered = |m: &Value| ["training_points", "done", "refused"].iter().any(|kind| m["type"] == *kind);
    for _ in 0..2 {
        // A viewer may ask, too.
        let mut viewer = lab.browser().await;
        viewer.send(json!({"type": "watch_training", "training": "training-1", "id": 1})).await;
        let points = viewer.until("the points", answered).await;
        assert_eq!((&points["training"], &points["first"]), (&json!("training-1"), &json!(0)), "{points}");
        let updates: Vec<_> = points["points"].as_array().unwrap().iter().map(|point| &point["update"]).collect();
        assert_eq!(updates, [100, 200, 300]);
        assert_eq!(viewer.until("the answer", answered).await["type"], "done");
        viewer.send(json!({"type": "watch_training", "training": "training-2", "id": 2})).await;
        let refused = viewer.until("the refusal", answered).await;
        assert_eq!((&refused["code"], &refused["field"]), (&json!("no_training"), &json!("training")), "{refused}");
        viewer.send(json!({"type": "watch_training", "training": null, "id": 3})).await;
        assert_eq!(viewer.until("the answer", answered).await["type"], "done", "no points");
        viewer.send(json!({"type": "watch_training"})).await;
    }
    lab.close().await;
}
