//! The Real-Time Data Exchange: frames, and the recipes by which a client chooses what it gets. Big-endian; protocol
//! versions 1 and 2. Version 1, which a client speaks until it asks for another, has no rate and no recipe's number for
//! outputs.

mod outputs;

pub use outputs::Output;

use bytes::Buf;
use tokio_util::codec::LengthDelimitedCodec;

use super::Arm;
use super::controller::{ClientId, Controller};
use super::dashboard::VERSION;
use super::inputs::Input;

/// The newest protocol version.
pub(super) const PROTOCOL: u16 = 2;
/// The rate of a CB3 controller.
pub const RATE_MOST_HZ: f64 = 125.0;
/// Names in a recipe.
const NAMES_MOST: usize = 256;
/// Bytes of a message for people; its length is one byte.
const TEXT_BYTES_MOST: usize = 255;
const WARNING: u8 = 2;
/// Input recipes of a client.
const RECIPES_MOST: usize = 64;

/// Types of frames.
pub(super) mod kind {
    pub const PROTOCOL_VERSION: u8 = b'V';
    pub const CONTROLLER_VERSION: u8 = b'v';
    pub const TEXT_MESSAGE: u8 = b'M';
    pub const DATA: u8 = b'U';
    pub const OUTPUTS: u8 = b'O';
    pub const INPUTS: u8 = b'I';
    pub const START: u8 = b'S';
    pub const PAUSE: u8 = b'P';
}

/// Why a connection is closed: what follows cannot be understood.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrameError {
    #[error("a frame has no type")]
    NoType,
    #[error("a frame of type {kind} is too short: {bytes} bytes of payload")]
    Short { kind: u8, bytes: usize },
    #[error("data for recipe {recipe} has {bytes} bytes, it must have {expected}")]
    Data { recipe: u8, bytes: usize, expected: usize },
    #[error("data for recipe {recipe}, which was not set up")]
    NoRecipe { recipe: u8 },
}

/// How frames lie in a stream: the size comes first, and counts itself.
pub fn framing() -> LengthDelimitedCodec {
    LengthDelimitedCodec::builder()
        .length_field_type::<u16>()
        .length_adjustment(-2)
        .max_frame_length(usize::from(u16::MAX))
        .new_codec()
}

/// The state of one client's connection.
#[derive(Debug, Default)]
pub struct Client {
    id: ClientId,
    is_version_2: bool,
    outputs: Option<Recipe>,
    /// What it writes, by the recipe's number, from 1; empty ones were refused.
    inputs: Vec<Vec<Input>>,
    is_started: bool,
}

/// What a client gets, and how often.
#[derive(Clone, Debug, PartialEq)]
struct Recipe {
    outputs: Vec<Output>,
    rate_hz: f64,
}

/// A frame without its size.
pub(super) fn frame(kind: u8, payload: &[u8]) -> Vec<u8> {
    [&[kind], payload].concat()
}

impl Client {
    pub fn new(id: ClientId) -> Self {
        Self { id, ..Self::default() }
    }

    /// The answer to a frame, if there is one. Both are without their sizes, see [`framing`].
    ///
    /// # Errors
    /// [`FrameError`]; then nothing was written.
    pub fn answer(&mut self, frame_in: &[u8], robot: &mut Controller) -> Result<Option<Vec<u8>>, FrameError> {
        let (&kind, mut payload) = frame_in.split_first().ok_or(FrameError::NoType)?;
        let short = FrameError::Short { kind, bytes: payload.len() };
        Ok(Some(match kind {
            kind::PROTOCOL_VERSION => {
                let wanted = payload.try_get_u16().map_err(|_| short)?;
                let is_spoken = (1..=PROTOCOL).contains(&wanted);
                if is_spoken {
                    self.is_version_2 = wanted == 2;
                    (self.outputs, self.is_started) = (None, false);
                }
                frame(kind, &[u8::from(is_spoken)])
            }
            kind::CONTROLLER_VERSION => frame(kind, &VERSION.map(u32::to_be_bytes).concat()),
            kind::OUTPUTS => {
                let rate_hz = match self.is_version_2 {
                    true => payload.try_get_f64().map_err(|_| short)?,
                    false => RATE_MOST_HZ,
                };
                self.choose(rate_hz, &names(payload))
            }
            kind::INPUTS => self.claim(&names(payload), robot),
            kind::START => {
                self.is_started = self.outputs.is_some();
                frame(kind, &[u8::from(self.is_started)])
            }
            kind::PAUSE => {
                self.is_started = false;
                frame(kind, &[1])
            }
            kind::DATA => {
                let recipe = payload.try_get_u8().map_err(|_| short)?;
                self.write(recipe, payload, robot)?;
                return Ok(None);
            }
            kind::TEXT_MESSAGE => return Ok(None),
            _ => self.message(&format!("Ferry does not know the type {kind}")),
        }))
    }

