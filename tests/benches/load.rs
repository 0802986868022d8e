//! What many browsers, a stalled one, several sessions and a training cost: `make soak` runs it and fails beyond the budgets.
//!
//! The server is a separate process, without recordings, because they change its memory. The clients run beside it on
//! the same cores.

use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::process::{Child, Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio::task::JoinHandle;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};

type Socket = WebSocketStream<MaybeTlsStream<TcpStream>>;

const VIEWERS: usize = 64;
const SESSIONS: usize = 4;
const INPUTS: usize = 250;
const SETTLE: Duration = Duration::from_secs(10);
const MEASURE: Duration = Duration::from_secs(30);
const STALLED: usize = 32;
/// The server ends a connection that reads nothing for 45 s.
const STALL: Duration = Duration::from_secs(40);
/// The budgets.
const MOST_CORE_SHARE: f64 = 0.25;
const MOST_STALLED_BYTES: f64 = 1_048_576.0;
const MOST_P99_RATIO: f64 = 1.1;
const MOST_INPUT_MS: f64 = 20.0;
const MOST_MISSED_RATIO: f64 = 1.1;

struct Ferry {
    child: Child,
    address: SocketAddr,
    _data: tempfile::TempDir,
}

impl Ferry {
    fn start() -> Self {
        let data = tempfile::tempdir().unwrap();
        // A file with the name of the folder makes it fail.
        std::fs::write(data.path().join("recordings"), "").unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_ferry"))
            .args(["serve", "--bind", "127.0.0.1:0", "--data"])
            .arg(data.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("listening on http://").unwrap().parse().unwrap();
        Self { child, address, _data: data }
    }

    /// Processor time used up to now.
    fn cpu(&self) -> Duration {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.child.id())).unwrap();
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap().split_whitespace().collect();
        // utime and stime, in hundredths of a second.
        let ticks: u64 = fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap();
        Duration::from_millis(ticks * 10)
    }

    fn rss_bytes(&self) -> f64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.child.id())).unwrap();
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
        1024.0 * line.trim().trim_end_matches(" kB").parse::<f64>().unwrap()
    }

    async fn socket(&self, session: &str) -> Socket {
        let address = self.address;
        let page = format!("http://{address}/s/{session}");
        tokio::task::spawn_blocking(move || ureq::get(page).call().unwrap()).await.unwrap();
        connect_async(format!("ws://{address}/api/sessions/{session}/live")).await.unwrap().0
    }

    /// Share of a core over a while.
    async fn core_share(&self, over: Duration) -> f64 {
        let (from, began) = (self.cpu(), Instant::now());
        tokio::time::sleep(over).await;
        (self.cpu() - from).as_secs_f64() / began.elapsed().as_secs_f64()
    }
}

impl Drop for Ferry {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Reads for a while; milliseconds between states.
fn watch(mut socket: Socket, over: Duration) -> JoinHandle<Vec<f64>> {
    tokio::spawn(async move {
        let (end, mut last, mut gaps_ms) = (Instant::now() + over, None::<Instant>, Vec::new());
        while Instant::now() < end {
            let Some(Ok(message)) = socket.next().await else { break };
            let Message::Text(text) = message else { continue };
            if text.starts_with("{\"type\":\"state\"") {
                let now = Instant::now();
                gaps_ms.extend(last.map(|last| (now - last).as_secs_f64() * 1e3));
                last = Some(now);
            }
        }
        gaps_ms
    })
}

fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share) as usize]
}

async fn tell(socket: &mut Socket, message: Value) {
    socket.send(Message::text(message.to_string())).await.unwrap();
}

/// A session with a goal on its way; a new goal when the last is reached keeps it at work.
async fn run(ferry: &Ferry, session: &str) -> Socket {
    let mut socket = ferry.socket(session).await;
    let load = json!({"type": "load_scenario", "map": "posts", "controller": "attractor", "start_m": [-0.25, -0.38], "goal_m": [0.12, -0.33]});
    tell(&mut socket, load).await;
    tell(&mut socket, json!({"type": "run"})).await;
    socket
}

/// Share of a core that the viewers add, and how many states a second each gets.
async fn viewers(ferry: &Ferry) -> (f64, f64, f64) {
    let operator = watch(run(ferry, "main").await, SETTLE * 2 + MEASURE * 3);
    tokio::time::sleep(SETTLE).await;
    let alone = ferry.core_share(MEASURE).await;
    let mut all = Vec::new();
    for _ in 1..VIEWERS {
        all.push(watch(ferry.socket("main").await, SETTLE + MEASURE));
    }
    tokio::time::sleep(SETTLE / 2).await;
    let together = ferry.core_share(MEASURE).await;
    let mut states = 0.0;
    for viewer in all {
        states += viewer.await.unwrap().len() as f64;
    }
    operator.abort();
    (together, together - alone, states / (VIEWERS - 1) as f64 / (SETTLE + MEASURE).as_secs_f64())
}

