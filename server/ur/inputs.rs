//! What a client may write, by name: registers, and the speed slider. Ferry has no digital or analog outputs and no force
//! sensor: they are accepted, because clients ask for them when they connect, and have no effect.

use bytes::Buf;

use super::registers::{REGISTERS, Registers};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    Int(usize),
    Double(usize),
    SpeedMask,
    SpeedFraction,
    /// Bytes that have no effect, and their type.
    Without(usize, &'static str),
}

/// Names that have no effect.
const WITHOUT: [(&str, Input); 12] = [
    ("standard_digital_output_mask", Input::Without(1, "UINT8")),
    ("standard_digital_output", Input::Without(1, "UINT8")),
    ("configurable_digital_output_mask", Input::Without(1, "UINT8")),
    ("configurable_digital_output", Input::Without(1, "UINT8")),
    ("tool_digital_output_mask", Input::Without(1, "UINT8")),
    ("tool_digital_output", Input::Without(1, "UINT8")),
    ("standard_analog_output_mask", Input::Without(1, "UINT8")),
    ("standard_analog_output_type", Input::Without(1, "UINT8")),
    ("standard_analog_output_0", Input::Without(8, "DOUBLE")),
    ("standard_analog_output_1", Input::Without(8, "DOUBLE")),
    ("external_force_torque", Input::Without(48, "VECTOR6D")),
    ("input_bit_registers0_to_31", Input::Without(4, "UINT32")),
];

impl Input {
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "speed_slider_mask" => return Some(Self::SpeedMask),
            "speed_slider_fraction" => return Some(Self::SpeedFraction),
            _ => {}
        }
        if let Some((_, input)) = WITHOUT.iter().find(|(known, _)| *known == name) {
            return Some(*input);
        }
        let (kind, number) = name.strip_prefix("input_")?.split_once("_register_")?;
        let number = number.parse().ok().filter(|number| *number < REGISTERS)?;
        match kind {
            "int" => Some(Self::Int(number)),
            "double" => Some(Self::Double(number)),
            _ => None,
        }
    }

    /// RTDE's name of its type.
    pub fn type_name(self) -> &'static str {
        match self {
            Self::Int(_) => "INT32",
            Self::SpeedMask => "UINT32",
            Self::Double(_) | Self::SpeedFraction => "DOUBLE",
            Self::Without(_, name) => name,
        }
    }

    /// Length of its value.
    pub fn bytes(self) -> usize {
        match self {
            Self::Int(_) | Self::SpeedMask => 4,
            Self::Double(_) | Self::SpeedFraction => 8,
            Self::Without(bytes, _) => bytes,
        }
    }

    /// Takes its value from `payload`, which must be long enough.
    pub fn read(self, payload: &mut &[u8], registers: &mut Registers) {
        match self {
            Self::Int(number) => registers.int[number] = payload.get_i32(),
            Self::Double(number) => registers.double[number] = payload.get_f64(),
            Self::SpeedMask => registers.is_speed_set = payload.get_u32() != 0,
            Self::SpeedFraction => registers.speed_fraction = payload.get_f64(),
            Self::Without(bytes, _) => payload.advance(bytes),
        }
    }
}
