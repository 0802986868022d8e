//! Prioritised replay (Schaul et al. 2016): a ring of transitions and a sum tree of their priorities. Transitions hold
//! cell numbers; the images are in the sweep.

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

use super::environment::{Ending, Goal};

/// Priorities with partial sums. Finds an index by its share of the total in log₂ n steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SumTree {
    /// A full binary tree: root at index 1, leaves in the second half.
    sums: Vec<f64>,
}

impl SumTree {
    /// All zeros, for `capacity` leaves.
    pub fn new(capacity: usize) -> Self {
        Self { sums: vec![0.0; 2 * capacity.next_power_of_two()] }
    }

    /// Sum of all leaves.
    pub fn total(&self) -> f64 {
        self.sums[1]
    }

    /// The value of a leaf.
    pub fn get(&self, index: usize) -> f64 {
        self.sums[self.sums.len() / 2 + index]
    }

    /// Sets a leaf. Sums are recomputed from the leaves, not by differences, so that they do not drift.
    pub fn set(&mut self, index: usize, value: f64) {
        let mut node = self.sums.len() / 2 + index;
        self.sums[node] = value;
        while node > 1 {
            node /= 2;
            self.sums[node] = self.sums[2 * node] + self.sums[2 * node + 1];
        }
    }

    /// The leaf where the running sum passes `mass`, 0 to the total; never a leaf of zero.
    pub fn find(&self, mut mass: f64) -> usize {
        let mut node = 1;
        while node < self.sums.len() / 2 {
            let left = 2 * node;
            // After rounding, `mass` may slightly exceed the right side's sum. A side of zero is never entered.
            node = if mass < self.sums[left] || self.sums[left + 1] == 0.0 {
                left
            } else {
                mass -= self.sums[left];
                left + 1
            };
        }
        node - self.sums.len() / 2
    }
}

/// One step of one episode.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transition {
    /// Index of the terrain.
    pub terrain: u8,
    /// Cell of the tool before the step.
    pub cell: u16,
    pub action: u8,
    /// Cell after the step; `None` if the step ended the episode in a wall.
    pub next: Option<u16>,
    /// The episode's goal.
    pub goal: Goal,
    /// How the episode ended, if it ended with this step.
    pub ending: Option<Ending>,
}

/// The ring. Lanes write in turn, so an episode's next step is `lanes` entries later.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replay {
    lanes: usize,
    capacity: usize,
    exponent: f64,
    transitions: Vec<Transition>,
    /// Index of the next write.
    head: usize,
    priorities: SumTree,
    /// Priority of new transitions, so that each is drawn soon.
    largest: f64,
}

/// The result of a draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Indices into the ring.
    pub indices: Vec<usize>,
    /// Importance weights, at most 1.
    pub weights: Vec<f32>,
}

impl Replay {
    /// An empty ring for `capacity` transitions, rounded down to whole steps of all lanes. `exponent` 0 draws
    /// uniformly.
    pub fn new(capacity: usize, lanes: usize, exponent: f64) -> Self {
        let capacity = (capacity / lanes).max(1) * lanes;
        let priorities = SumTree::new(capacity);
        Self { lanes, capacity, exponent, transitions: Vec::new(), head: 0, priorities, largest: 1.0 }
    }

    pub fn len(&self) -> usize {
        self.transitions.len()
    }

    pub fn is_empty(&self) -> bool {
        self.transitions.is_empty()
    }

    pub fn get(&self, index: usize) -> &Transition {
        &self.transitions[index]
    }

    /// Adds a transition. The oldest one is overwritten if the ring is full.
    pub fn push(&mut self, transition: Transition) {
        match self.transitions.get_mut(self.head) {
            Some(slot) => *slot = transition,
            None => self.transitions.push(transition),
        }
        self.priorities.set(self.head, self.largest.powf(self.exponent));
        self.head = (self.head + 1) % self.capacity;
    }

    /// Draws `count` transitions, one from each of `count` equal parts of the total priority (Schaul et al. 2016,
    /// appendix B.2.1), with importance weights (N·P)^−β divided by their maximum.
    pub fn draw(&self, count: usize, importance: f64, rng: &mut impl Rng) -> Draw {
        let (total, stored) = (self.priorities.total(), self.len() as f64);
        let part = total / count as f64;
        let indices: Vec<usize> =
            (0..count).map(|i| self.priorities.find((i as f64 + rng.random::<f64>()) * part)).collect();
        let weight = |&index: &usize| (stored * self.priorities.get(index) / total).powf(-importance);
        let weights: Vec<f64> = indices.iter().map(weight).collect();
        let largest = weights.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        Draw { indices, weights: weights.iter().map(|weight| (weight / largest) as f32).collect() }
    }

