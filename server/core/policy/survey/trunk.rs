//! The network's trunk over a survey: it learns what it costs to enter each cell, plans with these costs, and looks at
//! the cells around the tool.

use candle_core::{D, Device, Result, Tensor};
use candle_nn::VarBuilder;

use super::route::CheapestRoutes;
use super::{Survey, SurveyParts};
use crate::perception::Area;
use crate::policy::Action;
use crate::policy::convolution::Convolution;
use crate::policy::linear::{Input, Linear};

/// Planes of a cell: blocked, free, unseen, visits, goal. All are zero outside of the lattice.
const PLANES: usize = 5;
const FINE: usize = 8;
const COARSE: usize = 16;
/// Cells of the lattice along a cell of the coarse scale.
const SCALE: usize = 4;
/// Cells around the tool's that are seen one by one.
const AROUND: usize = 4;
const PATCH: usize = (2 * AROUND + 1) * (2 * AROUND + 1) * PLANES;
/// What an action costs more than the cheapest, twice, for each; the cheapest itself; where the goal is.
const PLANNED: usize = 4 + 4 + 1 + 4;
/// Cost of a cell that is blocked, or outside: more than any path through open cells, so that no plan crosses a wall.
const BLOCKED_COST: f64 = 1000.0;
const LEAST_COST: f64 = 0.02;
/// Visits that are told apart.
const MAX_VISITS: f32 = 4.0;

#[derive(Clone, Debug)]
pub struct SurveyTrunk {
    parts: SurveyParts,
    fine: [Linear; 2],
    coarse: Option<[Linear; 3]>,
    cost: Linear,
    local: Linear,
    join: Linear,
}

impl SurveyTrunk {
    pub const PLANES: usize = PLANES;

    /// Name, inputs and outputs of the layers.
    pub fn layers(parts: SurveyParts, hidden: usize) -> Vec<(&'static str, usize, usize)> {
        let mut layers = vec![("fine1", 9 * PLANES, FINE), ("fine2", 9 * FINE, FINE)];
        if parts.coarse {
            layers.extend([
                ("coarse1", SCALE * SCALE * PLANES, COARSE),
                ("coarse2", 9 * COARSE, COARSE),
                ("coarse3", 9 * COARSE, FINE),
            ]);
        }
        layers.extend([("cost", FINE, 1), ("local", PATCH + PLANNED, hidden), ("join", hidden, hidden)]);
        layers
    }

    pub(in crate::policy) fn new(parts: SurveyParts, weights: &VarBuilder<'_>) -> Result<Self> {
        let layer = |name: &str| Linear::new(&weights.pp(name), false);
        Ok(Self {
            parts,
            fine: [layer("fine1")?, layer("fine2")?],
            coarse: match parts.coarse {
                true => Some([layer("coarse1")?, layer("coarse2")?, layer("coarse3")?]),
                false => None,
            },
            cost: layer("cost")?,
            local: layer("local")?,
            join: layer("join")?,
        })
    }

    /// `[B]` → `[B, hidden]`.
    pub fn features(&self, surveys: &[&Survey]) -> Result<Tensor> {
        let frames: Vec<Frame> = surveys.iter().map(|survey| Frame::of(survey)).collect();
        let shape = frames[0].shape();
        if frames.iter().any(|frame| frame.shape() != shape) {
            candle_core::bail!("surveys of several shapes");
        }
        let planes: Vec<Vec<f32>> = frames.iter().map(|frame| frame.planes(self.parts)).collect();
        let by_cell = self.by_cell(&frames, &planes)?;
        let each = frames.iter().zip(&planes).enumerate();
        let tools = each.map(|(entry, (frame, planes))| Tool { entry, frame, planes, cell: frame.survey.tool });
        self.of_tools(&by_cell, &tools.collect::<Vec<_>>())
    }

