//! Inputs of the operator, checked before they change anything.

use serde::{Deserialize, Serialize};

use super::input_error::{InputError, REASON_BYTES_MOST, WAITING_MOST};
use super::{Event, Happening, Motion, Phase, Trial, TrialState};
use crate::control::limits::JointRefusal;
use crate::control::transport::Carrier;
use crate::control::transport::program::Answer;
use crate::control::transport::you::Steering;
use crate::geometry::{Point2, Point3};
use crate::map::Map;
use crate::plant::{BEAD_RADIUS_M, Bead, Hand, Mirror, Plant, Positioner};
use crate::robot::{Joints, ur5::JOINT_LIMIT_RAD};
use crate::scenario::{ControllerName, Disturbance, Parameters, Stream};

/// How far beyond a joint's limit a robot may report it.
const MEASURED_BEYOND_RAD: f64 = 0.1;

/// An input of a trial; it is logged with the tick that follows it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Input {
    /// Places the goal.
    SetGoal { x_m: f64, y_m: f64 },
    /// Removes the goal.
    ClearGoal,
    /// The hand takes the bead or moves it.
    Drag {
        /// Pointer, x.
        x_m: f64,
        /// Pointer, y.
        y_m: f64,
        /// Whether the bead is lifted over walls.
        lift: bool,
    },
    /// While paused, the hand places the bead at once.
    Place { x_m: f64, y_m: f64 },
    /// The hand releases the bead.
    Release,
    /// Selects sub-controller 2.
    SelectController(ControllerName),
    /// Replaces the parameters.
    Configure(Box<Parameters>),
    /// Applies a disturbance now.
    Disturb(Disturbance),
    /// Points the tool of the controller `you` to a place; it goes there, within its limits.
    Steer {
        x_m: f64,
        y_m: f64,
        /// Whether the hand also steers while sub-controller 1 is active.
        approach: bool,
    },
    /// All random numbers from now on are those of another seed, as if the trial had its luck again.
    Reseed {
        /// Replaces the scenario's seed.
        seed: u64,
    },
    /// The answer of a program for the next control step: the tool goes there, as far as a step reaches.
    Go { x_m: f64, y_m: f64 },
    /// The answer of a program for the next control step: the arm holds.
    Hold {
        /// At most 200 bytes.
        reason: String,
    },
    /// Joint angles at the next tick, from a program for a UR5.
    Servo {
        #[cfg_attr(feature = "schema", schema(value_type = [f64; 6]))]
        joints_rad: Joints,
    },
    /// At the next tick the arm is where a robot outside of Ferry is. A tick without this moves the simulated arm.
    Mirror {
        #[cfg_attr(feature = "schema", schema(value_type = [f64; 6]))]
        joints_rad: Joints,
        /// Whether the robot follows Ferry's controllers. If not, something else moves it.
        is_driven: bool,
    },
}

/// Finite and on the table.
pub(super) fn check_on_table(field: &'static str, point: Point2<f64>, map: &Map) -> Result<(), InputError> {
    check_finite(field, point)?;
    if map.workspace().contains(point) {
        return Ok(());
    }
    Err(InputError::OutsideWorkspace { field, x_m: point.x, y_m: point.y })
}

/// Finite, on the table, and room for the bead.
pub(super) fn check_place(field: &'static str, point: Point2<f64>, map: &Map) -> Result<(), InputError> {
    check_on_table(field, point, map)?;
    let (x_m, y_m) = (point.x, point.y);
    if map.clearance_m(point) < BEAD_RADIUS_M {
        return Err(InputError::InWall { field, x_m, y_m });
    }
    Ok(())
}

fn check_finite(field: &'static str, point: Point2<f64>) -> Result<(), InputError> {
    let bad = [point.x, point.y].into_iter().find(|value| !value.is_finite());
    bad.map_or(Ok(()), |value| Err(InputError::NotFinite { field, value }))
}

