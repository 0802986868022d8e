//! The last steps of all lanes.

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use ferry_core::policy::Survey;

/// One step, or the survey that an episode which ran out of steps ended with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    pub survey: Survey,
    /// `None` for the end of an episode that ran out of steps.
    pub step: Option<Step>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Step {
    pub action: u8,
    pub reward: f32,
    /// Whether the return ends here.
    pub terminal: bool,
    /// The values of the actions by the teacher.
    pub taught: [f32; 4],
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurveyReplay {
    /// A ring for each lane.
    lanes: Vec<Vec<Entry>>,
    /// Oldest entry of each full ring.
    oldest: Vec<usize>,
    each: usize,
}

impl SurveyReplay {
    pub fn new(lanes: usize, capacity: usize) -> Self {
        Self { lanes: vec![Vec::new(); lanes], oldest: vec![0; lanes], each: (capacity / lanes).max(2) }
    }

    pub fn len(&self) -> usize {
        self.lanes.iter().map(Vec::len).sum()
    }

    pub fn push(&mut self, lane: usize, entry: Entry) {
        let ring = &mut self.lanes[lane];
        if ring.len() < self.each {
            ring.push(entry);
        } else {
            ring[self.oldest[lane]] = entry;
            self.oldest[lane] = (self.oldest[lane] + 1) % self.each;
        }
    }

    /// A random step and the survey after it. For a terminal step the latter has no meaning.
    pub fn draw(&self, rng: &mut impl Rng) -> (&Survey, Step, &Survey) {
        loop {
            let lane = rng.random_range(0..self.lanes.len());
            let ring = &self.lanes[lane];
            // The newest has no successor yet.
            let age = rng.random_range(0..ring.len());
            if age + 1 == ring.len() {
                continue;
            }
            let at = |age: usize| &ring[(self.oldest[lane] + age) % ring.len()];
            if let Entry { survey, step: Some(step) } = at(age) {
                return (survey, *step, &at(age + 1).survey);
            }
        }
    }
}
