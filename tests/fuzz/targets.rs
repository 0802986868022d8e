//! What reads bytes that others wrote: each target takes any bytes, and the answer is a value or an error.

use std::collections::HashMap;
use std::net::IpAddr;
use std::sync::{Arc, LazyLock, Mutex};
use std::time::{Duration, Instant};

use ferry::protocol::ClientMessage;

use ferry_core::control::limits::Limits;
use ferry_core::geometry::{Point3, Rect};
use ferry_core::image::{CameraError, CameraFrame, ImageSource, Picture, Subject};
use ferry_core::map::{FreeSpace, Map};
use ferry_core::plant::{Positioner, PositionerKind, ToolOrientation};
use ferry_core::policy::Policy;
use ferry_core::robot::Joints;
use ferry_core::scenario::{ControllerName, Scenario};
use ferry_core::trial::{Arena, Case, Entry, InputLog, LoggedBeginning, Source, Trial, replay};
use ferry_ur::controller::{Controller, LoadError};
use ferry_ur::peer::{Peer, PeerError, Report};
use ferry_ur::{Arm, Twin, dashboard, rtde, script};
use tokio_util::codec::{Decoder, Encoder};

use super::drawing;

/// Ticks that what was read is run on for: the first has a control step.
const TICKS: usize = 34;

/// A loader under test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Text frames of the WebSocket.
    Message,
    /// Drawings.
    Map,
    /// Small drawings that bytes choose: Ferry's walls are where usvg draws.
    Drawing,
    /// Cases, the scenarios in them, and links.
    Case,
    /// Input logs as they lie on disk.
    Log,
    /// The content of a log's frames, with correct hashes.
    Entries,
    /// Policies.
    Policy,
    /// What a client sends to the robot server's RTDE port.
    Rtde,
    /// What a robot sends to `ferry drive`; the first byte says whether Ferry may move it.
    Reports,
    /// Programs for the robot.
    Script,
    /// Lines for the robot's dashboard.
    Dashboard,
}

impl Target {
    pub const ALL: [Self; 11] = [
        Self::Message,
        Self::Map,
        Self::Drawing,
        Self::Case,
        Self::Log,
        Self::Entries,
        Self::Policy,
        Self::Rtde,
        Self::Reports,
        Self::Script,
        Self::Dashboard,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Message => "message",
            Self::Map => "map",
            Self::Drawing => "drawing",
            Self::Case => "case",
            Self::Log => "log",
            Self::Entries => "entries",
            Self::Policy => "policy",
            Self::Rtde => "rtde",
            Self::Reports => "reports",
            Self::Script => "script",
            Self::Dashboard => "dashboard",
        }
    }

    /// Parses the bytes and uses the result. Returns whether they were accepted.
    pub fn reads(self, bytes: &[u8]) -> bool {
        match self {
            Self::Message => std::str::from_utf8(bytes).is_ok_and(message),
            Self::Map => std::str::from_utf8(bytes).is_ok_and(map),
            Self::Drawing => drawing::agrees(bytes),
            Self::Case => case(bytes),
            Self::Log => InputLog::read(bytes).is_ok_and(|log| run(&log)),
            Self::Entries => InputLog::read(&framed(bytes)).is_ok_and(|log| run(&log)),
            Self::Policy => policy(bytes),
            Self::Rtde => rtde(bytes).is_some(),
            Self::Reports => reports(bytes).is_some(),
            Self::Script => std::str::from_utf8(bytes).is_ok_and(script),
            Self::Dashboard => std::str::from_utf8(bytes).is_ok_and(lines),
        }
    }
}

fn message(text: &str) -> bool {
    let Ok(message) = ClientMessage::parse(text) else { return false };
    assert_eq!(ClientMessage::parse(&written(&message)).as_ref(), Ok(&message));
    message.command();
    true
}

/// A message as the page writes it: the tag beside the fields.
pub fn written(message: &ClientMessage) -> String {
    let serde_json::Value::Object(tagged) = serde_json::to_value(message).unwrap() else { panic!("{message:?}") };
    let (kind, mut fields) = tagged.into_iter().next().unwrap();
    fields.as_object_mut().unwrap().insert("type".to_owned(), kind.into());
    fields.to_string()
}

