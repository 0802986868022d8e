//! Disturbances: those of the scenario's script, those that strike at random, and the operator's.

use rand_chacha::ChaCha8Rng;

use super::script::Draw;
use super::{Event, EventKind, InputError, Trial, TrialError, input::check_on_table};
use crate::geometry::{Point2, Vector2};
use crate::map::{FreeSpace, Map};
use crate::plant::{Bead, contact};
use crate::robot::ur5::SERVO_PERIOD_S;
use crate::scenario::{Disturbance, SCRIPT_LIMIT, Scripted, When};

/// A random disturbance puts the bead down at least this far away (specification §2).
const LEAST_DISPLACEMENT_M: f64 = 0.15;

impl Trial {
    /// Strikes with what is due, and ends what has lasted long enough. `at_step` is the number of a
    /// control step just counted.
    pub(super) fn strike_as_scripted(&mut self, at_step: Option<u32>) {
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
            // Of those that wait for the bead only the first may strike.
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
            self.strike(&scripted.disturbance);
        }
    }

    /// Checks a scenario's script, naming the entry at fault.
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

    /// Carries out a disturbance that has been checked. A bead on the magnet feels neither kick nor push;
    /// whoever displaces one takes it off the magnet, or out of the hand.
    pub(super) fn strike(&mut self, disturbance: &Disturbance) {
        let ticks = |for_s: f64| (for_s / SERVO_PERIOD_S).ceil() as u64;
        let world = &mut self.state.world;
        let tick = world.tick;
        let bead = &mut world.plant.bead;
        let text = match *disturbance {
            Disturbance::Impulse { .. } | Disturbance::Drift { .. } if bead.lifted_off => return,
            Disturbance::Displace { x_m, y_m } => {
                // A map without any room for the bead is no arena.
                let Some(to) = contact::nearest_fit(&self.arena.map, Point2::new(x_m, y_m)) else { return };
                let from = std::mem::replace(bead, Bead::at(to)).position_m;
                world.plant.hand = None;
                // It did not pass what lies between.
                world.script.bead_before_m = Some(to);
                format!("the bead was lifted {:.0} cm away", (to - from).norm() * 100.0)
            }
            Disturbance::Impulse { x_n_s, y_n_s } => {
                bead.kick(Vector2::new(x_n_s, y_n_s));
                format!("a kick of {:.2} mN·s", x_n_s.hypot(y_n_s) * 1e3)
            }
            Disturbance::Drift { x_n, y_n, for_s } => {
                // One push at a time: the last counts.
                world.plant.drift_n = Vector2::new(x_n, y_n);
                world.script.drift_until = tick + ticks(for_s);
                format!("a push of {:.1} mN for {for_s} s", x_n.hypot(y_n) * 1e3)
            }
            Disturbance::Dropout { for_s } => {
                world.script.dropout_until = world.script.dropout_until.max(tick + ticks(for_s));
                format!("the tracker is blind for {for_s} s")
            }
        };
        world.counters.disturbances += 1;
        self.events.push(Event::new(tick, EventKind::Disturbance, format!("disturbed: {text}")));
    }

    /// A random displacement: the bead is lifted to a free point far away and put down.
    pub(super) fn strike_at_random(&mut self) {
        let world = &mut self.state.world;
        let mut rng = world.script.draws(self.scenario.seed, Draw::Place);
        world.script.at_leg_step = None;
        world.script.remaining = world.script.remaining.saturating_sub(1);
        world.script.struck += 1;
        let (map, space) = (&self.arena.map, &self.arena.space);
        match far_point(map, space, world.plant.bead.position_m, &mut rng) {
            Some(to) => self.strike(&Disturbance::Displace { x_m: to.x, y_m: to.y }),
            None => {
                let text = "no disturbance: no free place is far enough from the bead";
                self.events.push(Event::new(world.tick, EventKind::Session, text));
            }
        }
    }
}

fn far_point(map: &Map, space: &FreeSpace, from: Point2<f64>, rng: &mut ChaCha8Rng) -> Option<Point2<f64>> {
    let component = space.component_at(from);
    let is_far = |to: &Point2<f64>| (to - from).norm() >= LEAST_DISPLACEMENT_M;
    (0..1000).find_map(|_| space.sample(map, component, rng).filter(is_far))
}
