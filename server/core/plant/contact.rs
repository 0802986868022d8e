//! Contact of the bead with walls: it slides along them, bounces a little, and never passes through. A wall that moves
//! pushes it; the impulses are those of a wall at rest, in the frame of the wall.

use super::bead::shrunk;
use super::walls::{Touch, Walls};
use super::{BEAD_RADIUS_M, Bead};
use crate::geometry::{Point2, Vector2};

/// Coefficient of restitution between bead and wall.
const RESTITUTION: f64 = 0.3;
/// Coulomb friction coefficient between bead and wall.
const WALL_FRICTION: f64 = 0.1;
/// Maximum number of contacts resolved one after the other in one hop.
const PASSES: usize = 4;
/// Rounding tolerance of contact checks.
const SLOP_M: f64 = 1e-9;
/// A bead within this distance of a wall touches it.
const TOUCH_M: f64 = 1e-7;
/// A bead that touches a wall and moves into it slower than this leans on it instead of bouncing. The
/// strongest pull changes the speed by this much in a millisecond.
const LEAN_M_S: f64 = 0.02;
/// How often a bead between walls that close in is pushed away from the nearest, how far each time, the overlap that is
/// then allowed, and how far it may go in one hop: farther than any wall moves.
const SQUEEZES: usize = 40;
const SQUEEZE_M: f64 = 5e-5;
const SQUEEZED_M: f64 = 1e-6;
const SQUEEZED_MOST_M: f64 = 5e-4;

/// What a wall did to a bead that leans on it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lean {
    /// By how much the wall's friction slows the bead.
    pub friction_m_s: f64,
    /// Work of the wall, per mass.
    pub work_m2_s2: f64,
}

/// Removes the velocity of a leaning bead into its wall, so that only the remaining velocity works against
/// the table's friction.
pub(super) fn lean(bead: &mut Bead, walls: &Walls) -> Lean {
    let Some(touch) = walls.touch(bead.position_m, BEAD_RADIUS_M + TOUCH_M) else { return Lean::default() };
    let Some(normal) = touch.normal else { return Lean::default() };
    let push_m_s = -(bead.velocity_m_s.dot(&normal) - touch.speed_m_s);
    if !(0.0..=LEAN_M_S).contains(&push_m_s) {
        return Lean::default();
    }
    bead.velocity_m_s += normal * push_m_s;
    Lean { friction_m_s: WALL_FRICTION * push_m_s, work_m2_s2: push_m_s * touch.speed_m_s }
}

/// Moves the bead for `dt_s`, in hops so short that its centre cannot cross a wall undetected. Returns the work of the
/// walls, per mass.
pub(super) fn advance(bead: &mut Bead, walls: &Walls, dt_s: f64) -> f64 {
    let travel_m = bead.velocity_m_s.norm() * dt_s;
    let hops = (travel_m / (0.5 * BEAD_RADIUS_M)).ceil().max(1.0);
    (0..hops as usize).map(|_| hop(bead, walls, dt_s / hops)).sum()
}

/// A contact: the nearest point of the wall, and the normal from it to the bead.
#[derive(Clone, Copy)]
struct Contact {
    wall_m: Point2<f64>,
    normal: Vector2<f64>,
}

fn hop(bead: &mut Bead, walls: &Walls, dt_s: f64) -> f64 {
    if bead.velocity_m_s == Vector2::zeros() && !walls.are_moving() {
        return 0.0;
    }
    let mut work_m2_s2 = 0.0;
    let mut to = bead.position_m + bead.velocity_m_s * dt_s;
    let mut last: Option<Contact> = None;
    for _ in 0..PASSES {
        // A bead that walls have closed on may be pushed far by one of them, but not past another.
        if walls.are_moving() && (to - bead.position_m).norm() >= BEAD_RADIUS_M {
            break;
        }
        let Some(Touch { wall_m, normal, speed_m_s }) = walls.touch(to, BEAD_RADIUS_M - SLOP_M) else {
            bead.position_m = to;
            return work_m2_s2;
        };
        // The hop is shorter than the radius, so `to` is still on the free side of the wall, and the
        // normal points from the wall to the bead.
        let Some(normal) = normal else { break };
        let met = Contact { wall_m, normal };
        work_m2_s2 += bounce(bead, normal, speed_m_s);
        to = wall_m + normal * BEAD_RADIUS_M;
        // In a corner each wall pushes the bead into the other one, by less each time but never by zero, so
        // the bead is put where it touches both. Within a radius of its last valid position there is no wall
        // that it could have passed.
        if let Some(corner_m) = last.and_then(|other| corner(other, met))
            && (corner_m - bead.position_m).norm() < BEAD_RADIUS_M
            && walls.touch(corner_m, BEAD_RADIUS_M - SLOP_M).is_none()
        {
            to = corner_m;
        }
        last = Some(met);
    }
    // The wedge is too narrow to resolve: stay at the last valid position, or go where walls that close in leave room.
    bead.velocity_m_s = Vector2::zeros();
    if walls.are_moving() {
        bead.position_m = squeezed(bead.position_m, walls);
    }
    work_m2_s2
}

