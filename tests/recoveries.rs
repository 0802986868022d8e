//! Recovery maps: over HTTP from a live moment, and on the command line. Each trial is evidence: it can be set up in a
//! session, saved as a case and replayed.

use std::ops::ControlFlow;
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use ferry_camera::Camera;
use ferry_core::trial::{Case, CaseOutcome};
use ferry_files::open;

use crate::support::{Browser, Laboratory, ferry, files, gpu};

impl Laboratory {
    /// The report of a recovery map once it has ended; fails after a minute without progress.
    async fn mapped(&self, query: Value) -> Value {
        let (status, made) = self.ask("POST", "/api/recoveries", &query.to_string()).await;
        assert_eq!(status, 202, "{made}");
        let path = format!("/api/recoveries/{}", made["id"].as_str().unwrap());
        let (mut last, mut since) = (Value::Null, Instant::now());
        loop {
            let (status, report) = self.ask("GET", &path, "").await;
            assert_eq!(status, 200, "{report}");
            if !["waiting", "running"].contains(&report["stage"].as_str().unwrap()) {
                return report;
            }
            if report["done"] != last {
                (last, since) = (report["done"].clone(), Instant::now());
            }
            assert!(since.elapsed() < Duration::from_secs(900), "{} of {}", report["done"], report["planned"]);
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    }
}

/// A session on its way to a goal.
async fn under_way(lab: &Laboratory) -> Browser {
    let mut browser = lab.browser().await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "step", "ticks": 250})).await;
    browser.state("the moment", |m| m["tick"] == 250).await;
    browser
}

