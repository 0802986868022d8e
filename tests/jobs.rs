//! Jobs in the background: short ones run beside long ones, all are listed, and each can be paused and cancelled.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::support::{Browser, Laboratory};

/// Longest wait: jobs have a low priority, and other tests run beside them.
const LONGEST_WAIT: Duration = Duration::from_secs(240);

impl Laboratory {
    async fn job(&self, id: &str) -> Value {
        let (_, listed) = self.ask("GET", "/api/jobs", "").await;
        listed["jobs"].as_array().unwrap().iter().find(|job| job["id"] == id).cloned().unwrap_or(Value::Null)
    }

    /// The job once it fits.
    async fn job_when(&self, id: &str, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            let job = self.job(id).await;
            if fits(&job) {
                return job;
            }
            assert!(begun.elapsed() < LONGEST_WAIT, "{what}: {job}");
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }

    /// Starts a job and returns its id.
    async fn start(&self, path: &str, query: Value) -> String {
        let (status, made) = self.ask("POST", path, &query.to_string()).await;
        assert!([201, 202].contains(&status), "{made}");
        made["id"].as_str().unwrap().to_owned()
    }

    /// Pauses a job after its first results, sees that it stands still, and lets it go on.
    async fn interrupt(&self, id: &str) {
        self.job_when(id, "results", |job| job["has_results"] == true).await;
        assert_eq!(self.ask("POST", &format!("/api/jobs/{id}/pause"), "").await.0, 202);
        let paused = self.job_when(id, "a pause", |job| job["stage"] == "paused").await;
        assert!(paused["share"].as_f64() > Some(0.0) && paused["share"].as_f64() < Some(1.0), "{paused}");
        assert_eq!(self.ask("POST", &format!("/api/jobs/{id}/pause"), "").await.0, 409);
        tokio::time::sleep(Duration::from_millis(200)).await;
        assert_eq!(self.job(id).await, paused);
        assert_eq!(self.ask("POST", &format!("/api/jobs/{id}/resume"), "").await.0, 202);
    }

    async fn done(&self, id: &str) {
        self.job_when(id, "the end", |job| job["stage"] == "done").await;
    }
}

fn recovery() -> Value {
    json!({"session": "main", "grid": 8, "repeats": 2, "full": true, "controllers": ["attractor"], "within_s": 20})
}

/// A goal is set, and two seconds have passed.
async fn under_way(lab: &Laboratory) -> Browser {
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 250})).await;
    browser.state("the moment", |m| m["tick"] == 250).await;
    browser
}

#[tokio::test(flavor = "multi_thread")]
async fn a_recovery_map_and_a_comparison_come_and_end_during_a_training() {
    let lab = Laboratory::open().await;
    let mut browser = under_way(&lab).await;
    let long = json!({"map": "u-turn", "name": "long", "seed": 7, "settings": {"updates": 20_000}});
    let training = lab.start("/api/trainings?session=main", long).await;
    let waits = json!({"map": "u-turn", "name": "waits", "seed": 7, "settings": {"updates": 20_000}});
    let waiting = lab.start("/api/trainings", waits).await;
    let runs = |job: &Value| job["stage"] == "running" && job["has_results"] == true;
    let listed = browser.during(lab.job_when(&training, "a first value map", runs)).await;
    assert_eq!(
        (&listed["kind"], &listed["name"], &listed["owner"]),
        (&json!("training"), &json!("long"), &json!("main"))
    );
    assert!(listed["left_s"].as_f64() > Some(0.0) && listed["estimate_s"].as_f64() > Some(0.0), "{listed}");
    let next = lab.job(&waiting).await;
    assert_eq!((&next["before"], &next["owner"], &next["lane"]), (&json!(1), &Value::Null, &json!("long")));
    assert!(next["starts_in_s"].as_f64() > Some(0.0), "{next}");

    let map = lab.start("/api/recoveries", recovery()).await;
    browser.send(json!({"type": "fork", "tick": 250, "controllers": ["attractor"]})).await;
    browser.until("a comparison", |m| m["type"] == "comparison" && m["branches"] != json!([])).await;
    let job = browser.during(lab.job_when(&map, "a first trial", |job| job["has_results"] == true)).await;
    assert_eq!((&job["lane"], &job["owner"]), (&json!("short"), &json!("main")), "{job}");
    browser.during(lab.done("comparison-1")).await;
    lab.done(&map).await;
    assert_eq!(lab.job(&training).await["stage"], "running", "it did not wait for the training");

    assert_eq!(lab.ask("POST", "/api/jobs/comparison-1/pause", "").await.0, 409);
    for id in [waiting, training] {
        assert_eq!(lab.ask("DELETE", &format!("/api/jobs/{id}"), "").await.0, 202);
        lab.job_when(&id, "its end", |job| job["stage"] == "cancelled").await;
        assert_eq!(lab.ask("DELETE", &format!("/api/jobs/{id}"), "").await.0, 409);
    }
    assert_eq!(lab.ask("DELETE", "/api/jobs/nothing", "").await.0, 404);
    let (status, problem) = lab.ask("POST", "/api/evaluations?session=No!", "{}").await;
    assert_eq!((status, &problem["field"]), (422, &json!("session")), "{problem}");
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_pause_changes_no_result() {
    let lab = Laboratory::open().await;
    let _browser = under_way(&lab).await;
    let [whole, paused] =
        [lab.start("/api/recoveries", recovery()).await, lab.start("/api/recoveries", recovery()).await];
    lab.interrupt(&paused).await;
    lab.done(&whole).await;
    lab.done(&paused).await;
    let mut found = Vec::new();
    for id in [whole, paused] {
        found.push(lab.ask("GET", &format!("/api/recoveries/{id}"), "").await.1);
    }
    assert_eq!((&found[0]["cells"], &found[0]["done"]), (&found[1]["cells"], &found[1]["done"]));

    let query =
        json!({"controllers": ["attractor", "errt"], "maps": ["posts"], "disturbances": [0], "episodes": 6, "seed": 1});
    let [whole, paused] =
        [lab.start("/api/evaluations", query.clone()).await, lab.start("/api/evaluations", query).await];
    lab.interrupt(&paused).await;
    lab.done(&whole).await;
    lab.done(&paused).await;
    let mut rows = Vec::new();
    for id in [whole, paused] {
        let (_, report) = lab.ask("GET", &format!("/api/evaluations/{id}"), "").await;
        let row = |row: &Value| [&row["episodes"], &row["delivered"], &row["tracking_error_mean_m"]].map(Clone::clone);
        rows.push((report["rows"].as_array().unwrap().iter().map(row).collect::<Vec<_>>(), report["failures"].clone()));
    }
    assert_eq!(rows[0], rows[1]);
    lab.close().await;
}
