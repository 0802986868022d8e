//! SIGTERM: sessions end, recordings are written and browsers are informed soon.

mod states;

use std::io::Write;
use std::net::TcpStream;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use ferry::http::Token;
use ferry_core::trial::InputLog;
use futures_util::StreamExt;
use rustix::process::{Pid, Signal, kill_process};
use serde_json::json;
use tokio_tungstenite::connect_async;
use tokio_tungstenite::tungstenite::Message;

use crate::support::{Browser, Ferry, exchange, ferry, files, tool};

/// Less than two seconds on an idle machine.
const WITHIN: Duration = Duration::from_secs(10);

fn serve(data: &Path, change: impl FnOnce(&mut Command)) -> Ferry {
    served(data, &["serve"], change)
}

fn served(data: &Path, how: &[&str], change: impl FnOnce(&mut Command)) -> Ferry {
    let mut command = ferry(how);
    command.args(["--bind", "127.0.0.1:0", "--data"]).arg(data);
    // A pipe that is not read would fill up.
    command.stderr(std::fs::File::create(data.join("log")).unwrap());
    change(&mut command);
    Ferry::start(&mut command)
}

/// Time until the server ended, and its log.
fn terminate(mut ferry: Ferry, data: &Path) -> (Duration, String) {
    let asked = Instant::now();
    kill_process(Pid::from_child(&ferry.child), Signal::TERM).unwrap();
    let status = ferry.child.wait().unwrap();
    let took = asked.elapsed();
    let log = std::fs::read_to_string(data.join("log")).unwrap();
    assert!(status.success(), "{status}\n{log}");
    (took, log)
}

#[tokio::test(flavor = "multi_thread")]
async fn whatever_goes_on_it_ends_soon_and_files_are_whole() {
    let data = tempfile::tempdir().unwrap();
    let child = serve(data.path(), |_| ());
    let address = child.address;
    let mut browsers = Vec::new();
    for name in ["anna", "bert", "main"] {
        let page = format!("GET /s/{name} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
        tokio::task::spawn_blocking(move || exchange(address, page.as_bytes())).await.unwrap();
        let (socket, _) = connect_async(format!("ws://{address}/api/sessions/{name}/live")).await.unwrap();
        let mut browser = Browser::of(socket);
        browser
            .send(json!({"type": "load_scenario", "map": "posts", "goal_m": [0.12, -0.33], "start_m": [-0.25, -0.38]}))
            .await;
        browser.send(json!({"type": "set_speed", "factor": 64})).await;
        browser.send(json!({"type": "run"})).await;
        browser.state("running", |m| m["tick"].as_u64() > Some(100)).await;
        browsers.push(browser);
    }
    // Steps that take minutes and cannot be interrupted otherwise.
    for _ in 0..50 {
        browsers[0].send(json!({"type": "step", "ticks": 12_500})).await;
    }
    // A client that does not read, one that sends nothing, one that never ends its request, and an evaluation.
    let (_stalled, _) = connect_async(format!("ws://{address}/api/sessions/main/live")).await.unwrap();
    let _silent = TcpStream::connect(address).unwrap();
    let mut endless = TcpStream::connect(address).unwrap();
    write!(endless, "POST /api/maps HTTP/1.1\r\nHost: {address}\r\nContent-Length: 100000\r\n\r\nx").unwrap();
    let body =
        json!({"maps": ["colon"], "controllers": ["rl"], "episodes": 500, "disturbances": [0], "seed": 1}).to_string();
    let evaluation = format!(
        "POST /api/evaluations HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}",
        body.len()
    );
    let (status, answer) = tokio::task::spawn_blocking(move || exchange(address, evaluation.as_bytes())).await.unwrap();
    assert_eq!(status, 201, "{answer}");
    let mut closing = browsers.pop().unwrap().socket;
    let closed = tokio::spawn(async move {
        while let Some(message) = closing.next().await {
            if let Ok(Message::Close(frame)) = message {
                return frame.map(|frame| u16::from(frame.code));
            }
        }
        None
    });
    tokio::time::sleep(Duration::from_millis(500)).await;

    let folder = data.path().to_owned();
    let (took, log) = tokio::task::spawn_blocking(move || terminate(child, &folder)).await.unwrap();
    assert!(took < WITHIN, "it took {took:?}\n{log}");
    assert!(!log.contains("ERROR"), "{log}");
    assert_eq!(closed.await.unwrap(), Some(1001));
    let recordings = data.path().join("recordings");
    let parts = files(&recordings, "rrd");
    assert_eq!(parts.len(), 3);
    for part in &parts {
        let verified = Command::new(tool("rerun")).args(["rrd", "verify"]).arg(part).output().unwrap();
        assert!(verified.status.success(), "{}", String::from_utf8_lossy(&verified.stderr));
    }
    for log in files(&recordings, "ferry") {
        assert!(InputLog::read(&std::fs::read(log).unwrap()).unwrap().entries.len() > 100);
    }
}

/// A browser that does not read and an evaluation, both with the graphics device in hand.
async fn stop_while_it_works() {
    let data = tempfile::tempdir().unwrap();
    let child = serve(data.path(), |_| ());
    let address = child.address;
    let mut browser = Browser::at(address).await;
    browser.send(json!({"type": "set_speed", "factor": 64})).await;
    browser.send(json!({"type": "run"})).await;
    browser.state("running", |m| m["tick"].as_u64() > Some(50)).await;
    let (stalled, _) = connect_async(format!("ws://{address}/api/sessions/main/live")).await.unwrap();
    let ended = tokio::task::spawn_blocking(move || {
        let body = json!({"maps": ["colon"], "controllers": ["rl"], "episodes": 500, "disturbances": [0], "seed": 1});
        let body = body.to_string();
        let length = body.len();
        let head = format!("POST /api/evaluations HTTP/1.1\r\nHost: {address}\r\nContent-Length: {length}\r\n\r\n");
        assert_eq!(exchange(address, (head + &body).as_bytes()).0, 201);
        std::thread::sleep(Duration::from_millis(500));
        terminate(child, data.path());
    });
    ended.await.unwrap();
    drop((browser, stalled));
}

/// The process once ended by a signal in one of ten cases: its device was closed while the process ended.
#[tokio::test(flavor = "multi_thread")]
#[ignore = "long"]
async fn forty_servers_that_stop_while_they_work_end_well() {
    for _ in 0..10 {
        tokio::join!(stop_while_it_works(), stop_while_it_works(), stop_while_it_works(), stop_while_it_works());
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn the_token_is_in_no_log_and_in_no_file() {
    let data = tempfile::tempdir().unwrap();
    let token = Token::generate().unwrap();
    let child = serve(data.path(), |command| {
        command.env("FERRY_TOKEN", &token).env("FERRY_LOG", "trace").env("FERRY_LOG_FORMAT", "json");
    });
    let address = child.address;
    let asked = {
        let token = token.clone();
        tokio::task::spawn_blocking(move || {
            let body = json!({ "token": token }).to_string();
            let login = format!(
                "POST /login HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nConnection: close\r\n\
                 Content-Length: {}\r\n\r\n{body}",
                body.len()
            );
            let (status, answer) = exchange(address, login.as_bytes());
            assert_eq!(status, 204, "{answer}");
            let bearer = format!("Authorization: Bearer {token}\r\n");
            for path in ["/api/sessions", "/metrics", "/", "/s/anna", "/api/sessions/main/case.json"] {
                let request = format!("GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{bearer}\r\n");
                let (_, answer) = exchange(address, request.as_bytes());
                assert!(!answer.contains(&token), "{answer}");
                assert!(answer.to_lowercase().contains("referrer-policy: no-referrer"), "{answer}");
            }
        })
    };
    asked.await.unwrap();
    let folder = data.path().to_owned();
    let (_, log) = tokio::task::spawn_blocking(move || terminate(child, &folder)).await.unwrap();
    assert!(log.contains("\"message\":\"login\""), "{log}");
    assert_eq!(log.lines().find(|line| !line.starts_with('{')), None, "each line is one object");
    assert!(!log.contains(&token), "the token is in the log");
    let mut folders = vec![data.path().to_owned()];
    let mut looked_at = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                looked_at += 1;
                let bytes = std::fs::read(&path).unwrap();
                assert!(!bytes.windows(token.len()).any(|window| window == token.as_bytes()), "{path:?}");
            }
        }
    }
    assert!(looked_at >= 5, "{looked_at} files");
}

