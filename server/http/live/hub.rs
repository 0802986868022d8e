//! One session and its browsers. Each message is encoded once, and one browser is the operator.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use jiff::Timestamp;
use tokio::sync::{Semaphore, watch};
use tokio::time::Instant;

use super::comparison;
use super::course::{self, Part};
use super::frames::{BINARY_HEAD, binary, json};
use super::seats::Seats;
use crate::protocol::{
    BINARY_CAMERA_JPEG, BINARY_OBSERVATION, Hello, OverlayMessage, PROTOCOL_VERSION, Role, SceneMessage, SeenMessage,
    ServerMessage, StateMessage,
};
use crate::session::{CommandError, SessionHandle, View};
use ferry_camera::Gpu;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::ControllerName;
use ferry_core::session::Recalled;

/// Camera frames are sent at most thirty times a second.
const CAMERA_EVERY: Duration = Duration::from_millis(33);
const JPEG_QUALITY: u8 = 85;

/// The newest messages, ready to send. Parts that did not change are shared with the last one.
#[derive(Clone)]
pub struct Encoded {
    /// Number of the view.
    pub view: u64,
    pub state: Utf8Bytes,
    pub scene: Utf8Bytes,
    /// Incremented when `scene` changes.
    pub scene_version: u64,
    /// Incremented when the events of the trial have to be sent again.
    pub past_version: u64,
    pub overlay: Utf8Bytes,
    pub seen: Utf8Bytes,
    /// Incremented when `seen` changes.
    pub seen_version: u64,
    pub camera: Bytes,
    camera_tick: u64,
    pub observation: Bytes,
    /// Incremented when overlay, camera or observation change.
    pub sight_version: u64,
    /// The part of the course that this state adds to the state before.
    pub course: Part,
}

impl Encoded {
    /// The camera's image as a JPEG file, and the tick at which it was taken; `None` if none could be encoded.
    pub fn camera_jpeg(&self) -> Option<(u64, Bytes)> {
        (!self.camera.is_empty()).then(|| (self.camera_tick, self.camera.slice(BINARY_HEAD..)))
    }
}

/// A session with its browsers.
pub struct Hub {
    pub id: String,
    pub session: SessionHandle,
    opened: Timestamp,
    gpu: Arc<Gpu>,
    encoded: watch::Receiver<Encoded>,
    seats: watch::Sender<Seats>,
    /// Number of open camera streams.
    camera_streams: AtomicUsize,
    encoder: Mutex<Option<tokio::task::JoinHandle<()>>>,
    /// Becomes true when the session is deleted; its connections watch it.
    closing: watch::Sender<bool>,
    /// The newest comparison, ready to send; empty before the first.
    comparison: watch::Sender<Utf8Bytes>,
    /// Number of comparisons started; an older one stops when it is no longer the last.
    comparisons: AtomicU64,
    /// Permit of the running comparison.
    comparing: Arc<Semaphore>,
    /// Time of the last disconnect or of the last request without a connection. Shared with the connections and the
    /// parking task.
    watched: Mutex<Instant>,
    /// Paused because it had no viewers for long.
    parked: AtomicBool,
    /// Key of the seat that began the newest attempt at a challenge.
    player: Mutex<Option<String>>,
}

impl Hub {
    /// Starts encoding a session's views.
    pub fn start(id: &str, session: SessionHandle, gpu: Arc<Gpu>) -> Arc<Self> {
        let now = Instant::now();
        let views = session.watch();
        let mut encoder = Encoder::default();
        let first = encoder.encode(&views.borrow(), true);
        let (publish, encoded) = watch::channel(first);
        let encoder = tokio::spawn(encode_all(encoder, views, publish));
        Arc::new(Self {
            id: id.to_owned(),
            session,
            opened: Timestamp::now(),
            gpu,
            comparison: watch::Sender::new(Utf8Bytes::default()),
            comparisons: AtomicU64::new(0),
            comparing: Arc::new(Semaphore::new(1)),
            encoded,
            seats: watch::Sender::new(Seats::new(now)),
            camera_streams: AtomicUsize::new(0),
            encoder: Mutex::new(Some(encoder)),
            closing: watch::Sender::new(false),
            watched: Mutex::new(now),
            parked: AtomicBool::new(false),
            player: Mutex::default(),
        })
    }

    fn watched(&self) -> MutexGuard<'_, Instant> {
        self.watched.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes a request about the session without a connection.
    pub fn touch(&self) {
        *self.watched() = Instant::now();
        self.parked.store(false, Ordering::Relaxed);
    }