    /// A message for people, as a frame: a warning.
    pub fn message(&self, text: &str) -> Vec<u8> {
        let (text, source) = (&text[..text.floor_char_boundary(TEXT_BYTES_MOST)], "Ferry");
        let parts = match self.is_version_2 {
            true => [&[text.len() as u8][..], text.as_bytes(), &[source.len() as u8], source.as_bytes(), &[WARNING]],
            false => [&[WARNING][..], text.as_bytes(), &[], &[], &[]],
        };
        frame(kind::TEXT_MESSAGE, &parts.concat())
    }

    fn choose(&mut self, rate_hz: f64, names: &[String]) -> Vec<u8> {
        let found: Vec<Option<Output>> = names.iter().map(|name| Output::named(name)).collect();
        let types: Vec<_> = found.iter().map(|output| output.map_or("NOT_FOUND", Output::type_name)).collect();
        let outputs: Option<Vec<Output>> = found.into_iter().collect();
        let is_usable = rate_hz > 0.0 && !names.is_empty() && names.len() <= NAMES_MOST;
        self.is_started = false;
        self.outputs =
            outputs.filter(|_| is_usable).map(|outputs| Recipe { outputs, rate_hz: rate_hz.min(RATE_MOST_HZ) });
        let answer = recipe_answer(u8::from(self.outputs.is_some()), &types);
        frame(kind::OUTPUTS, if self.is_version_2 { &answer } else { &answer[1..] })
    }

    /// Sets up an input recipe. Its number is taken also if it is refused, so that those that follow keep theirs.
    fn claim(&mut self, names: &[String], robot: &mut Controller) -> Vec<u8> {
        let found: Vec<Option<Input>> = names.iter().map(|name| Input::named(name)).collect();
        let is_usable = !names.is_empty() && names.len() <= NAMES_MOST && self.inputs.len() < RECIPES_MOST;
        let mut types = Vec::new();
        let mut inputs = Vec::new();
        for input in found {
            types.push(match input {
                None => "NOT_FOUND",
                Some(input) if is_usable && robot.claim(input, self.id) => {
                    inputs.push(input);
                    input.type_name()
                }
                Some(_) => "IN_USE",
            });
        }
        let is_complete = is_usable && inputs.len() == names.len();
        if self.inputs.len() < RECIPES_MOST {
            self.inputs.push(if is_complete { inputs } else { Vec::new() });
        }
        let number = if is_complete { self.inputs.len() as u8 } else { 0 };
        frame(kind::INPUTS, &recipe_answer(number, &types))
    }

    fn write(&self, recipe: u8, mut payload: &[u8], robot: &mut Controller) -> Result<(), FrameError> {
        let inputs = usize::from(recipe).checked_sub(1).and_then(|place| self.inputs.get(place));
        let inputs = inputs.filter(|inputs| !inputs.is_empty()).ok_or(FrameError::NoRecipe { recipe })?;
        let expected = inputs.iter().map(|input| input.bytes()).sum();
        if payload.len() != expected {
            return Err(FrameError::Data { recipe, bytes: payload.len(), expected });
        }
        robot.write(inputs, &mut payload);
        Ok(())
    }

    /// Ticks between two data frames, while they are sent.
    pub fn every_ticks(&self) -> Option<u64> {
        let recipe = self.outputs.as_ref().filter(|_| self.is_started)?;
        Some((RATE_MOST_HZ / recipe.rate_hz).round().max(1.0) as u64)
    }

    /// A frame with the values that the client has chosen; `None` without a recipe.
    pub fn data(&self, arm: &Arm, robot: &Controller) -> Option<Vec<u8>> {
        let recipe = self.outputs.as_ref()?;
        let mut payload = if self.is_version_2 { vec![1] } else { Vec::new() };
        recipe.outputs.iter().for_each(|output| output.write(arm, robot, &mut payload));
        Some(frame(kind::DATA, &payload))
    }
}

