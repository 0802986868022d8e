//! The server matches its OpenAPI description. schemathesis generates valid and invalid requests from it.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};

use ferry_core::policy::Policy;
use serde_json::{Value, json};

use crate::support::{Browser, Ferry, ferry, tool};

/// Operations that never succeed here: a plain request cannot become a WebSocket, no token is set, and generated text is not
/// a map or a policy (`leases` and `trainings` upload them).
const NEVER_ACCEPTED: [&str; 9] = [
    "DELETE /api/maps/{name}",
    "GET /api/controllers/{name}",
    "GET /api/sessions/{id}/attempt",
    "GET /api/sessions/{id}/live",
    "POST /api/challenges/{name}/attempts",
    "POST /api/map-checks",
    "POST /api/maps",
    "POST /api/policies/{file}",
    "POST /login",
];

/// Only a job that has not ended can be paused and cancelled, and one that has paused can go on, which may take longer than
/// until the next request (`jobs` and `trainings` do it).
const DEPENDS_ON_TIMING: [&str; 4] = [
    "DELETE /api/jobs/{id}",
    "POST /api/jobs/{id}/pause",
    "POST /api/jobs/{id}/resume",
    "POST /api/trainings/{id}/resume",
];

/// The same in `schemathesis.toml`.
const LONG_EVALUATION: &str = "evaluation-2";

fn ask(ferry: &Ferry, method: &str, path: &str, body: &str) -> Value {
    let request = ureq::http::Request::builder().method(method).uri(format!("http://{}{path}", ferry.address));
    let mut response = ureq::run(request.body(body.to_owned()).unwrap()).unwrap();
    serde_json::from_str(&response.body_mut().read_to_string().unwrap()).unwrap()
}

/// Prepares data for the requests: a session with a goal, a finished training with its policy, another policy, a finished
/// evaluation, a finished recovery map, and an evaluation that runs until it is cancelled. Returns the id of a recording.
async fn fill(ferry: &Ferry) -> String {
    let training = json!({"map": "u-turn", "name": "kept", "seed": 1, "settings": {"updates": 1}});
    ask(ferry, "POST", "/api/trainings", &training.to_string());
    let spare = format!("http://{}/api/policies/spare", ferry.address);
    ureq::post(spare).send(Policy::shipped_bytes("colon").unwrap().as_slice()).unwrap();
    let query =
        json!({"controllers": ["attractor", "errt"], "maps": ["posts"], "disturbances": [0], "episodes": 2, "seed": 1});
    ask(ferry, "POST", "/api/evaluations", &query.to_string());
    let mapped = json!({"map": "posts", "controllers": ["errt"], "grid": 4, "repeats": 1});
    ask(ferry, "POST", "/api/recoveries", &mapped.to_string());
    let long = json!({"controllers": ["errt", "rl"], "maps": ["colon", "colon-folds"], "disturbances": [2], "episodes": 1000,
        "seed": 1});
    let long = ask(ferry, "POST", "/api/evaluations", &long.to_string());
    assert_eq!(long["id"], LONG_EVALUATION);
    let mut browser = Browser::at(ferry.address).await;
    let scenario = json!({"type": "load_scenario", "map": "posts", "controller": "errt", "start_m": [-0.25, -0.38],
        "goal_m": [0.12, -0.33]});
    browser.send(scenario).await;
    browser.send(json!({"type": "step", "ticks": 200})).await;
    browser.until("200 ticks", |m| m["type"] == "state" && m["tick"] == 200).await;
    for _ in 0..600 {
        let is_done = |path| ask(ferry, "GET", path, "")["stage"] == "done";
        if is_done("/api/evaluations/evaluation-1") && is_done("/api/recoveries/recovery-1") {
            let recordings = ask(ferry, "GET", "/api/recordings", "");
            return recordings["recordings"][0]["id"].as_str().unwrap().to_owned();
        }
        tokio::time::sleep(std::time::Duration::from_millis(100)).await;
    }
    panic!("four trials take more than a minute");
}

/// Largest number of requests that are generated for one operation; `FERRY_EXAMPLES` changes it.
fn examples() -> String {
    std::env::var("FERRY_EXAMPLES").unwrap_or_else(|_| "8".to_owned())
}

/// Runs schemathesis in a folder, because it writes files into its working directory.
fn schemathesis(ferry: &Ferry, recording: &str, folder: &Path, report: &Path) -> Output {
    Command::new(tool("schemathesis"))
        .args(["--no-color", "--config-file", concat!(env!("CARGO_MANIFEST_DIR"), "/tests/schemathesis.toml"), "run"])
        .arg(format!("http://{}/api/openapi.json", ferry.address))
        .args(["--max-examples", &examples()])
        .args(["--report", "json", "--report-json-path"])
        .arg(report)
        .env("FERRY_RECORDING", recording)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Cancels evaluations that wait, so that jobs of other kinds find room in the queue. The long one stays until a request
/// cancels it.
fn keep_room_in_the_queue(ferry: &Ferry, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        let listed = ask(ferry, "GET", "/api/evaluations", "");
        for evaluation in listed["evaluations"].as_array().into_iter().flatten() {
            if evaluation["stage"] == "waiting" && evaluation["id"] != LONG_EVALUATION {
                ask(ferry, "DELETE", &format!("/api/evaluations/{}", evaluation["id"].as_str().unwrap()), "");
            }
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_server_matches_its_description() {
    let data = tempfile::tempdir().unwrap();
    let ferry = Ferry::serve(&mut ferry(&[]), data.path());
    let recording = fill(&ferry).await;
    // One that can be deleted, once.
    std::fs::write(data.path().join("recordings/finished.rrd"), "RRF2").unwrap();
    let report = data.path().join("report.json");
    let is_over = AtomicBool::new(false);
    let asked = std::thread::scope(|scope| {
        scope.spawn(|| keep_room_in_the_queue(&ferry, &is_over));
        let asked = schemathesis(&ferry, &recording, data.path(), &report);
        is_over.store(true, Ordering::Relaxed);
        asked
    });
    let told = String::from_utf8_lossy(&asked.stdout);
    assert!(asked.status.success(), "{told}{}", String::from_utf8_lossy(&asked.stderr));

    let report: Value = serde_json::from_slice(&std::fs::read(report).unwrap()).unwrap();
    assert_eq!((&report["complete"], &report["failures"], &report["errors"]), (&json!(true), &json!([]), &json!([])));
    let document = ask(&ferry, "GET", "/api/openapi.json", "");
    let described: usize =
        document["paths"].as_object().unwrap().values().map(|item| item.as_object().unwrap().len()).sum();
    // All operations except the description itself, which it always requests.
    assert_eq!(report["operations"]["tested"], json!(described - 1), "{told}");
    assert!(report["test_cases"]["generated"].as_u64() > Some(1000), "{told}");
    let accepted: BTreeMap<&str, u64> = report["valid_rates"]
        .as_object()
        .unwrap()
        .iter()
        .map(|(name, phases)| {
            let counts = phases.as_object().unwrap().values().map(|phase| phase["accepted"].as_u64().unwrap());
            (name.as_str(), counts.sum())
        })
        .collect();
    let is_refused = |name: &str, count: u64| count == 0 && !DEPENDS_ON_TIMING.contains(&name);
    let refused: Vec<_> =
        accepted.iter().filter(|(name, count)| is_refused(name, **count)).map(|(name, _)| *name).collect();
    assert_eq!(refused, NEVER_ACCEPTED, "of {accepted:?}");
    assert_eq!(accepted.len(), described - 1);
}
