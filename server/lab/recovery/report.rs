//! The report of a recovery map, for people and programs.

mod html;

use serde::Serialize;
use ts_rs::TS;
use utoipa::ToSchema;

use super::findings::Cell;
use super::{Basin, BasinDifference, Findings, Kind, Spot, Subject};
use crate::evaluate::ReportError;
use ferry_core::geometry::Point2;
use ferry_core::map::Map;
use ferry_core::schema::Numbers2;

/// The trials of one controller in one cell.
#[derive(Clone, Debug, PartialEq, Serialize, TS, ToSchema)]
#[schema(as = RecoveryCell)]
#[ts(rename = "RecoveryCell")]
pub struct CellRow {
    /// Number of the cell.
    pub cell: u32,
    /// Centre and size of a square of places.
    pub x_m: Option<f64>,
    pub y_m: Option<f64>,
    pub size_m: Option<f64>,
    /// Direction of a push or drag, counter-clockwise from x.
    pub direction_rad: Option<f64>,
    /// Force of a push in newtons, length of a drag in metres, duration of a loss in seconds.
    pub strength: Option<f64>,
    /// When the tracker becomes blind, after the moment.
    pub at_s: Option<f64>,
    /// Name of the controller, or of the program.
    pub controller: String,
    pub delivered: u32,
    /// Delivered, but after more than `within_s`.
    pub late: u32,
    pub lost: u32,
    /// Trials that have ended.
    pub repeats: u32,
    /// Wilson 95 % interval of `delivered / repeats`.
    #[schema(value_type = Numbers2)]
    pub delivered_wilson95: [f64; 2],
    /// Median time to the delivery, with late ones.
    pub time_s_median: Option<f64>,
    /// How most of the lost trials ended.
    pub why: Option<String>,
}

impl CellRow {
    /// One per cell and controller with a trial that has ended.
    pub fn all(findings: &Findings, names: &[&str]) -> Vec<Self> {
        let cells = findings.cells.iter().zip(0..);
        let rows =
            |(cell, number)| names.iter().enumerate().map(move |(index, name)| Self::of(number, cell, index, name));
        cells.flat_map(rows).flatten().collect()
    }

    fn of(number: u32, cell: &Cell, index: usize, controller: &str) -> Option<Self> {
        let tally = cell.tally(index);
        let mut row = Self {
            cell: number,
            x_m: None,
            y_m: None,
            size_m: None,
            direction_rad: None,
            strength: None,
            at_s: None,
            controller: controller.to_owned(),
            delivered: tally.delivered,
            late: tally.late,
            lost: tally.lost,
            repeats: tally.repeats(),
            delivered_wilson95: tally.wilson95(),
            time_s_median: cell.median_s(index),
            why: cell.why(index),
        };
        match cell.spot {
            Spot::Place { at_m, size_m } => {
                (row.x_m, row.y_m, row.size_m) = (Some(at_m.x), Some(at_m.y), Some(size_m));
            }
            Spot::Push { direction_rad, force_n: strength } | Spot::Drag { direction_rad, distance_m: strength } => {
                (row.direction_rad, row.strength) = (Some(direction_rad), Some(strength));
            }
            Spot::Blind { at_s, for_s } => (row.at_s, row.strength) = (Some(at_s), Some(for_s)),
        }
        (row.repeats > 0).then_some(row)
    }
}

/// The report of a recovery map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// Version of Ferry.
    pub ferry: String,
    /// Graphics adapter.
    pub adapter: String,
    pub map: String,
    pub kind: Kind,
    pub controllers: Vec<String>,
    pub grid: u32,
    pub repeats: u32,
    pub seed: u64,
    pub within_s: f64,
    /// The moment.
    pub tick: u64,
    /// Bead, tool and goal at the moment.
    pub bead_m: Point2<f64>,
    pub tool_m: Point2<f64>,
    pub goal_m: Option<Point2<f64>>,
    /// Parameters at the moment, other than the default.
    pub changes: Vec<String>,
    /// One entry per cell and controller.
    pub cells: Vec<CellRow>,
    pub basins: Vec<Basin>,
    pub differences: Vec<BasinDifference>,
}

impl Report {
    pub fn of(subject: &Subject, adapter: &str, findings: &Findings) -> Self {
        let Subject { query, .. } = subject;
        let names: Vec<&str> = subject.controllers.iter().map(String::as_str).collect();
        Self {
            ferry: env!("CARGO_PKG_VERSION").to_owned(),
            adapter: adapter.to_owned(),
            map: subject.map.name.clone(),
            kind: query.kind,
            controllers: subject.controllers.clone(),
            grid: query.grid,
            repeats: query.repeats,
            seed: query.seed,
            within_s: query.within_s,
            tick: subject.tick,
            bead_m: subject.bead_m,
            tool_m: subject.tool_m,
            goal_m: subject.goal_m,
            changes: subject.changes.clone(),
            cells: CellRow::all(findings, &names),
            basins: Basin::all(findings, &names),
            differences: BasinDifference::all(findings, &names),
        }
    }

    /// One HTML file that needs no other.
    pub fn to_html(&self, map: &Map) -> String {
        html::document(self, map)
    }

    /// The cells as CSV (RFC 4180), with a head.
    ///
    /// # Errors
    /// [`ReportError`].
    pub fn to_csv(&self) -> Result<String, ReportError> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in &self.cells {
            writer.serialize(CsvRow::from(row))?;
        }
        let bytes = writer.into_inner().map_err(|error| ReportError::Buffer(error.to_string()))?;
        String::from_utf8(bytes).map_err(|error| ReportError::Buffer(error.to_string()))
    }
}

/// A cell without lists, because CSV has no lists.
#[derive(Serialize)]
struct CsvRow<'a> {
    cell: u32,
    controller: &'a str,
    x_m: Option<f64>,
    y_m: Option<f64>,
    size_m: Option<f64>,
    direction_rad: Option<f64>,
    strength: Option<f64>,
    at_s: Option<f64>,
    delivered: u32,
    late: u32,
    lost: u32,
    repeats: u32,
    delivered_wilson95_low: f64,
    delivered_wilson95_high: f64,
    time_s_median: Option<f64>,
    why: Option<&'a str>,
}

impl<'a> From<&'a CellRow> for CsvRow<'a> {
    fn from(row: &'a CellRow) -> Self {
        let [delivered_wilson95_low, delivered_wilson95_high] = row.delivered_wilson95;
        Self {
            cell: row.cell,
            controller: &row.controller,
            x_m: row.x_m,
            y_m: row.y_m,
            size_m: row.size_m,
            direction_rad: row.direction_rad,
            strength: row.strength,
            at_s: row.at_s,
            delivered: row.delivered,
            late: row.late,
            lost: row.lost,
            repeats: row.repeats,
            delivered_wilson95_low,
            delivered_wilson95_high,
            time_s_median: row.time_s_median,
            why: row.why.as_deref(),
        }
    }
}
