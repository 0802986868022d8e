//! One session and all its browsers: each message is encoded once, and one browser is the operator.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use serde::Serialize;
use tokio::sync::{OwnedSemaphorePermit, watch};
use tokio::time::Instant;

use super::fork;
use crate::camera::Gpu;
use crate::protocol::{
    BINARY_CAMERA_JPEG, BINARY_OBSERVATION, Hello, OverlayMessage, PROTOCOL_VERSION, Role, SceneMessage, SeenMessage,
    ServerMessage, StateMessage,
};
use crate::scenario::ControllerName;
use crate::session::{CommandError, Session, View};

/// Camera frames go out at most thirty times a second.
const CAMERA_EVERY: Duration = Duration::from_millis(33);
const JPEG_QUALITY: u8 = 85;

/// The newest messages, ready to send. Parts that did not change are shared with the last one.
#[derive(Clone)]
pub struct Encoded {
    pub state: Utf8Bytes,
    pub scene: Utf8Bytes,
    /// Raised when `scene` changes.
    pub scene_version: u64,
    pub overlay: Utf8Bytes,
    pub seen: Utf8Bytes,
    /// Raised when `seen` changes.
    pub seen_version: u64,
    pub camera: Bytes,
    pub observation: Bytes,
    /// Raised when overlay, camera or observation change.
    pub sight_version: u64,
}

/// Who sits where.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seats {
    /// Connection that is the operator.
    pub operator: Option<u64>,
    /// Connection that last asked an operator to make way.
    pub asking: Option<u64>,
    next: u64,
}

/// A session with its browsers.
pub struct Hub {
    pub id: String,
    pub session: Session,
    gpu: Arc<Gpu>,
    encoded: watch::Receiver<Encoded>,
    seats: watch::Sender<Seats>,
    encoder: Mutex<Option<tokio::task::JoinHandle<()>>>,
    /// Turns true when the session is deleted; its browsers watch it.
    closing: watch::Sender<bool>,
    /// The newest comparison, ready to send; empty before the first.
    comparison: watch::Sender<Utf8Bytes>,
    /// Forks begun; an older one stops when it is no longer the last.
    forks: AtomicU64,
    /// Its place among the sessions.
    _place: OwnedSemaphorePermit,
}

impl Hub {
    /// Starts encoding a session's views.
    pub fn start(id: &str, session: Session, gpu: Arc<Gpu>, place: OwnedSemaphorePermit) -> Arc<Self> {
        let views = session.watch();
        let first = Encoder::default().encode(&views.borrow(), true);
        let (publish, encoded) = watch::channel(first);
        let encoder = tokio::spawn(encode_all(views, publish));
        Arc::new(Self {
            id: id.to_owned(),
            session,
            gpu,
            comparison: watch::Sender::new(Utf8Bytes::default()),
            forks: AtomicU64::new(0),
            encoded,
            seats: watch::Sender::new(Seats::default()),
            encoder: Mutex::new(Some(encoder)),
            closing: watch::Sender::new(false),
            _place: place,
        })
    }

