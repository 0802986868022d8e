//! The server is killed at any moment, or its disk is full: what was recorded before stays readable.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use ferry_core::trial::{Entry, InputLog, replay};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::json;

use crate::support::{Browser, Ferry, ferry, files, read};

/// Maximum loss at a crash.
const LOST_TICKS: u64 = 62;

/// How often the server is killed; the stated guarantee was tested with `FERRY_KILLS=50`.
fn kills() -> u32 {
    std::env::var("FERRY_KILLS").map_or(4, |count| count.parse().expect("FERRY_KILLS is a count"))
}

/// Runs a session and kills the server; returns the last tick that a browser saw.
async fn run_and_kill(data: &Path, after: Duration) -> u64 {
    let ferry = Ferry::serve(&mut ferry(&[]), data);
    let mut browser = Browser::at(ferry.address).await;
    browser
        .send(json!({"type": "load_scenario", "map": "posts", "start_m": [-0.25, -0.38], "goal_m": [0.12, -0.33]}))
        .await;
    browser.send(json!({"type": "run"})).await;
    let begun = Instant::now();
    let mut seen = 0;
    while begun.elapsed() < after {
        let state = browser.state("a state", |_| true).await;
        seen = state["tick"].as_u64().unwrap();
    }
    drop(ferry);
    seen
}

#[tokio::test(flavor = "multi_thread")]
async fn a_killed_server_loses_half_a_second_at_most() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let (mut rrds, mut seen) = (Vec::new(), Vec::new());
    let folder = tempfile::tempdir().unwrap();
    for index in 0..kills() {
        let data = folder.path().join(index.to_string());
        let after = Duration::from_millis(rng.random_range(300..3000));
        seen.push(run_and_kill(&data, after).await);
        rrds.push(files(&data.join("recordings"), "rrd").remove(0));
    }
    let mut lost = Vec::new();
    for ((rrd, &seen), found) in rrds.iter().zip(&seen).zip(read(&rrds)) {
        let logged = found["last_tick"].as_u64().unwrap();
        let log = InputLog::read(&std::fs::read(rrd.with_extension("ferry")).unwrap()).unwrap();
        let mut whole = log.entries.iter().filter_map(|entry| match entry {
            Entry::Tick(tick) => Some(tick.tick),
            Entry::Begin(_) => None,
        });
        let whole = whole.next_back().unwrap_or(0);
        let mut last = 0;
        replay(&log, None, &mut |record| last = record.tick).unwrap();
        assert_eq!(last, whole);
        lost.push((seen.saturating_sub(logged), seen.saturating_sub(whole)));
    }
    println!("ticks lost by Rerun's file and by the input log: {lost:?}");
    assert!(lost.iter().all(|&(rrd, log)| rrd <= LOST_TICKS && log <= LOST_TICKS), "{lost:?}");
}

/// A limit on the size of files replaces a full disk: writing fails at the same place. The signal of that limit does not
/// end the server.
#[cfg(unix)]
#[tokio::test(flavor = "multi_thread")]
async fn a_full_disk_stops_the_recording_visibly_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let mut limited = Command::new("sh");
    limited.args(["-c", "ulimit -f 400; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_ferry")]);
    let ferry = Ferry::serve(&mut limited, folder.path());
    let mut browser = Browser::at(ferry.address).await;
    browser.send(json!({"type": "set_goal", "x_m": 0.12, "y_m": -0.33})).await;
    browser.send(json!({"type": "set_speed", "factor": 8})).await;
    browser.send(json!({"type": "run"})).await;
    let recording = browser.state("a recording", |m| m["tick"].as_u64() > Some(10)).await;
    assert_eq!(recording["recording"]["code"], "on");
    let stopped = |m: &serde_json::Value| m["recording"]["code"] == "stopped";
    let full = browser.state("the recording stops", stopped).await;
    let later = full["tick"].as_u64().unwrap() + 250;
    let goes_on = browser.state("the session goes on", |m| m["tick"].as_u64() >= Some(later)).await;
    assert_eq!(goes_on["ended"], serde_json::Value::Null);
    let logs = files(&folder.path().join("recordings"), "ferry");
    let log = InputLog::read(&std::fs::read(&logs[0]).unwrap()).unwrap();
    assert!(replay(&log, None, &mut |_| {}).unwrap().ticks > 10);
}