    /// What [`Self::features_at`] needs of a survey.
    pub fn plan<'a>(&self, survey: &'a Survey) -> Result<Plan<'a>> {
        let frame = Frame::of(survey);
        let planes = frame.planes(self.parts);
        let by_cell = self.by_cell(std::slice::from_ref(&frame), std::slice::from_ref(&planes))?;
        Ok(Plan { frame, planes, by_cell })
    }

    /// Features of one survey with the tool above each of many cells: `[cells, hidden]`.
    pub fn features_at(&self, plan: &Plan<'_>, cells: &[usize]) -> Result<Tensor> {
        let tool = |&cell: &usize| Tool { entry: 0, frame: &plan.frame, planes: &plan.planes, cell };
        self.of_tools(&plan.by_cell, &cells.iter().map(tool).collect::<Vec<_>>())
    }

    /// The cost of a step into each cell and on to the goal: `[B, rows · columns]` of the frames.
    fn by_cell(&self, frames: &[Frame<'_>], planes: &[Vec<f32>]) -> Result<Tensor> {
        let [columns, _] = frames[0].shape();
        let costs = self.costs(planes, frames[0].shape())?;
        let goals = frames.iter().map(|frame| frame.cell(frame.survey.goal)).collect();
        let to_goal = CheapestRoutes { columns, goals }.forward(&costs)?;
        costs + to_goal
    }

    /// `[B]` → `[B, hidden]`.
    fn of_tools(&self, by_cell: &Tensor, tools: &[Tool<'_>]) -> Result<Tensor> {
        let planned = planned(by_cell, tools)?;
        let patches = tools.iter().flat_map(|tool| tool.frame.patch(tool.planes, tool.cell));
        let patches = Tensor::from_iter(patches, &Device::Cpu)?.reshape((tools.len(), PATCH))?;
        let local = self.local.forward(&Tensor::cat(&[&patches, &planned], 1)?, Input::AsItIs, None)?;
        self.join.forward(&local, Input::Rectified, None)
    }

    /// Cost of entering each cell: `[B, rows · columns]` of the frames.
    fn costs(&self, planes: &[Vec<f32>], [columns, rows]: [usize; 2]) -> Result<Tensor> {
        let batch = planes.len();
        let x = Tensor::from_iter(planes.iter().flatten().copied(), &Device::Cpu)?;
        let x = x.reshape((batch, rows, columns, PLANES))?;
        let conv = |layer: &Linear, x: &Tensor, kernel, stride, rectify_input| {
            let padding = usize::from(kernel == 3);
            Convolution { kernel, stride, padding, rectify_input }.forward(x, &layer.weight, &layer.bias)
        };
        let mut sum = conv(&self.fine[1], &conv(&self.fine[0], &x, 3, 1, false)?, 3, 1, true)?;
        if let Some([first, second, third]) = &self.coarse {
            let wide = conv(first, &x, SCALE, SCALE, false)?;
            let wide = conv(third, &conv(second, &wide, 3, 1, true)?, 3, 1, true)?;
            let (high, across) = (rows / SCALE, columns / SCALE);
            let wide = wide.reshape((batch, high, 1, across, 1, FINE))?;
            let wide = wide.broadcast_as((batch, high, SCALE, across, SCALE, FINE))?;
            sum = (sum + wide.reshape((batch, rows, columns, FINE))?)?;
        }
        let raw = conv(&self.cost, &sum, 1, 1, true)?.reshape((batch, rows * columns))?;
        // Softplus; without learning it is near 1.
        let learned = ((raw + 0.5)?.clamp(-15.0, 15.0)?.exp()? + 1.0)?.log()?;
        let blocked = planes.iter().flat_map(|planes| {
            let cells = planes.chunks_exact(PLANES);
            cells.map(|cell| if cell[1] + cell[2] > 0.0 { LEAST_COST } else { BLOCKED_COST } as f32)
        });
        learned + Tensor::from_iter(blocked, &Device::Cpu)?.reshape((batch, rows * columns))?
    }
}

/// What the plan says about the four actions, and where the goal is: `[B, PLANNED]`.
fn planned(by_cell: &Tensor, tools: &[Tool<'_>]) -> Result<Tensor> {
    let (batch, count) = (tools.len(), by_cell.dim(1)?);
    let beside = tools.iter().flat_map(|tool| {
        let cell = tool.frame.cell(tool.cell);
        Action::ALL.map(|action| {
            let (dx, dy) = action.offset();
            (tool.entry * count + cell.wrapping_add_signed(dx + dy * tool.frame.columns as isize)) as u32
        })
    });
    let beside = Tensor::from_iter(beside, &Device::Cpu)?;
    let by_action = by_cell.flatten_all()?.index_select(&beside, 0)?.reshape((batch, 4))?;
    let least = by_action.min_keepdim(D::Minus1)?;
    let more = by_action.broadcast_sub(&least)?;
    let bounded = more.broadcast_div(&(&more + 1.0)?)?;
    let far = (more * 0.1)?.clamp(0.0, 1.0)?;
    let ahead = ((least + 1.0)?.log()? * 0.2)?;
    let bearing = tools.iter().flat_map(|tool| tool.frame.bearing(tool.cell));
    let bearing = Tensor::from_iter(bearing, &Device::Cpu)?.reshape((batch, 4))?;
    Tensor::cat(&[&bounded, &far, &ahead, &bearing], 1)
}

/// A survey with what the planning layer says of it.
#[derive(Clone, Debug)]
pub struct Plan<'a> {
    frame: Frame<'a>,
    planes: Vec<f32>,
    /// `[1, rows · columns]` of the frame.
    by_cell: Tensor,
}

/// The tool above a cell of the survey of one entry of a batch.
struct Tool<'a> {
    entry: usize,
    frame: &'a Frame<'a>,
    planes: &'a [f32],
    cell: usize,
}

