//! Challenges in a session: an attempt counts while it runs without interruption, at real speed, steered only.

use std::sync::Arc;
use std::time::Duration;

use super::playing::{Ended, Played, Playing, Void};
use super::{CommandError, Scenery, Session};
use crate::challenge::{Attempt, Challenge, ChallengeName, Referee, TICKS_MOST};
use crate::image::ImageSource;
use crate::trial::{Case, TickRecord, Timed};

impl<E: ImageSource> Session<E> {
    pub(super) fn play(&mut self, name: ChallengeName, now: Duration) -> Result<(), CommandError> {
        let challenge = match &self.playing {
            Some(playing) if playing.challenge.name == name => playing.challenge.clone(),
            _ => Arc::new(Challenge::of(name)?),
        };
        self.replace(challenge.scenario.clone(), challenge.arena.clone(), None)?;
        self.pace.set_factor(1.0, now);
        self.playing =
            Some(Playing { challenge: challenge.clone(), referee: Referee::default(), ended: None, void: None });
        self.scenery = Arc::new(Scenery { challenge: Some(challenge), ..self.next_scenery(0) });
        Ok(())
    }

    /// Name of the challenge that is being played.
    pub(super) fn challenge_name(&self) -> Option<ChallengeName> {
        self.playing.as_ref().map(|playing| playing.challenge.name.clone())
    }

    /// The attempt no longer counts, unless it has ended.
    pub(super) fn spoil(&mut self, why: Void) {
        if let Some(playing) = self.playing.as_mut().filter(|playing| playing.ended.is_none()) {
            playing.void.get_or_insert(why);
        }
    }

    /// Counts a tick. At the end of the attempt the session pauses.
    pub(super) fn referee(&mut self, record: &TickRecord) {
        let Some(playing) = &mut self.playing else { return };
        if playing.ended.is_some() || playing.void == Some(Void::Rewound) {
            return;
        }
        let score = playing.referee.watch(record);
        let ended = match score {
            Some(score) => {
                let told = self.history.timeline().inputs_from_start().unwrap_or_default();
                let inputs = told.into_iter().map(|(tick, input)| Timed { tick, input }).collect();
                let scenario = playing.challenge.scenario.clone();
                let log = Case { about: String::new(), scenario, map: None, inputs, expect: None };
                let world_hash = format!("{:016x}", record.world.total());
                Ended::Delivered(Arc::new(Attempt { log, score, world_hash }))
            }
            None if record.tick >= TICKS_MOST => Ended::TimeUp,
            None => return,
        };
        playing.ended = Some(ended);
        self.running = false;
        self.stepping = 0;
    }

    /// The attempt at the challenge that is being played.
    ///
    /// # Errors
    /// [`CommandError::NoChallenge`].
    pub fn played(&self) -> Result<Played, CommandError> {
        let Playing { challenge, referee, ended, void } = self.playing.clone().ok_or(CommandError::NoChallenge)?;
        Ok(Played { challenge, trace: referee.into_trace(), ended, void })
    }
}