impl Trial {
    /// An operator's input, as [`Self::apply`]. While paused the spring cannot pull the bead, so a release puts it
    /// where the pointer is; the log then holds [`Input::Place`].
    pub fn operate(&mut self, input: Input, is_paused: bool) -> Result<(), InputError> {
        match (&input, self.state.world.plant.hand) {
            (Input::Release, Some(hand)) if is_paused => {
                self.apply(Input::Place { x_m: hand.target_m.x, y_m: hand.target_m.y })
            }
            _ => self.apply(input),
        }
    }

    /// Applies one input between two ticks, or refuses it and changes nothing.
    pub fn apply(&mut self, input: Input) -> Result<(), InputError> {
        // A release is always allowed; while paused it places the bead.
        let holds = self.state.world.plant.hand.is_some();
        let lets_go = holds && matches!(input, Input::Release | Input::Place { .. });
        if self.inputs.len() >= WAITING_MOST && !lets_go {
            return Err(InputError::TooManyWait);
        }
        match &input {
            Input::SetGoal { x_m, y_m } => self.set_goal(Point2::new(*x_m, *y_m))?,
            Input::ClearGoal => self.clear_goal(),
            Input::Drag { x_m, y_m, lift } => self.drag(Point2::new(*x_m, *y_m), *lift)?,
            Input::Place { x_m, y_m } => self.place(Point2::new(*x_m, *y_m))?,
            Input::Release => self.release(),
            Input::SelectController(name) => {
                if *name != self.state.controller {
                    let what = Happening::ControllerSelected { controller: *name };
                    self.events.push(Event::new(self.state.world.tick, what));
                }
                self.state.controller = *name;
                let seed = self.state.world.script.seed(self.scenario.seed);
                self.state.controller_state.carrier = Carrier::new(*name, seed);
            }
            Input::Configure(parameters) => self.configure(parameters)?,
            Input::Disturb(disturbance) => {
                Self::check_disturbance(disturbance, &self.arena.map)?;
                self.apply_disturbance(disturbance);
            }
            Input::Steer { x_m, y_m, approach } => self.steer(Point2::new(*x_m, *y_m), *approach)?,
            Input::Reseed { seed } => self.reseed(*seed),
            Input::Go { x_m, y_m } => {
                let target_m = Point2::new(*x_m, *y_m);
                check_finite("target_m", target_m)?;
                self.answer(Answer::Go { target_m })?;
            }
            Input::Hold { reason } if reason.len() > REASON_BYTES_MOST => {
                return Err(InputError::LongReason { bytes: reason.len() });
            }
            Input::Hold { reason } => self.answer(Answer::Hold { reason: reason.clone() })?,
            Input::Servo { joints_rad } => self.servo(joints_rad)?,
            Input::Mirror { joints_rad, is_driven } => {
                self.mirror(Mirror { joints_rad: *joints_rad, is_driven: *is_driven })?;
            }
        }
        self.inputs.push(input);
        Ok(())
    }

    /// The hand may point anywhere finite; the tool stays inside the workspace.
    fn steer(&mut self, pointer: Point2<f64>, approach: bool) -> Result<(), InputError> {
        check_finite("steer", pointer)?;
        let target_m = self.arena.map.workspace().nearest(pointer);
        let TrialState { controller, controller_state, .. } = &mut self.state;
        let Carrier::You(you) = &mut controller_state.carrier else { return Err(InputError::NotYou(*controller)) };
        you.steer(Steering { target_m, approach });
        Ok(())
    }

    fn answer(&mut self, answer: Answer) -> Result<(), InputError> {
        let TrialState { controller, controller_state, .. } = &mut self.state;
        let Carrier::Program(program) = &mut controller_state.carrier else {
            return Err(InputError::NotProgram(*controller));
        };
        program.answer(answer);
        Ok(())
    }

    fn servo(&mut self, joints_rad: &Joints) -> Result<(), InputError> {
        if self.state.controller != ControllerName::Robot {
            return Err(InputError::NotRobot(self.state.controller));
        }
        let world = &mut self.state.world;
        let here_rad = world.reference.joints_rad().ok_or(JointRefusal::NoJoints)?;
        self.arena.limits(&world.parameters).joints(&here_rad, joints_rad)?;
        world.motion = Motion::Joints(*joints_rad);
        Ok(())
    }

