//! The search tree, with a nearest-node query that includes the cost from the root.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::Point2;

/// A tree of straight edges that grows from its first node, the root. Clones share memory until one of them grows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Vec<Stored>", try_from = "Vec<Stored>")]
pub struct Tree {
    nodes: Arc<Vec<Node>>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Node {
    point: Point2<f64>,
    /// The root is its own parent.
    parent: u32,
    /// Length of the path from the root.
    cost_m: f64,
}

/// A serialised node: its position and its parent, which precedes it.
type Stored = (Point2<f64>, u32);

/// A tree from a file may have this many nodes beside its root, because each is looked at in each attempt. An attempt
/// adds two at most.
const MOST_STORED: usize = 40_000;

impl From<Tree> for Vec<Stored> {
    fn from(tree: Tree) -> Self {
        tree.nodes.iter().map(|node| (node.point, node.parent)).collect()
    }
}

impl TryFrom<Vec<Stored>> for Tree {
    type Error = &'static str;

    fn try_from(stored: Vec<Stored>) -> Result<Self, Self::Error> {
        let (&(root, _), others) = stored.split_first().ok_or("the tree has no root")?;
        if others.len() > MOST_STORED {
            return Err("the tree has more nodes than a search makes");
        }
        let mut tree = Self::new(root);
        for &(point, parent) in others {
            if parent as usize >= tree.node_count() {
                return Err("a node precedes its parent");
            }
            tree.push(point, parent as usize);
        }
        Ok(tree)
    }
}

impl Tree {
    /// A tree that consists of its root.
    pub fn new(root: Point2<f64>) -> Self {
        Self { nodes: Arc::new(vec![Node { point: root, parent: 0, cost_m: 0.0 }]) }
    }

    /// Adds a node at the end of a straight edge from `parent` and returns its number.
    pub fn push(&mut self, point: Point2<f64>, parent: usize) -> usize {
        let from = &self.nodes[parent];
        let cost_m = from.cost_m + (point - from.point).norm();
        Arc::make_mut(&mut self.nodes).push(Node { point, parent: parent as u32, cost_m });
        self.nodes.len() - 1
    }

    /// Number of nodes, including the root.
    pub fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub fn point(&self, node: usize) -> Point2<f64> {
        self.nodes[node].point
    }

    /// Length of the path from the root to a node.
    pub fn cost_m(&self, node: usize) -> f64 {
        self.nodes[node].cost_m
    }

    /// The node with the smallest sum of distance and `beta` · cost from the root; the first one if several are equal.
    ///
    /// All nodes are looked at: for the few hundred that a search has, an index costs more than it saves.
    pub fn nearest(&self, target: Point2<f64>, beta: f64) -> usize {
        let mut best = (f64::INFINITY, 0);
        for (node, Node { point, cost_m, .. }) in self.nodes.iter().enumerate() {
            let distance_2 = (point - target).norm_squared();
            // Most are farther away than the best sum, and need no square root.
            if distance_2 < best.0 * best.0 {
                let sum_m = distance_2.sqrt() + beta * cost_m;
                if sum_m < best.0 {
                    best = (sum_m, node);
                }
            }
        }
        best.1
    }

    /// The points from the root to a node.
    pub fn path(&self, node: usize) -> Vec<Point2<f64>> {
        let parent = |&node: &usize| (node > 0).then(|| self.nodes[node].parent as usize);
        let mut points: Vec<_> = std::iter::successors(Some(node), parent).map(|node| self.point(node)).collect();
        points.reverse();
        points
    }

    /// Both ends of every edge, the one nearer to the root first.
    pub fn edges(&self) -> impl Iterator<Item = [Point2<f64>; 2]> {
        self.nodes[1..].iter().map(|node| [self.point(node.parent as usize), node.point])
    }
}