#[test]
fn settings_that_do_not_go_together_are_refused_before_anything_begins() {
    let data = tempfile::tempdir().unwrap();
    let file = data.path().join("token");
    std::fs::write(&file, "too short").unwrap();
    let taken = data.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    let token = Token::generate().unwrap();
    for (arguments, variables, parts) in [
        (vec!["--bind", "0.0.0.0:0"], vec![], &["--bind 0.0.0.0", "token"][..]),
        (vec!["--bind", "0.0.0.0:0"], vec![("FERRY_TOKEN", token.as_str())], &["--origin"]),
        (vec!["--origin", "https://lab.example.org"], vec![], &["--origin https://lab.example.org", "token"]),
        (vec!["--origin", "lab.example.org"], vec![], &["--origin", "a scheme and a host"]),
        (
            vec!["--token-file", file.to_str().unwrap()],
            vec![],
            &["--token-file", "64 hexadecimal digits", "9 characters"],
        ),
        (vec!["--token-file", "/nowhere/token"], vec![], &["--token-file /nowhere/token"]),
        (vec![], vec![("FERRY_TOKEN", "secret-slip")], &["64 hexadecimal digits"]),
        (vec!["--data", taken.to_str().unwrap()], vec![], &["--data", "cannot be written"]),
        (vec!["--sessions", "0"], vec![], &["--sessions", "1..=256"]),
        (vec!["--park-after", "0"], vec![], &["--park-after"]),
        (vec![], vec![("FERRY_LOG_FORMAT", "xml")], &["FERRY_LOG_FORMAT", "\"xml\""]),
        (vec![], vec![("FERRY_ADAPTER", "abacus")], &["abacus", "vulkan"]),
    ] {
        let mut command = ferry(&[]);
        command.args(["serve", "--bind", "127.0.0.1:0"]);
        if !arguments.contains(&"--data") {
            command.arg("--data").arg(data.path().join("data"));
        }
        // The later of two options counts.
        if arguments.contains(&"--bind") {
            command = ferry(&[]);
            command.args(["serve", "--data"]).arg(data.path().join("data"));
        }
        let output = command.args(&arguments).envs(variables).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && output.stdout.is_empty(), "{arguments:?}: {said}");
        for part in parts {
            assert!(said.contains(part), "{arguments:?}: no {part:?} in {said}");
        }
        assert!(!said.contains("secret-slip") && !said.contains(&token), "{said}");
    }
}
