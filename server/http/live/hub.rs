//! One session and its browsers. Each message is encoded once, and one browser is the operator.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::time::Duration;

use axum::extract::ws::Utf8Bytes;
use jiff::Timestamp;
use tokio::sync::{Semaphore, watch};
use tokio::time::Instant;

use super::encoded::{self, Encoded};
use super::seats::Seats;
use crate::protocol::{Hello, PROTOCOL_VERSION, Role};
use crate::session::SessionHandle;
use ferry_camera::Gpu;
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_ur::Twin;

/// A session with its browsers.
pub struct Hub {
    pub id: String,
    pub session: SessionHandle,
    opened: Timestamp,
    gpu: Arc<Gpu>,
    encoded: watch::Receiver<Encoded>,
    seats: watch::Sender<Seats>,
    /// The visitor whose own session it is.
    owner: Option<Arc<str>>,
    /// The robot that the arm mirrors. Who becomes the operator does not drive it yet.
    twin: Option<Arc<Twin>>,
    /// Number of open camera streams.
    camera_streams: AtomicUsize,
    encoder: Mutex<Option<tokio::task::JoinHandle<()>>>,
    /// Becomes true when the session is deleted; its connections watch it.
    closing: watch::Sender<bool>,
    /// The newest comparison, ready to send; empty before the first.
    comparison: watch::Sender<Utf8Bytes>,
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
    pub fn start(
        id: &str,
        session: SessionHandle,
        gpu: Arc<Gpu>,
        owner: Option<Arc<str>>,
        twin: Option<Arc<Twin>>,
    ) -> Arc<Self> {
        let now = Instant::now();
        let (encoded, encoder) = encoded::encode(session.watch());
        Arc::new(Self {
            id: id.to_owned(),
            session,
            opened: Timestamp::now(),
            gpu,
            comparison: watch::Sender::new(Utf8Bytes::default()),
            comparing: Arc::new(Semaphore::new(1)),
            encoded,
            seats: watch::Sender::new(Seats::new(now)),
            owner,
            twin,
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
        self.seats.borrow().viewers()
    }

    pub fn owner(&self) -> Option<&Arc<str>> {
        self.owner.as_ref()
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

    /// Sends the newest message of a comparison.
    pub fn send_comparison(&self, message: Utf8Bytes) {
        self.comparison.send_replace(message);
    }

    /// Permit of the running comparison.
    pub fn comparing(&self) -> Arc<Semaphore> {
        self.comparing.clone()
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
                let left_s = seats.answers_within(now).map(|left| left.as_secs_f64().round() as u64);
                (seats.epoch, seats.is_held(), seats.asking.clone(), left_s)
            };
            let (before, operator) = (told(seats), seats.operator);
            done = Some(change(seats, now));
            if let Some(twin) = self.twin.as_ref().filter(|_| seats.operator != operator) {
                // Letting go is never refused.
                let _ = twin.hold(None, now.into_std());
            }
            before != told(seats)
        });
        self.touch();
        done.expect("the change was made")
    }

    /// Time without an operator.
    pub fn unsteered_for(&self) -> Duration {
        self.seats.borrow().unsteered_for(Instant::now())
    }

    /// No browser can join any more, if there has been no operator for this long. Returns whether that is so.
    pub fn close_if_unsteered(&self, least: Duration) -> bool {
        let mut is_closed = false;
        self.seats.send_if_modified(|seats| {
            is_closed = seats.close_if_unsteered(least, Instant::now());
            false
        });
        is_closed
    }

    /// Whether a visitor operates it, or can.
    pub fn is_open_to(&self, visitor: &Arc<str>) -> bool {
        self.reseat(|seats, now| {
            seats.settle(now);
            seats.is_open_to(Some(visitor))
        })
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
        let ahead = seats.asking.iter().position(|asks| *asks == connection);
        Hello {
            protocol: PROTOCOL_VERSION,
            message_bytes: message_bytes as u32,
            session: self.id.clone(),
            seat: key.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            role: if operates { Role::Operator } else { Role::Viewer },
            epoch: seats.epoch,
            operator_present: seats.is_held(),
            asked: operates && !seats.asking.is_empty(),
            asks: ahead.is_some(),
            ahead: ahead.unwrap_or(0) as u32,
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
