//! The hand of one browser, and who looks after it: also while the browser takes nothing in and its connection waits to
//! send.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use tokio::sync::Notify;
use tokio::time::Instant;

use super::hub::Hub;
use crate::session::Command;
use crate::trial::Input;

/// Looks so often whether somebody has left without a word.
const BEAT: Duration = Duration::from_secs(1);
/// A page whose hand holds the bead repeats that at least twice a second. After this silence the bead is released and
/// the session pauses.
pub const SILENCE: Duration = Duration::from_secs(5);

/// Shared by a browser's connection and by who looks after its hand.
pub struct Hand {
    own: u64,
    hub: Arc<Hub>,
    holds: Mutex<Holds>,
    /// It was made to let go, since it had said nothing.
    pub silenced: Notify,
}

struct Holds {
    bead: bool,
    /// The browser's last valid command.
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

    /// A valid command; `bead` says whether the hand holds the bead after it, where it says anything of that.
    pub fn commanded(&self, bead: Option<bool>) {
        let mut holds = self.holds();
        holds.commanded = Instant::now();
        holds.bead = bead.unwrap_or(holds.bead);
    }

    /// Lets go, if it holds; returns whether it did.
    pub async fn let_go(&self) -> bool {
        let held = std::mem::take(&mut self.holds().bead);
        if held {
            // The session may have ended, and with it the hand.
            let _ = self.hub.session.send(Command::Input(Input::Release)).await;
        }
        held
    }

    fn is_silent(&self) -> bool {
        let holds = self.holds();
        holds.bead && holds.commanded.elapsed() > SILENCE
    }

    /// For as long as the connection lasts.
    pub async fn look_after(self: Arc<Self>) {
        loop {
            tokio::time::sleep(BEAT).await;
            self.hub.reseat(|seats, now| seats.take_if_unanswered(self.own, now));
            if self.hub.seats().borrow().operator != Some(self.own) {
                self.let_go().await;
            } else if self.is_silent() && self.let_go().await {
                // One that has ended holds anyway.
                let _ = self.hub.session.send(Command::Pause).await;
                self.silenced.notify_one();
            }
        }
    }
}