/// Ten minutes of moments to go back to are kept; until they are there, memory grows by them.
async fn fill(operator: &mut Socket) {
    tell(operator, json!({"type": "set_speed", "factor": 64})).await;
    let full = async {
        loop {
            let Message::Text(text) = operator.next().await.unwrap().unwrap() else { continue };
            let message: Value = serde_json::from_str(&text).unwrap();
            if message["type"] == "state" && message["oldest_tick"].as_u64() > Some(0) {
                break;
            }
        }
    };
    tokio::time::timeout(Duration::from_secs(300), full).await.expect("ten minutes pass within five");
    tell(operator, json!({"type": "set_speed", "factor": 1})).await;
}

/// Bytes that a stalled viewer costs, and by how much the others' p99 of the time between states grows. Many stall, because
/// the server's memory changes by megabytes anyway.
async fn stalled(ferry: &Ferry) -> (f64, f64, f64) {
    let round = async |count: usize, over: Duration| {
        let mut stalled = Vec::new();
        for _ in 0..count {
            stalled.push(ferry.socket("main").await);
        }
        let mut others = Vec::new();
        for _ in 0..4 {
            others.push(watch(ferry.socket("main").await, over));
        }
        let mut rss = Vec::new();
        let end = Instant::now() + over;
        while Instant::now() < end {
            tokio::time::sleep(Duration::from_secs(1)).await;
            rss.push(ferry.rss_bytes());
        }
        let mut gaps_ms = Vec::new();
        for other in others {
            gaps_ms.extend(other.await.unwrap());
        }
        drop(stalled);
        (quantile(rss.split_off(rss.len() / 2), 0.5), quantile(gaps_ms, 0.99))
    };
    let mut operator = run(ferry, "main").await;
    fill(&mut operator).await;
    let operator = watch(operator, STALL * 4);
    round(0, STALL).await;
    let (rss_before, p99_before) = round(0, STALL).await;
    let (rss_with, p99_with) = round(STALLED, STALL).await;
    operator.abort();
    ((rss_with - rss_before) / STALLED as f64, p99_before, p99_with)
}

/// A session that steps, compares and goes back without pause.
async fn restless(mut socket: Socket) {
    let mut ticks = 0_u64;
    loop {
        ticks += 1;
        for command in [
            json!({"type": "step", "ticks": 12_500}),
            json!({"type": "fork", "tick": 0}),
            json!({"type": "rewind", "tick": ticks % 32}),
        ] {
            tell(&mut socket, command).await;
            let pause = tokio::time::sleep(Duration::from_millis(150));
            tokio::pin!(pause);
            loop {
                tokio::select! {
                    () = &mut pause => break,
                    message = socket.next() => drop(message.unwrap().unwrap()),
                }
            }
        }
    }
}

/// Starts a training that outlasts the measurement, and waits until it learns.
async fn train(ferry: &Ferry) {
    let address = format!("http://{}/api/trainings", ferry.address);
    let query = json!({"map": "colon", "name": "beside", "seed": 1, "settings": {"updates": 20_000}});
    ureq::post(&address).content_type("application/json").send(query.to_string()).unwrap();
    let learns = async {
        loop {
            let list = ureq::get(&address).call().unwrap().body_mut().read_to_string().unwrap();
            let list: Value = serde_json::from_str(&list).unwrap();
            if list["trainings"][0]["updates"].as_u64() > Some(0) {
                break;
            }
            tokio::time::sleep(Duration::from_millis(200)).await;
        }
    };
    tokio::time::timeout(Duration::from_secs(120), learns).await.expect("it learns within two minutes");
}

/// How often the session `load-0` has skipped lost time.
async fn missed(ferry: &Ferry) -> f64 {
    let address = format!("http://{}/api/sessions/load-0/state", ferry.address);
    let state = ureq::get(&address).call().unwrap().body_mut().read_to_string().unwrap();
    serde_json::from_str::<Value>(&state).unwrap()["missed_deadlines"].as_f64().unwrap()
}

/// Input to state of one session without and beside a training, and how often each of them missed a deadline.
async fn beside_a_training(ferry: &Ferry) -> ([Vec<f64>; 2], [f64; 2]) {
    let alone_ms = inputs(ferry, 1).await;
    let missed_alone = missed(ferry).await;
    train(ferry).await;
    let before = missed(ferry).await;
    let beside_ms = inputs(ferry, 1).await;
    ([alone_ms, beside_ms], [missed_alone, missed(ferry).await - before])
}

