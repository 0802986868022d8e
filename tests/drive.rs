//! `ferry drive`: Ferry mirrors a robot and leads it, over the wire. The robot is the controller of another Ferry; between
//! the two lies a cable that can be damaged.

mod arms;
mod cable;
mod handing_over;

use std::cell::Cell;
use std::collections::VecDeque;
use std::ffi::OsStr;
use std::ops::{Deref, DerefMut};
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use futures_util::StreamExt;
use serde_json::{Value, json};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio_tungstenite::tungstenite::Message;

use self::cable::{Cable, Fault};
use crate::support::{Browser, Ferry, ferry, files};

/// Where the virtual robot rests at first.
const REST: [f64; 2] = [-0.1, -0.35];
const TICK_S: f64 = 0.008;
/// How often the page says that the button is held.
const HOLD_EVERY: Duration = Duration::from_millis(50);

/// A Ferry that answers as a robot, and its page.
async fn robot(address: &str, map: &str, start_m: [f64; 2], data: &Path) -> (Ferry, Browser) {
    robot_of(address, map, start_m, data, &[]).await
}

async fn robot_of(address: &str, map: &str, start_m: [f64; 2], data: &Path, more: &[&OsStr]) -> (Ferry, Browser) {
    let mut command = ferry(&["serve", "--bind", "127.0.0.1:0", "--robot-server", address, "--data"]);
    let server = Ferry::start(command.arg(data).args(more).stderr(Stdio::null()));
    let mut browser = Browser::at(server.address).await;
    browser.send(json!({"type": "load_scenario", "map": map, "start_m": start_m})).await;
    browser.state("the start", |state| (number(&state["tool_m"][0]) - start_m[0]).abs() < 1e-3).await;
    (server, browser)
}

/// A page with the button that lets the robot follow.
struct Page {
    browser: Browser,
    /// Number of the press.
    press: u32,
}

impl Deref for Page {
    type Target = Browser;

    fn deref(&self) -> &Browser {
        &self.browser
    }
}

impl DerefMut for Page {
    fn deref_mut(&mut self) -> &mut Browser {
        &mut self.browser
    }
}