/// Names in a list with commas, which may end with one.
fn names(list: &[u8]) -> Vec<String> {
    let list = String::from_utf8_lossy(list);
    let parts = list.split(',').map(str::trim).filter(|name| !name.is_empty());
    parts.take(NAMES_MOST + 1).map(str::to_owned).collect()
}

fn recipe_answer(id: u8, types: &[&str]) -> Vec<u8> {
    [&[id][..], types.join(",").as_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytes::{Bytes, BytesMut};
    use proptest::prelude::*;
    use tokio_util::codec::{Decoder, Encoder};

    fn outputs(rate_hz: f64, names: &str) -> Vec<u8> {
        [&rate_hz.to_be_bytes()[..], names.as_bytes()].concat()
    }

    fn version_2() -> Client {
        Client { is_version_2: true, ..Client::default() }
    }

    fn answered(client: &mut Client, kind: u8, payload: &[u8]) -> Vec<u8> {
        let answer = client.answer(&frame(kind, payload), &mut Controller::default()).unwrap().unwrap();
        assert_eq!(answer[0], kind);
        answer[1..].to_vec()
    }

    #[test]
    fn a_client_gets_what_it_has_chosen() {
        let mut client = Client::default();
        assert_eq!(answered(&mut client, b'V', &[0, 3]), [0]);
        assert_eq!(answered(&mut client, b'V', &[0, 2]), [1]);
        assert_eq!(answered(&mut client, b'v', &[]), [0, 0, 0, 3, 0, 0, 0, 15, 0, 0, 0, 8, 0, 0, 0, 0]);
        assert_eq!(answered(&mut client, b'S', &[]), [0], "nothing is chosen");
        assert_eq!(client.data(&Arm::default(), &Controller::default()), None);
        let chosen = answered(&mut client, b'O', &outputs(62.5, "timestamp,actual_q,robot_mode,"));
        assert_eq!(chosen, [&[1], "DOUBLE,VECTOR6D,INT32".as_bytes()].concat());
        assert_eq!(client.every_ticks(), None, "not started");
        assert_eq!(answered(&mut client, b'S', &[]), [1]);
        assert_eq!(client.every_ticks(), Some(2));
        let arm = Arm { time_s: 1.5, has_joints: true, actual_q_rad: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], ..Arm::default() };
        let data = client.data(&arm, &Controller::default()).unwrap();
        let mut payload = &data[..];
        assert_eq!((payload.get_u8(), payload.get_u8(), payload.get_f64()), (b'U', 1, 1.5));
        assert_eq!(std::array::from_fn::<_, 6, _>(|_| payload.get_f64()), arm.actual_q_rad);
        assert_eq!((payload.get_i32(), payload.len()), (7, 0));
        assert_eq!(answered(&mut client, b'P', &[]), [1]);
        assert_eq!(client.every_ticks(), None);
    }

    #[test]
    fn version_1_has_no_rate_and_no_number_of_the_recipe() {
        let mut client = Client::default();
        for _ in 0..2 {
            assert_eq!(answered(&mut client, b'O', b"robot_mode,wings"), b"INT32,NOT_FOUND");
            assert_eq!(answered(&mut client, b'O', b"timestamp,robot_mode"), b"DOUBLE,INT32");
            assert_eq!(answered(&mut client, b'S', &[]), [1]);
            assert_eq!(client.every_ticks(), Some(1));
            let arm = Arm { time_s: 1.5, has_joints: true, ..Arm::default() };
            let data = client.data(&arm, &Controller::default()).unwrap();
            assert_eq!(data, [&b"U"[..], &1.5_f64.to_be_bytes(), &7_i32.to_be_bytes()].concat());
            assert_eq!(client.message("no"), b"M\x02no");
            assert_eq!(answered(&mut client, b'V', &[0, 1]), [1]);
            assert_eq!(client.data(&arm, &Controller::default()), None, "another version, another recipe");
        }
        let long = "é".repeat(200);
        assert_eq!(version_2().message(&long), [&b"M\xfe"[..], "é".repeat(127).as_bytes(), b"\x05Ferry\x02"].concat());
    }

    #[test]
    fn unknown_names_and_rates_leave_nothing_chosen() {
        let mut client = version_2();
        let chosen = answered(&mut client, b'O', &outputs(125.0, "actual_q,wings"));
        assert_eq!(chosen, [&[0], "VECTOR6D,NOT_FOUND".as_bytes()].concat());
        for rate_hz in [0.0, -1.0, f64::NAN] {
            assert_eq!(answered(&mut client, b'O', &outputs(rate_hz, "actual_q"))[0], 0, "{rate_hz}");
        }
        assert_eq!(answered(&mut client, b'S', &[]), [0]);
        let many = vec!["actual_q"; NAMES_MOST + 1].join(",");
        assert_eq!(answered(&mut client, b'O', &outputs(125.0, &many))[0], 0);
        assert_eq!(
            client.answer(&[b'O', 0, 0], &mut Controller::default()),
            Err(FrameError::Short { kind: b'O', bytes: 2 })
        );
        assert_eq!(client.answer(&[], &mut Controller::default()), Err(FrameError::NoType));
        assert_eq!(client.answer(b"X", &mut Controller::default()).unwrap().unwrap()[0], b'M');
    }

    #[test]
    fn registers_are_claimed_and_written() {
        let (mut first, mut second, mut robot) = (Client::new(1), Client::new(2), Controller::default());
        let setup = |client: &mut Client, names: &str, robot: &mut Controller| {
            client.answer(&frame(b'I', names.as_bytes()), robot).unwrap().unwrap()[1..].to_vec()
        };
        assert_eq!(
            setup(&mut first, "input_int_register_0,wings", &mut robot),
            [&[0], "INT32,NOT_FOUND".as_bytes()].concat()
        );
        let types = "INT32,DOUBLE,VECTOR6D".as_bytes();
        let names = "input_int_register_0,input_double_register_1,external_force_torque,";
        assert_eq!(
            setup(&mut first, names, &mut robot),
            [&[2], types].concat(),
            "the number of the refused one is taken"
        );
        assert_eq!(setup(&mut second, "input_int_register_0", &mut robot), [&[0], "IN_USE".as_bytes()].concat());
        assert_eq!(setup(&mut second, "input_int_register_1", &mut robot), [&[2], "INT32".as_bytes()].concat());
        let data = [&[b'U', 2][..], &7_i32.to_be_bytes(), &0.5_f64.to_be_bytes(), &[0; 48]].concat();
        assert_eq!(first.answer(&data, &mut robot), Ok(None));
        assert_eq!((robot.inputs().int[0], robot.inputs().double[1]), (7, 0.5));
        let before = robot.inputs().clone();
        let short = first.answer(&data[..20], &mut robot);
        assert_eq!(short, Err(FrameError::Data { recipe: 2, bytes: 18, expected: 60 }));
        assert_eq!(first.answer(&[b'U', 1, 0], &mut robot), Err(FrameError::NoRecipe { recipe: 1 }));
        assert_eq!(second.answer(&[b'U', 9], &mut robot), Err(FrameError::NoRecipe { recipe: 9 }));
        assert_eq!(robot.inputs(), &before);
        // A client that leaves frees its registers.
        robot.disconnect(1);
        assert_eq!(setup(&mut second, "input_int_register_0", &mut robot), [&[3], "INT32".as_bytes()].concat());
    }

    #[test]
    fn the_size_of_a_frame_counts_itself_and_the_type() {
        let mut stream = BytesMut::new();
        framing().encode(Bytes::from(frame(b'V', &[0, 2])), &mut stream).unwrap();
        assert_eq!(stream[..], [0, 5, b'V', 0, 2]);
        stream.extend_from_slice(&[0, 4]);
        assert_eq!(framing().decode(&mut stream).unwrap().unwrap()[..], [b'V', 0, 2]);
        assert_eq!(framing().decode(&mut stream).unwrap(), None, "the rest has not arrived");
        assert!(framing().decode(&mut BytesMut::from(&[0, 1, b'V'][..])).is_err());
    }

    proptest! {
        #[test]
        fn any_frame_is_answered_or_refused(frames in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..40), 0..8)) {
            let (mut client, mut robot) = (Client::default(), Controller::default());
            for received in frames {
                if let Ok(Some(answer)) = client.answer(&received, &mut robot) {
                    prop_assert!(!answer.is_empty() && answer.len() < 10_000);
                }
                prop_assert_eq!(client.data(&Arm::default(), &Controller::default()).is_some(), client.outputs.is_some());
            }
        }
    }
}
