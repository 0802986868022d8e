//! What a training costs the short jobs beside it, and what all of them cost a live session: `make soak` runs it and fails
//! beyond the budgets.
//!
//! A recovery map of 60 trials and a comparison of three controllers begin together, in turn while the training is paused and
//! while it runs. The server is a separate process; the clients run beside it on the same cores.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::{ClientRequestBuilder, Message};
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

/// Pairs of a round alone and one beside the training.
const PAIRS: usize = 5;
const TRIALS: u64 = 60;
const IDLE: Duration = Duration::from_secs(10);
/// The budgets.
const MOST_FIRST_S: f64 = 3.0;
const MOST_RATIO: f64 = 2.0;
const MOST_DEADLINE_RATIO: f64 = 1.1;

struct Ferry {
    child: Child,
    address: String,
    /// Of one visitor, whose control of a session waits for it between two connections.
    cookie: String,
    _data: tempfile::TempDir,
}

impl Ferry {
    fn start() -> Self {
        let data = tempfile::tempdir().unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_ferry"))
            .args(["serve", "--bind", "127.0.0.1:0", "--data"])
            .arg(data.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("listening on http://").unwrap().to_owned();
        let page = ureq::get(format!("http://{address}/s/main")).call().unwrap();
        let cookie = page.headers()["set-cookie"].to_str().unwrap().split(';').next().unwrap().to_owned();
        Self { child, address, cookie, _data: data }
    }

    fn get(&self, path: &str) -> Value {
        let text = ureq::get(format!("http://{}{path}", self.address)).call().unwrap().body_mut().read_to_string();
        serde_json::from_str(&text.unwrap()).unwrap()
    }

    fn post(&self, path: &str, body: &Value) -> Value {
        let request = ureq::post(format!("http://{}{path}", self.address)).content_type("application/json");
        serde_json::from_str(&request.send(body.to_string()).unwrap().body_mut().read_to_string().unwrap()).unwrap()
    }

    fn job(&self, id: &str) -> Value {
        self.get("/api/jobs")["jobs"].as_array().unwrap().iter().find(|job| job["id"] == id).unwrap().clone()
    }

    /// Seconds until a job fits.
    async fn until(&self, id: &str, fits: impl Fn(&Value) -> bool) -> f64 {
        let begun = Instant::now();
        while !fits(&self.job(id)) {
            assert!(begun.elapsed() < Duration::from_secs(300), "{}", self.job(id));
            tokio::time::sleep(Duration::from_millis(25)).await;
        }
        begun.elapsed().as_secs_f64()
    }

    async fn socket(&self, session: &str) -> Socket {
        ureq::get(format!("http://{}/s/{session}", self.address)).call().unwrap();
        let address = format!("ws://{}/api/sessions/{session}/live", self.address).parse().unwrap();
        connect_async(ClientRequestBuilder::new(address).with_header("cookie", &self.cookie)).await.unwrap().0
    }

    fn missed(&self) -> f64 {
        self.get("/api/sessions/live/state")["missed_deadlines"].as_f64().unwrap()
    }
}

impl Drop for Ferry {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

async fn tell(socket: &mut Socket, message: Value) {
    socket.send(Message::text(message.to_string())).await.unwrap();
}

async fn message(socket: &mut Socket, fits: impl Fn(&Value) -> bool) -> Value {
    loop {
        let next = tokio::time::timeout(Duration::from_secs(60), socket.next()).await.expect("no message");
        let Message::Text(text) = next.unwrap().unwrap() else { continue };
        let message: Value = serde_json::from_str(&text).unwrap();
        assert_ne!(message["type"], "error", "{message}");
        if fits(&message) {
            return message;
        }
    }
}

/// A session with a goal.
async fn load(ferry: &Ferry, session: &str) -> Socket {
    let mut socket = ferry.socket(session).await;
    let scenario = json!({"type": "load_scenario", "map": "posts", "controller": "attractor", "start_m": [-0.25, -0.38],
        "goal_m": [0.12, -0.33]});
    tell(&mut socket, scenario).await;
    socket
}

/// How long a round took, in seconds.
#[derive(Debug, Default)]
struct Round {
    first_trial: f64,
    first_branch: f64,
    recovery: f64,
    comparison: f64,
    /// Milliseconds between two states of the live session.
    gaps_ms: Vec<f64>,
    missed: f64,
}

/// Milliseconds between states while something else happens.
async fn during<T>(live: &mut Socket, other: impl Future<Output = T>) -> (T, Vec<f64>) {
    let (mut last, mut gaps_ms) = (None::<Instant>, Vec::new());
    tokio::pin!(other);
    loop {
        tokio::select! {
            done = &mut other => return (done, gaps_ms),
            message = live.next() => {
                let Message::Text(text) = message.unwrap().unwrap() else { continue };
                if text.starts_with("{\"type\":\"state\"") {
                    let now = Instant::now();
                    gaps_ms.extend(last.map(|last| (now - last).as_secs_f64() * 1e3));
                    last = Some(now);
                }
            }
        }
    }
}

async fn round(ferry: &Ferry, live: &mut Socket) -> Round {
    let missed = ferry.missed();
    // A connection that reads nothing between two rounds would be closed.
    let main = &mut ferry.socket("main").await;
    let query = json!({"session": "main", "tick": 250, "kind": "push", "grid": 5, "repeats": 1,
        "controllers": ["rl", "errt", "attractor"]});
    let jobs = async {
        let begun = Instant::now();
        let id = ferry.post("/api/recoveries", &query)["id"].as_str().unwrap().to_owned();
        tell(main, json!({"type": "fork", "tick": 250})).await;
        let recovery = async {
            let first = ferry.until(&id, |job| job["has_results"] == true).await;
            ferry.until(&id, |job| job["stage"] == "done").await;
            (first, begun.elapsed().as_secs_f64())
        };
        let comparison = async {
            let begins = |m: &Value| m["type"] == "comparison" && m["running"] == true && m["branches"] == json!([]);
            message(main, begins).await;
            let has_samples = |m: &Value| m["type"] == "comparison" && m["branches"][0]["samples"][0].is_array();
            let samples = message(main, has_samples).await;
            let first = begun.elapsed().as_secs_f64();
            if samples["running"] == true {
                message(main, |m| m["type"] == "comparison" && m["running"] == false).await;
            }
            (first, begun.elapsed().as_secs_f64())
        };
        let ((first_trial, recovery), (first_branch, comparison)) = tokio::join!(recovery, comparison);
        let report = ferry.get(&format!("/api/recoveries/{id}"));
        assert_eq!(report["done"], TRIALS);
        Round { first_trial, first_branch, recovery, comparison, ..Round::default() }
    };
    let (round, gaps_ms) = during(live, jobs).await;
    Round { gaps_ms, missed: ferry.missed() - missed, ..round }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn p99(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[(values.len() - 1) * 99 / 100]
}

#[tokio::main]
async fn main() -> ExitCode {
    let ferry = Ferry::start();
    let mut main = load(&ferry, "main").await;
    tell(&mut main, json!({"type": "step", "ticks": 250})).await;
    message(&mut main, |m| m["type"] == "state" && m["tick"] == 250).await;
    drop(main);
    let mut live = load(&ferry, "live").await;
    tell(&mut live, json!({"type": "run"})).await;
    let query = json!({"map": "colon", "name": "beside", "seed": 1, "settings": {"updates": 20_000}});
    let training = ferry.post("/api/trainings", &query)["id"].as_str().unwrap().to_owned();
    during(&mut live, ferry.until(&training, |job| job["has_results"] == true)).await;
    let switch = async |to: &str, stage: &str| {
        ferry.post(&format!("/api/jobs/{training}/{to}"), &json!({}));
        ferry.until(&training, |job| job["stage"] == stage).await;
    };
    // The devices of the short lane and of the comparisons open before anything is measured.
    round(&ferry, &mut live).await;
    let (mut alone, mut beside, mut idle_ms, mut idle_missed) = (Vec::new(), Vec::new(), Vec::new(), 0.0);
    for pair in 0..PAIRS {
        during(&mut live, switch("pause", "paused")).await;
        let before = ferry.missed();
        idle_ms.extend(during(&mut live, tokio::time::sleep(IDLE)).await.1);
        idle_missed += ferry.missed() - before;
        alone.push(round(&ferry, &mut live).await);
        during(&mut live, switch("resume", "running")).await;
        let updates = |job: &Value| job["share"].as_f64();
        let from = ferry.job(&training);
        during(&mut live, ferry.until(&training, |job| updates(job) > updates(&from))).await;
        beside.push(round(&ferry, &mut live).await);
        for (name, round) in [("alone ", alone.last()), ("beside", beside.last())] {
            let Some(Round { first_trial, first_branch, recovery, comparison, missed, gaps_ms }) = round else {
                continue;
            };
            println!(
                "{pair} {name}: recovery map {recovery:.2} s (first {first_trial:.2}), comparison {comparison:.2} s (first \
                 {first_branch:.2}), live p99 {:.1} ms, {missed} missed",
                p99(gaps_ms.clone())
            );
        }
    }
    let mut failed = false;
    let mut judge = |what: &str, value: f64, most: f64| {
        failed |= value > most;
        println!("{}  {what}: {value:.2}, at most {most}", if value > most { "FAIL" } else { "ok  " });
    };
    let of = |rounds: &[Round], read: fn(&Round) -> f64| median(rounds.iter().map(read).collect());
    judge("first trial beside a training, s", of(&beside, |round| round.first_trial), MOST_FIRST_S);
    judge("first branch beside a training, s", of(&beside, |round| round.first_branch), MOST_FIRST_S);
    let ratio = |read: fn(&Round) -> f64| median(alone.iter().zip(&beside).map(|(a, b)| read(b) / read(a)).collect());
    judge("recovery map beside a training ÷ alone", ratio(|round| round.recovery), MOST_RATIO);
    judge("comparison beside a training ÷ alone", ratio(|round| round.comparison), MOST_RATIO);
    let busy_ms: Vec<f64> = beside.iter().flat_map(|round| round.gaps_ms.iter().copied()).collect();
    println!("time between states of a live session, p99: {:.1} ms without jobs", p99(idle_ms.clone()));
    judge("the same with all jobs ÷ without", p99(busy_ms) / p99(idle_ms), MOST_DEADLINE_RATIO);
    let busy_missed = beside.iter().map(|round| round.missed).sum::<f64>();
    println!("missed deadlines: {idle_missed} without jobs, {busy_missed} with all");
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
