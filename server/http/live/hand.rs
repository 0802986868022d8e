//! The hand of one browser and its watchdog. The watchdog works even while the connection blocks on
//! sending.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::Notify;
use tokio::time::Instant;

use super::hub::Hub;
use super::seats::Seats;
use ferry_core::session::Command;
use ferry_core::trial::Input;

/// Interval of the watchdog.
const BEAT: Duration = Duration::from_secs(1);
/// A page whose hand holds the bead repeats that at least twice a second. After this silence the bead is released and
/// the session pauses.
pub const SILENCE: Duration = Duration::from_secs(5);

/// Shared by a browser's connection and the watchdog.
pub struct Hand {
    own: u64,
    hub: Arc<Hub>,
    holds: Mutex<Holds>,
    /// The bead was released because of the silence.
    pub silenced: Notify,
}

struct Holds {
    bead: bool,
    /// Time of the browser's last valid command.
    commanded: Instant,
}

impl Hand {
    pub fn new(own: u64, hub: Arc<Hub>) -> Arc<Self> {
        let holds = Mutex::new(Holds { bead: false, commanded: Instant::now() });
        Arc::new(Self { own, hub, holds, silenced: Notify::new() })
    }

    fn holds(&self) -> MutexGuard<'_, Holds> {
        self.holds.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Notes a valid command; `bead` is whether the hand holds the bead after it, if the command affects that.
    pub fn commanded(&self, bead: Option<bool>) {
        let mut holds = self.holds();
        holds.commanded = Instant::now();
        holds.bead = bead.unwrap_or(holds.bead);
    }

    /// Releases the bead if the hand holds it; returns whether it did.
    pub async fn release(&self) -> bool {
        let held = std::mem::take(&mut self.holds().bead);
        if held {
            // The session may have ended, together with the hand.
            let _ = self.hub.session.send(Command::Input(Input::Release)).await;
        }
        held
    }

    fn is_silent(&self) -> bool {
        let holds = self.holds();
        holds.bead && holds.commanded.elapsed() > SILENCE
    }

    /// Runs as long as the connection.
    pub async fn watch(self: Arc<Self>) {
        loop {
            tokio::time::sleep(BEAT).await;
            self.hub.reseat(Seats::settle);
            if self.hub.seats().borrow().operator != Some(self.own) {
                self.release().await;
            } else if self.is_silent() && self.release().await {
                // An ended session is paused anyway.
                let _ = self.hub.session.send(Command::Pause).await;
                self.silenced.notify_one();
            }
        }
    }
}