/// Where a bead at rest is pushed by walls that have closed in: away from the nearest one until it fits. Where it fits
/// nowhere, the walls hold it and yield to it; it is where they have to yield least.
fn squeezed(from_m: Point2<f64>, walls: &Walls) -> Point2<f64> {
    let may_go = |to: Point2<f64>| (to - from_m).norm() <= SQUEEZED_MOST_M && walls.fits_between_drawn(to);
    let (mut here, mut last) = (from_m, None);
    let mut best: Option<(f64, Point2<f64>)> = None;
    for _ in 0..SQUEEZES {
        if !may_go(here) {
            break;
        }
        let Some(Touch { wall_m, normal: Some(normal), .. }) = walls.touch(here, BEAD_RADIUS_M - SQUEEZED_M) else {
            return here;
        };
        let overlap_m = BEAD_RADIUS_M - (here - wall_m).dot(&normal);
        if best.is_none_or(|(least_m, _)| overlap_m < least_m) {
            best = Some((overlap_m, here));
        }
        // Between two walls that narrow, where it touches both.
        let met = Contact { wall_m, normal };
        let beside = last.and_then(|other| corner(other, met));
        if let Some(place) = beside.filter(|&to| may_go(to) && walls.touch(to, BEAD_RADIUS_M - SQUEEZED_M).is_none()) {
            return place;
        }
        last = Some(met);
        here += normal * overlap_m.min(SQUEEZE_M);
    }
    // In a corner of moving walls the way out is not away from the nearest one.
    let fits = |to: &Point2<f64>| may_go(*to) && walls.touch(*to, BEAD_RADIUS_M - SQUEEZED_M).is_none();
    let aside = around(from_m).find(fits);
    aside.or_else(|| best.map(|(_, place)| place)).unwrap_or(from_m)
}

/// Places that a bead which walls have closed on can be pushed to in a millisecond, nearest first.
pub(super) fn around(place: Point2<f64>) -> impl Iterator<Item = Point2<f64>> {
    [1e-4, 2.5e-4, 4e-4].into_iter().flat_map(move |away_m| {
        (0..16_u32).map(move |k| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 16.0).sin_cos();
            place + Vector2::new(cos, sin) * away_m
        })
    })
}

/// Applies the impulse of a wall, which moves along its normal with `speed_m_s`, to a bead that moves into it.
/// Returns the work of the wall, per mass.
fn bounce(bead: &mut Bead, normal: Vector2<f64>, speed_m_s: f64) -> f64 {
    let approach_m_s = bead.velocity_m_s.dot(&normal) - speed_m_s;
    if approach_m_s >= 0.0 {
        return 0.0;
    }
    let impulse_m_s = -(1.0 + RESTITUTION) * approach_m_s;
    let normal_m_s = approach_m_s + speed_m_s;
    let tangential = shrunk(bead.velocity_m_s - normal * normal_m_s, WALL_FRICTION * impulse_m_s);
    bead.velocity_m_s = tangential - normal * RESTITUTION * approach_m_s;
    // Without this condition, a wall at rest would change the sign of a zero.
    if speed_m_s != 0.0 {
        bead.velocity_m_s += normal * speed_m_s;
    }
    impulse_m_s * speed_m_s
}

/// The position at which the bead touches both walls; `None` if they are parallel.
fn corner(a: Contact, b: Contact) -> Option<Point2<f64>> {
    let normals = nalgebra::Matrix2::from_rows(&[a.normal.transpose(), b.normal.transpose()]);
    let reach = |c: Contact| c.normal.dot(&c.wall_m.coords) + BEAD_RADIUS_M;
    normals.try_inverse().map(|inverse| Point2::from(inverse * Vector2::new(reach(a), reach(b))))
}