    /// The robot may be anywhere. The first report puts the arm there, without a motion on the way.
    fn mirror(&mut self, mirror: Mirror) -> Result<(), InputError> {
        let world = &mut self.state.world;
        world.reference.joints_rad().ok_or(JointRefusal::NoJoints)?;
        for (joint, &angle_rad) in mirror.joints_rad.iter().enumerate() {
            if !angle_rad.is_finite() {
                return Err(JointRefusal::NotFinite { joint, angle_rad }.into());
            }
            if angle_rad.abs() > JOINT_LIMIT_RAD + MEASURED_BEYOND_RAD {
                return Err(JointRefusal::JointLimit { joint, angle_rad }.into());
            }
        }
        let is_first = world.plant.mirror.replace(mirror).is_none();
        if is_first {
            world.plant.positioner = Positioner::Arm(mirror.joints_rad);
        }
        if is_first || !mirror.is_driven {
            world.motion = Motion::Joints(mirror.joints_rad);
        }
        Ok(())
    }

    fn reseed(&mut self, seed: u64) {
        let TrialState { world, controller_state, .. } = &mut self.state;
        world.script.seed = Some(seed);
        world.tracker.reseed(Stream::Tracker.rng(seed));
        controller_state.carrier.reseed(seed);
    }

    fn set_goal(&mut self, goal: Point2<f64>) -> Result<(), InputError> {
        let (field, map) = ("goal", &self.arena.map);
        check_place(field, goal, map)?;
        let world = &self.state.world;
        let tool_m = Point3::new(goal.x, goal.y, world.parameters.tool_height_m);
        self.arena
            .limits(&world.parameters)
            .position(tool_m, &world.reference)
            .map_err(|refusal| InputError::Reach { field, refusal })?;
        let world = &mut self.state.world;
        world.goal_m = Some(goal);
        world.reached_tick = None;
        world.counters.goal_steps = 0;
        world.counters.held_steps = 0;
        if !matches!(world.phase, Phase::LiftedOff | Phase::Approaching) {
            world.phase = Phase::Transporting;
        }
        self.events.push(Event::new(world.tick, Happening::GoalPlaced { x_m: goal.x, y_m: goal.y }));
        self.start_leg();
        self.state.controller_state.carrier.transport().start_leg();
        Ok(())
    }

    fn clear_goal(&mut self) {
        let world = &mut self.state.world;
        world.goal_m = None;
        world.reached_tick = None;
        self.events.push(Event::new(world.tick, Happening::GoalRemoved));
    }

    /// The pointer may be anywhere finite; the bead goes where walls let it.
    fn drag(&mut self, pointer: Point2<f64>, lift: bool) -> Result<(), InputError> {
        check_finite("drag", pointer)?;
        let target_m = self.arena.map.workspace().nearest(pointer);
        let world = &mut self.state.world;
        let taken = world.plant.hand.is_none();
        let put_down = world.plant.hand.is_some_and(|hand| hand.lift) && !lift;
        world.plant.bead.lifted_off = false;
        world.plant.hand = Some(Hand { target_m, lift });
        if taken {
            world.counters.disturbances += 1;
            self.events.push(Event::new(world.tick, Happening::Taken));
        }
        if taken || put_down {
            self.set_down();
        }
        Ok(())
    }

    fn place(&mut self, pointer: Point2<f64>) -> Result<(), InputError> {
        check_finite("drag", pointer)?;
        let wanted = self.arena.map.workspace().nearest(pointer);
        let (x_m, y_m) = (wanted.x, wanted.y);
        let fit = self.walls().nearest_fit(wanted).ok_or(InputError::InWall { field: "drag", x_m, y_m })?;
        let world = &mut self.state.world;
        let from = world.plant.bead.position_m;
        world.plant.bead = Bead::at(fit);
        if world.plant.hand.take().is_none() {
            world.counters.disturbances += 1;
        }
        self.events.push(Event::new(world.tick, Happening::Placed { distance_m: (fit - from).norm() }));
        Ok(())
    }

    fn release(&mut self) {
        if self.state.world.plant.hand.take().is_some() {
            self.set_down();
            let world = &self.state.world;
            self.events.push(Event::new(world.tick, Happening::Released));
        }
    }

