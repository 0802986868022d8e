//! RTDE as a client: what Ferry asks a robot for, how it reads the reports, and how it writes targets.

use bytes::Buf;

use super::arm::Spatial;
use super::drive_script::{CHECK_REGISTER, FLANGE_REGISTER, JOINTS_REGISTER, REGISTER};
use super::rtde::{self, kind};
use ferry_core::robot::Joints;

/// What the robot reports, and the types of it. Registers only if Ferry may move the arm.
const OUTPUTS: [(&str, &str); 20] = [
    ("timestamp", "DOUBLE"),
    ("actual_q", "VECTOR6D"),
    ("actual_TCP_pose", "VECTOR6D"),
    ("robot_mode", "INT32"),
    ("safety_mode", "INT32"),
    ("runtime_state", "UINT32"),
    ("output_int_register_24", "INT32"),
    ("input_int_register_24", "INT32"),
    ("output_double_register_24", "DOUBLE"),
    ("output_double_register_25", "DOUBLE"),
    ("output_double_register_26", "DOUBLE"),
    ("output_double_register_27", "DOUBLE"),
    ("output_double_register_28", "DOUBLE"),
    ("output_double_register_29", "DOUBLE"),
    ("output_double_register_30", "DOUBLE"),
    ("output_double_register_31", "DOUBLE"),
    ("output_double_register_32", "DOUBLE"),
    ("output_double_register_33", "DOUBLE"),
    ("output_double_register_34", "DOUBLE"),
    ("output_double_register_35", "DOUBLE"),
];
const READ_ONLY: usize = 6;
/// A little more than a joint's limit.
const ANGLE_MOST_RAD: f64 = 6.3;
const INPUTS: &str = "input_int_register_24,input_double_register_24,input_double_register_25,\
    input_double_register_26,input_double_register_27,input_double_register_28,input_double_register_29,\
    input_int_register_25";
const INPUT_TYPES: &str = "INT32,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,DOUBLE,INT32";

/// Why a connection is given up.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PeerError {
    #[error("it does not speak version 2 of RTDE")]
    Version,
    #[error("it does not know {name}; a CB3 controller needs version 3.9 or later")]
    Unknown { name: String },
    #[error("{name} has the type {found}, not {expected}")]
    Type { name: String, found: String, expected: String },
    #[error("it answers {found} names instead of {expected}")]
    Count { found: usize, expected: usize },
    #[error("another client writes {name} already")]
    InUse { name: String },
    #[error("it does not start to report")]
    NotStarted,
    #[error("a frame of type {kind} has {bytes} bytes, which is too short")]
    Short { kind: u8, bytes: usize },
    #[error("a frame of type {found} came instead of {expected}")]
    Unexpected { found: u8, expected: u8 },
    #[error("actual_q[{joint}] is {angle_rad:e}, it must be within ±{ANGLE_MOST_RAD}")]
    Angle { joint: usize, angle_rad: f64 },
}

/// What the robot says of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Report {
    pub timestamp_s: f64,
    pub joints_rad: Joints,
    /// Where the robot says that its tool is, with the tool that is set on the robot.
    pub tool: Spatial,
    /// 7 while it runs.
    pub robot_mode: i32,
    /// 1 normal, 2 reduced, 3 protective stop.
    pub safety_mode: i32,
    /// 2 while a program runs.
    pub runtime_state: u32,
    /// Of [`super::drive_script`]: the period, as the program reports it, and as Ferry has answered.
    pub period: i32,
    pub answered: i32,
    /// Of the program, too: the flange's pose, and the joints that it was computed from.
    pub flange: Spatial,
    pub flange_joints_rad: Joints,
}

/// A step of the setup: a request, and a check of its answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    Version,
    Outputs,
    Inputs,
    Start,
}

/// What one connection exchanges.
#[derive(Clone, Copy, Debug)]
pub struct Peer {
    /// Whether registers are written.
    writes: bool,
    recipe: u8,
}

impl Peer {
    pub fn new(writes: bool) -> Self {
        Self { writes, recipe: 0 }
    }

