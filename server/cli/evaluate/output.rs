//! What `ferry evaluate` and `ferry merge` print and write.

use std::process::ExitCode;

use comfy_table::{CellAlignment, ColumnConstraint, Table, TableStyle};

use crate::cli::formats::{Formats, Formatted};
use ferry_lab::evaluate::{Comparison, Failure, Manner, PairedMean, Report, Row, Setting};

#[derive(clap::Args)]
pub struct Output {
    #[command(flatten)]
    pub(in crate::cli) formats: Formats,
    /// Address of the page for the links in the report
    #[arg(long, value_name = "ADDRESS", default_value = "http://127.0.0.1:8080")]
    page: String,
}

impl Output {
    /// Writes the files, and prints the report.
    pub fn write(&self, report: &Report, manner: Manner) -> anyhow::Result<ExitCode> {
        let formatted = Formatted {
            csv: &|| Ok(report.to_csv()?),
            html: &|| Ok(report.to_html(&self.page)),
            print: &|| self.print(report, manner),
        };
        self.formats.write(report, &formatted)
    }

    fn print(&self, report: &Report, manner: Manner) {
        println!("seed {}, rendered by {}", report.seed, report.adapter);
        let changes = report.changes();
        if !changes.is_empty() {
            println!("parameters other than the default: {}", changes.join(", "));
        }
        if manner.by_hand {
            println!("disturbed by a hand that draws the bead through free space");
        }
        if manner.tool_apart {
            println!("at the start the tool is at least 15 cm from the bead");
        }
        println!("{}", rows_table(&report.rows));
        for row in report.rows.iter().filter(|row| row.beyond_steps > 0) {
            let Row { controller, map, disturbances, varied, beyond_steps, episodes, .. } = row;
            println!(
                "{controller} on {map}, {disturbances} disturbances{}: {beyond_steps} of {episodes} goals are farther than \
                 step_limit allows",
                after_comma(varied)
            );
        }
        if !report.comparisons.is_empty() {
            println!(
                "\npaired differences, first minus second, with 95 % intervals; steps, error and path where both \
                 delivered, and steps over all trials with the interval corrected for {} comparisons",
                report.comparisons.len()
            );
            println!("{}", comparisons_table(&report.comparisons));
        }
        print_failures(&report.failures, &self.page);
    }
}

/// A table of text, the first `left` columns as words, the others as numbers.
pub(in crate::cli) fn table(head: &[&str], left: usize) -> Table {
    let mut table = Table::new();
    table.load_style(TableStyle::new()).set_header(head.to_vec());
    for column in table.column_iter_mut().skip(left) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

pub(in crate::cli) fn interval([low, high]: [f64; 2]) -> String {
    format!("{low:.3} to {high:.3}")
}

/// What varied parameters are, after a comma; nothing without any.
fn after_comma(varied: &[Setting]) -> String {
    varied.iter().map(|setting| format!(", {setting}")).collect()
}

fn rows_table(rows: &[Row]) -> Table {
    let head = [
        "controller",
        "map",
        "varied",
        "dist.",
        "reached",
        "95 % Wilson",
        "delivered",
        "95 % Wilson",
        "error mm",
        "in x, y",
        "max x, y",
        "path/shortest",
        "steps",
        "switches",
        "trained here",
        "ms/step p50 p99",
    ];
    let mut table = table(&head, 3);
    for row in rows {
        let pair = |x_m: f64, y_m: f64| format!("{:.1} {:.1}", x_m * 1e3, y_m * 1e3);
        table.add_row(vec![
            row.controller.clone(),
            row.map.clone(),
            Setting::line(&row.varied),
            row.disturbances.to_string(),
            format!("{}/{}", row.successes, row.episodes),
            interval(row.successes_wilson95),
            format!("{}/{}", row.delivered, row.episodes),
            interval(row.wilson95),
            format!("{:.1}", row.tracking_error_mean_m * 1e3),
            pair(row.tracking_error_mean_x_m, row.tracking_error_mean_y_m),
            pair(row.tracking_error_max_x_m, row.tracking_error_max_y_m),
            row.path_ratio_mean.map_or("-".to_owned(), |ratio| format!("{ratio:.3}")),
            format!("{:.1}", row.steps_mean),
            format!("{:.2}", row.switches_mean),
            row.trained_on_map.map_or("-", |trained| if trained { "yes" } else { "no" }).to_owned(),
            format!("{:.1} {:.1}", row.decision_ms_p50, row.decision_ms_p99),
        ]);
    }
    without_empty(table, 2)
}

/// Without a column if no row has anything in it.
fn without_empty(mut table: Table, column: usize) -> Table {
    let is_empty = table.row_iter().all(|row| row.cell_iter().nth(column).is_none_or(|cell| cell.content().is_empty()));
    if is_empty && let Some(column) = table.column_mut(column) {
        column.set_constraint(ColumnConstraint::Hidden);
    }
    table
}

fn comparisons_table(comparisons: &[Comparison]) -> Table {
    let head = [
        "first - second",
        "map",
        "varied",
        "dist.",
        "both, first, second, neither",
        "delivered, points",
        "steps",
        "error mm",
        "path/shortest",
        "steps of all",
    ];
    let mut table = table(&head, 3);
    let signed = |mean: f64, [low, high]: [f64; 2], scale: f64, digits: usize| {
        let [mean, low, high] = [mean, low, high].map(|value| value * scale);
        format!("{mean:+.digits$} ({low:+.digits$} to {high:+.digits$})")
    };
    let paired = |mean: Option<PairedMean>, scale: f64, digits: usize| {
        mean.map_or("-".to_owned(), |mean| signed(mean.mean, mean.interval95, scale, digits))
    };
    for one in comparisons {
        table.add_row(vec![
            format!("{} - {}", one.controller, one.against),
            one.map.clone(),
            Setting::line(&one.varied),
            one.disturbances.to_string(),
            format!("{}, {}, {}, {}", one.both, one.first_only, one.second_only, one.neither),
            signed(one.delivered_difference, one.delivered_difference95, 100.0, 1),
            paired(one.steps, 1.0, 1),
            paired(one.tracking_error_mean_m, 1e3, 1),
            paired(one.path_ratio, 1.0, 3),
            one.steps_of_all.map_or("-".to_owned(), |all| signed(all.mean, all.interval_corrected, 1.0, 1)),
        ]);
    }
    without_empty(table, 2)
}

/// Prints each failure with its reason and a link to replay it.
fn print_failures(failures: &[Failure], page: &str) {
    for failure in failures {
        println!(
            "\n{} on {}, {} disturbances{}, trial {}: {} ({} steps)",
            failure.controller,
            failure.map,
            failure.disturbances,
            after_comma(&failure.varied),
            failure.index,
            failure.reason(),
            failure.steps,
        );
        if let Some(link) = &failure.link {
            println!("  {page}/{link}");
        }
    }
}