fn outcome(case: &Case) -> CaseOutcome {
    let arena = open::arena_of(case).unwrap();
    case.run(&arena, &mut Camera::of(&gpu(), arena.static_scene()).unwrap(), &mut |_| ControlFlow::Continue(()))
        .unwrap()
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn a_trial_of_a_live_moment_is_set_up_and_saved_exactly() {
    let lab = Laboratory::open().await;
    let mut browser = under_way(&lab).await;
    let query = json!({"session": "main", "grid": 6, "repeats": 2, "full": true, "controllers": ["errt", "attractor"]});
    let report = browser.during(lab.mapped(query)).await;
    assert_eq!((&report["stage"], &report["tick"]), (&json!("done"), &json!(250)), "{report}");
    assert_eq!((&report["session"], &report["trial"], &report["map"]), (&json!("main"), &json!(0), &json!("posts")));
    assert_eq!(report["done"], report["planned"]);
    let cells = report["cells"].as_array().unwrap();
    assert!(cells.len() >= 20 && cells.iter().all(|cell| cell["repeats"] == 2), "{cells:?}");
    let id = report["id"].as_str().unwrap();
    let last = cells.last().unwrap()["cell"].as_u64().unwrap();
    let mut hashes = std::collections::BTreeSet::new();
    for cell in [0, last / 2, last] {
        let (_, tried) = lab.ask("GET", &format!("/api/recoveries/{id}/cells/{cell}"), "").await;
        for trial in tried["trials"].as_array().unwrap() {
            let (controller, repeat) = (trial["controller"].as_str().unwrap(), trial["repeat"].as_u64().unwrap());
            hashes.insert(trial["world_hash"].as_str().unwrap().to_owned());
            let open =
                json!({"type": "open_try", "recovery": id, "cell": cell, "controller": controller, "repeat": repeat});
            browser.send(open).await;
            browser.state("the moment again", |m| m["tick"] == 250 && m["controller"] == controller).await;
            browser.send(json!({"type": "step", "ticks": trial["tick"].as_u64().unwrap() - 250})).await;
            let end = browser.state("the end", |m| m["tick"] == trial["tick"]).await;
            assert_eq!((&end["world_hash"], &end["phase"]["text"]), (&trial["world_hash"], &trial["phase"]), "{trial}");

            let path = format!("/api/recoveries/{id}/cells/{cell}/{controller}/{repeat}/case.json");
            let (status, case) = lab.ask("GET", &path, "").await;
            assert_eq!(status, 200, "{case}");
            let case = Case::from_json(case.to_string().as_bytes()).unwrap();
            let ended = outcome(&case);
            assert_eq!(ended.meets(&case), trial["outcome"] == "delivered", "{trial}");
            if trial["outcome"] == "delivered" {
                assert_eq!((ended.tick, ended.refused), (trial["tick"].as_u64().unwrap(), vec![]));
            }
        }
    }
    assert_eq!(hashes.len(), 12, "each trial has its own noise");
    let (status, html) = lab.ask_text("GET", &format!("/api/recoveries/{id}/map.html"), "", &[]).await;
    assert!(status == 200 && html.contains("attractor") && html.contains("<svg"));
    let (status, ended) = lab.ask("DELETE", &format!("/api/recoveries/{id}"), "").await;
    assert_eq!((status, &ended["code"]), (409, &json!("already_ended")));
    lab.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_wrong_is_refused_by_name_and_a_running_map_is_cancelled() {
    let lab = Laboratory::open().await;
    let refusal = async |query: Value| {
        let (status, problem) = lab.ask("POST", "/api/recoveries", &query.to_string()).await;
        assert!([400, 404, 422].contains(&status), "{status} {problem}");
        (problem["field"].as_str().unwrap_or_default().to_owned(), problem["detail"].as_str().unwrap().to_owned())
    };
    let (field, detail) = refusal(json!({})).await;
    assert_eq!((field.as_str(), detail.as_str()), ("tick", "tick 0: no goal is set, so there is nothing to deliver"));
    let mut browser = under_way(&lab).await;
    for (query, field, text) in [
        (json!({"grid": 3}), "grid", "grid is 3, it must be 4 to 96"),
        (json!({"repeats": 0}), "repeats", "repeats is 0"),
        (json!({"within_s": 0.1}), "within_s", "within_s is 0.1"),
        (json!({"controllers": ["you"]}), "controllers[0]", "no person"),
        (json!({"controllers": ["rl", "program"]}), "controllers[1]", "no program"),
        (json!({"grid": 96, "repeats": 100}), "grid", "the limit is 100000"),
        (json!({"session": "main", "map": "posts"}), "map", "session"),
        (json!({"map": "posts", "tick": 3}), "tick", "no session"),
        (json!({"map": "nowhere"}), "map", "nowhere"),
        (json!({"scenario": "nowhere"}), "scenario", "nowhere"),
        (json!({"tick": 100_000}), "tick", "tick is 100000"),
        (json!({"kind": "shove"}), "kind", "shove"),
        (json!({"session": "absent"}), "", "absent"),
    ] {
        let (named, detail) = refusal(query.clone()).await;
        assert!(named == field && detail.contains(text), "{query}: {named:?} {detail}");
    }
    // Serde would take an array for an object without names.
    let (status, problem) = lab.ask("POST", "/api/recoveries", "[null, null]").await;
    assert_eq!((status, &problem["code"]), (400, &json!("malformed")), "{problem}");
    let long = json!({"controllers": ["errt"], "grid": 96, "repeats": 20, "full": true, "map": "colon"});
    let (status, made) = lab.ask("POST", "/api/recoveries", &long.to_string()).await;
    assert_eq!(status, 202, "{made}");
    let path = format!("/api/recoveries/{}", made["id"].as_str().unwrap());
    let (status, _) = lab.ask("DELETE", &path, "").await;
    assert_eq!(status, 202);
    let begun = Instant::now();
    while lab.ask("GET", &path, "").await.1["stage"] != "cancelled" {
        assert!(begun.elapsed() < Duration::from_secs(30));
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    browser
        .send(json!({"type": "open_try", "recovery": "recovery-9", "cell": 0, "controller": "rl", "repeat": 0}))
        .await;
    let error = browser.error().await;
    assert_eq!((&error["code"], &error["field"]), (&json!("no_try"), &json!("recovery")), "{error}");
    lab.close().await;
}

fn on_the_command_line(arguments: &[&str]) -> Value {
    let output =
        ferry(&[]).args(["recovery", "--map", "posts", "--grid", "4", "--json"]).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn replays(log: &Path) -> bool {
    ferry(&["replay", "--camera", &log.display().to_string()]).output().unwrap().status.success()
}

#[test]
#[ignore = "long"]
fn every_kind_is_mapped_recorded_and_replayed() {
    for (kind, count) in [("place", 4..=16), ("push", 16..=16), ("drag", 16..=16), ("blind", 16..=16)] {
        let folder = tempfile::tempdir().unwrap();
        let (csv, html) = (folder.path().join("map.csv"), folder.path().join("map.html"));
        let records = folder.path().join("trials");
        let report = on_the_command_line(&[
            "--kind",
            kind,
            "--controller",
            "attractor",
            "--repeats",
            "1",
            "--csv",
            &csv.display().to_string(),
            "--html",
            &html.display().to_string(),
            "--record",
            &records.display().to_string(),
        ]);
        let cells = report["cells"].as_array().unwrap();
        assert!(count.contains(&cells.len()), "{kind}: {}", cells.len());
        assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), cells.len() + 1);
        assert!(std::fs::read_to_string(html).unwrap().contains(kind));
        let delivered = cells.iter().filter(|cell| cell["delivered"] == 1).count();
        assert_eq!(report["basins"][0]["delivered"], delivered);
        assert!(delivered > 0, "{kind}");
        let logs: Vec<_> = files(&records, "ferry").into_iter().filter(|log| !name(log).starts_with("und")).collect();
        assert_eq!(logs.len(), cells.len(), "{kind}");
        for log in logs.iter().step_by(5) {
            assert!(replays(log), "{log:?}");
            assert!(open::case(&log.with_extension("json").display().to_string()).is_ok());
        }
    }
}

fn name(path: &Path) -> &str {
    path.file_name().unwrap().to_str().unwrap()
}

#[test]
#[ignore = "long"]
fn the_number_of_threads_does_not_change_a_map() {
    let maps = ["1", "3"].map(|threads| {
        let output = ferry(&["recovery", "--map", "posts", "--grid", "6", "--repeats", "2", "--json"])
            .args(["--controller", "attractor,errt", "--set", "tracker_noise_m=0.002"])
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        serde_json::from_slice::<Value>(&output.stdout).unwrap()
    });
    assert_eq!(maps[0], maps[1]);
    let [difference] = &maps[0]["differences"].as_array().unwrap()[..] else { panic!("one pair") };
    let count = |name: &str| difference[name].as_u64().unwrap();
    let trials = maps[0]["basins"][0]["trials"].as_u64().unwrap();
    assert_eq!(count("both") + count("first_only") + count("second_only") + count("neither"), trials);
}

#[test]
#[ignore = "long"]
fn a_moment_of_a_scenario_has_the_inputs_before_it() {
    let output = ferry(&["recovery", "--scenario", "example-2", "--at-s", "2", "--grid", "4", "--repeats", "1"])
        .args(["--kind", "push", "--controller", "attractor", "--json"])
        .output()
        .unwrap();
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&report["tick"], &report["map"]), (&json!(250), &json!("attractor-example")), "{report}");
    let refused = ferry(&["recovery", "--scenario", "example-2", "--at-s=-1"]).output().unwrap();
    assert!(String::from_utf8_lossy(&refused.stderr).contains("at_s is -1, it must be 0 to 86400"));
}