fn map(text: &str) -> bool {
    let Ok(map) = Map::from_svg("fuzz", text) else { return false };
    FreeSpace::new(&map, 0.012);
    for ring in map.walls().iter().chain(map.free()).flat_map(|polygon| polygon.rings()) {
        assert!(ring.len() >= 3 && ring.iter().flatten().all(|c| c.is_finite()));
    }
    true
}

fn case(bytes: &[u8]) -> bool {
    let Ok(case) = Case::from_json(bytes) else { return false };
    let again = serde_json::to_vec(&case).unwrap();
    assert_eq!(Case::from_json(&again).as_ref(), Ok(&case));
    if let Some(link) = case.scenario.link() {
        assert!(link.starts_with("#v=1&map="), "{link}");
    }
    let Some(arena) = shipped(&case.scenario.map) else { return true };
    let mut ticks = 0;
    let _ = case.run(&arena, &mut Spots, &mut |_| {
        ticks += 1;
        if ticks < TICKS { std::ops::ControlFlow::Continue(()) } else { std::ops::ControlFlow::Break(()) }
    });
    true
}

/// Replays, and runs each trial on even where it is not as it was.
fn run(log: &InputLog) -> bool {
    let _ = replay(log, None, &mut |_| {});
    let mut arena = None;
    let mut running: Option<Trial> = None;
    for entry in log.entries.iter().take(TICKS) {
        match entry {
            Entry::Begin(beginning) => {
                if let Some(map) = &beginning.map {
                    arena = map.arena().ok();
                }
                running = arena.as_ref().and_then(|arena| begin(beginning, arena));
                // Also decide from the camera's images.
                if let Some(mut trial) = running.clone() {
                    let _ = (0..TICKS).try_for_each(|_| trial.tick(Source::Camera(&mut Spots)).map(|_| ()));
                }
            }
            Entry::Tick(logged) => {
                let Some(trial) = &mut running else { continue };
                for input in &logged.inputs {
                    let _ = trial.apply(input.clone());
                }
                let _ = trial.tick(Source::Logged(logged.decision.clone()));
            }
        }
    }
    true
}

fn begin(beginning: &LoggedBeginning, arena: &Arc<Arena>) -> Option<Trial> {
    let mut trial = Trial::new(beginning.scenario.clone(), arena.clone()).ok()?;
    if let Some(state) = &beginning.state {
        trial.resume(state.as_ref().clone()).ok()?;
    }
    Some(trial)
}

/// A log whose only frame holds these bytes.
pub fn framed(payload: &[u8]) -> Vec<u8> {
    use std::io::Write;
    use xxhash_rust::xxh3::xxh3_64_with_seed;
    let mut packed = flate2::write::DeflateEncoder::new(Vec::new(), flate2::Compression::none());
    packed.write_all(payload).unwrap();
    let packed = packed.finish().unwrap();
    let (version, length) = (InputLog::VERSION, (packed.len() as u32).to_le_bytes());
    let check = (xxh3_64_with_seed(&length, u64::from(version)) as u32).to_le_bytes();
    let hash = xxh3_64_with_seed(&packed, u64::from(version)).to_le_bytes();
    let end = (12 + 8 + packed.len() as u64 + 8 + 16).to_le_bytes();
    let seal = xxh3_64_with_seed(&end, u64::from_le_bytes(*b"ferrylog")).to_le_bytes();
    [b"ferrylog", &version.to_le_bytes()[..], &length, &check, &packed, &hash, &end, &seal].concat()
}

/// The bytes are a file's beginning; its weights all have the same four bytes, the last of the input.
fn policy(bytes: &[u8]) -> bool {
    let filled = weights(bytes);
    let Ok(policy) = Policy::from_bytes(bytes).or_else(|_| Policy::from_bytes(&filled)) else { return false };
    let arena = shipped("open").expect("a shipped map").with_policy(policy);
    let scenario = Scenario {
        controller: ControllerName::Rl,
        start_m: Some(ferry_core::geometry::Point2::new(-0.1, -0.35)),
        goal_m: Some(ferry_core::geometry::Point2::new(0.1, -0.35)),
        ..Scenario::idle("open", 1)
    };
    let mut trial = Trial::new(scenario, arena).unwrap();
    trial.tick(Source::Camera(&mut Spots)).unwrap();
    true
}

