//! One disturbance of a recovery map, and the inputs that carry it out.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use ferry_core::geometry::{Point2, Vector2};
use ferry_core::robot::ur5::SERVO_PERIOD_S;
use ferry_core::scenario::{Disturbance, MOST_DRIFT_N};
use ferry_core::trial::{Input, Timed};

/// Duration of a push.
const PUSH_S: f64 = 0.5;
/// The hand pulls as fast as that of an evaluation by hand, and holds the bead at the end for this long.
const HAND_SPEED_M_S: f64 = 0.2;
const HOLD_S: f64 = 0.5;
/// Farthest drag.
const DRAG_MOST_M: f64 = 0.16;
/// Longest time for which the tracker is blind.
const BLIND_MOST_S: f64 = 8.0;

/// One disturbance of a recovery map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Spot {
    /// The bead is lifted to the centre of a square.
    Place { at_m: Point2<f64>, size_m: f64 },
    /// The bead is pushed for half a second.
    Push { direction_rad: f64, force_n: f64 },
    /// A hand pulls the bead from where it is.
    Drag { direction_rad: f64, distance_m: f64 },
    /// The tracker is blind from this time on.
    Blind { at_s: f64, for_s: f64 },
}

fn ticks(time_s: f64) -> u64 {
    (time_s / SERVO_PERIOD_S).ceil() as u64
}

fn toward(direction_rad: f64, length: f64) -> Vector2<f64> {
    length * Vector2::new(direction_rad.cos(), direction_rad.sin())
}

impl Spot {
    /// The inputs, for a moment at a tick with the bead at a place.
    pub fn inputs(self, tick: u64, bead_m: Point2<f64>) -> Vec<Timed> {
        let disturb = |tick, disturbance| vec![Timed { tick, input: Input::Disturb(disturbance) }];
        match self {
            Self::Place { at_m, .. } => disturb(tick, Disturbance::Displace { x_m: at_m.x, y_m: at_m.y }),
            Self::Push { direction_rad, force_n } => {
                let force = toward(direction_rad, force_n);
                disturb(tick, Disturbance::Drift { x_n: force.x, y_n: force.y, for_s: PUSH_S })
            }
            Self::Drag { direction_rad, distance_m } => {
                let moving = ticks(distance_m / HAND_SPEED_M_S);
                let held = moving + ticks(HOLD_S);
                let drag = |at: u64| {
                    let share = at as f64 / moving as f64;
                    let to = bead_m + toward(direction_rad, distance_m * share);
                    Timed { tick: tick + at, input: Input::Drag { x_m: to.x, y_m: to.y, lift: false } }
                };
                let release = Timed { tick: tick + held, input: Input::Release };
                (0..=moving).map(drag).chain([release]).collect()
            }
            Self::Blind { at_s, for_s } => disturb(tick + ticks(at_s), Disturbance::Dropout { for_s }),
        }
    }

    /// Ticks from the moment until the disturbance is over.
    pub(super) fn lasts_ticks(self) -> u64 {
        match self {
            Self::Place { .. } => 0,
            Self::Push { .. } => ticks(PUSH_S),
            Self::Drag { distance_m, .. } => ticks(distance_m / HAND_SPEED_M_S) + ticks(HOLD_S),
            Self::Blind { at_s, for_s } => ticks(at_s) + ticks(for_s),
        }
    }

    /// Its share of a map of equal cells.
    pub(super) fn weight(self) -> f64 {
        match self {
            Self::Place { size_m, .. } => size_m * size_m,
            _ => 1.0,
        }
    }

    /// Directions times forces.
    pub(super) fn pushes(grid: u32) -> Vec<Self> {
        polar(grid, MOST_DRIFT_N, |direction_rad, force_n| Self::Push { direction_rad, force_n })
    }

    /// Directions times distances.
    pub(super) fn drags(grid: u32) -> Vec<Self> {
        polar(grid, DRAG_MOST_M, |direction_rad, distance_m| Self::Drag { direction_rad, distance_m })
    }

    /// Times, up to that of the slowest delivery without a disturbance, times durations.
    pub(super) fn losses(grid: u32, until_s: f64) -> Vec<Self> {
        let at_s = |column: u32| until_s * f64::from(column) / f64::from(grid);
        strengths(grid, BLIND_MOST_S)
            .into_iter()
            .flat_map(|for_s| (0..grid).map(move |column| Self::Blind { at_s: at_s(column), for_s }))
            .collect()
    }
}

/// A quarter as many strengths as columns, at least four, in equal steps.
fn strengths(grid: u32, most: f64) -> Vec<f64> {
    let count = (grid / 4).max(4);
    (1..=count).map(|step| most * f64::from(step) / f64::from(count)).collect()
}

fn polar(grid: u32, most: f64, spot: impl Fn(f64, f64) -> Spot) -> Vec<Spot> {
    let direction_rad = |column: u32| TAU * f64::from(column) / f64::from(grid);
    let spot = &spot;
    strengths(grid, most)
        .into_iter()
        .flat_map(|strength| (0..grid).map(move |column| spot(direction_rad(column), strength)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hand_moves_steadily_and_lets_go_at_the_end() {
        let inputs = Spot::Drag { direction_rad: TAU / 4.0, distance_m: 0.1 }.inputs(100, Point2::new(0.1, -0.4));
        let places: Vec<(u64, f64)> = inputs
            .iter()
            .filter_map(|timed| match timed.input {
                Input::Drag { y_m, .. } => Some((timed.tick, y_m)),
                _ => None,
            })
            .collect();
        assert_eq!((places[0], places.len()), ((100, -0.4), 64));
        assert!((places.last().unwrap().1 + 0.3).abs() < 1e-12);
        for pair in places.windows(2) {
            let speed_m_s = (pair[1].1 - pair[0].1) / SERVO_PERIOD_S;
            assert!((0.19..=0.2 + 1e-9).contains(&speed_m_s), "{speed_m_s}");
        }
        let last = inputs.last().unwrap();
        assert_eq!((last.tick, &last.input), (226, &Input::Release));
    }

    #[test]
    fn grids_have_no_disturbance_twice_and_none_beyond_the_limits() {
        for spots in [Spot::pushes(12), Spot::drags(12), Spot::losses(12, 9.0)] {
            assert_eq!(spots.len(), 48);
            for (index, spot) in spots.iter().enumerate() {
                assert!(!spots[..index].contains(spot));
                for Timed { input, .. } in spot.inputs(0, Point2::new(0.0, -0.4)) {
                    if let Input::Disturb(disturbance) = input {
                        disturbance.check().unwrap();
                    }
                }
            }
        }
    }
}