    /// Time without connections and camera streams.
    pub fn unwatched_for(&self) -> Duration {
        let is_watched = self.viewers() > 0 || self.camera_streams.load(Ordering::Relaxed) > 0;
        if is_watched { Duration::ZERO } else { self.watched().elapsed() }
    }

    /// The session is not parked before the value is dropped.
    pub fn watch_camera(self: &Arc<Self>) -> CameraWatch {
        self.camera_streams.fetch_add(1, Ordering::Relaxed);
        self.touch();
        CameraWatch(Arc::downgrade(self))
    }

    /// Whether a fault has ended the session.
    pub fn has_ended(&self) -> bool {
        self.session.watch().borrow().ended.is_some()
    }

    pub fn is_parked(&self) -> bool {
        self.parked.load(Ordering::Relaxed)
    }

    pub fn set_parked(&self) {
        self.parked.store(true, Ordering::Relaxed);
    }

    pub fn viewers(&self) -> usize {
        self.seats.borrow().viewers
    }

    /// Disconnects every browser.
    pub fn close(&self) {
        self.closing.send_replace(true);
    }

    /// Also ends the session, even if other references to it exist. Blocks until its files are closed.
    pub fn shut(&self) {
        self.close();
        self.session.close();
    }

    pub fn closing(&self) -> watch::Receiver<bool> {
        self.closing.subscribe()
    }

    pub fn encoded(&self) -> watch::Receiver<Encoded> {
        self.encoded.clone()
    }

    pub fn comparison(&self) -> watch::Receiver<Utf8Bytes> {
        self.comparison.subscribe()
    }

    /// Starts a comparison, which sends its own messages. No controllers are all.
    pub async fn compare(self: &Arc<Self>, tick: u64, controllers: &[ControllerName]) -> Result<(), CommandError> {
        let point = self.session.recall(tick, Recalled::Present).await?;
        let mut asked = ControllerName::OFFERED.to_vec();
        asked.extend(point.program().map(|_| ControllerName::Program));
        asked.retain(|name| controllers.is_empty() || controllers.contains(name));
        if !point.point.has_goal() {
            return Err(CommandError::NoGoal { tick });
        }
        let number = self.comparisons.fetch_add(1, Ordering::Relaxed) + 1;
        let trial = self.session.watch().borrow().scenery.trial;
        let hub = self.clone();
        tokio::spawn(async move {
            // The previous one stops at its next tick.
            let Ok(place) = hub.comparing.clone().acquire_owned().await else { return };
            let comparing = tokio::task::spawn_blocking(move || {
                let _place = place;
                let is_last = || hub.comparisons.load(Ordering::Relaxed) == number && !*hub.closing.borrow();
                if !is_last() {
                    return;
                }
                comparison::compare(&point, trial, &asked, &hub.gpu, &is_last, &|message| {
                    hub.comparison.send_replace(json(&ServerMessage::Comparison(Box::new(message))));
                });
            });
            // The function catches panics.
            let _ = comparing.await;
        });
        Ok(())
    }

    pub fn seats(&self) -> watch::Receiver<Seats> {
        self.seats.subscribe()
    }

    /// Changes the seats and informs the browsers if the operator, a pending request or the second of its end changes.
    pub fn reseat<T>(&self, change: impl FnOnce(&mut Seats, Instant) -> T) -> T {
        let mut done = None;
        self.seats.send_if_modified(|seats| {
            let now = Instant::now();
            let told = |seats: &Seats| {
                (seats.epoch, seats.asking, seats.answers_within(now).map(|left| left.as_secs_f64().round() as u64))
            };
            let before = told(seats);
            done = Some(change(seats, now));
            before != told(seats)
        });
        self.touch();
        done.expect("the change was made")
    }

    /// Notes who begins an attempt at a challenge.
    pub fn set_player(&self, key: &str) {
        *self.player.lock().unwrap_or_else(PoisonError::into_inner) = Some(key.to_owned());
    }

    /// Whether the newest attempt at a challenge was begun from the seat with this key.
    pub fn is_player(&self, key: &str) -> bool {
        self.player.lock().unwrap_or_else(PoisonError::into_inner).as_deref() == Some(key)
    }

