//! Evaluations over HTTP: the same rows as on the command line, in the background.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::{Laboratory, ferry};

/// So many trials that they do not end during a test.
const LONG: u32 = 1000;

fn query(change: Value) -> Value {
    let mut query =
        json!({"controllers": ["attractor"], "maps": ["posts"], "disturbances": [0], "episodes": 4, "seed": 1});
    query.as_object_mut().unwrap().extend(change.as_object().unwrap().clone());
    query
}

impl Laboratory {
    async fn begin(&self, change: Value) -> String {
        let (status, made) = self.ask("POST", "/api/evaluations", &query(change).to_string()).await;
        assert_eq!(status, 201, "{made}");
        format!("/api/evaluations/{}", made["id"].as_str().unwrap())
    }

    /// Waits for a state of the evaluation; fails after a minute without progress.
    async fn evaluation(&self, path: &str, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let (mut last, mut since) = (Value::Null, Instant::now());
        loop {
            let (status, report) = self.ask("GET", path, "").await;
            assert_eq!(status, 200, "{report}");
            if fits(&report) {
                return report;
            }
            if report != last {
                (last, since) = (report, Instant::now());
            }
            assert!(since.elapsed() < Duration::from_secs(900), "no progress: {what}: {last}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    async fn ended(&self, path: &str) -> Value {
        self.evaluation(path, "the end", |report| !["waiting", "running"].contains(&stage(report))).await
    }
}

fn stage(report: &Value) -> &str {
    report["stage"].as_str().unwrap()
}

/// Rows without timings.
fn timeless(rows: &Value) -> Vec<Value> {
    let mut rows = rows.as_array().unwrap().clone();
    for row in &mut rows {
        row.as_object_mut().unwrap().retain(|name, _| !name.starts_with("decision_ms"));
    }
    rows
}

fn on_the_command_line(controllers: &str, disturbances: &str) -> Vec<Value> {
    let output = ferry(&[])
        .args(["evaluate", "--map", "posts", "--episodes", "4", "--seed", "1", "--json"])
        .args(["--controller", controllers, "--disturbances", disturbances])
        .output()
        .unwrap();
    timeless(&serde_json::from_slice::<Value>(&output.stdout).unwrap()["rows"])
}

#[tokio::test(flavor = "multi_thread")]
async fn rows_equal_those_of_the_command_line() {
    let lab = Laboratory::open().await;
    let asked = json!({"controllers": ["attractor", "errt"], "disturbances": [0, 1]});
    let (first, second) = (lab.begin(asked.clone()).await, lab.begin(asked).await);
    let (first, second) = (lab.ended(&first).await, lab.ended(&second).await);
    assert_eq!((stage(&first), stage(&second)), ("done", "done"), "{first}");
    let rows = timeless(&first["rows"]);
    assert_eq!(rows, timeless(&second["rows"]));
    assert_eq!(rows, [on_the_command_line("attractor,errt", "0"), on_the_command_line("attractor,errt", "1")].concat());
    for (cell, row) in first["cells"].as_array().unwrap().iter().zip(&rows) {
        assert_eq!((&cell["controller"], &cell["disturbances"]), (&row["controller"], &row["disturbances"]));
        assert_eq!((&cell["done"], &cell["delivered"]), (&row["episodes"], &row["delivered"]));
        assert!(cell["elapsed_s"].as_f64() > Some(0.0), "{cell}");
    }
    let (_, all) = lab.ask("GET", "/api/evaluations", "").await;
    let ids: Vec<_> = all["evaluations"].as_array().unwrap().iter().map(|one| &one["id"]).collect();
    assert_eq!(ids, [&first["id"], &second["id"]]);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_failed_trial_fails_again_in_a_session() {
    let lab = Laboratory::open().await;
    let report = lab.begin(json!({"maps": ["colon"], "disturbances": [1], "seed": 4})).await;
    let report = lab.ended(&report).await;
    let failure = &report["failures"][0];
    let row = &report["rows"][0];
    let (episodes, delivered) = (row["episodes"].as_u64().unwrap(), row["delivered"].as_u64().unwrap());
    assert_eq!(report["failures"].as_array().unwrap().len() as u64, episodes - delivered);
    assert!(delivered < episodes, "the attractor cannot carry through the colon: {row}");

    let mut browser = lab.browser().await;
    browser
        .send(json!({
            "type": "load_scenario", "map": "colon", "controller": "attractor", "disturbances": 1,
            "seed": failure["seed"], "start_m": failure["start_m"], "goal_m": failure["goal_m"],
        }))
        .await;
    browser.send(json!({"type": "set_speed", "factor": 64})).await;
    browser.send(json!({"type": "run"})).await;
    let end = browser.state("the same end", |m| m["phase"]["text"] == failure["outcome"]).await;
    assert_eq!((&end["steps"], &end["disturbances"]), (&failure["steps"], &failure["disturbances"]), "{failure}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn results_can_be_downloaded() {
    let lab = Laboratory::open().await;
    let asked = json!({"controllers": ["attractor", "errt"], "maps": ["colon"], "seed": 2});
    let path = lab.begin(asked).await;
    let report = lab.ended(&path).await;
    let comparison = &report["comparisons"][0];
    let count = |name: &str| comparison[name].as_u64().unwrap();
    assert_eq!(count("both") + count("first_only") + count("second_only") + count("neither"), 4);
    let row = |index: usize| report["rows"][index]["delivered"].as_u64().unwrap();
    assert_eq!((count("both") + count("first_only"), count("both") + count("second_only")), (row(0), row(1)));

    let file = async |name: &str| String::from_utf8(lab.bytes(&format!("{path}/{name}")).await).unwrap();
    let from_json: Value = serde_json::from_str(&file("report.json").await).unwrap();
    assert_eq!(from_json["rows"], report["rows"]);
    assert_eq!(from_json["comparisons"], report["comparisons"]);
    assert_eq!(file("report.csv").await.lines().count(), 3);
    let page = file("report.html").await;
    // The report's links open this server's page.
    let link = from_json["failures"][0]["link"].as_str().unwrap();
    assert!(page.contains(&format!("href=\"http://{}/{}\"", lab.address, link.replace('&', "&amp;"))), "{link}");
    assert_eq!(lab.ask("GET", &format!("{path}/report.pdf"), "").await.0, 404);
    assert_eq!(lab.ask("GET", "/api/evaluations/missing/report.csv", "").await.0, 404);
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_queue_is_limited_and_entries_can_be_cancelled() {
    let lab = Laboratory::open().await;
    let long = lab.begin(json!({"controllers": ["errt", "attractor"], "episodes": LONG})).await;
    let under_way = |report: &Value| report["cells"][0]["done"].as_u64() >= Some(1);
    lab.evaluation(&long, "a first trial", under_way).await;
    let mut waiting = Vec::new();
    for _ in 0..4 {
        waiting.push(lab.begin(json!({"episodes": LONG})).await);
    }
    let more = query(json!({"episodes": LONG})).to_string();
    let (status, problem) = lab.ask("POST", "/api/evaluations", &more).await;
    assert_eq!((status, &problem["code"]), (429, &json!("too_many_jobs")));
    assert!(problem["detail"].as_str().unwrap().contains("the lane of long jobs is full"), "{problem}");
    let short = lab.begin(json!({})).await;
    assert_eq!(stage(&lab.ended(&short).await), "done", "a short one does not wait for them");

    // A waiting evaluation is cancelled at once, a running one soon, without a row.
    let (status, left) = lab.ask("DELETE", &waiting[0], "").await;
    assert_eq!((status, stage(&left)), (202, "cancelled"));
    assert_eq!(lab.ask("DELETE", &waiting[0], "").await.0, 409);
    let asked = Instant::now();
    assert_eq!(lab.ask("DELETE", &long, "").await.0, 202);
    let report = lab.ended(&long).await;
    // One tick of a trial at low priority.
    assert!(asked.elapsed() < Duration::from_secs(5), "{:?}", asked.elapsed());
    assert_eq!((stage(&report), &report["rows"], &report["rows_done"]), ("cancelled", &json!([]), &json!(0)));
    assert!(report["cells"][0]["done"].as_u64().unwrap() < u64::from(LONG));
    // The next one starts.
    lab.evaluation(&waiting[1], "a first trial", under_way).await;
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_queries_are_refused_by_field_and_value() {
    let lab = Laboratory::open().await;
    for (change, status, code, field, parts) in [
        (json!({"episodes": 0}), 422, "out_of_range", "episodes", &["episodes is 0", "1 to 1000"][..]),
        (json!({"episodes": 1001}), 422, "out_of_range", "episodes", &["1001"]),
        (json!({"episodes": -1}), 400, "malformed", "episodes", &["-1"]),
        (json!({"controllers": ["magic"]}), 400, "malformed", "controllers[0]", &["magic", "rl", "errt", "attractor"]),
        (json!({"controllers": []}), 422, "out_of_range", "controllers", &["empty"]),
        (json!({"maps": ["posts", "nowhere"]}), 422, "map_refused", "maps[1]", &["nowhere", "colon", "vessels"]),
        (json!({"maps": ["/etc/passwd"]}), 422, "map_refused", "maps[0]", &["/etc/passwd"]),
        (json!({"disturbances": [0, 3, 99]}), 422, "out_of_range", "disturbances[2]", &["99", "0 to 10"]),
        (json!({"seed": 1.5}), 400, "malformed", "seed", &["1.5"]),
        (json!({"wings": 2}), 400, "malformed", "wings", &["wings"]),
        (
            json!({"controllers": ["rl", "errt", "attractor"], "maps": ["open", "posts", "colon"], "disturbances": [0, 1, 2],
                "vary": [{"name": "friction", "from": 0.1, "to": 0.4, "count": 10}]}),
            422,
            "too_many",
            "maps",
            &["270 cells", "240"],
        ),
        (
            json!({"vary": [{"name": "friction", "from": 0.1, "to": 1.4, "count": 2}]}),
            422,
            "out_of_range",
            "vary",
            &["friction is 1.4, it must be 0 to 1"],
        ),
        (
            json!({"vary": [{"name": "frictoin", "from": 0.1, "to": 0.4, "count": 2}]}),
            422,
            "out_of_range",
            "vary",
            &["did you mean friction?"],
        ),
    ] {
        let (answered, problem) = lab.ask("POST", "/api/evaluations", &query(change.clone()).to_string()).await;
        assert_eq!((answered, &problem["code"]), (status, &json!(code)), "{change}: {problem}");
        assert_eq!(problem["field"], field, "{change}: {problem}");
        let detail = problem["detail"].as_str().unwrap();
        assert!(parts.iter().all(|part| detail.contains(part)), "{change}: {detail}");
    }
    assert_eq!(lab.ask("GET", "/api/evaluations", "").await.1, json!({"evaluations": []}));
    for method in ["GET", "DELETE"] {
        assert_eq!(lab.ask(method, "/api/evaluations/evaluation-1", "").await.0, 404);
    }
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn stopping_the_server_cancels_evaluations() {
    let lab = Laboratory::open().await;
    let long = lab.begin(json!({"episodes": LONG})).await;
    lab.evaluation(&long, "a first trial", |report| report["cells"][0]["done"].as_u64() >= Some(1)).await;
    let asked = Instant::now();
    lab.close().await;
    assert!(asked.elapsed() < Duration::from_secs(2), "{:?}", asked.elapsed());
}
