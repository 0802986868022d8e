//! A session's views as messages, each encoded once for all browsers.

use std::sync::Arc;
use std::time::Duration;

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::Instant;

use super::course::{self, Part};
use super::frames::{BINARY_HEAD, binary, json};
use crate::protocol::{
    BINARY_CAMERA_JPEG, BINARY_OBSERVATION, OverlayMessage, SceneMessage, SeenMessage, ServerMessage, StateMessage,
};
use crate::session::View;

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

/// Encodes each view, until the task is aborted or the session has ended.
pub fn encode(views: watch::Receiver<Arc<View>>) -> (watch::Receiver<Encoded>, JoinHandle<()>) {
    let mut encoder = Encoder::default();
    let first = encoder.encode(&views.borrow(), true);
    let (publish, encoded) = watch::channel(first);
    (encoded, tokio::spawn(encode_all(encoder, views, publish)))
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