/// A file of the length in its header, at most the length of a policy.
fn weights(bytes: &[u8]) -> Vec<u8> {
    const LONGEST: usize = 2 << 20;
    let (Some(length), Some(&last)) = (bytes.first_chunk(), bytes.last_chunk::<4>()) else { return bytes.to_vec() };
    let header = (u64::from_le_bytes(*length) as usize).min(bytes.len() - 8);
    let text = &bytes[8..8 + header];
    let ends = serde_json::from_slice::<HashMap<String, serde_json::Value>>(text).unwrap_or_default();
    let ends = ends.values().filter_map(|tensor| tensor["data_offsets"][1].as_u64());
    let mut file = bytes[..8 + header].to_vec();
    let end = file.len() + (ends.max().unwrap_or(0) as usize).min(LONGEST);
    file.extend(last.iter().cycle().take(end - file.len()));
    file
}

/// `None` where the connection would be closed.
fn rtde(mut stream: &[u8]) -> Option<()> {
    let mut robot = Simulated::default();
    robot.load(CONTROL_SCRIPT).expect("it is recognised");
    let (mut client, mut framing) = (rtde::Client::default(), rtde::framing());
    let mut received = bytes::BytesMut::new();
    let mut sent = bytes::BytesMut::new();
    while !stream.is_empty() {
        // In pieces, as from a socket.
        let (piece, rest) = stream.split_at(stream.len().min(7));
        (stream, received) = (rest, [&received[..], piece].concat()[..].into());
        while let Some(frame) = framing.decode(&mut received).ok()? {
            if let Some(answer) = client.answer(&frame, &mut robot.controller).ok()? {
                framing.encode(bytes::Bytes::from(answer), &mut sent).expect("an answer fits into a frame");
            }
            if let Some(data) = client.data(&Arm::default(), &robot.controller) {
                framing.encode(bytes::Bytes::from(data), &mut sent).expect("data fit into a frame");
            }
            robot.runs(3);
        }
    }
    Some(())
}

/// `None` where Ferry gives up the connection, or before the robot has reported.
fn reports(bytes: &[u8]) -> Option<Report> {
    let (&first, stream) = bytes.split_first()?;
    let mut peer = Peer::new(first & 1 == 1);
    let mut framing = rtde::framing();
    let mut received = bytes::BytesMut::from(stream);
    let twin = Twin::new(IpAddr::from([127, 0, 0, 1]), first & 1 == 1);
    for &step in peer.steps() {
        while !peer.accept(step, &framing.decode(&mut received).ok()??).map_err(is_brief).ok()? {}
    }
    twin.connected(Ok(()));
    let (mut last, mut now) = (None, Instant::now());
    while let Some(frame) = framing.decode(&mut received).ok()? {
        now += Duration::from_millis(8);
        let Some(report) = peer.report(&frame).map_err(is_brief).ok()? else { continue };
        assert!(report.joints_rad.iter().all(|angle_rad| angle_rad.abs() < 6.4), "{report:?}");
        twin.hear(report, now);
        let _ = twin.hold(Some(1), now);
        assert_eq!(twin.answers().borrow().period, 0, "no session has checked where the arm is");
        last = Some(report);
    }
    last
}

/// The page shows it.
fn is_brief(error: PeerError) {
    assert!(error.to_string().len() < 200, "{error}");
}

fn script(text: &str) -> bool {
    let mut robot = Simulated::default();
    let mut reader = script::Reader::default();
    let mut all = true;
    for line in text.lines() {
        let Ok(program) = reader.take(line) else { return false };
        let Some(program) = program else { continue };
        robot.controller.unlock();
        let is_loaded = robot.load(&program).is_ok();
        let before = robot.joints_rad;
        robot.runs(TICKS);
        let may_move = is_loaded || robot.begun;
        assert!(may_move || before == robot.joints_rad, "no motion from what was refused");
        robot.begun |= is_loaded;
        all &= is_loaded;
    }
    all
}

