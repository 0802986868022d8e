//! The report of a recovery map as a single HTML file.

use maud::{Markup, PreEscaped, html};

use super::{CellRow, Report};
use crate::evaluate::html_document;
use crate::recovery::Kind;
use ferry_core::geometry::Point2;
use ferry_core::map::Map;

const STYLE: &str = "
:root { color-scheme: light dark; --line: #8886; }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 96rem; padding: 0 1rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0; }
th, td { border-bottom: 1px solid var(--line); padding: .3rem .6rem; text-align: right; white-space: nowrap; }
th:first-child { text-align: left; }
.maps { display: flex; flex-wrap: wrap; gap: 1.5rem; }
figure { flex: 1 1 26rem; margin: 0; max-width: 46rem; }
figure svg { background: #fff; display: block; height: auto; width: 100%; }
.key svg { height: 1em; vertical-align: -.15em; width: 1.6em; }
small { opacity: .75; }
";

/// Stripes for late, crosses for lost: the map is read without its colours, too.
const PATTERNS: &str = r##"<pattern id="late" width="8" height="8" patternUnits="userSpaceOnUse">
<rect width="8" height="8" fill="#f2b04a"/><path d="M-2 2l4-4M0 8l8-8M6 10l4-4" stroke="#7a4b00" stroke-width="1.2"/></pattern>
<pattern id="lost" width="8" height="8" patternUnits="userSpaceOnUse">
<rect width="8" height="8" fill="#e9e5e4"/><path d="M2 2l4 4M6 2l-4 4" stroke="#8c1f1f" stroke-width="1.2"/></pattern>"##;

const DELIVERED: &str = "#1769c2";
/// Width of a figure's drawing.
const WIDTH: f64 = 600.0;

pub(super) fn document(report: &Report, map: &Map) -> String {
    let kind = report.kind.as_str();
    let title = format!("Ferry: recovery map ({kind}) on {}, seed {}", report.map, report.seed);
    let body = html! {
        h1 { "Recovery map: " (kind) " on " (report.map) }
        p {
            "Ferry " (report.ferry) ", rendered by " (report.adapter) ". From tick " (report.tick) ", seed "
            (report.seed) ", " (report.repeats) " trials per cell and controller. A delivery within "
            (report.within_s) " s is in time. Intervals are at 95 %."
        }
        @if !report.changes.is_empty() {
            p { "Parameters other than the default: " (report.changes.join(", ")) }
        }
        p.key {
            (key(DELIVERED)) " delivered: the more trials, the darker; "
            (key("url(#late)")) " mostly late; " (key("url(#lost)")) " mostly not delivered."
        }
        div.maps {
            @for name in &report.controllers {
                figure {
                    figcaption { (name) }
                    (figure(report, map, name))
                }
            }
        }
        (basins(report))
        (differences(report))
    };
    html_document(&title, STYLE, body)
}

fn key(fill: &str) -> Markup {
    html! { svg viewBox="0 0 26 16" aria-hidden="true" {
        defs { (PreEscaped(PATTERNS)) }
        rect width="26" height="16" fill=(fill) stroke="#888" {}
    } }
}

fn basins(report: &Report) -> Markup {
    let has_area = report.basins.iter().any(|basin| basin.area_m2.is_some());
    html! {
        table {
            thead { tr {
                th scope="col" { "Controller" } th scope="col" { "Delivered" } th scope="col" { "Share" }
                th scope="col" { "Wilson" }
                @if has_area { th scope="col" { "Area, cm²" } th scope="col" { "Interval" } }
            } }
            tbody {
                @for basin in &report.basins {
                    tr {
                        th scope="row" { (basin.controller) }
                        td { (basin.delivered) "/" (basin.trials) }
                        td { (format!("{:.3}", basin.share)) }
                        td { (format!("{:.3} to {:.3}", basin.share95[0], basin.share95[1])) }
                        @if let (Some(area), Some([low, high])) = (basin.area_m2, basin.area95_m2) {
                            td { (format!("{:.0}", area * 1e4)) }
                            td { (format!("{:.0} to {:.0}", low * 1e4, high * 1e4)) }
                        }
                    }
                }
            }
        }
    }
}

fn differences(report: &Report) -> Markup {
    let points = |share: f64| format!("{:+.1}", share * 100.0);
    html! {
        @if !report.differences.is_empty() {
            h2 { "Paired differences" }
            p { "First minus second, in percentage points, at the same cells with the same noise." }
            table {
                thead { tr {
                    th scope="col" { "First – second" } th scope="col" { "Both, first, second, neither" }
                    th scope="col" { "Difference" } th scope="col" { "Interval" }
                    th scope="col" { "Corrected for " (report.differences.len()) }
                } }
                tbody {
                    @for one in &report.differences {
                        tr {
                            th scope="row" { (one.controller) " – " (one.against) }
                            td { (one.both) ", " (one.first_only) ", " (one.second_only) ", " (one.neither) }
                            td { (points(one.share_difference)) }
                            td { (points(one.share_difference95[0])) " to " (points(one.share_difference95[1])) }
                            td {
                                (points(one.share_difference_corrected[0])) " to "
                                (points(one.share_difference_corrected[1]))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn figure(report: &Report, map: &Map, controller: &str) -> Markup {
    let rows: Vec<&CellRow> = report.cells.iter().filter(|row| row.controller == controller).collect();
    match rows.first() {
        Some(row) if row.x_m.is_some() => places(report, map, &rows),
        Some(row) if row.at_s.is_some() => losses(&rows),
        _ => directions(&rows, report.kind),
    }
}

/// Fill and opacity of a cell.
fn fill(row: &CellRow) -> (&'static str, f64) {
    let share = f64::from(row.delivered) / f64::from(row.repeats);
    match row.delivered.max(row.late).max(row.lost) {
        most if most == row.delivered => (DELIVERED, 0.25 + 0.75 * share),
        most if most == row.late => ("url(#late)", 1.0),
        _ => ("url(#lost)", 1.0),
    }
}

fn words(row: &CellRow) -> String {
    let why = row.why.as_ref().map_or(String::new(), |why| format!(" ({why})"));
    let time = row.time_s_median.map_or(String::new(), |time_s| format!(", median {time_s:.1} s"));
    format!("{} delivered, {} late, {} not delivered{why}{time}", row.delivered, row.late, row.lost)
}

fn places(report: &Report, map: &Map, rows: &[&CellRow]) -> Markup {
    let workspace = map.workspace();
    let scale = WIDTH / workspace.size_m().x;
    let x = |x_m: f64| (x_m - workspace.x_min_m) * scale;
    let y = |y_m: f64| (workspace.y_max_m - y_m) * scale;
    let outline = |ring: &[[f64; 2]]| {
        let corners: Vec<String> = ring.iter().map(|&[x_m, y_m]| format!("{:.1},{:.1}", x(x_m), y(y_m))).collect();
        format!("M{}Z", corners.join("L"))
    };
    let walls: String = map.walls().iter().flat_map(|wall| wall.rings()).map(outline).collect();
    let dot = |at: Point2<f64>, color: &str, name: &str| {
        html! { circle cx=(x(at.x)) cy=(y(at.y)) r="6" fill=(color) stroke="#fff" stroke-width="2" { title { (name) } } }
    };
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {:.0}", workspace.size_m().y * scale)) role="img" {
            defs { (PreEscaped(PATTERNS)) }
            path d=(walls) fill="#cdaaa5" fill-rule="evenodd" {}
            @for row in rows {
                @if let (Some(x_m), Some(y_m), Some(size_m)) = (row.x_m, row.y_m, row.size_m) {
                    @let (fill, opacity) = fill(row);
                    rect x=(x(x_m - size_m / 2.0)) y=(y(y_m + size_m / 2.0)) width=(size_m * scale - 0.5)
                        height=(size_m * scale - 0.5) fill=(fill) fill-opacity=(opacity) { title { (words(row)) } }
                }
            }
            (dot(report.bead_m, "#c85a00", "bead"))
            @if let Some(goal_m) = report.goal_m { (dot(goal_m, "#15803d", "goal")) }
        }
    }
}

/// The different values of a column, in order.
fn steps(rows: &[&CellRow], value: fn(&CellRow) -> Option<f64>) -> Vec<f64> {
    let mut steps: Vec<f64> = rows.iter().filter_map(|row| value(row)).collect();
    steps.sort_by(f64::total_cmp);
    steps.dedup();
    steps
}

/// Times to the right, durations upward.
fn losses(rows: &[&CellRow]) -> Markup {
    let (times_s, durations_s) = (steps(rows, |row| row.at_s), steps(rows, |row| row.strength));
    let (wide, high) = ((WIDTH - 40.0) / times_s.len() as f64, 30.0);
    let bottom = high * durations_s.len() as f64;
    let place =
        |steps: &[f64], value: Option<f64>| steps.iter().position(|step| Some(*step) == value).unwrap_or(0) as f64;
    html! {
        svg viewBox=(format!("0 0 {WIDTH} {}", bottom + 24.0)) role="img" {
            defs { (PreEscaped(PATTERNS)) }
            @for row in rows {
                @let (fill, opacity) = fill(row);
                rect x=(40.0 + place(&times_s, row.at_s) * wide) y=(bottom - (place(&durations_s, row.strength) + 1.0) * high)
                    width=(wide - 1.0) height=(high - 1.0) fill=(fill) fill-opacity=(opacity) { title { (words(row)) } }
            }
            @for (index, duration_s) in durations_s.iter().enumerate() {
                text x="34" y=(bottom - (index as f64 + 0.35) * high) text-anchor="end" font-size="11" {
                    (format!("{duration_s:.1} s"))
                }
            }
            @for (index, time_s) in times_s.iter().enumerate().step_by(4) {
                text x=(40.0 + index as f64 * wide) y=(bottom + 15.0) font-size="11" { (format!("at {time_s:.1} s")) }
            }
        }
    }
}

/// Rings of sectors, the strongest outside.
fn directions(rows: &[&CellRow], kind: Kind) -> Markup {
    let strengths = steps(rows, |row| row.strength);
    let (least, most) = (strengths.first().copied().unwrap_or(1.0), strengths.last().copied().unwrap_or(1.0));
    let (per_unit, unit) = if kind == Kind::Push { (1e3, "mN") } else { (1e2, "cm") };
    let count = rows.iter().filter(|row| row.strength == Some(least)).count();
    let half = std::f64::consts::PI / count.max(1) as f64;
    let scale = (WIDTH / 2.0 - 30.0) / (most + least);
    let corner = |radius: f64, angle: f64| format!("{:.1},{:.1}", radius * angle.cos(), -radius * angle.sin());
    let sector = |direction_rad: f64, strength: f64| {
        let (inner, outer) = (strength * scale, (strength + least) * scale);
        let (from, to) = (direction_rad - half, direction_rad + half);
        let corners = [corner(inner, from), corner(outer, from), corner(outer, to), corner(inner, to)];
        format!(
            "M{}L{}A{outer:.1} {outer:.1} 0 0 0 {}L{}A{inner:.1} {inner:.1} 0 0 1 {}Z",
            corners[0], corners[1], corners[2], corners[3], corners[0]
        )
    };
    html! {
        svg viewBox=(format!("{} {} {WIDTH} {WIDTH}", -WIDTH / 2.0, -WIDTH / 2.0)) role="img" {
            defs { (PreEscaped(PATTERNS)) }
            @for row in rows {
                @if let (Some(direction_rad), Some(strength)) = (row.direction_rad, row.strength) {
                    @let (fill, opacity) = fill(row);
                    path d=(sector(direction_rad, strength)) fill=(fill) fill-opacity=(opacity) stroke="#fff" {
                        title { (words(row)) }
                    }
                }
            }
            @for (index, &strength) in strengths.iter().enumerate() {
                text y=((strength + least / 2.0) * scale + 4.0) text-anchor="middle" font-size="12" stroke="#fff"
                    stroke-width="3" paint-order="stroke" {
                    (format!("{:.1}", strength * per_unit)) @if index + 1 == strengths.len() { " " (unit) }
                }
            }
        }
    }
}
