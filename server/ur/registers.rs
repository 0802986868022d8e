//! The general-purpose registers, by which a client and a program on the controller talk.

use super::arm::Spatial;

/// Registers of each type.
pub const REGISTERS: usize = 48;

#[derive(Clone, Debug, PartialEq)]
pub struct Registers {
    pub int: [i32; REGISTERS],
    pub double: [f64; REGISTERS],
    /// Whether the speed slider is set from outside.
    pub is_speed_set: bool,
    pub speed_fraction: f64,
}

impl Default for Registers {
    fn default() -> Self {
        Self { int: [0; REGISTERS], double: [0.0; REGISTERS], is_speed_set: false, speed_fraction: 1.0 }
    }
}

impl Registers {
    /// Six numbers from this register on; they exist.
    pub fn six(&self, from: usize) -> Spatial {
        std::array::from_fn(|i| self.double[from + i])
    }

    pub fn set_six(&mut self, from: usize, values: Spatial) {
        self.double[from..from + 6].copy_from_slice(&values);
    }

    /// The speed slider: 0 to 1.
    pub fn fraction(&self) -> f64 {
        let is_usable = self.is_speed_set && (0.0..=1.0).contains(&self.speed_fraction);
        if is_usable { self.speed_fraction } else { 1.0 }
    }
}
