//! The teacher: a planner that knows only what the policy knows, and takes everything unseen as free. A teacher that
//! knew the whole maze would ask for what the policy cannot know (the imitation gap, Weihs et al. 2021).

use super::lattice::{UNREACHABLE, steps_to};
use ferry_core::perception::Area;
use ferry_core::policy::{Action, Survey};

/// Steps to the goal by the teacher, from the tool's cell and after each action; `None` into a wall or without a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    pub here: Option<u16>,
    pub after: [Option<u16>; 4],
}

impl Advice {
    pub fn on(survey: &Survey) -> Self {
        let (columns, _) = survey.shape();
        let is_free = |cell: usize| survey.known(cell) != Area::Blocked;
        let steps = steps_to(columns, survey.count(), survey.goal, is_free);
        let of = |cell: usize| Some(steps[cell]).filter(|&steps| steps != UNREACHABLE);
        let after = Action::ALL.map(|action| {
            let next = survey.beside(survey.tool, action)?;
            if is_free(next) { of(next) } else { None }
        });
        Self { here: of(survey.tool).or_else(|| after.iter().flatten().min().map(|steps| steps + 1)), after }
    }
}
