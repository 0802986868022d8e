//! Trainings and policies over HTTP: the same bits as on the command line, a policy that sessions can select, and clear
//! refusals.

use std::net::SocketAddr;
use std::time::{Duration, Instant};

use ferry_core::policy::{Manifest, Policy};
use serde_json::{Value, json};

use crate::support::{Browser, Laboratory, ferry};

/// A training of a few seconds, which learns little.
fn query(change: Value) -> Value {
    let mut query = json!({"map": "u-turn", "name": "mine", "seed": 7, "settings": {"updates": 200}});
    query.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
    query
}

/// Fails after 15 minutes without a change: jobs have a low priority, and other tests run beside.
async fn ended(lab: &Laboratory, id: &str) -> Value {
    let (mut last, mut since) = (Value::Null, Instant::now());
    loop {
        let (status, report) = lab.ask("GET", &format!("/api/trainings/{id}"), "").await;
        assert_eq!(status, 200, "{report}");
        if ["done", "failed", "cancelled"].contains(&report["stage"].as_str().unwrap()) {
            return report;
        }
        if report != last {
            (last, since) = (report, Instant::now());
        }
        assert!(since.elapsed() < Duration::from_secs(900), "no progress: {last}");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

/// The updates of all points until the last one. The browser connects again after each message with points.
async fn points(lab: SocketAddr, last: u64) -> Vec<u64> {
    let mut points = Vec::new();
    loop {
        let mut browser = Browser::at(lab).await;
        browser.send(json!({"type": "watch_training", "training": "training-1"})).await;
        points.clear();
        loop {
            let message = browser.whenever("a point", |m| m["type"] == "training_points").await;
            assert_eq!(message["first"], json!(points.len()), "no gap, and none twice");
            let new = message["points"].as_array().unwrap();
            points.extend(new.iter().map(|point| point["update"].as_u64().unwrap()));
            if points.last() == Some(&last) {
                return points;
            }
            if !new.is_empty() && message["first"] != 0 {
                break;
            }
        }
    }
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn a_training_becomes_a_policy_with_the_bits_of_the_command_line() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (status, made) = lab.ask("POST", "/api/trainings", &query(json!({})).to_string()).await;
    assert_eq!((status, &made["id"], &made["updates_total"]), (201, &json!("training-1"), &json!(200)), "{made}");
    // Both are read meanwhile: a client that does not read is disconnected.
    let points = tokio::spawn(points(lab.address, 200));
    let told = tokio::spawn(async move {
        let scene = browser.whenever("the scene", |m| m["type"] == "scene").await;
        let is_added = |policy: &Value| policy["is_shipped"] == json!(false);
        let knows = |m: &Value| m["list"] == "policies" && m["items"].as_array().unwrap().iter().any(is_added);
        let list = browser.whenever("the policy", knows).await;
        let ends = |m: &Value| m["list"] == "trainings" && m["items"][0]["stage"] == "done";
        // The policy comes first: with the training's end it can be selected.
        browser.whenever("the end", ends).await;
        (browser, scene, list)
    });
    let done = ended(&lab, "training-1").await;
    assert_eq!((&done["stage"], &done["updates"], &done["frames"]), (&json!("done"), &json!(200), &json!(2)), "{done}");
    assert_eq!(done["curve"].as_array().unwrap().len(), 2);
    assert_eq!(done["examined"]["episodes"], 1000);

    assert_eq!(points.await.unwrap(), [100, 200], "each once, in order");

    let (_, cells) = lab.ask("GET", "/api/trainings/training-1/cells", "").await;
    let count = cells["centers_m"].as_array().unwrap().len();
    assert!(count > 200, "{count}");
    let (_, frame) = lab.ask("GET", "/api/trainings/training-1/frames/1", "").await;
    for list in ["values", "actions", "quantiles", "endings"] {
        assert_eq!(frame[list].as_array().unwrap().len(), count, "{list}");
    }
    assert_eq!(lab.ask("GET", "/api/trainings/training-1/frames/2", "").await.0, 404);

    // The page learns of the policy, and a session takes it.
    let reference = done["policy"].as_str().unwrap().to_owned();
    let (mut browser, scene, list) = told.await.unwrap();
    assert_eq!(list["items"].as_array().unwrap().last().unwrap()["reference"], json!(reference));
    let mut parameters = scene["parameters"].clone();
    parameters["rl_policy"] = json!("mine");
    browser.send(json!({"type": "configure", "parameters": parameters})).await;
    browser.until("the hash", |m| m["type"] == "scene" && m["parameters"]["rl_policy"] == json!(reference)).await;

    let out = lab.data.path().join("cli.safetensors");
    let trained = ferry(&["train", "--map", "u-turn", "--recipe", "quick", "--seed", "7", "--set", "updates=200"])
        .args(["--episodes", "10", "--sweeps"])
        .arg(lab.data.path().join("sweeps"))
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    assert!(trained.status.success(), "{}", String::from_utf8_lossy(&trained.stderr));
    let bytes = lab.bytes("/api/policies/mine.safetensors").await;
    assert!(bytes == std::fs::read(out).unwrap(), "the files differ");
    lab.close().await;
}

/// What the page's button asks for. The share of all pairs of cells from which the policy reaches the goal, and the seconds
/// from the request to the end.
async fn toy(lab: &Laboratory, seed: u64) -> (f64, f64) {
    let begun = Instant::now();
    let asked = json!({"map": "toy", "name": format!("toy-{seed}"), "seed": seed, "recipe": "toy"});
    let (status, made) = lab.ask("POST", "/api/trainings", &asked.to_string()).await;
    assert_eq!(status, 201, "{made}");
    let done = ended(lab, made["id"].as_str().unwrap()).await;
    let spent_s = begun.elapsed().as_secs_f64();
    let [episodes, reached] = ["episodes", "reached"].map(|name| done["examined"][name].as_f64().unwrap());
    assert!(done["stage"] == "done" && done["examined"]["all_pairs"] == true, "{done}");
    // Those within 2 cm of each other are left out.
    assert!((2500.0..=60.0 * 59.0).contains(&episodes), "{episodes}");
    println!("seed {seed}: {reached} of {episodes} pairs, {:.1} % in {spent_s:.1} s", 100.0 * reached / episodes);
    (reached / episodes, spent_s)
}

#[tokio::test(flavor = "multi_thread")]
async fn the_toy_map_is_learned_and_examined_over_all_its_pairs() {
    let lab = Laboratory::open().await;
    let (share, _) = toy(&lab, 1).await;
    assert!(share >= 0.9, "{share}");
    let (_, cells) = lab.ask("GET", "/api/trainings/training-1/cells", "").await;
    let count = cells["centers_m"].as_array().unwrap().len();
    assert!((40..=60).contains(&count), "{count}");
    if std::env::var_os("FERRY_GENERATE").is_some() {
        keep_finished(&lab, cells).await;
    }
    lab.close().await;
}

/// Writes the finished training that the page plays while another one computes.
async fn keep_finished(lab: &Laboratory, cells: Value) {
    let (_, report) = lab.ask("GET", "/api/trainings/training-1", "").await;
    let mut frames = Vec::new();
    for index in 0..report["frames"].as_u64().unwrap() {
        frames.push(lab.ask("GET", &format!("/api/trainings/training-1/frames/{index}"), "").await.1);
    }
    let kept = json!({"query": report["query"], "examined": report["examined"], "cells": cells, "frames": frames});
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/src/features/train/finished.gen.ts");
    let head =
        "// Generated from a training of the map toy. Do not edit.\n\nimport type { Finished } from './finished';\n";
    std::fs::write(path, format!("{head}\n// prettier-ignore\nexport const FINISHED: Finished = {kept};\n")).unwrap();
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn five_seeds_learn_the_toy_map() {
    let lab = Laboratory::open().await;
    for seed in 11..=15 {
        let (share, _) = toy(&lab, seed).await;
        assert!(share >= 0.9, "seed {seed}: {share}");
    }
    lab.close().await;
}

/// A small policy: its weights do not matter here.
fn file(seed: u64) -> Vec<u8> {
    let bytes = Policy::shipped_bytes("colon").unwrap();
    let weights = ferry_core::policy::weights(&bytes).unwrap();
    let manifest = Manifest { seed, ..Policy::from_bytes(&bytes).unwrap().manifest().clone() };
    let specs = manifest.architecture.tensors().into_iter();
    let weights: Vec<_> = specs.map(|spec| (spec.clone(), weights[&spec.name].clone())).collect();
    Policy::to_bytes(&manifest, &weights).unwrap()
}

fn upload(lab: &Laboratory, name: &str, bytes: &[u8]) -> (u16, Value) {
    let url = format!("http://{}/api/policies/{name}", lab.address);
    let agent = ureq::Agent::new_with_config(ureq::Agent::config_builder().http_status_as_error(false).build());
    let mut answer = agent.post(url).content_type("application/octet-stream").send(bytes).unwrap();
    let text = answer.body_mut().read_to_string().unwrap();
    (answer.status().as_u16(), serde_json::from_str(&text).unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn an_uploaded_policy_is_found_by_its_hash_until_it_is_deleted() {
    let lab = Laboratory::open().await;
    let mut browser = lab.browser().await;
    let (status, added) = upload(&lab, "first", &file(1));
    assert_eq!((status, &added["name"], &added["is_shipped"]), (201, &json!("first"), &json!(false)), "{added}");
    for (name, bytes, expected) in [
        ("first", file(2), (409, "taken")),
        ("colon", file(2), (422, "out_of_range")),
        ("second", file(2)[..5000].to_vec(), (422, "policy_refused")),
    ] {
        let (status, problem) = upload(&lab, name, &bytes);
        assert_eq!((status, problem["code"].as_str().unwrap()), expected, "{problem}");
    }
    let (status, renamed) = lab.ask("PATCH", "/api/policies/first", r#"{"name": "second"}"#).await;
    assert_eq!((status, &renamed["name"]), (200, &json!("second")), "{renamed}");
    assert_eq!(upload(&lab, "first", &file(2)).0, 201, "the name is free for another policy");

    // A link that was made before still means the same policy.
    let mut parameters = lab.default_parameters().await;
    parameters["rl_policy"] = added["reference"].clone();
    let scenario = json!({"type": "load_scenario", "map": "posts", "controller": "rl", "start_m": [-0.25, -0.38],
        "goal_m": [0.12, -0.33], "parameters": parameters});
    browser.send(scenario.clone()).await;
    let is_set = |m: &Value| m["type"] == "scene" && m["parameters"]["rl_policy"] == renamed["reference"];
    browser.until("the policy with its new name", is_set).await;
    browser.send(json!({"type": "set_speed", "factor": 16})).await;
    browser.send(json!({"type": "run"})).await;
    browser.state("steps", |m| m["steps"].as_u64() > Some(2)).await;

    assert_eq!(lab.ask("DELETE", "/api/policies/second", "").await.0, 204);
    let held = browser.state("the arm holds", |m| m["refusal"].is_object()).await;
    assert!(held["refusal"]["text"].as_str().unwrap().contains("second@"), "{held}");
    browser.send(scenario).await;
    let refused = browser.error().await;
    assert_eq!((&refused["code"], &refused["field"]), (&json!("unknown_policy"), &json!("rl_policy")), "{refused}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_cannot_be_trained_is_refused_and_nothing_is_kept() {
    let lab = Laboratory::open().await;
    for (change, status, field) in [
        (json!({"map": "nowhere"}), 422, "map"),
        (json!({"map": "attractor-example"}), 422, "map"),
        (json!({"name": "colon"}), 422, "name"),
        (json!({"name": "no name"}), 422, "name"),
        (json!({"settings": {"discount": 2}}), 422, "settings.discount"),
        (json!({"settings": {"updates": 1_000_000}}), 422, "settings.updates"),
        (json!({"settings": {"speed": 1}}), 400, "settings.speed"),
        (json!({"start_from": "explorer"}), 422, "start_from"),
        (json!({"start_from": "mine@0000000000000000"}), 422, "start_from"),
        (json!({"goal_m": [9, 9]}), 422, "goal_m"),
    ] {
        let (found, problem) = lab.ask("POST", "/api/trainings", &query(change).to_string()).await;
        assert_eq!((found, problem["field"].as_str()), (status, Some(field)), "{problem}");
    }
    let (_, all) = lab.ask("GET", "/api/trainings", "").await;
    assert_eq!(all, json!({"trainings": []}));
    for (method, path) in [("POST", "training-1/pause"), ("POST", "training-1/resume"), ("DELETE", "training-1")] {
        assert_eq!(lab.ask(method, &format!("/api/trainings/{path}"), "").await.0, 404, "{path}");
    }
    let data = lab.close().await;
    assert!(!data.path().join("trainings").exists());
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn a_training_waits_pauses_and_is_cancelled() {
    let lab = Laboratory::open().await;
    let long = query(json!({"settings": {"updates": 20_000}}));
    assert_eq!(lab.ask("POST", "/api/trainings", &long.to_string()).await.0, 201);
    let (status, problem) = lab.ask("POST", "/api/trainings", &long.to_string()).await;
    assert_eq!((status, &problem["field"]), (409, &json!("name")), "{problem}");
    let second = query(json!({"name": "second"}));
    let (_, waiting) = lab.ask("POST", "/api/trainings", &second.to_string()).await;
    assert_eq!(waiting["stage"], "waiting");
    assert_eq!(lab.ask("POST", "/api/trainings/training-1/pause", "").await.0, 202);
    // A paused one makes way.
    assert_eq!(ended(&lab, "training-2").await["stage"], "done");
    let (_, paused) = lab.ask("GET", "/api/trainings/training-1", "").await;
    assert_eq!(paused["stage"], "paused");
    assert_eq!(lab.ask("POST", "/api/trainings/training-1/pause", "").await.0, 409);
    assert_eq!(lab.ask("POST", "/api/trainings/training-1/resume", "").await.0, 202);
    assert_eq!(lab.ask("DELETE", "/api/trainings/training-1", "").await.0, 202);
    assert_eq!(ended(&lab, "training-1").await["stage"], "cancelled");
    assert_eq!(lab.ask("DELETE", "/api/trainings/training-1", "").await.0, 204);
    assert_eq!(lab.ask("GET", "/api/trainings/training-1", "").await.0, 404);
    let data = lab.close().await;
    let kept: Vec<_> = std::fs::read_dir(data.path().join("trainings")).unwrap().collect();
    assert_eq!(kept.len(), 1, "{kept:?}");
}
