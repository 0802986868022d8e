//! The course of a trial for browsers: whole when one joins, and then what lies between two states that it gets. The part
//! between two views is encoded once for all.

use axum::body::Bytes;

use super::frames::binary;
use crate::protocol::BINARY_COURSE;
use crate::session::View;
use ferry_core::control::switching::Mode;
use ferry_core::scenario::ControllerName;
use ferry_core::session::Course;

/// How far a browser has the course: up to `next_tick`, of this trial, cut this often.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    trial: Option<u64>,
    cuts: u64,
    next_tick: u64,
}

impl Reach {
    /// The tick from which a browser needs the course, to go on to `now`; `None` if it needs nothing.
    fn needs(&self, now: &Newest) -> Option<u64> {
        let (cuts, cut_tick) = now.course.cuts();
        if self.trial != now.reach.trial || cuts > self.cuts + 1 {
            return Some(0);
        }
        let is_cut = cuts > self.cuts;
        let from = if is_cut { self.next_tick.min(cut_tick + 1) } else { self.next_tick };
        let has_gap = now.tick >= from + now.course.step_ticks() && now.course.newest_tick() >= Some(from);
        (is_cut || has_gap).then_some(from)
    }

    fn reached(&self, now: &Newest) -> Self {
        let is_same = (self.trial, self.cuts) == (now.reach.trial, now.reach.cuts);
        Self { next_tick: now.reach.next_tick.max(if is_same { self.next_tick } else { 0 }), ..now.reach }
    }
}

/// The course up to a view.
#[derive(Clone, Debug, Default)]
struct Newest {
    course: Course,
    tick: u64,
    /// That of a browser which has all of it.
    reach: Reach,
}

impl Newest {
    fn of(view: &View) -> Self {
        let (course, tick) = (view.course.clone(), view.moment.tick);
        let next_tick = course.newest_tick().unwrap_or(0).max(tick) + 1;
        let reach = Reach { trial: Some(view.scenery.trial), cuts: course.cuts().0, next_tick };
        Self { course, tick, reach }
    }
}

/// What a view adds to the view before, ready to send.
#[derive(Clone, Debug, Default)]
pub struct Part {
    newest: Newest,
    /// For browsers that have the course so far.
    after: Reach,
    frame: Option<Bytes>,
}

impl Part {
    pub fn after(before: &Self, view: &View) -> Self {
        let newest = Newest::of(view);
        let after = before.newest.reach;
        // The first browser to come gets the whole.
        let frame = after.trial.and_then(|_| frame_for(after, &newest));
        Self { newest, after, frame }
    }

    /// The frame for a browser before the state of this view.
    pub fn next_for(&self, reach: &mut Reach) -> Option<Bytes> {
        let frame = if *reach == self.after { self.frame.clone() } else { frame_for(*reach, &self.newest) };
        *reach = reach.reached(&self.newest);
        frame
    }
}

fn frame_for(reach: Reach, newest: &Newest) -> Option<Bytes> {
    Some(frame(&newest.course, reach.needs(newest)?))
}

/// See [`super::live`].
fn frame(course: &Course, from_tick: u64) -> Bytes {
    let (first_tick, points) = course.points_from(from_tick);
    let mut payload = Vec::with_capacity(8 + 18 * points.len());
    payload.extend((course.step_ticks() as u32).to_le_bytes());
    payload.extend((first_tick as u32).to_le_bytes());
    for axis in 0..2 {
        payload.extend(points.iter().flat_map(|point| point.tool_m[axis].to_le_bytes()));
    }
    for axis in 0..2 {
        payload.extend(points.iter().flat_map(|point| point.bead_m[axis].to_le_bytes()));
    }
    payload.extend(points.iter().map(|point| Mode::index(point.mode)));
    let number = |name| ControllerName::ALL.iter().position(|&other| other == name).unwrap_or_default() as u8;
    payload.extend(points.iter().map(|point| number(point.controller)));
    binary(BINARY_COURSE, from_tick, &payload)
}