    /// Sets the priority of a transition from its loss.
    pub fn set_loss(&mut self, index: usize, loss: f64) {
        // A transition with zero loss is still drawn occasionally.
        let loss = loss.max(1e-6);
        self.largest = self.largest.max(loss);
        self.priorities.set(index, loss.powf(self.exponent));
    }

    /// The following steps of the same episode, including the one at `index`, at most `count`; fewer if the episode or
    /// the ring ends.
    pub fn following(&self, index: usize, count: usize) -> impl Iterator<Item = &Transition> {
        let mut at = Some(index);
        let mut left = count;
        std::iter::from_fn(move || {
            let here = at.filter(|_| left > 0)?;
            left -= 1;
            let transition = &self.transitions[here];
            let next = (here + self.lanes) % self.capacity;
            // All entries between an index and the head are younger.
            let age = (self.head + self.capacity - here - 1) % self.capacity;
            let has_next = transition.ending.is_none() && age >= self.lanes && next < self.transitions.len();
            at = has_next.then_some(next);
            Some(transition)
        })
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;

    fn transition(cell: u16, ending: Option<Ending>) -> Transition {
        let goal = Goal { cell: 0, offset: [0, 0] };
        Transition { terrain: 0, cell, action: 0, next: Some(cell + 1), goal, ending }
    }

    #[test]
    fn leaves_are_drawn_in_proportion_to_their_priority() {
        let mut tree = SumTree::new(10);
        let priorities = [0.0, 1.0, 5.0, 0.0, 2.5, 0.5, 0.0, 8.0, 3.0, 0.0];
        for (index, &priority) in priorities.iter().enumerate() {
            tree.set(index, 100.0);
            tree.set(index, priority);
        }
        assert_eq!(tree.total(), 20.0);
        let mut rng = ChaCha8Rng::seed_from_u64(5);
        let mut counts = [0u32; 10];
        let draws = 200_000;
        for _ in 0..draws {
            counts[tree.find(rng.random::<f64>() * tree.total())] += 1;
        }
        // χ² with 5 degrees of freedom exceeds 20.5 by chance for one in a thousand seeds.
        let chi2: f64 = priorities
            .iter()
            .zip(counts)
            .filter(|&(&priority, count)| priority > 0.0 || count > 0)
            .map(|(&priority, count)| {
                let expected = f64::from(draws) * priority / 20.0;
                (f64::from(count) - expected).powi(2) / expected
            })
            .sum();
        assert!(chi2 < 20.5, "χ² = {chi2}, {counts:?}");
        assert_eq!(tree.find(tree.total()), 8, "rounding at the end does not reach an empty leaf");
    }

    #[test]
    fn draws_and_weights_follow_the_losses() {
        let mut replay = Replay::new(100, 1, 0.5);
        for cell in 0..50 {
            replay.push(transition(cell, None));
        }
        for index in 0..50 {
            replay.set_loss(index, if index < 10 { 4.0 } else { 1.0 });
        }
        // Priorities 2 and 1: 20 of 60 parts belong to the first ten.
        let mut rng = ChaCha8Rng::seed_from_u64(6);
        let mut first = 0;
        for _ in 0..1000 {
            let draw = replay.draw(6, 1.0, &mut rng);
            first += draw.indices.iter().filter(|&&index| index < 10).count();
            for (&index, &weight) in draw.indices.iter().zip(&draw.weights) {
                let expected = if index < 10 { 0.5 } else { 1.0 };
                assert!((weight - expected).abs() < 1e-6, "{index} {weight}");
            }
        }
        assert_eq!(first, 2000, "stratified: two of six parts each time");
        assert_eq!(replay.draw(6, 0.0, &mut rng).weights, [1.0; 6]);
    }

    #[test]
    fn follows_an_episode_in_its_lane_to_its_end_or_the_newest_step() {
        let mut replay = Replay::new(8, 2, 0.0);
        let cells = |replay: &Replay, index, count| {
            replay.following(index, count).map(|transition| transition.cell).collect::<Vec<_>>()
        };
        for step in 0..3 {
            replay.push(transition(10 + step, (step == 2).then_some(Ending::Reached)));
            replay.push(transition(20 + step, None));
        }
        assert_eq!(cells(&replay, 0, 9), [10, 11, 12]);
        assert_eq!(cells(&replay, 0, 2), [10, 11]);
        assert_eq!(cells(&replay, 1, 9), [20, 21, 22]);
        for step in 3..5 {
            replay.push(transition(10 + step, None));
            replay.push(transition(20 + step, None));
        }
        // The ring has wrapped: 14 and 24 have replaced the first steps.
        assert_eq!(cells(&replay, 2, 9), [11, 12]);
        assert_eq!(cells(&replay, 3, 9), [21, 22, 23, 24]);
        assert_eq!(cells(&replay, 1, 9), [24], "no step follows the newest");
    }
}