    /// The setup, in this order. A connection that only reads asks for no input.
    pub fn steps(&self) -> &'static [Step] {
        match self.writes {
            true => &[Step::Version, Step::Outputs, Step::Inputs, Step::Start],
            false => &[Step::Version, Step::Outputs, Step::Start],
        }
    }

    fn outputs(&self) -> &'static [(&'static str, &'static str)] {
        if self.writes { &OUTPUTS } else { &OUTPUTS[..READ_ONLY] }
    }

    /// The request of a step, without its size.
    pub fn request(&self, step: Step) -> Vec<u8> {
        match step {
            Step::Version => rtde::frame(kind::PROTOCOL_VERSION, &rtde::PROTOCOL.to_be_bytes()),
            Step::Outputs => {
                let names: Vec<_> = self.outputs().iter().map(|(name, _)| *name).collect();
                let names = names.join(",");
                rtde::frame(kind::OUTPUTS, &[&rtde::RATE_MOST_HZ.to_be_bytes()[..], names.as_bytes()].concat())
            }
            Step::Inputs => rtde::frame(kind::INPUTS, INPUTS.as_bytes()),
            Step::Start => rtde::frame(kind::START, &[]),
        }
    }

    /// Whether a frame is the answer of a step. Messages for people may come at any time.
    ///
    /// # Errors
    /// The robot cannot do what Ferry needs.
    pub fn accept(&mut self, step: Step, frame: &[u8]) -> Result<bool, PeerError> {
        let (&found, payload) = frame.split_first().ok_or(PeerError::Short { kind: 0, bytes: 0 })?;
        let expected = self.request(step)[0];
        if found == kind::TEXT_MESSAGE {
            return Ok(false);
        }
        if found != expected {
            return Err(PeerError::Unexpected { found, expected });
        }
        let (&first, types) = payload.split_first().ok_or(PeerError::Short { kind: found, bytes: 0 })?;
        match step {
            Step::Version if first == 1 => {}
            Step::Version => return Err(PeerError::Version),
            Step::Outputs => check_types(types, self.outputs().iter().copied())?,
            Step::Inputs => {
                check_types(types, INPUTS.split(',').zip(INPUT_TYPES.split(',')))?;
                self.recipe = first;
            }
            Step::Start if first == 1 => {}
            Step::Start => return Err(PeerError::NotStarted),
        }
        Ok(true)
    }

    /// The report in a frame; `None` if the frame is a message for people.
    ///
    /// # Errors
    /// The frame cannot be understood.
    pub fn report(&self, frame: &[u8]) -> Result<Option<Report>, PeerError> {
        let (&found, mut payload) = frame.split_first().ok_or(PeerError::Short { kind: 0, bytes: 0 })?;
        match found {
            kind::DATA => {}
            kind::TEXT_MESSAGE => return Ok(None),
            _ => return Err(PeerError::Unexpected { found, expected: kind::DATA }),
        }
        let bytes = 1 + self.outputs().iter().map(|(_, kind)| bytes_of(kind)).sum::<usize>();
        if payload.len() < bytes {
            return Err(PeerError::Short { kind: kind::DATA, bytes: payload.len() });
        }
        // The number of the only recipe.
        payload.advance(1);
        let mut report = Report { timestamp_s: payload.get_f64(), ..Report::default() };
        for (joint, angle_rad) in report.joints_rad.iter_mut().enumerate() {
            *angle_rad = payload.get_f64();
            if angle_rad.is_nan() || angle_rad.abs() > ANGLE_MOST_RAD {
                return Err(PeerError::Angle { joint, angle_rad: *angle_rad });
            }
        }
        report.tool = six(&mut payload);
        (report.robot_mode, report.safety_mode) = (payload.get_i32(), payload.get_i32());
        report.runtime_state = payload.get_u32();
        if self.writes {
            (report.period, report.answered) = (payload.get_i32(), payload.get_i32());
            (report.flange, report.flange_joints_rad) = (six(&mut payload), six(&mut payload));
        }
        Ok(Some(report))
    }

    /// A frame that writes a target, and the period that it answers.
    pub fn target(&self, period: i32, joints_rad: &Joints) -> Vec<u8> {
        let (first, last) = (period.to_be_bytes(), period.wrapping_neg().to_be_bytes());
        let joints = joints_rad.map(f64::to_be_bytes);
        rtde::frame(kind::DATA, &[&[self.recipe][..], &first, joints.as_flattened(), &last].concat())
    }
}

const _: () = assert!(
    REGISTER == 24 && CHECK_REGISTER == 25 && FLANGE_REGISTER == 24 && JOINTS_REGISTER == 30,
    "the names above have these numbers"
);

fn six(payload: &mut &[u8]) -> Spatial {
    std::array::from_fn(|_| payload.get_f64())
}

fn bytes_of(kind: &str) -> usize {
    match kind {
        "DOUBLE" => 8,
        "VECTOR6D" => 48,
        _ => 4,
    }
}

