//! Counts where outlines meet before they are united: the cost of the union grows with this count, which can be
//! quadratic in the number of edges.

use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::Ring;

/// Points at which a drawing's outlines may meet. Each may add a vertex to the walls.
const MAX_CONTACTS: usize = 100_000;
/// Pairs of edges with overlapping boxes, whether they meet or not: half a second of work.
const MAX_PAIRS: usize = 10_000_000;

/// The remaining limits of a drawing.
pub(super) struct Budget {
    contacts: usize,
    pairs: usize,
}

/// How the edges of some rings meet, except at the corners between neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Contacts {
    pub cross: bool,
    pub touch: bool,
}

struct Edge {
    a: Vector,
    b: Vector,
    ring: usize,
    /// Index in `edges` of the ring's next edge.
    next: usize,
}

impl Budget {
    pub fn new() -> Self {
        Self { contacts: MAX_CONTACTS, pairs: MAX_PAIRS }
    }

    /// Counts the contacts of closed rings; `Err` is the ring at which a limit was exceeded.
    pub fn spend(&mut self, rings: &[Ring]) -> Result<Contacts, usize> {
        let edges = edges_of(rings);
        let bvh = Bvh::from_iter(BvhBuildStrategy::Binned, edges.iter().map(Edge::aabb).enumerate());
        let mut contacts = Contacts::default();
        for (i, edge) in edges.iter().enumerate() {
            for j in bvh.intersect_aabb(&edge.aabb()) {
                let j = j as usize;
                if j <= i {
                    continue;
                }
                self.pairs = self.pairs.checked_sub(1).ok_or(edge.ring)?;
                let neighbours = edge.next == j || edges[j].next == i;
                let (cross, touch) = meet(edge, &edges[j], neighbours);
                if cross || touch {
                    self.contacts = self.contacts.checked_sub(1).ok_or(edge.ring)?;
                }
                contacts.cross |= cross;
                contacts.touch |= touch;
            }
        }
        Ok(contacts)
    }
}

/// The edges of some rings, except those of length 0.
fn edges_of(rings: &[Ring]) -> Vec<Edge> {
    let mut edges = Vec::new();
    for (ring, points) in rings.iter().enumerate() {
        let first = edges.len();
        for (k, &[ax, ay]) in points.iter().enumerate() {
            let [bx, by] = points[(k + 1) % points.len()];
            if [ax, ay] != [bx, by] {
                edges.push(Edge { a: Vector::new(ax, ay), b: Vector::new(bx, by), ring, next: edges.len() + 1 });
            }
        }
        if let Some(last) = edges[first..].last_mut() {
            last.next = first;
        }
    }
    edges
}

/// Whether two edges cross at an inner point of both, and if not, whether they touch. Neighbours share a corner and
/// touch only if they fold back on each other.
fn meet(p: &Edge, q: &Edge, neighbours: bool) -> (bool, bool) {
    let side = |e: &Edge, point: Vector| {
        let cross = (e.b - e.a).perp_dot(point - e.a);
        i32::from(cross > 0.0) - i32::from(cross < 0.0)
    };
    let [qa, qb, pa, pb] = [side(p, q.a), side(p, q.b), side(q, p.a), side(q, p.b)];
    if neighbours {
        let folds = qa == 0 && qb == 0 && (p.b - p.a).dot(q.b - q.a) < 0.0;
        return (false, folds);
    }
    if qa * qb > 0 || pa * pb > 0 {
        return (false, false);
    }
    let cross = qa * qb < 0 && pa * pb < 0;
    (cross, !cross)
}

impl Edge {
    fn aabb(&self) -> Aabb {
        Aabb::new(self.a.min(self.b), self.a.max(self.b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contacts(rings: &[Ring]) -> Contacts {
        Budget::new().spend(rings).unwrap()
    }

    #[test]
    fn distinguishes_crossing_touching_and_separate_edges() {
        let (cross, touch) = (Contacts { cross: true, touch: false }, Contacts { cross: false, touch: true });
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let moved = |dx: f64, dy: f64| square.iter().map(|[x, y]| [x + dx, y + dy]).collect::<Ring>();
        assert_eq!(contacts(std::slice::from_ref(&square)), Contacts::default());
        assert_eq!(contacts(&[square.clone(), moved(9.0, 0.0)]), Contacts::default());
        assert_eq!(contacts(&[square.clone(), moved(2.0, 2.0)]), cross);
        assert_eq!(contacts(&[square.clone(), moved(4.0, 1.0)]), touch);
        assert_eq!(contacts(&[square.clone(), moved(4.0, 4.0)]), touch);
        let bow = vec![[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]];
        assert_eq!(contacts(&[bow]), cross);
        let spike = vec![[0.0, 0.0], [8.0, 0.0], [4.0, 0.0], [4.0, 4.0]];
        assert!(contacts(&[spike]).touch);
        let doubled = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 0.0]];
        assert_eq!(contacts(&[doubled]), Contacts::default());
    }

    #[test]
    fn a_dense_scribble_exceeds_the_budget_at_its_own_ring() {
        let square = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let fan = |k: u32| [if k.is_multiple_of(2) { 10.0 } else { 20.0 }, f64::from(k * 7919 % 10_007)];
        let scribble: Ring = (0..10_000).map(fan).collect();
        assert_eq!(Budget::new().spend(&[square, scribble]), Err(1));
    }
}
