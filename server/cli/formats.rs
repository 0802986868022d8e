//! The formats in which a report is printed and written.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use serde::Serialize;

#[derive(clap::Args)]
pub struct Formats {
    /// Print only one JSON object
    #[arg(long)]
    json: bool,
    /// Write the rows of the table, or the cells of the map, to this CSV file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write tables, figures and maps to this self-contained HTML file
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
}

/// A report in each format.
pub struct Formatted<'a> {
    pub csv: &'a dyn Fn() -> anyhow::Result<String>,
    pub html: &'a dyn Fn() -> anyhow::Result<String>,
    /// Prints it for people.
    pub print: &'a dyn Fn(),
}

impl Formats {
    /// Opens the files before anything runs, so that an error is reported early.
    pub fn prepare(&self) -> anyhow::Result<()> {
        for path in [&self.csv, &self.html].into_iter().flatten() {
            // What is in the file stays until there is something new to write.
            let opened = std::fs::OpenOptions::new().append(true).create(true).open(path);
            opened.with_context(|| path.display().to_string())?;
        }
        Ok(())
    }

    /// Writes the files, and prints the report.
    pub fn write(&self, report: &impl Serialize, formatted: &Formatted<'_>) -> anyhow::Result<ExitCode> {
        for (path, text) in [(&self.csv, formatted.csv), (&self.html, formatted.html)] {
            if let Some(path) = path {
                std::fs::write(path, text()?).with_context(|| path.display().to_string())?;
            }
        }
        if self.json {
            println!("{}", serde_json::to_string(report)?);
        } else {
            (formatted.print)();
        }
        Ok(ExitCode::SUCCESS)
    }
}