fn check_types<'a>(types: &[u8], wanted: impl Iterator<Item = (&'a str, &'a str)> + Clone) -> Result<(), PeerError> {
    let types = String::from_utf8_lossy(types);
    let found: Vec<&str> = types.split(',').filter(|one| !one.is_empty()).collect();
    for (one, (name, expected)) in found.iter().zip(wanted.clone()) {
        match *one {
            "NOT_FOUND" => return Err(PeerError::Unknown { name: name.to_owned() }),
            "IN_USE" => return Err(PeerError::InUse { name: name.to_owned() }),
            one if one != expected => {
                let found = one.chars().take(20).collect();
                return Err(PeerError::Type { name: name.to_owned(), found, expected: expected.to_owned() });
            }
            _ => {}
        }
    }
    let expected = wanted.count();
    if found.len() != expected {
        return Err(PeerError::Count { found: found.len(), expected });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controller::Controller;
    use crate::{Arm, rtde::Client};
    use proptest::prelude::*;

    fn answer(step: Step, payload: &[u8]) -> Result<bool, PeerError> {
        let mut peer = Peer::new(true);
        let kind = peer.request(step)[0];
        peer.accept(step, &rtde::frame(kind, payload))
    }

    /// Both sides of RTDE in this crate understand each other.
    #[test]
    fn reports_and_targets_arrive() {
        for writes in [true, false] {
            let (mut peer, mut client, mut robot) = (Peer::new(writes), Client::new(1), Controller::default());
            for &step in peer.steps() {
                let answer = client.answer(&peer.request(step), &mut robot).unwrap().unwrap();
                assert_eq!(peer.accept(step, &rtde::frame(kind::TEXT_MESSAGE, b"\x05hello\x01a\x03")), Ok(false));
                assert_eq!(peer.accept(step, &answer), Ok(true), "{step:?}");
            }
            let actual_q_rad = [1.0, -2.0, 3.0, -4.0, 5.0, -6.0];
            let actual_tool = [0.1, -0.35, 0.28, 2.2, -2.2, 0.0];
            let arm = Arm { time_s: 2.5, has_joints: true, actual_q_rad, actual_tool, ..Arm::default() };
            let mut expected = Report {
                timestamp_s: 2.5,
                joints_rad: actual_q_rad,
                tool: actual_tool,
                robot_mode: 7,
                safety_mode: 1,
                runtime_state: 1,
                ..Report::default()
            };
            if writes {
                client.answer(&peer.target(41, &[0.5; 6]), &mut robot).unwrap();
                assert_eq!((robot.inputs().int[REGISTER], robot.inputs().six(REGISTER)), (41, [0.5; 6]));
                assert_eq!(robot.inputs().int[CHECK_REGISTER], -41);
                expected.answered = 41;
            }
            assert_eq!(peer.report(&client.data(&arm, &robot).unwrap()), Ok(Some(expected)));
        }
    }

    #[test]
    fn a_robot_that_cannot_do_it_is_refused_by_name() {
        assert_eq!(answer(Step::Version, &[0]), Err(PeerError::Version));
        let types = |types: &str| answer(Step::Outputs, &[&[1], types.as_bytes()].concat());
        let registers = ",DOUBLE".repeat(12);
        assert_eq!(types(&format!("DOUBLE,VECTOR6D,VECTOR6D,INT32,INT32,UINT32,INT32,INT32{registers}")), Ok(true));
        let old = types("DOUBLE,VECTOR6D,VECTOR6D,INT32,INT32,UINT32,NOT_FOUND,NOT_FOUND");
        assert_eq!(old, Err(PeerError::Unknown { name: "output_int_register_24".to_owned() }));
        assert_eq!(types("DOUBLE,VECTOR6D"), Err(PeerError::Count { found: 2, expected: 20 }));
        let other = types("DOUBLE,VECTOR3D,VECTOR6D,INT32,INT32,UINT32,INT32,INT32").unwrap_err();
        assert_eq!(other.to_string(), "actual_q has the type VECTOR3D, not VECTOR6D");
        let taken = answer(Step::Inputs, &[&[0], "IN_USE".as_bytes()].concat());
        assert_eq!(taken, Err(PeerError::InUse { name: "input_int_register_24".to_owned() }));
        assert_eq!(answer(Step::Start, &[0]), Err(PeerError::NotStarted));
        assert_eq!(answer(Step::Start, &[]), Err(PeerError::Short { kind: b'S', bytes: 0 }));
        let other = Peer::new(true).accept(Step::Start, b"V\x01");
        assert_eq!(other, Err(PeerError::Unexpected { found: b'V', expected: b'S' }));
        let nowhere = Arm { actual_q_rad: [0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0], ..Arm::default() };
        let (mut client, peer) = (Client::new(1), Peer::new(false));
        assert_eq!(peer.report(b"M\x01a\x01b\x03"), Ok(None));
        assert_eq!(peer.report(b"U\x01"), Err(PeerError::Short { kind: b'U', bytes: 1 }));
        assert!(matches!(peer.report(&[0, 99, 1]), Err(PeerError::Unexpected { found: 0, .. })));
        for step in [Step::Version, Step::Outputs] {
            client.answer(&peer.request(step), &mut Controller::default()).unwrap();
        }
        let report = peer.report(&client.data(&nowhere, &Controller::default()).unwrap());
        assert!(matches!(report, Err(PeerError::Angle { joint: 1, .. })));
    }

    proptest! {
        #[test]
        fn any_bytes_are_understood_or_refused(frame in prop::collection::vec(any::<u8>(), 0..300), cut in 0..300_usize) {
            for writes in [true, false] {
                let mut peer = Peer::new(writes);
                for &step in peer.steps() {
                    let _ = peer.accept(step, &frame);
                }
                let data = rtde::frame(kind::DATA, &frame[..cut.min(frame.len())]);
                if let Ok(Some(report)) = peer.report(&data) {
                    prop_assert!(report.joints_rad.iter().all(|angle| angle.abs() <= ANGLE_MOST_RAD));
                }
            }
        }
    }
}
