//! An opened test case: its inputs are applied at their ticks, like those of an operator.

use crate::trial::{Expectation, Input, Timed};

/// The part of a case that a scenario does not contain.
#[derive(Debug)]
pub struct OpenedCase {
    pub about: String,
    pub expect: Option<Expectation>,
    /// In order of ticks.
    inputs: Vec<Timed>,
}

impl OpenedCase {
    pub(super) fn new(about: String, mut inputs: Vec<Timed>, expect: Option<Expectation>) -> Self {
        let mut last = 0;
        // `Case::run` applies an input that comes too early in the file after those before it.
        for timed in &mut inputs {
            last = last.max(timed.tick);
            timed.tick = last;
        }
        Self { about, expect, inputs }
    }

    pub fn inputs(&self) -> &[Timed] {
        &self.inputs
    }

    /// The inputs from a tick on.
    pub(super) fn inputs_from(&self, tick: u64) -> &[Timed] {
        &self.inputs[self.inputs.partition_point(|timed| timed.tick < tick)..]
    }

    /// Whether the hand holds the bead after the inputs of this tick.
    pub(super) fn holds_at(&self, tick: u64) -> bool {
        let applied = &self.inputs[..self.inputs.partition_point(|timed| timed.tick <= tick)];
        let holds = applied.iter().rev().find_map(|timed| match timed.input {
            Input::Drag { .. } => Some(true),
            Input::Place { .. } | Input::Release => Some(false),
            _ => None,
        });
        holds.unwrap_or(false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_in_order_of_ticks_and_the_hand_holds_until_its_release() {
        let drag = |tick, x_m| Timed { tick, input: Input::Drag { x_m, y_m: 0.0, lift: false } };
        let inputs = vec![drag(3, 0.0), drag(10, 0.1), drag(5, 0.2), Timed { tick: 20, input: Input::Release }];
        let case = OpenedCase::new(String::new(), inputs, None);
        assert_eq!(case.inputs().iter().map(|timed| timed.tick).collect::<Vec<_>>(), [3, 10, 10, 20]);
        assert_eq!(case.inputs_from(4).len(), 3);
        assert_eq!(case.inputs_from(21).len(), 0);
        assert_eq!([2, 3, 19, 20].map(|tick| case.holds_at(tick)), [false, true, true, false]);
    }
}
