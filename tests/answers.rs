//! Messages with an `id` are answered, after all that shows their effect.

use serde_json::{Value, json};

use crate::support::{Browser, Laboratory};

/// Sends a message with an id; returns what came up to its answer, which is last.
async fn ask(browser: &mut Browser, id: u64, mut message: Value) -> Vec<Value> {
    message["id"] = json!(id);
    browser.send(message).await;
    let mut came = Vec::new();
    loop {
        let next = browser.until("anything", |_| true).await;
        let is_answer = next["id"].is_u64();
        came.push(next);
        if is_answer {
            return came;
        }
    }
}

fn last<'a>(came: &'a [Value], kind: &str) -> &'a Value {
    came.iter().rev().find(|message| message["type"] == kind).unwrap_or_else(|| panic!("no {kind} in {came:?}"))
}

#[tokio::test(flavor = "multi_thread")]
async fn done_follows_the_state_the_scene_and_the_events_that_show_it() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    for round in 0..20 {
        let x_m = 0.1 + 1e-3 * f64::from(round);
        let came = ask(&mut browser, 10, json!({"type": "set_goal", "x_m": x_m, "y_m": -0.33})).await;
        assert_eq!(came.last().unwrap(), &json!({"type": "done", "id": 10, "trial": round}));
        assert_eq!(last(&came, "state")["goal_m"], json!([x_m, -0.33, 0.0]));
        assert!(last(&came, "event")["what"]["text"].as_str().unwrap().contains("goal"), "{came:?}");

        // That of a step comes at its end; what is sent meanwhile is answered in order.
        browser.send(json!({"type": "step", "ticks": 40, "id": 11})).await;
        let came = ask(&mut browser, 12, json!({"type": "set_speed", "factor": 2.0})).await;
        assert_eq!((&came.last().unwrap()["id"], &last(&came, "state")["tick"]), (&json!(11), &json!(40)), "{came:?}");
        assert_eq!(browser.until("the second answer", |m| m["type"] == "done").await["id"], 12);

        let came = ask(&mut browser, 13, json!({"type": "reset"})).await;
        assert_eq!(came.last().unwrap(), &json!({"type": "done", "id": 13, "trial": round + 1}));
        assert_eq!((&last(&came, "state")["tick"], &last(&came, "scene")["trial"]), (&json!(0), &json!(round + 1)));
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn refused_names_code_field_and_values() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let mut viewer = lab.browser().await;
    for (message, code, field, values) in [
        (
            json!({"type": "set_goal", "x_m": 2.0, "y_m": 0.0}),
            "outside_workspace",
            "goal",
            json!({"x_m": 2.0, "y_m": 0.0}),
        ),
        (json!({"type": "step", "ticks": 0}), "out_of_range", "ticks", json!({"value": 0.0, "allowed": "1 to 12500"})),
        (json!({"type": "return_to", "run": 7}), "no_run", "run", json!({"run": 7})),
        (
            json!({"type": "select_controller", "controller": "program", "program": "x"}),
            "no_program",
            "program",
            json!({"program": "x"}),
        ),
        (json!({"type": "steer", "x_m": 0.0, "y_m": -0.3}), "not_you", "type", json!({"controller": "attractor"})),
        (json!({"type": "fly"}), "malformed", "type", json!({})),
        (json!({"type": "run", "epoch": 99}), "stale_epoch", "epoch", json!({})),
    ] {
        let came = ask(&mut browser, 5, message.clone()).await;
        let refused = came.last().unwrap();
        let found = (&refused["type"], &refused["code"], &refused["field"], &refused["values"]);
        assert_eq!(found, (&json!("refused"), &json!(code), &json!(field), &values), "{message}: {refused}");
        assert!(refused["detail"].as_str().is_some_and(|detail| !detail.is_empty()), "{refused}");
    }
    let refused = ask(&mut viewer, 1, json!({"type": "run"})).await.pop().unwrap();
    assert_eq!((&refused["code"], &refused["id"]), (&json!("not_operator"), &json!(1)), "{refused}");
    // Without an id nothing changes: an error, or silence.
    browser.send(json!({"type": "set_goal", "x_m": 2.0, "y_m": 0.0})).await;
    assert_eq!(browser.error().await["code"], "outside_workspace");
    let came = ask(&mut viewer, 2, json!({"type": "take_control"})).await;
    assert_eq!(came.last().unwrap()["type"], "done");
    lab.close().await;
}
