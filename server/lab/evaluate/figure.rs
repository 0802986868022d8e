//! One trial as a figure like the paper's: trajectories of tool and bead, their x and y, and the tracking errors.

use plotters::coord::Shift;
use plotters::prelude::*;
use serde::{Deserialize, Serialize};

use ferry_core::geometry::{Point2, Rect};
use ferry_core::map::Map;
use ferry_core::scenario::Scenario;
use ferry_core::trial::{EventKind, TickRecord};

const SIZE_PX: (u32, u32) = (1200, 900);
const TOOL: RGBColor = RGBColor(10, 99, 194);
const BEAD: RGBColor = RGBColor(200, 90, 0);
const GOAL: RGBColor = RGBColor(21, 128, 61);
const WALL: RGBColor = RGBColor(205, 170, 165);
const MARK: RGBColor = RGBColor(198, 40, 40);
const FONT: &str = "sans-serif";
/// A larger step of the bead within 8 ms is a displacement, not motion.
const JUMP_M: f64 = 0.02;
/// Only every fifth sample of a curve is drawn: 40 ms are less than a pixel.
const DRAWN_EVERY: usize = 5;

/// A figure could not be drawn.
#[derive(Debug, thiserror::Error)]
#[error("figure: {0}")]
pub struct FigureError(String);

impl From<DrawingError> for FigureError {
    fn from(error: DrawingError) -> Self {
        Self(error.to_string())
    }
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Sample {
    time_s: f64,
    tool_m: Point2<f64>,
    bead_m: Point2<f64>,
}

/// The data of a figure.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trace {
    workspace: Rect,
    /// Outlines of walls and of their holes, larger ones first, and whether each is a wall.
    outlines: Vec<(Vec<[f64; 2]>, bool)>,
    title: String,
    start_m: Option<Point2<f64>>,
    goal_m: Option<Point2<f64>>,
    samples: Vec<Sample>,
    disturbed_s: Vec<f64>,
}

impl Trace {
    pub fn of(map: &Map, scenario: &Scenario) -> Self {
        Self {
            workspace: *map.workspace(),
            outlines: outlines(map),
            title: format!("{} on {}, seed {}", scenario.controller.as_str(), scenario.map, scenario.seed),
            start_m: scenario.start_m,
            goal_m: scenario.goal_m,
            samples: Vec::new(),
            disturbed_s: Vec::new(),
        }
    }

    pub fn add(&mut self, record: &TickRecord) {
        let moment = &record.moment;
        let time_s = moment.sim_time_s();
        self.samples.push(Sample { time_s, tool_m: moment.tool_m.xy(), bead_m: moment.bead_m.xy() });
        let is_disturbance = |kind| kind == EventKind::Disturbance;
        self.disturbed_s.extend(record.events.iter().filter(|event| is_disturbance(event.kind())).map(|_| time_s));
    }