/// Milliseconds from a goal's sending to the state that shows it, of this many sessions at once.
async fn inputs(ferry: &Ferry, count: usize) -> Vec<f64> {
    let mut sessions = Vec::new();
    for number in 0..count {
        sessions.push(run(ferry, &format!("load-{number}")).await);
    }
    tokio::time::sleep(SETTLE).await;
    let asking: Vec<_> = sessions
        .into_iter()
        .enumerate()
        .map(|(number, mut socket)| {
            tokio::spawn(async move {
                let mut took_ms = Vec::new();
                for input in 0..INPUTS {
                    let x_m = 0.1 + (input % 20) as f64 * 1e-3;
                    // What has come meanwhile is read first.
                    let pause = tokio::time::sleep(Duration::from_millis(90 + 7 * number as u64));
                    tokio::pin!(pause);
                    loop {
                        tokio::select! {
                            () = &mut pause => break,
                            message = socket.next() => drop(message.unwrap().unwrap()),
                        }
                    }
                    let sent = Instant::now();
                    tell(&mut socket, json!({"type": "set_goal", "x_m": x_m, "y_m": -0.33})).await;
                    loop {
                        let Message::Text(text) = socket.next().await.unwrap().unwrap() else { continue };
                        if !text.starts_with("{\"type\":\"state\"") {
                            continue;
                        }
                        let state: Value = serde_json::from_str(&text).unwrap();
                        if state["goal_m"][0].as_f64().is_some_and(|shown| (shown - x_m).abs() < 1e-9) {
                            break;
                        }
                    }
                    took_ms.push(sent.elapsed().as_secs_f64() * 1e3);
                }
                took_ms
            })
        })
        .collect();
    let mut all = Vec::new();
    for asked in asking {
        all.extend(asked.await.unwrap());
    }
    all
}

#[tokio::main]
async fn main() -> ExitCode {
    let ferry = Ferry::start();
    let mut failed = false;
    let mut judge = |what: &str, value: f64, most: f64, unit: &str| {
        let over = value > most;
        failed |= over;
        println!("{}  {what}: {value:.3} {unit}, at most {most}", if over { "FAIL" } else { "ok  " });
    };
    let took_ms = inputs(&ferry, SESSIONS).await;
    println!("input to state, {SESSIONS} sessions: p50 {:.1} ms", quantile(took_ms.clone(), 0.5));
    judge("input to state on the wire, p99", quantile(took_ms, 0.99), MOST_INPUT_MS, "ms");
    drop(ferry);

    let ferry = Ferry::start();
    let neighbour = tokio::spawn(restless(run(&ferry, "restless").await));
    let took_ms = inputs(&ferry, 1).await;
    assert!(!neighbour.is_finished(), "the restless session ended");
    neighbour.abort();
    println!(
        "input to state beside a session that steps, compares and goes back: p50 {:.1} ms",
        quantile(took_ms.clone(), 0.5)
    );
    judge("input to state beside that session, p99", quantile(took_ms, 0.99), MOST_INPUT_MS, "ms");
    drop(ferry);

    let ferry = Ferry::start();
    let ([alone_ms, beside_ms], [missed_alone, missed_beside]) = beside_a_training(&ferry).await;
    println!(
        "input to state without and beside a training: p50 {:.1} and {:.1} ms, p99 {:.1} ms without; missed deadlines \
         {missed_alone} and {missed_beside}",
        quantile(alone_ms.clone(), 0.5),
        quantile(beside_ms.clone(), 0.5),
        quantile(alone_ms, 0.99)
    );
    judge("input to state beside a training, p99", quantile(beside_ms, 0.99), MOST_INPUT_MS, "ms");
    judge("missed deadlines, beside over without", (missed_beside + 1.0) / (missed_alone + 1.0), MOST_MISSED_RATIO, "");
    drop(ferry);

    let ferry = Ferry::start();
    let (together, added, states) = viewers(&ferry).await;
    println!("{VIEWERS} viewers: {states:.1} states a second each, {together:.3} of a core with the session itself");
    judge("share of a core for the viewers", added, MOST_CORE_SHARE, "");
    drop(ferry);

    let ferry = Ferry::start();
    let (bytes, before, with) = stalled(&ferry).await;
    println!("p99 between states: {before:.2} ms without stalled viewers, {with:.2} ms with {STALLED}");
    judge("memory for a stalled viewer", bytes, MOST_STALLED_BYTES, "bytes");
    judge("the others' p99 with it over without", with / before, MOST_P99_RATIO, "");
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
