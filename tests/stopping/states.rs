//! SIGTERM in all that a server does: within two seconds, without an error in its log.

use std::any::Any;
use std::io::Write;
use std::net::{SocketAddr, TcpStream};
use std::path::Path;
use std::process::Stdio;

use serde_json::{Value, json};

use super::*;

/// An idle machine is promised this.
const PROMISED: Duration = Duration::from_secs(2);
const ROBOT: &str = "127.0.28.150";

/// What has to stay open while the server stops.
type Open = Vec<Box<dyn Any>>;

async fn ask(address: SocketAddr, method: &str, path: &str, body: Value) -> (u16, Value) {
    let body = if body.is_null() { String::new() } else { body.to_string() };
    let length = body.len();
    let request = format!(
        "{method} {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n{body}"
    );
    let (status, answer) = tokio::task::spawn_blocking(move || exchange(address, request.as_bytes())).await.unwrap();
    let body = answer.split_once("\r\n\r\n").map_or("", |(_, body)| body);
    (status, serde_json::from_str(body).unwrap_or(Value::Null))
}

/// Submits a job and waits until it is at a stage.
async fn job(address: SocketAddr, kind: &str, query: Value, stage: &str) -> Open {
    let (status, made) = ask(address, "POST", &format!("/api/{kind}"), query).await;
    assert!([201, 202].contains(&status), "{made}");
    let path = format!("/api/{kind}/{}", made["id"].as_str().unwrap());
    let begun = Instant::now();
    loop {
        let (_, report) = ask(address, "GET", &path, Value::Null).await;
        if report["stage"] == stage {
            return Vec::new();
        }
        assert!(begun.elapsed() < Duration::from_secs(120) && report["stage"] != "failed", "{stage}: {report}");
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
}

async fn training(address: SocketAddr, updates: u32, stage: &str) -> Open {
    let query = json!({"map": "u-turn", "name": "mine", "seed": 7, "settings": {"updates": updates}});
    job(address, "trainings", query, stage).await
}

async fn session(address: SocketAddr, commands: &[Value]) -> Open {
    let mut browser = Browser::at(address).await;
    browser.send(json!({"type": "load_scenario", "map": "posts", "goal_m": [0.12, -0.33]})).await;
    browser.send(json!({"type": "set_speed", "factor": 64})).await;
    browser.send(json!({"type": "run"})).await;
    browser.state("running", |m| m["tick"].as_u64() > Some(100)).await;
    for command in commands {
        browser.send(command.clone()).await;
    }
    vec![Box::new(browser)]
}

/// A client of the robot moves its arm.
async fn moved(address: SocketAddr) -> Open {
    let mut browser = Browser::at(address).await;
    browser.send(json!({"type": "load_scenario", "map": "open", "start_m": [-0.1, -0.35]})).await;
    let state = browser.state("the start", |m| m["tick"] == 0).await;
    let mut joints: Vec<f64> = state["joints_rad"].as_array().unwrap().iter().map(|q| q.as_f64().unwrap()).collect();
    joints[0] += 0.3;
    let mut client = TcpStream::connect((ROBOT, 30002)).unwrap();
    writeln!(client, "movej({joints:?}, a=0.1, v=0.02)").unwrap();
    browser.state("it moves", |m| m["robot"]["command"] == "movej").await;
    vec![Box::new(browser), Box::new(client)]
}

/// Stops a server, and tells in how many seconds; its log has no error.
async fn stop(child: Ferry, data: &Path, open: Open) -> Duration {
    tokio::time::sleep(Duration::from_millis(300)).await;
    let folder = data.to_owned();
    let (took, log) = tokio::task::spawn_blocking(move || terminate(child, &folder)).await.unwrap();
    drop(open);
    assert!(!log.contains("ERROR") && !log.contains("panicked"), "{log}");
    took
}

#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn in_twelve_states_it_ends_within_two_seconds_without_an_error() {
    let compare = json!({"type": "compare", "tick": 50, "controllers": ["rl", "errt", "attractor"]});
    let steps = vec![json!({"type": "step", "ticks": 12_500}); 50];
    let evaluation = json!({"maps": ["colon"], "controllers": ["rl"], "episodes": 500, "disturbances": [0], "seed": 1});
    let recovery = json!({"map": "colon", "grid": 40, "repeats": 10});
    let mut slow = Vec::new();
    for state in [
        "idle",
        "running",
        "stepping",
        "comparing",
        "taking the images of a training",
        "learning",
        "examining",
        "evaluating",
        "mapping the recovery",
        "moving for a client",
        "mirroring a robot",
    ] {
        let data = tempfile::tempdir().unwrap();
        let robot = tempfile::tempdir().unwrap();
        let robot = (state == "mirroring a robot").then(|| {
            let mut command = ferry(&["serve", "--bind", "127.0.0.1:0", "--robot-server", ROBOT, "--data"]);
            Ferry::start(command.arg(robot.path()).stderr(Stdio::null()))
        });
        let child = match state {
            "mirroring a robot" => served(data.path(), &["drive", "--robot", ROBOT], |_| ()),
            "moving for a client" => served(data.path(), &["serve", "--robot-server", ROBOT], |_| ()),
            _ => serve(data.path(), |_| ()),
        };
        let address = child.address;
        let open = match state {
            "idle" => Vec::new(),
            "running" => session(address, &[]).await,
            "stepping" => session(address, &[&[json!({"type": "pause"})], steps.as_slice()].concat()).await,
            "comparing" => session(address, &[json!({"type": "pause"}), compare.clone()]).await,
            "taking the images of a training" => training(address, 20_000, "images").await,
            "learning" => training(address, 20_000, "learning").await,
            "examining" => training(address, 30, "examination").await,
            "evaluating" => job(address, "evaluations", evaluation.clone(), "running").await,
            "mapping the recovery" => job(address, "recoveries", recovery.clone(), "running").await,
            "moving for a client" => moved(address).await,
            _ => {
                let mut browser = Browser::at(address).await;
                browser.state("it mirrors", |m| m["twin"]["robot_mode"] == 7).await;
                vec![Box::new(browser) as Box<dyn Any>]
            }
        };
        let took = stop(child, data.path(), open).await;
        println!("{state}: {took:?}");
        if took > PROMISED {
            slow.push((state, took));
        }
        drop(robot);
    }
    // The twelfth is a command of its own.
    let data = tempfile::tempdir().unwrap();
    let mut sweep = ferry(&["sweep", "--map", "colon", "--out"]);
    let mut child = sweep.arg(data.path()).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    tokio::time::sleep(Duration::from_secs(2)).await;
    assert!(child.try_wait().unwrap().is_none(), "a sweep takes longer");
    let asked = Instant::now();
    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    child.wait().unwrap();
    println!("sweeping: {:?}", asked.elapsed());
    if asked.elapsed() > PROMISED {
        slow.push(("sweeping", asked.elapsed()));
    }
    assert!(slow.is_empty(), "{slow:?}");
}
