//! Disturbances: scripted ones, random ones, and those of the operator.

use rand_chacha::ChaCha8Rng;

use super::script::Draw;
use super::{Event, Happening, InputError, Trial, TrialError, input::check_on_table};
use crate::geometry::{Point2, Vector2};
use crate::map::{FreeSpace, Map};
use crate::plant::Bead;
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{Disturbance, SCRIPT_LIMIT, Scripted, When};

/// A random disturbance moves the bead at least this far.
const LEAST_DISPLACEMENT_M: f64 = 0.15;

impl Trial {
    /// Applies due disturbances and ends expired ones. `at_step` is the number of the control step that was
    /// just counted.
    pub(super) fn apply_scripted(&mut self, at_step: Option<u32>) {
        let world = &mut self.state.world;
        let tick = world.tick;
        if world.script.drift_until == tick {
            world.plant.drift_n = Vector2::zeros();
        }
        let bead_m = world.plant.bead.position_m;
        let before_m = match at_step {
            None => world.script.bead_before_m.replace(bead_m),
            Some(_) => None,
        };
        let mut is_first = at_step.is_none();
        let is_due = |scripted: &mut Scripted| {
            // Of the entries that wait for the bead's position only the first may be applied.
            let is_next = !scripted.at.waits_for_bead() || std::mem::take(&mut is_first);
            is_next
                && match scripted.at {
                    When::Tick(at) => at == tick,
                    When::Step(step) => at_step == Some(step),
                    When::PassesXM(x_m) => before_m.is_some_and(|before| (before.x < x_m) != (bead_m.x < x_m)),
                    When::Near { x_m, y_m, within_m } => (bead_m - Point2::new(x_m, y_m)).norm() <= within_m,
                }
        };
        let due: Vec<Scripted> = world.script.pending.extract_if(.., is_due).collect();
        for scripted in due {
            self.apply_disturbance(&scripted.disturbance);
        }
    }

    /// Checks a scenario's script; an error names the entry.
    pub(super) fn check_script(script: &[Scripted], map: &Map) -> Result<(), TrialError> {
        if script.len() > SCRIPT_LIMIT {
            return Err(TrialError::LongScript { entries: script.len() });
        }
        for (index, scripted) in script.iter().enumerate() {
            let checked = scripted.check().map_err(InputError::from);
            checked
                .and_then(|()| Self::check_disturbance(&scripted.disturbance, map))
                .map_err(|error| TrialError::Script { index, error })?;
        }
        Ok(())
    }

    /// Checks a disturbance against its ranges and the map.
    pub(super) fn check_disturbance(disturbance: &Disturbance, map: &Map) -> Result<(), InputError> {
        disturbance.check()?;
        match *disturbance {
            Disturbance::Displace { x_m, y_m } => check_on_table("displace", Point2::new(x_m, y_m), map),
            _ => Ok(()),
        }
    }

    /// Applies a disturbance that has been checked. Kicks and pushes do not affect a bead on the magnet; a
    /// displacement takes the bead off the magnet or out of the hand.
    pub(super) fn apply_disturbance(&mut self, disturbance: &Disturbance) {
        let ticks = |for_s: f64| (for_s / SERVO_PERIOD_S).ceil() as u64;
        let fit = match *disturbance {
            Disturbance::Displace { x_m, y_m } => self.walls().nearest_fit(Point2::new(x_m, y_m)),
            _ => None,
        };
        let world = &mut self.state.world;
        let tick = world.tick;
        let bead = &mut world.plant.bead;
        let what = match *disturbance {
            Disturbance::Impulse { .. } | Disturbance::Drift { .. } if bead.lifted_off => return,
            Disturbance::Displace { .. } => {
                // An arena always has room for the bead.
                let Some(to) = fit else { return };
                let from = std::mem::replace(bead, Bead::at(to)).position_m;
                world.plant.hand = None;
                // The bead did not pass through the places between.
                world.script.bead_before_m = Some(to);
                Happening::Displaced { distance_m: (to - from).norm() }
            }
            Disturbance::Impulse { x_n_s, y_n_s } => {
                bead.kick(Vector2::new(x_n_s, y_n_s));
                Happening::Kicked { impulse_n_s: x_n_s.hypot(y_n_s) }
            }
            Disturbance::Drift { x_n, y_n, for_s } => {
                // There is one push at a time: the last one replaces the others.
                world.plant.drift_n = Vector2::new(x_n, y_n);
                world.script.drift_until = tick + ticks(for_s);
                Happening::Pushed { force_n: x_n.hypot(y_n), for_s }
            }
            Disturbance::Dropout { for_s } => {
                world.script.dropout_until = world.script.dropout_until.max(tick + ticks(for_s));
                Happening::Blinded { for_s }
            }
        };
        world.counters.disturbances += 1;
        self.events.push(Event::new(tick, what));
    }

    /// Applies a random displacement: lifts the bead to a free point far away.
    pub(super) fn apply_random(&mut self) {
        let world = &mut self.state.world;
        let mut rng = world.script.draws(self.scenario.seed, Draw::Place);
        world.script.at_leg_step = None;
        world.script.remaining = world.script.remaining.saturating_sub(1);
        world.script.struck += 1;
        let (map, space) = (&self.arena.map, &self.arena.space);
        let bead_m = world.plant.bead.position_m;
        match far_point(map, space, space.component_at(bead_m), bead_m, &mut rng) {
            Some(to) => self.apply_disturbance(&Disturbance::Displace { x_m: to.x, y_m: to.y }),
            None => self.events.push(Event::new(world.tick, Happening::NotDisturbed)),
        }
    }
}

/// A random free place, in a component or anywhere, that is far from another place.
pub fn far_point(
    map: &Map,
    space: &FreeSpace,
    component: Option<u32>,
    from: Point2<f64>,
    rng: &mut ChaCha8Rng,
) -> Option<Point2<f64>> {
    let is_far = |to: &Point2<f64>| (to - from).norm() >= LEAST_DISPLACEMENT_M;
    (0..1000).find_map(|_| space.sample(map, component, rng).filter(is_far))
}
