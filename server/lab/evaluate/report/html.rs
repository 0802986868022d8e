//! The report as a single HTML file.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Report;
use super::curves::Curves;
use crate::evaluate::comparison::PairedMean;
use crate::evaluate::{Comparison, Failure, PaperRow, Row, Setting};

const STYLE: &str = "
:root { color-scheme: light dark; --line: #8886; --mark: #0a63c2; --paper: #c85a00; }
@media (prefers-color-scheme: dark) { :root { --mark: #7ab8ff; --paper: #ffa45c; } }
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 96rem; padding: 0 1rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0; }
th, td { border-bottom: 1px solid var(--line); padding: .3rem .6rem; text-align: right; vertical-align: top; }
td, tbody th { white-space: nowrap; }
td.long { white-space: normal; }
th:first-child, td:first-child, .text { text-align: left; }
thead th { vertical-align: bottom; }
tr.paper { color: var(--paper); }
.scroll { overflow-x: auto; }
figure { margin: 1.5rem 0; }
figure svg { background: #fff; height: auto; max-width: 100%; }
.interval { height: 1em; vertical-align: -.15em; width: 8em; }
.interval line { stroke: var(--mark); stroke-width: 2; }
.interval circle { fill: var(--mark); }
.interval .all { stroke: var(--line); stroke-width: 1; }
.paper .interval line { stroke: var(--paper); }
.paper .interval circle { fill: var(--paper); }
.paper .interval .all { stroke: var(--line); }
small { opacity: .75; }
";

pub(super) fn document(report: &Report, page: &str) -> String {
    let title = format!("Ferry: {} rows, seed {}", report.rows.len(), report.seed);
    let body = html! {
        h1 { "Evaluation" }
        p {
            "Ferry " (report.ferry) ", seed " (report.seed) ", rendered by " (report.adapter) ". "
            em { "Reached" } ": the tool came within 2 cm of the goal, the paper's test. "
            em { "Delivered" } ": the bead did too. All controllers of a map met the same starts, goals, seeds \
             and pushes. Intervals are at 95 %."
        }
        @for figure in Curves::all(&report.rows) {
            figure { (PreEscaped(figure.to_svg().unwrap_or_default())) }
        }
        (rows(report))
        (comparisons(&report.comparisons))
        (failures(&report.failures, page))
        h2 { "The first episode of each row" }
        @for (row, figure) in report.rows.iter().zip(&report.figures) {
            @if let Some(svg) = figure {
                figure {
                    figcaption { (subject(row)) }
                    (PreEscaped(svg))
                }
            }
        }
    };
    html_document(&title, STYLE, body)
}

/// A document that needs no other file.
pub fn html_document(title: &str, style: &str, body: Markup) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width";
                title { (title) }
                style { (PreEscaped(style)) }
            }
            body {
                (body)
                p { small { "A simulation; not safety-rated." } }
            }
        }
    }
    .into_string()
}

fn subject(row: &Row) -> String {
    let varied: String = row.varied.iter().map(|setting| format!(", {setting}")).collect();
    format!("{} on {}, {} disturbances{varied}", row.controller, row.map, row.disturbances)
}

fn rows(report: &Report) -> Markup {
    let is_varied = report.rows.iter().any(|row| !row.varied.is_empty());
    html! {
        @if !report.changes().is_empty() {
            p { "Parameters other than the default: " (report.changes().join(", ")) }
        }
        @for row in report.rows.iter().filter(|row| row.trained_on_map == Some(false)) {
            p { (subject(row)) ": the policy was not trained on this map." }
        }
        @for row in report.rows.iter().filter(|row| row.beyond_steps > 0) {
            p { (subject(row)) ": " (row.beyond_steps) " goals are farther than step_limit allows." }
        }
        div.scroll { table {
            thead { tr {
                th scope="col" { "Controller" } th.text scope="col" { "Map" }
                @if is_varied { th.text scope="col" { "Varied" } }
                th scope="col" { "Disturbances" }
                th scope="col" { "Reached" } th scope="col" { "Wilson" }
                th scope="col" { "Delivered" } th scope="col" { "Wilson" }
                th scope="col" { "Mean error" br; small { "distance; in x, in y; mm" } }
                th scope="col" { "Largest error" br; small { "mean over episodes, in x, in y; mm" } }
                th scope="col" { "Way over shortest" }
                th scope="col" { "Steps" } th scope="col" { "Switches" }
                th scope="col" { "Control step" br; small { "p50, p99; ms" } }
            } }
            tbody {
                @for (row, paper) in report.rows.iter().zip(&report.paper) {
                    tr {
                        th scope="row" { (row.controller) }
                        td.text { (row.map) }
                        @if is_varied { td.text { (Setting::line(&row.varied)) } }
                        td { (row.disturbances) }
                        td { (row.successes) "/" (row.episodes) }
                        td { (interval(row.successes, row.episodes, row.successes_wilson95)) }
                        td { (row.delivered) "/" (row.episodes) }
                        td { (interval(row.delivered, row.episodes, row.wilson95)) }
                        td {
                            (mm(row.tracking_error_mean_m)) "; " (mm(row.tracking_error_mean_x_m)) ", "
                            (mm(row.tracking_error_mean_y_m))
                        }
                        td { (mm(row.tracking_error_max_x_m)) ", " (mm(row.tracking_error_max_y_m)) }
                        td { (row.path_ratio_mean.map_or("–".into(), |ratio| format!("{ratio:.3}"))) }
                        td { (format!("{:.1}", row.steps_mean)) }
                        td { (format!("{:.2}", row.switches_mean)) }
                        td { (format!("{:.1}, {:.1}", row.decision_ms_p50, row.decision_ms_p99)) }
                    }
                    @if let Some(paper) = paper { (paper_row(paper, row)) }
                }
            }
        } }
    }
}