/// A survey with a border of at least one cell, with sides that the coarse scale divides.
#[derive(Clone, Debug)]
struct Frame<'a> {
    survey: &'a Survey,
    columns: usize,
    rows: usize,
}

impl<'a> Frame<'a> {
    fn of(survey: &'a Survey) -> Self {
        let (columns, rows) = survey.shape();
        let side = |count: usize| (count + 2).next_multiple_of(SCALE);
        Self { survey, columns: side(columns), rows: side(rows) }
    }

    fn shape(&self) -> [usize; 2] {
        [self.columns, self.rows]
    }

    /// The frame's index of a survey's cell.
    fn cell(&self, cell: usize) -> usize {
        let [column, row] = self.survey.place(cell).map(|index| index as usize + 1);
        row * self.columns + column
    }

    fn planes(&self, parts: SurveyParts) -> Vec<f32> {
        let mut planes = vec![0.0; self.columns * self.rows * PLANES];
        for cell in 0..self.survey.count() {
            let plane = &mut planes[self.cell(cell) * PLANES..][..PLANES];
            match self.survey.known(cell) {
                // A goal near a wall can still be reached from beside its cell.
                Area::Blocked if cell != self.survey.goal => plane[0] = 1.0,
                Area::Free | Area::Blocked => plane[1] = 1.0,
                Area::Unknown => plane[2] = 1.0,
            }
            if parts.visits {
                plane[3] = (f32::from(self.survey.visits(cell)) / MAX_VISITS).min(1.0);
            }
        }
        planes[self.cell(self.survey.goal) * PLANES + 4] = 1.0;
        planes
    }

    /// The planes around the tool's cell.
    fn patch(&self, planes: &[f32], tool: usize) -> Vec<f32> {
        let tool = self.cell(tool);
        let (column, row) = (tool % self.columns, tool / self.columns);
        let around = |middle: usize| (0..=2 * AROUND).map(move |offset| (middle + offset).checked_sub(AROUND));
        let mut patch = Vec::with_capacity(PATCH);
        for row in around(row) {
            for column in around(column) {
                match row.zip(column).filter(|&(row, column)| row < self.rows && column < self.columns) {
                    Some((row, column)) => {
                        patch.extend_from_slice(&planes[(row * self.columns + column) * PLANES..][..PLANES]);
                    }
                    None => patch.extend([0.0; PLANES]),
                }
            }
        }
        patch
    }

    /// Direction of the goal from the tool's cell, and how far it is on each axis, at most 1.
    fn bearing(&self, tool: usize) -> [f32; 4] {
        let [tool, goal] = [tool, self.survey.goal].map(|cell| self.survey.place(cell));
        let [dx, dy] = std::array::from_fn(|axis| (goal[axis] - tool[axis]) as f32);
        let length = dx.hypot(dy).max(1.0);
        [dx / length, dy / length, (dx / 64.0).clamp(-1.0, 1.0), (dy / 64.0).clamp(-1.0, 1.0)]
    }
}