    pub fn hello(&self, connection: u64, key: &str, seats: &Seats, message_bytes: usize) -> Hello {
        let operates = seats.operator == Some(connection);
        Hello {
            protocol: PROTOCOL_VERSION,
            message_bytes: message_bytes as u32,
            session: self.id.clone(),
            seat: key.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            role: if operates { Role::Operator } else { Role::Viewer },
            epoch: seats.epoch,
            operator_present: seats.operator.is_some(),
            asked: operates && seats.asking.is_some(),
            asks: seats.asking == Some(connection),
            answer_within_s: seats.answers_within(Instant::now()).map(|left| left.as_secs_f64()),
            adapter: self.gpu.adapter_name().to_owned(),
            opened: self.opened.to_string(),
            resumed_s: self.session.resumed().tick.map(|tick| tick as f64 * SERVO_PERIOD_S),
        }
    }
}

impl Drop for Hub {
    fn drop(&mut self) {
        if let Some(encoder) = self.encoder.get_mut().ok().and_then(Option::take) {
            encoder.abort();
        }
    }
}

/// An open camera stream. It does not keep its session in memory.
pub struct CameraWatch(Weak<Hub>);

impl Drop for CameraWatch {
    fn drop(&mut self) {
        if let Some(hub) = self.0.upgrade() {
            hub.touch();
            hub.camera_streams.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

async fn encode_all(mut encoder: Encoder, mut views: watch::Receiver<Arc<View>>, publish: watch::Sender<Encoded>) {
    let mut camera_sent = Instant::now();
    loop {
        // A frame that came too soon after the last one is sent later, unless a newer one replaces it.
        let camera_next = camera_sent + CAMERA_EVERY;
        tokio::select! {
            changed = views.changed() => if changed.is_err() { return },
            () = tokio::time::sleep_until(camera_next), if encoder.owes_sight => {}
        }
        let view = views.borrow_and_update().clone();
        let camera_due = camera_sent.elapsed() >= CAMERA_EVERY;
        let encoded = encoder.encode(&view, camera_due);
        if camera_due {
            camera_sent = Instant::now();
        }
        publish.send_replace(encoded);
    }
}

#[derive(Default)]
struct Encoder {
    last: Option<Encoded>,
    /// Version of the static parts.
    scene_version: Option<u64>,
    sight: Option<Arc<(u64, ferry_core::trial::Sight)>>,
    owes_sight: bool,
}

impl Encoder {
    fn encode(&mut self, view: &View, camera_due: bool) -> Encoded {
        let mut next = self.last.clone().unwrap_or_else(|| Encoded {
            view: 0,
            state: Utf8Bytes::default(),
            scene: Utf8Bytes::default(),
            scene_version: 0,
            past_version: 0,
            overlay: Utf8Bytes::default(),
            seen: Utf8Bytes::default(),
            seen_version: 0,
            camera: Bytes::new(),
            camera_tick: 0,
            observation: Bytes::new(),
            sight_version: 0,
            course: Part::default(),
        });
        next.view = view.number;
        next.course = course::Part::after(&next.course, view);
        next.state = json(&ServerMessage::State(Box::new(StateMessage::from(view))));
        let scene_version = Some(view.scenery.version);
        if self.scene_version != scene_version {
            self.scene_version = scene_version;
            next.scene = json(&ServerMessage::Scene(Box::new(SceneMessage::from(&*view.scenery))));
            next.scene_version += 1;
            next.past_version = view.scenery.past_version;
        }
        let seen = self.sight.as_ref().is_some_and(|sight| Arc::ptr_eq(sight, &view.sight));
        self.owes_sight = !seen && !camera_due;
        if !seen && camera_due {
            let before = self.sight.replace(view.sight.clone());
            let (tick, sight) = &*view.sight;
            if !before.is_some_and(|before| before.1.known.shares_cells(&sight.known)) {
                next.seen_version += 1;
                next.seen = json(&ServerMessage::Seen(SeenMessage::of(&sight.known, next.seen_version)));
            }
            next.overlay = json(&ServerMessage::Overlay(Box::new(OverlayMessage::from(view))));
            match sight.frame.picture.to_jpeg(JPEG_QUALITY) {
                Ok(jpeg) => {
                    next.camera = binary(BINARY_CAMERA_JPEG, *tick, &jpeg);
                    next.camera_tick = *tick;
                }
                Err(error) => tracing::warn!(%error, "camera frame not encoded"),
            }
            next.observation = binary(BINARY_OBSERVATION, *tick, &sight.observation().bytes);
            next.sight_version += 1;
        }
        self.last = Some(next.clone());
        next
    }
}