fn paper_row(paper: &PaperRow, row: &Row) -> Markup {
    html! {
        tr.paper {
            th scope="row" { "the paper, " (paper.section) }
            td.text { "its own maze" }
            td { @if row.disturbances > 0 { "some" } @else { "0" } }
            td { (paper.successes) "/" (paper.episodes) br; small { "printed as " (paper.printed) } }
            td { (interval(paper.successes, paper.episodes, paper.successes_wilson95)) }
            td { "–" } td { "–" }
            td { @if let Some(error_m) = paper.tracking_error_mean_m { (mm(error_m)) " in both axes" } @else { "–" } }
            td {
                @if let (Some(x_m), Some(y_m)) = (paper.tracking_error_max_x_m, paper.tracking_error_max_y_m) {
                    (mm(x_m)) ", " (mm(y_m))
                } @else { "–" }
            }
            td { "–" } td { "–" } td { "–" } td { "–" }
        }
    }
}

/// A share and its interval on a line from 0 to 1, and as numbers.
fn interval(count: u32, of: u32, [low, high]: [f64; 2]) -> Markup {
    let share = f64::from(count) / f64::from(of);
    html! {
        svg.interval viewBox="-4 0 108 12" role="img" aria-label=(format!("{low:.3} to {high:.3}")) {
            line.all x1="0" x2="100" y1="6" y2="6" {}
            line x1=(100.0 * low) x2=(100.0 * high) y1="6" y2="6" {}
            circle cx=(100.0 * share) cy="6" r="3.5" {}
        }
        br;
        small { (format!("{low:.3}–{high:.3}")) }
    }
}

fn comparisons(comparisons: &[Comparison]) -> Markup {
    html! {
        @if !comparisons.is_empty() {
            h2 { "Paired differences" }
            p { "First minus second, at the same trials; steps, errors and paths where both delivered." }
            div.scroll { table {
                thead { tr {
                    th scope="col" { "First – second" } th.text scope="col" { "Map" }
                    th scope="col" { "Disturbances" }
                    th scope="col" { "Delivered" br; small { "both, first only, second only, neither" } }
                    th scope="col" { "Difference of shares" br; small { "percentage points" } }
                    th scope="col" { "Steps" } th scope="col" { "Mean error, mm" } th scope="col" { "Way over shortest" }
                } }
                tbody {
                    @for one in comparisons {
                        tr {
                            th scope="row" { (one.controller) " – " (one.against) }
                            td.text { (one.map) " " small { (Setting::line(&one.varied)) } }
                            td { (one.disturbances) }
                            td { (one.both) ", " (one.first_only) ", " (one.second_only) ", " (one.neither) }
                            td {
                                (format!("{:+.1}", one.delivered_difference * 100.0))
                                br;
                                small { (range(one.delivered_difference95, 100.0, 1)) }
                            }
                            td { (paired(one.steps, 1.0, 1)) }
                            td { (paired(one.tracking_error_mean_m, 1e3, 1)) }
                            td { (paired(one.path_ratio, 1.0, 3)) }
                        }
                    }
                }
            } }
        }
    }
}

fn paired(mean: Option<PairedMean>, scale: f64, digits: usize) -> Markup {
    html! {
        @match mean {
            Some(mean) => {
                (format!("{:+.digits$}", mean.mean * scale))
                br;
                small { (range(mean.interval95, scale, digits)) }
            }
            None => "–",
        }
    }
}

fn range([low, high]: [f64; 2], scale: f64, digits: usize) -> String {
    format!("{:+.digits$} to {:+.digits$}", low * scale, high * scale)
}

fn failures(failures: &[Failure], page: &str) -> Markup {
    html! {
        h2 { "Failures" }
        @if failures.is_empty() {
            p { "None." }
        } @else {
            p { "A link sets the episode up in the laboratory at " code { (page) } "; Run replays it." }
            div.scroll { table {
                thead { tr {
                    th scope="col" { "Controller" } th.text scope="col" { "Map" } th scope="col" { "Disturbances" }
                    th scope="col" { "Episode" } th.text scope="col" { "How it ended" } th scope="col" { "Steps" }
                } }
                tbody {
                    @for failure in failures {
                        tr {
                            th scope="row" { (failure.controller) }
                            td.text { (failure.map) " " small { (Setting::line(&failure.varied)) } }
                            td { (failure.disturbances) }
                            td {
                                @match &failure.link {
                                    Some(link) => a href=(format!("{page}/{link}")) { (failure.index) },
                                    None => (failure.index),
                                }
                            }
                            td.text.long { (failure.reason()) @if failure.reached { " (reached)" } }
                            td { (failure.steps) }
                        }
                    }
                }
            } }
        }
    }
}

fn mm(length_m: f64) -> String {
    format!("{:.1}", length_m * 1e3)
}
