//! The state of the robot, and what it does.

use std::time::Instant;

use super::doubt::{Apart, Doubt};
use super::facts::TwinTrouble;
use super::{DriveError, NORMAL, PLAYING, REDUCED, RUNNING, SILENCE, START_WITHIN};
use crate::drive_script::OVER;
use crate::news::News;
use crate::peer::Report;
use ferry_core::robot::Joints;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Drive {
    Rests,
    /// Waits until the session has checked where the arm is, and the robot's register is 0: no old number counts.
    Clears {
        since: Instant,
        is_checked: bool,
    },
    /// The program was sent. The robot reports the period `before` until it begins.
    Begins {
        since: Instant,
        before: i32,
    },
    Follows {
        sent_rad: Joints,
        period: i32,
        period_at: Instant,
    },
}

#[derive(Debug)]
pub(super) struct State {
    /// Why there is no connection.
    pub(super) trouble: Option<TwinTrouble>,
    pub(super) model: Option<String>,
    pub(super) heard: Option<(Report, Instant)>,
    /// Ferry's program on the robot has told where the flange is, and that is where a UR5's would be.
    pub(super) is_proven: bool,
    /// The largest in this connection.
    pub(super) doubt: Option<Doubt>,
    /// Until when the page's button counts as held.
    pub(super) held_until: Option<Instant>,
    /// The press of the button that is held, and the last one whose motion has ended.
    pub(super) press: Option<u32>,
    pub(super) spent: Option<u32>,
    pub(super) drive: Drive,
    pub(super) stopped: Option<DriveError>,
    /// A connection has begun, and the session may not run yet.
    pub(super) is_new: bool,
    pub(super) news: News,
}

pub(super) fn check_modes(report: &Report) -> Result<(), DriveError> {
    if report.robot_mode != RUNNING {
        return Err(DriveError::Mode(report.robot_mode));
    }
    match report.safety_mode {
        NORMAL | REDUCED => Ok(()),
        mode => Err(DriveError::Safety(mode)),
    }
}

impl State {
    /// Compares the flange, as the robot's controller computes it, with Ferry's.
    pub(super) fn compare(&mut self, report: &Report) -> Result<(), DriveError> {
        let apart = Apart::flange(report);
        if apart.is_other_arm() {
            return Err(DriveError::OtherArm(Box::new(apart)));
        }
        if !self.is_proven {
            (self.is_proven, self.doubt) = (true, None);
        }
        self.note(Doubt::of_flange(apart));
        Ok(())
    }

    /// Keeps the largest doubt, and tells of the first.
    pub(super) fn note(&mut self, doubt: Option<Doubt>) {
        let Some(new) = doubt else { return };
        let distance_m = |doubt: &Doubt| match doubt {
            Doubt::Tool(apart) | Doubt::Flange(apart) => apart.distance_m,
        };
        if self.doubt.is_none() {
            self.news.tell(new.to_string());
        }
        if self.doubt.is_none_or(|old| distance_m(&old) < distance_m(&new)) {
            self.doubt = Some(new);
        }
    }

    pub(super) fn check_drive(&self, now: Instant) -> Result<(), DriveError> {
        if self.drive == Drive::Rests {
            return Ok(());
        }
        let Some((report, at)) = self.heard else { return Err(DriveError::NotConnected) };
        if now.saturating_duration_since(at) > SILENCE {
            return Err(DriveError::Silent);
        }
        check_modes(&report)?;
        match self.drive {
            Drive::Clears { since, .. } | Drive::Begins { since, .. }
                if now.saturating_duration_since(since) > START_WITHIN =>
            {
                Err(DriveError::NotBegun)
            }
            Drive::Follows { .. } if report.period == OVER || report.runtime_state != PLAYING => Err(DriveError::Over),
            Drive::Follows { period_at, .. } if now.saturating_duration_since(period_at) > SILENCE => {
                Err(DriveError::Silent)
            }
            _ => Ok(()),
        }
    }
}