    /// Sends every browser away.
    pub fn close(&self) {
        self.closing.send_replace(true);
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

    /// Starts a comparison, which tells of itself.
    pub async fn fork(self: &Arc<Self>, tick: u64, controllers: Vec<ControllerName>) -> Result<(), CommandError> {
        let past = self.session.recall(tick).await?;
        if !past.has_goal() {
            return Err(CommandError::NoGoal { tick });
        }
        let number = self.forks.fetch_add(1, Ordering::Relaxed) + 1;
        let trial = self.session.watch().borrow().scenery.trial;
        let hub = self.clone();
        tokio::task::spawn_blocking(move || {
            let is_last = || hub.forks.load(Ordering::Relaxed) == number && !*hub.closing.borrow();
            fork::compare(&past, trial, &controllers, &hub.gpu, &is_last, &|message| {
                hub.comparison.send_replace(json(&ServerMessage::Comparison(Box::new(message))));
            });
        });
        Ok(())
    }

    pub fn seats(&self) -> watch::Receiver<Seats> {
        self.seats.subscribe()
    }

    /// A new connection; it becomes the operator if nobody is.
    pub fn join(&self) -> u64 {
        let mut own = 0;
        self.seats.send_modify(|seats| {
            seats.next += 1;
            own = seats.next;
            seats.operator = seats.operator.or(Some(own));
        });
        own
    }

    /// A connection ends or stops operating; an asking one takes over.
    pub fn release(&self, connection: u64) {
        self.seats.send_if_modified(|seats| {
            let left_asking = seats.asking == Some(connection);
            if left_asking {
                seats.asking = None;
            }
            let left_operating = seats.operator == Some(connection);
            if left_operating {
                seats.operator = seats.asking.take();
            }
            left_asking || left_operating
        });
    }

    /// Takes the operator's seat if it is free, asks its holder otherwise.
    pub fn take(&self, connection: u64) {
        self.seats.send_if_modified(|seats| match seats.operator {
            Some(operator) if operator == connection => false,
            Some(_) => {
                seats.asking = Some(connection);
                true
            }
            None => {
                seats.operator = Some(connection);
                true
            }
        });
    }

    pub fn hello(&self, connection: u64, seats: &Seats) -> Hello {
        let operates = seats.operator == Some(connection);
        Hello {
            protocol: PROTOCOL_VERSION,
            session: self.id.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            role: if operates { Role::Operator } else { Role::Viewer },
            operator_present: seats.operator.is_some(),
            asked: operates && seats.asking.is_some(),
            adapter: self.gpu.adapter_name().to_owned(),
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

async fn encode_all(mut views: watch::Receiver<Arc<View>>, publish: watch::Sender<Encoded>) {
    let mut encoder = Encoder { last: Some(publish.borrow().clone()), ..Encoder::default() };
    let mut camera_sent = Instant::now();
    loop {
        // A frame that came too soon after the last is sent when its time comes, unless superseded.
        let changed = if encoder.owes_sight {
            tokio::time::timeout_at(camera_sent + CAMERA_EVERY, views.changed()).await.unwrap_or(Ok(()))
        } else {
            views.changed().await
        };
        if changed.is_err() {
            return;
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
    scene_version: Option<u64>,
    sight: Option<Arc<(u64, crate::trial::Sight)>>,
    owes_sight: bool,
}

impl Encoder {
    fn encode(&mut self, view: &View, camera_due: bool) -> Encoded {
        let mut next = self.last.clone().unwrap_or_else(|| Encoded {
            state: Utf8Bytes::default(),
            scene: Utf8Bytes::default(),
            scene_version: 0,
            overlay: Utf8Bytes::default(),
            seen: Utf8Bytes::default(),
            seen_version: 0,
            camera: Bytes::new(),
            observation: Bytes::new(),
            sight_version: 0,
        });
        next.state = json(&ServerMessage::State(Box::new(StateMessage::from(view))));
        if self.scene_version != Some(view.scenery.version) {
            self.scene_version = Some(view.scenery.version);
            next.scene = json(&ServerMessage::Scene(Box::new(SceneMessage::from(&*view.scenery))));
            next.scene_version += 1;
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
                Ok(jpeg) => next.camera = binary(BINARY_CAMERA_JPEG, *tick, &jpeg),
                Err(error) => tracing::warn!(%error, "camera frame not encoded"),
            }
            next.observation = binary(BINARY_OBSERVATION, *tick, &sight.observation().bytes);
            next.sight_version += 1;
        }
        self.last = Some(next.clone());
        next
    }
}

pub fn json(message: &impl Serialize) -> Utf8Bytes {
    serde_json::to_string(message).expect("messages are plain data").into()
}

fn binary(kind: u8, tick: u64, payload: &[u8]) -> Bytes {
    let mut bytes = vec![kind, 0, 0, 0];
    bytes.extend((tick as u32).to_le_bytes());
    bytes.extend(payload);
    bytes.into()
}