/// A Ferry that mirrors a robot, and its page.
async fn driver(address: &str, more: &[&str], data: &Path) -> (Ferry, Page) {
    let mut command = ferry(&["drive", "--robot", address, "--bind", "127.0.0.1:0", "--data"]);
    let server = Ferry::start(command.arg(data).args(more).stderr(Stdio::null()));
    let page = Page { browser: Browser::at(server.address).await, press: 1 };
    (server, page)
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn joints(state: &Value) -> [f64; 6] {
    std::array::from_fn(|i| number(&state["joints_rad"][i]))
}

fn apart(one: &[f64; 6], other: &[f64; 6]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn text(message: &Value) -> &str {
    message["what"]["text"].as_str().unwrap_or_default()
}

/// The newest state: what has come before is read first.
async fn present(browser: &mut Browser) -> Value {
    let mut newest = browser.state("the present", |_| true).await;
    while let Ok(message) = tokio::time::timeout(Duration::from_millis(5), browser.socket.next()).await {
        let Some(Ok(Message::Text(text))) = message else { continue };
        let value: Value = serde_json::from_str(&text).unwrap();
        if value["type"] == "state" {
            newest = value;
        }
    }
    newest
}

/// Holds the button until a message fits.
async fn hold_until(page: &mut Page, what: &str, within: Duration, fits: impl Fn(&Value) -> bool) -> Value {
    let Page { browser, press } = page;
    let mut beat = tokio::time::interval(HOLD_EVERY);
    let mut newest = Value::Null;
    let waiting = async {
        loop {
            tokio::select! {
                _ = beat.tick() => browser.send(json!({"type": "drive_robot", "press": press})).await,
                message = browser.socket.next() => {
                    let message = message.unwrap_or_else(|| panic!("closed before: {what}")).unwrap();
                    let Message::Text(text) = message else { continue };
                    let value: Value = serde_json::from_str(&text).unwrap();
                    if fits(&value) {
                        return value;
                    }
                    if value["type"] == "state" {
                        newest = value;
                    }
                }
            }
        }
    };
    let waited = tokio::time::timeout(within, waiting).await;
    waited.unwrap_or_else(|_| panic!("waited in vain: {what}; the newest state is {newest}"))
}

/// Whether the robot has begun to follow and has stopped since, also because a busy machine did not hold the button in
/// time; or has not begun, because it stopped before a message told of it.
fn stopping() -> impl Fn(&Value) -> bool {
    let (was_held, since) = (Cell::new(false), Instant::now());
    move |m| {
        let is_held = &m["twin"]["is_held"];
        was_held.set(was_held.get() || *is_held == true);
        *is_held == false && (was_held.get() || since.elapsed() > Duration::from_secs(3))
    }
}

/// Presses the button, again and again, until the robot follows.
async fn press(page: &mut Page) {
    for _ in 0..20 {
        let has_stopped = stopping();
        let tried = hold_until(page, "it follows or not", Duration::from_secs(30), |m| {
            m["twin"]["is_driven"] == true || has_stopped(m) || m["type"] == "error"
        });
        let tried = tried.await;
        if tried["twin"]["is_driven"] == true {
            return;
        }
        eprintln!("it does not follow: {} {}", tried["twin"], tried["message"]);
        release(page).await;
        tokio::time::sleep(Duration::from_millis(300)).await;
    }
    panic!("the robot does not follow");
}

async fn release(page: &mut Page) {
    page.send(json!({"type": "drive_robot"})).await;
    page.press += 1;
    page.state("released", |state| state["twin"]["is_held"] == false).await;
}

/// Sends the bead and its goal to a place; the button has to be pressed again.
async fn task(page: &mut Page, map: &str, seed: usize, start_m: Option<[f64; 2]>, goal_m: [f64; 2]) {
    let mut load = json!({"type": "load_scenario", "map": map, "controller": "errt", "seed": seed, "goal_m": goal_m});
    if let Some(start_m) = start_m {
        load["start_m"] = json!(start_m);
    }
    page.send(load).await;
    page.until("it is loaded", |m| m["type"] == "scene" && m["seed"] == seed && m["map"] == map).await;
    page.send(json!({"type": "run"})).await;
    release(page).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_twin_is_where_the_robot_is_and_does_not_move_it() {
    const ADDRESS: &str = "127.0.28.120";
    const RECORDED: &str = "127.0.28.121";
    let data = tempfile::tempdir().unwrap();
    let (_robot, mut robot) = robot(ADDRESS, "open", REST, &data.path().join("robot")).await;
    let cable = Cable::lay(RECORDED, ADDRESS).await;
    let (server, mut twin) = driver(RECORDED, &[], &data.path().join("twin")).await;
    let rests = robot.state("it rests", |_| true).await;
    let mirrored = twin.state("it mirrors", |state| apart(&joints(state), &joints(&rests)) < 1e-12).await;
    assert_eq!(mirrored["twin"]["trouble"], Value::Null);
    assert_eq!((&mirrored["twin"]["robot_mode"], &mirrored["twin"]["allows_motion"]), (&json!(7), &json!(false)));

    // Ferry's controllers want to go somewhere, but the arm is the robot's.
    task(&mut twin, "open", 5, Some([0.2, -0.45]), [0.0, -0.3]).await;
    twin.send(json!({"type": "drive_robot", "press": 1})).await;
    let refused = twin.error().await;
    assert_eq!(refused["code"], "robot_refused");
    assert!(refused["message"].as_str().unwrap().contains("--enable-motion"), "{refused}");
    let mut line = TcpStream::connect((ADDRESS, 30_003)).await.unwrap();
    line.write_all(b"speedl([0.05,0,0,0,0,0], 0.5, 1)\n").await.unwrap();
    robot.state("it moves", |state| number(&state["tool_m"][0]) > REST[0] + 0.04).await;
    let moved = robot.state("it rests again", |state| state["robot"]["program"].is_null()).await;
    let mirrored = twin.state("it mirrors", |state| apart(&joints(state), &joints(&moved)) < 1e-3).await;
    assert!(number(&mirrored["tool_m"][0]) > REST[0] + 0.04);
    assert_eq!((&mirrored["steps"], &mirrored["deliveries"]), (&json!(0), &json!(0)));
    assert_eq!(robot.state("the present", |_| true).await["robot"]["program"], Value::Null);
    drop(server);

    // The same session again, from its recording: the twin goes through the same joints, and only asks for reports.
    let recorded = cable.recorded();
    cable.take_up().await;
    let (player, nothing) = (recorded.player(RECORDED).await, TcpListener::bind((RECORDED, 30_002)).await.unwrap());
    let (_server, mut twin) = driver(RECORDED, &[], &data.path().join("again")).await;
    let end = *recorded.joints().last().unwrap();
    let mut seen = Vec::new();
    while seen.last().is_none_or(|last| apart(last, &end) > 1e-12) {
        seen.push(joints(&twin.state("the recording goes on", |state| state["twin"]["trouble"].is_null()).await));
    }
    let known = recorded.joints();
    let is_known = |one: &[f64; 6]| known.iter().any(|known| apart(known, one) < 1e-12);
    // Before the first report the arm is Ferry's own.
    let reported: Vec<_> = seen.iter().skip_while(|one| !is_known(one)).collect();
    assert!(reported.iter().all(|one| is_known(one)), "{reported:?}");
    assert!(reported.len() > 30, "{}", reported.len());
    let kinds = player.await.unwrap();
    assert_eq!(kinds, b"VOS", "it asks for version, outputs and start, and writes nothing");
    assert!(tokio::time::timeout(Duration::from_millis(10), nothing.accept()).await.is_err());
}

#[tokio::test(flavor = "multi_thread")]
async fn ferry_delivers_with_a_robot_over_the_wire() {
    const ADDRESS: &str = "127.0.28.122";
    const GOALS: [[f64; 2]; 3] = [[0.12, -0.33], [-0.25, -0.38], [0.0, -0.47]];
    let wanted: usize = std::env::var("FERRY_DELIVERIES").map_or(1, |count| count.parse().unwrap());
    let data = tempfile::tempdir().unwrap();
    let (_robot, mut robot) = robot(ADDRESS, "posts", GOALS[1], &data.path().join("robot")).await;
    // It would be disconnected if it did not read.
    let watching = tokio::spawn(async move { robot.whenever("the end", |_| false).await });
    let (server, mut page) = driver(ADDRESS, &["--enable-motion"], &data.path().join("twin")).await;
    page.state("it is connected", |state| state["twin"]["trouble"].is_null()).await;
    let (mut delivered, mut stops) = (0, 0);
    for seed in 0..wanted {
        task(&mut page, "posts", seed, None, GOALS[seed % GOALS.len()]).await;
        loop {
            // A busy machine may be late, and the robot then stops. The operator presses again.
            let has_stopped = stopping();
            let is_over = |m: &Value| m["deliveries"] == 1 || m["phase"]["code"] == "stopped";
            let end = hold_until(&mut page, "a delivery", Duration::from_secs(300), |m| {
                m["type"] == "state" && (has_stopped(m) || is_over(m)) || m["type"] == "error"
            })
            .await;
            release(&mut page).await;
            if !is_over(&end) {
                eprintln!("seed {seed}: {} {}", end["twin"]["stopped"], end["message"]);
                stops += 1;
                assert!(stops <= 20 * wanted, "the robot stops again and again");
                continue;
            }
            eprintln!(
                "seed {seed}: {} after {:.1} s, {}",
                end["phase"]["text"],
                number(&end["sim_time_s"]),
                end["refusal"]["text"]
            );
            delivered += usize::from(end["deliveries"] == 1);
            break;
        }
    }
    eprintln!("{delivered} of {wanted} delivered, {stops} stops");
    assert_eq!(delivered, wanted);
    watching.abort();
    // The session replays without the robot.
    drop(server);
    let log = files(&data.path().join("twin/recordings"), "ferry").remove(0);
    let replayed = ferry(&["replay"]).arg(log).output().unwrap();
    assert!(replayed.status.success(), "{}", String::from_utf8_lossy(&replayed.stderr));
}

#[tokio::test(flavor = "multi_thread")]
async fn the_robot_stops_when_the_cable_is_damaged() {
    const ADDRESS: &str = "127.0.28.123";
    const CABLE: &str = "127.0.28.124";
    let data = tempfile::tempdir().unwrap();
    let (_robot, mut robot) = robot(ADDRESS, "open", REST, &data.path().join("robot")).await;
    let cable = Cable::lay(CABLE, ADDRESS).await;
    let (_server, mut page) = driver(CABLE, &["--enable-motion"], &data.path().join("twin")).await;
    let tick = |state: &Value| state["tick"].as_u64().unwrap();
    let mut tries = 0;
    let mut faults = VecDeque::from(Fault::ALL);
    while let Some(fault) = faults.pop_front() {
        let (before, at) = loop {
            tries += 1;
            assert!(tries <= 20, "{fault:?}: the robot stops again and again");
            page.state("it is connected", |state| state["twin"]["trouble"].is_null()).await;
            // Back and forth: the bead lies at the other side, and sub-controller 1 flies there.
            let side = if tries % 2 == 0 { 0.22 } else { -0.22 };
            task(&mut page, "open", tries, Some([side, -0.4]), [0.0, -0.3]).await;
            let from = joints(&present(&mut robot).await);
            press(&mut page).await;
            let moves = async {
                robot.whenever("it moves", |m| m["type"] == "state" && apart(&joints(m), &from) > 0.05).await;
                let before = present(&mut robot).await;
                let at = robot.state("it goes on", |state| tick(state) > tick(&before)).await;
                cable.damage(fault);
                if fault == Fault::Doubled {
                    // The same message twice changes nothing.
                    let goes_on = |m: &Value| m["type"] == "state" && tick(m) > tick(&at) + 40;
                    robot.whenever("it goes on", |m| goes_on(m) && m["robot"]["program"] == "ferry_drive").await;
                }
                (before, at)
            };
            let stops = hold_until(&mut page, "it moves or stops", Duration::from_secs(60), |m| {
                m["type"] == "state" && m["twin"]["is_driven"] == false
            });
            tokio::select! {
                moved = moves => break moved,
                // A busy machine may be late.
                stopped = stops => eprintln!("{fault:?}: {}", stopped["twin"]["stopped"]),
            }
            cable.damage(Fault::None);
            release(&mut page).await;
        };
        let speed_rad_s = apart(&joints(&at), &joints(&before)) / (TICK_S * (tick(&at) - tick(&before)) as f64);
        if fault != Fault::Doubled {
            let holds = hold_until(&mut page, "forever", Duration::from_secs(60), |_| false);
            // Until the robot has stood still for a while, with the button held.
            let mut last = at.clone();
            let mut moved_tick = tick(&at);
            let stops = async {
                while tick(&last) < moved_tick + 50 {
                    let state = robot.state("it goes on", |state| tick(state) > tick(&last)).await;
                    if apart(&joints(&state), &joints(&last)) > 1e-7 {
                        moved_tick = tick(&state);
                    }
                    last = state;
                    assert!(moved_tick < tick(&at) + 400, "{fault:?}: it goes on");
                }
            };
            tokio::select! { () = stops => {}, _ = holds => unreachable!() };
            let moved_s = TICK_S * (moved_tick - tick(&at)) as f64;
            let allowed_s = 0.1 + speed_rad_s / 4.0;
            eprintln!("{fault:?}: {speed_rad_s:.2} rad/s, at rest after {moved_s:.3} s, allowed {allowed_s:.3} s");
            // What is on its way, and the age of a state.
            assert!(moved_s <= allowed_s + 5.0 * TICK_S, "{fault:?}: {moved_s:.3} s, allowed {allowed_s:.3} s");
            let stopped = page.state("it says so", |state| state["twin"]["is_driven"] == false).await;
            if stopped["twin"]["stopped"].is_null() {
                eprintln!("{fault:?}: a busy machine did not hold the button in time");
                faults.push_front(fault);
            }
        }
        // With the cable whole again nothing moves by itself.
        cable.damage(Fault::None);
        release(&mut page).await;
        present(&mut robot).await;
        let rests = robot.state("without a program", |state| state["robot"]["program"].is_null()).await;
        page.state("it is connected", |state| state["twin"]["trouble"].is_null()).await;
        let later = robot.state("later", |state| tick(state) > tick(&rests) + 60).await;
        let (rests, later) = (joints(&rests), joints(&later));
        assert!(fault == Fault::Doubled || apart(&rests, &later) < 1e-6, "{fault:?}");
    }
    let told = page.until("the journal", |m| m["type"] == "state" && m["twin"].is_object()).await;
    assert_eq!(told["twin"]["trouble"], Value::Null);
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_not_a_robot_is_said_and_moves_nothing() {
    const ADDRESS: &str = "127.0.28.125";
    let data = tempfile::tempdir().unwrap();
    let listener = TcpListener::bind((ADDRESS, 30_004)).await.unwrap();
    let (_server, mut page) = driver(ADDRESS, &["--enable-motion"], data.path()).await;
    let answers: [(&[u8], &str); 4] = [
        (b"HTTP/1.1 400 Bad Request\r\n\r\n", "the connection is broken"),
        (&[0, 4, b'V', 0], "version 2"),
        (
            &[
                0, 4, b'V', 1, 0, 22, b'O', 0, b'N', b'O', b'T', b'_', b'F', b'O', b'U', b'N', b'D', b',', b'V', b'E',
                b'C', b'T', b'O', b'R', b'6', b'D',
            ],
            "timestamp",
        ),
        (&[], "the connection"),
    ];
    for (answer, why) in answers {
        let (mut socket, _) = listener.accept().await.unwrap();
        socket.write_all(answer).await.unwrap();
        let mut asked = [0; 5];
        socket.read_exact(&mut asked).await.unwrap();
        assert_eq!(asked, [0, 5, b'V', 0, 2]);
        drop(socket);
        let told =
            page.until(why, |m| m["twin"]["trouble"]["text"].as_str().is_some_and(|told| told.contains(why))).await;
        assert_eq!(told["running"], false);
    }
    page.send(json!({"type": "drive_robot", "press": 1})).await;
    let refused = page.error().await;
    assert!(refused["message"].as_str().unwrap().contains("not connected"), "{refused}");
    let told = page.until("an event", |m| m["type"] == "event" && text(m).starts_with("robot: ")).await;
    assert_eq!(told["kind"], "refused");

    let both = ferry(&["drive", "--robot", ADDRESS, "--robot-server"]).output().unwrap();
    assert!(!both.status.success() && String::from_utf8_lossy(&both.stderr).contains("--robot-server"));
}