    /// The figure as SVG.
    ///
    /// # Errors
    /// [`FigureError`] with the message of the plotting library.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        let mut svg = String::new();
        self.draw(&SVGBackend::with_string(&mut svg, SIZE_PX).into_drawing_area())?;
        Ok(svg)
    }

    fn draw(&self, area: &DrawingArea<SVGBackend, Shift>) -> Result<(), DrawingError> {
        area.fill(&WHITE)?;
        let area = area.titled(&self.title, (FONT, 22))?;
        let (above, below) = area.split_vertically(500);
        self.locus(&above)?;
        let panels = below.split_evenly((1, 3));
        let of = |value: fn(&Sample) -> f64| -> Vec<(f64, f64)> {
            drawn(&self.samples).map(|sample| (sample.time_s, value(sample))).collect()
        };
        let axis = [(TOOL, "tool"), (BEAD, "bead")];
        self.lines(&panels[0], "x, m", axis, [of(|s| s.tool_m.x), of(|s| s.bead_m.x)])?;
        self.lines(&panels[1], "y, m", axis, [of(|s| s.tool_m.y), of(|s| s.bead_m.y)])?;
        let errors = [(TOOL, "in x"), (BEAD, "in y")];
        let error = [of(|s| s.tool_m.x - s.bead_m.x), of(|s| s.tool_m.y - s.bead_m.y)];
        self.lines(&panels[2], "tracking error, m", errors, error)?;
        area.present()
    }

    /// Walls, start, goal, and trajectories of tool and bead, with equal scales of x and y.
    fn locus(&self, area: &DrawingArea<SVGBackend, Shift>) -> Result<(), DrawingError> {
        let Rect { x_min_m, x_max_m, y_min_m, y_max_m } = self.workspace;
        let (width_px, height_px) = area.dim_in_pixel();
        // Margins and axis labels take about sixty pixels.
        let aspect = f64::from(width_px - 60) / f64::from(height_px - 60);
        let size = self.workspace.size_m();
        let more_m = 0.5 * (size.y * aspect - size.x).max(0.0);
        let mut chart = ChartBuilder::on(area)
            .margin(10)
            .x_label_area_size(25)
            .y_label_area_size(40)
            .build_cartesian_2d(x_min_m - more_m..x_max_m + more_m, y_min_m..y_max_m)?;
        let points = |ring: &[[f64; 2]]| ring.iter().map(|&[x, y]| (x, y)).collect::<Vec<_>>();
        let filled = |(ring, is_wall): &(Vec<[f64; 2]>, bool)| {
            Polygon::new(points(ring), if *is_wall { WALL } else { WHITE }.filled())
        };
        chart.draw_series(self.outlines.iter().map(filled))?;
        chart.draw_series([Rectangle::new([(x_min_m, y_min_m), (x_max_m, y_max_m)], BLACK.stroke_width(1))])?;
        chart.configure_mesh().disable_mesh().label_style((FONT, 13)).draw()?;
        // A displacement interrupts the line.
        for carried in self.samples.chunk_by(|a, b| (a.bead_m - b.bead_m).norm() < JUMP_M) {
            let course = drawn(carried).map(|sample| (sample.bead_m.x, sample.bead_m.y));
            chart.draw_series(LineSeries::new(course, BEAD.stroke_width(2)))?;
        }
        for pair in self.samples.windows(2).filter(|pair| (pair[0].bead_m - pair[1].bead_m).norm() >= JUMP_M) {
            let ends = [pair[0].bead_m, pair[1].bead_m].map(|at| (at.x, at.y));
            chart.draw_series(DashedLineSeries::new(ends, 6, 5, MARK.stroke_width(1)))?;
        }
        let tool = drawn(&self.samples).map(|sample| (sample.tool_m.x, sample.tool_m.y));
        chart.draw_series(LineSeries::new(tool, TOOL.stroke_width(1)))?;
        let at = |place: Point2<f64>| (place.x, place.y);
        chart.draw_series(self.start_m.map(at).map(|place| Circle::new(place, 6, BEAD.stroke_width(2))))?;
        chart.draw_series(self.goal_m.map(at).map(|place| Cross::new(place, 7, GOAL.stroke_width(3))))?;
        Ok(())
    }

    /// Two curves over time, with disturbances marked.
    fn lines(
        &self,
        area: &DrawingArea<SVGBackend, Shift>,
        caption: &str,
        styles: [(RGBColor, &str); 2],
        curves: [Vec<(f64, f64)>; 2],
    ) -> Result<(), DrawingError> {
        let end_s = self.samples.last().map_or(1.0, |sample| sample.time_s);
        let values = || curves.iter().flatten().map(|(_, value)| *value);
        let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let air = (0.05 * (high - low)).max(1e-3);
        let mut chart = ChartBuilder::on(area)
            .caption(caption, (FONT, 16))
            .margin(8)
            .x_label_area_size(35)
            .y_label_area_size(45)
            .build_cartesian_2d(0.0..end_s, low - air..high + air)?;
        chart.configure_mesh().light_line_style(WHITE).x_desc("s").label_style((FONT, 12)).draw()?;
        for &time_s in &self.disturbed_s {
            let ends = [(time_s, low - air), (time_s, high + air)];
            chart.draw_series(DashedLineSeries::new(ends, 4, 4, MARK.stroke_width(1)))?;
        }
        for ((color, name), curve) in styles.into_iter().zip(curves) {
            chart
                .draw_series(LineSeries::new(curve, color.stroke_width(1)))?
                .label(name)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 16, y)], color.stroke_width(2)));
        }
        chart.configure_series_labels().label_font((FONT, 12)).background_style(WHITE.mix(0.8)).draw()
    }
}

/// The samples of a curve that are drawn, including the last one.
fn drawn(samples: &[Sample]) -> impl Iterator<Item = &Sample> {
    let last = samples.len().saturating_sub(1);
    samples.iter().enumerate().filter(move |&(at, _)| at % DRAWN_EVERY == 0 || at == last).map(|(_, sample)| sample)
}

fn outlines(map: &Map) -> Vec<(Vec<[f64; 2]>, bool)> {
    let rings =
        map.walls().iter().flat_map(|wall| wall.rings().zip(std::iter::once(true).chain(std::iter::repeat(false))));
    let mut outlines: Vec<_> = rings.map(|(ring, is_wall)| (ring.to_vec(), is_wall)).collect();
    // An outline inside another one is the smaller one.
    let area = |ring: &[[f64; 2]]| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - b[0] * a[1]).sum::<f64>().abs()
    };
    outlines.sort_by(|a, b| area(&b.0).total_cmp(&area(&a.0)));
    outlines
}

type DrawingError = DrawingAreaErrorKind<std::io::Error>;
