//! The planning layer: the cost of the cheapest route from every cell to the goal, for learned costs of the cells.
//!
//! It is the fixed point of value iteration with the lattice's own steps, as in Value Iteration Networks (Tamar et al.
//! 2016) and Value Propagation Networks (Nardelli et al. 2019), which iterate a fixed number of times instead. Dijkstra's
//! algorithm finds it exactly. Its derivative by a cell's cost is 1 if the cheapest route enters the cell, else 0.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use candle_core::{CpuStorage, CustomOp1, Error, Layout, Result, Shape, Storage, Tensor};
use rayon::prelude::*;

use crate::policy::lattice::neighbours;

/// Costs to the goal from costs of entering a cell, both `[B, rows · columns]` of f32: 0 at the goal, elsewhere the
/// least of a neighbour's own cost and its cost to the goal.
#[derive(Clone, Debug)]
pub struct CheapestRoutes {
    pub columns: usize,
    /// The cell of each entry's goal.
    pub goals: Vec<usize>,
}

impl CheapestRoutes {
    /// # Errors
    /// Those of candle, for another type or device, or costs that are negative or not finite.
    pub fn forward(self, costs: &Tensor) -> Result<Tensor> {
        costs.contiguous()?.apply_op1(self)
    }

    fn to_goal(&self, costs: &[f32], goal: usize) -> Vec<f32> {
        let mut found = vec![f32::INFINITY; costs.len()];
        let mut open = BinaryHeap::new();
        found[goal] = 0.0;
        open.push(Reverse((0u32, goal as u32)));
        while let Some(Reverse((bits, cell))) = open.pop() {
            let cell = cell as usize;
            // Numbers that are not negative have the order of their bits.
            let at = f32::from_bits(bits);
            if at > found[cell] {
                continue;
            }
            let entered = at + costs[cell];
            for beside in neighbours(cell, self.columns, costs.len()) {
                if entered < found[beside] {
                    found[beside] = entered;
                    open.push(Reverse((entered.to_bits(), beside as u32)));
                }
            }
        }
        found
    }

    /// Gradient by the costs: each cell's own gradient, along its whole route.
    fn along_routes(&self, costs: &[f32], found: &[f32], goal: usize, gradient: &[f32]) -> Vec<f32> {
        let mut by_cost = vec![0.0; costs.len()];
        for (from, &gradient) in gradient.iter().enumerate().filter(|&(_, &gradient)| gradient != 0.0) {
            let mut cell = from;
            while cell != goal {
                let by_cost_of = |&next: &usize| costs[next] + found[next];
                let next = neighbours(cell, self.columns, costs.len())
                    .min_by(|a, b| by_cost_of(a).total_cmp(&by_cost_of(b)))
                    .expect("a cell has neighbours");
                by_cost[next] += gradient;
                cell = next;
            }
        }
        by_cost
    }
}

impl CustomOp1 for CheapestRoutes {
    fn name(&self) -> &'static str {
        "cheapest routes"
    }

    fn cpu_fwd(&self, costs: &CpuStorage, layout: &Layout) -> Result<(CpuStorage, Shape)> {
        let costs = slice(costs, layout)?;
        if let Some(cost) = costs.iter().find(|cost| !(cost.is_finite() && **cost > 0.0)) {
            candle_core::bail!("cheapest routes: a cost is {cost}");
        }
        let (_, count) = layout.shape().dims2()?;
        let each = costs.par_chunks_exact(count).zip(&self.goals);
        let found: Vec<f32> = each.flat_map_iter(|(costs, &goal)| self.to_goal(costs, goal)).collect();
        Ok((CpuStorage::F32(found), layout.shape().clone()))
    }

    fn bwd(&self, costs: &Tensor, found: &Tensor, gradient: &Tensor) -> Result<Option<Tensor>> {
        let gradient = gradient.contiguous()?;
        let (_, count) = costs.dims2()?;
        let (costs_storage, costs_layout) = costs.storage_and_layout();
        let (found_storage, found_layout) = found.storage_and_layout();
        let (gradient_storage, gradient_layout) = gradient.storage_and_layout();
        let rows = slice(on_cpu(&costs_storage)?, costs_layout)?
            .par_chunks_exact(count)
            .zip(slice(on_cpu(&found_storage)?, found_layout)?.par_chunks_exact(count))
            .zip(slice(on_cpu(&gradient_storage)?, gradient_layout)?.par_chunks_exact(count))
            .zip(&self.goals);
        let by_cost: Vec<f32> = rows
            .flat_map_iter(|(((costs, found), gradient), &goal)| self.along_routes(costs, found, goal, gradient))
            .collect();
        Tensor::from_vec(by_cost, costs.shape(), costs.device()).map(Some)
    }
}

fn slice<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let (start, end) = layout.contiguous_offsets().ok_or_else(|| Error::RequiresContiguous { op: "routes" }.bt())?;
    Ok(&storage.as_slice::<f32>()?[start..end])
}

fn on_cpu(storage: &Storage) -> Result<&CpuStorage> {
    match storage {
        Storage::Cpu(storage) => Ok(storage),
        _ => candle_core::bail!("cheapest routes are computed on the CPU only"),
    }
}