fn lines(text: &str) -> bool {
    let mut robot = Simulated::default();
    robot.load("speedl([0.03,0,0,0,0,0], 0.5, 0.1)").expect("it is understood");
    for line in text.lines() {
        let answer = dashboard::answer(line, &Arm::default(), &mut robot.controller);
        assert!(!answer.is_empty() && answer.len() < line.len() + 100);
        robot.runs(3);
        if dashboard::ends(line) {
            break;
        }
    }
    true
}

/// What `ur_rtde`'s program has that it is recognised by.
const CONTROL_SCRIPT: &str = "def rtde_control():\n  global reg_offset_int = # int register offset\n0\n  textmsg(\"RTDE Control Script\")\nend\n";

/// A robot whose joints follow its controller within the limits.
#[derive(Default)]
struct Simulated {
    controller: Controller,
    joints_rad: Joints,
    tick: u64,
    begun: bool,
}

impl Simulated {
    fn load(&mut self, text: &str) -> Result<(), LoadError> {
        if self.tick == 0 {
            let place_m = Point3::new(0.0, -0.35, 0.1);
            let home = Positioner::home(PositionerKind::Arm, place_m);
            let there = Positioner::at(place_m, ToolOrientation::Vertical, &home).unwrap();
            self.joints_rad = there.joints_rad().unwrap();
        }
        self.controller.load(text, true)
    }

    fn runs(&mut self, ticks: usize) {
        let workspace = Rect { x_min_m: -0.3, x_max_m: 0.3, y_min_m: -0.7, y_max_m: -0.15 };
        let limits =
            Limits { workspace, speed_m_s: 0.04, flight_speed_m_s: 0.25, tool_orientation: ToolOrientation::Vertical };
        for _ in 0..ticks {
            self.tick += 1;
            let here_rad = self.joints_rad;
            let Some(next_rad) = self.controller.next(self.tick, true, Some(&here_rad), &limits) else { continue };
            if let Err(error) = limits.joints(&here_rad, &next_rad) {
                self.controller.violate(&error.to_string());
                assert!(self.controller.is_stopped());
                let after = self.controller.next(self.tick, true, Some(&here_rad), &limits);
                assert_eq!(after, None, "the arm stands still");
                continue;
            }
            let place_m = Positioner::Arm(next_rad).tool_m();
            assert!(workspace.contains(place_m.xy()) && place_m.z >= 0.09, "{place_m}");
            self.joints_rad = next_rad;
        }
        assert!(self.controller.standing().refused.len() <= 20);
        self.controller.take_news();
    }
}

fn shipped(name: &str) -> Option<Arc<Arena>> {
    static ARENAS: LazyLock<Mutex<HashMap<String, Arc<Arena>>>> = LazyLock::new(Mutex::default);
    let mut arenas = ARENAS.lock().unwrap();
    if let Some(arena) = arenas.get(name) {
        return Some(arena.clone());
    }
    let arena = Map::shipped(name).ok().map(Arena::of)?;
    arenas.insert(name.to_owned(), arena.clone());
    Some(arena)
}

/// Sees dark spots wherever it looks: no graphics adapter is needed.
pub struct Spots;

impl ImageSource for Spots {
    fn capture(&mut self, subject: &Subject) -> Result<CameraFrame, CameraError> {
        const SIDE_PX: u32 = 480;
        static PICTURE: LazyLock<Picture> = LazyLock::new(|| {
            let is_dark = |x: u32, y: u32| (x / 40 * 7 + y / 40 * 3).is_multiple_of(11);
            let gray = |i: u32| if is_dark(i % SIDE_PX, i / SIDE_PX) { 20 } else { 230 };
            let rgba = (0..SIDE_PX * SIDE_PX).flat_map(|i| [gray(i), gray(i), gray(i), 255]).collect();
            Picture { width_px: SIDE_PX, height_px: SIDE_PX, rgba }
        });
        let pinhole = subject.mount.over(ferry_core::geometry::Point2::new(subject.tool_m[0], subject.tool_m[1]), 0.0);
        Ok(CameraFrame { picture: PICTURE.clone(), tick: subject.tick, pinhole })
    }
}