    /// Puts the bead where it fits, nearest to where it is: it may have hung over a wall.
    fn set_down(&mut self) {
        let walls = self.walls();
        let here = self.state.world.plant.bead.position_m;
        if walls.clearance_m(here) < BEAD_RADIUS_M
            && let Some(fit) = walls.nearest_fit(here)
        {
            self.state.world.plant.bead = Bead::at(fit);
        }
    }

    fn configure(&mut self, parameters: &Parameters) -> Result<(), InputError> {
        parameters.check()?;
        let world = &self.state.world;
        let there = Point3::new(world.reference_m.x, world.reference_m.y, parameters.tool_height_m);
        self.arena
            .limits(parameters)
            .position(there, &world.reference)
            .map_err(|refusal| InputError::Reach { field: "parameters", refusal })?;
        self.plant = Plant::new(parameters.plant());
        self.state.world.parameters = parameters.clone();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::EmptyFloor;
    use crate::scenario::Scenario;
    use crate::trial::{Arena, Source};

    #[test]
    fn inputs_while_paused_are_limited() {
        let mut trial = Trial::new(Scenario::idle("open", 1), Arena::shipped("open").unwrap()).unwrap();
        trial.apply(Input::Drag { x_m: 0.0, y_m: -0.4, lift: false }).unwrap();
        for _ in 1..WAITING_MOST {
            trial.apply(Input::ClearGoal).unwrap();
        }
        let before = trial.state().world_hash();
        let goal = Input::SetGoal { x_m: 0.1, y_m: -0.3 };
        assert_eq!(trial.apply(goal.clone()), Err(InputError::TooManyWait));
        assert_eq!(trial.state().world_hash(), before);
        for last in [Input::Release, Input::Place { x_m: 0.0, y_m: -0.4 }] {
            let mut held = trial.clone();
            held.apply(last.clone()).unwrap();
            assert_eq!(held.apply(last), Err(InputError::TooManyWait), "it holds nothing any more");
        }
        trial.apply(Input::Release).unwrap();
        let mut camera = EmptyFloor::default();
        assert_eq!(trial.tick(Source::Camera(&mut camera)).unwrap().inputs.len(), WAITING_MOST + 1);
        trial.apply(goal).unwrap();
    }

    #[test]
    fn the_hand_leads_the_tool_of_you_and_of_no_other_controller() {
        let begin = |controller| {
            let scenario = Scenario { controller, start_m: Some(Point2::new(0.0, -0.35)), ..Scenario::idle("open", 1) };
            Trial::new(scenario, Arena::shipped("open").unwrap()).unwrap()
        };
        let steer = |x_m: f64, approach| Input::Steer { x_m, y_m: -0.35, approach };
        let mut other = begin(ControllerName::Errt);
        let before = other.state().world_hash();
        assert_eq!(other.apply(steer(0.1, false)), Err(InputError::NotYou(ControllerName::Errt)));
        assert_eq!(other.state().world_hash(), before);

        let mut trial = begin(ControllerName::You);
        let mut camera = EmptyFloor::default();
        let mut run = |trial: &mut Trial, ticks: u32| {
            (0..ticks).for_each(|_| drop(trial.tick(Source::Camera(&mut camera)).unwrap()));
            trial.tool_m().x
        };
        assert!(matches!(trial.apply(steer(f64::NAN, false)), Err(InputError::NotFinite { field: "steer", .. })));
        let start_m = run(&mut trial, 100);
        trial.apply(steer(0.03, false)).unwrap();
        // Without a goal, too.
        assert!((run(&mut trial, 250) - 0.03).abs() < 2e-3);
        // The bead is far away: sub-controller 1 flies to it, unless the hand steers that, too.
        trial.apply(Input::Place { x_m: -0.2, y_m: -0.35 }).unwrap();
        let mut by_hand = trial.clone();
        by_hand.apply(steer(0.2, true)).unwrap();
        assert!(run(&mut trial, 250) < start_m - 0.1);
        assert!((run(&mut by_hand, 250) - 0.2).abs() < 2e-3);
    }
}
