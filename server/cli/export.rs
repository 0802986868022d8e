//! `ferry export`.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;

use crate::export::{mjcf, urdf};
use ferry_core::scenario::Parameters;

#[derive(clap::Args)]
pub struct Arguments {
    format: Format,
    /// File to write, instead of standard output
    #[arg(long)]
    out: Option<PathBuf>,
    /// Set a parameter, for example block_orientation=B; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// For ROS and most simulators
    Urdf,
    /// For MuJoCo
    Mjcf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let parameters = Parameters::default().with(&arguments.set).context("--set")?;
    let text = match arguments.format {
        Format::Urdf => urdf(&parameters),
        Format::Mjcf => mjcf(&parameters),
    };
    match &arguments.out {
        Some(path) => std::fs::write(path, text).with_context(|| path.display().to_string())?,
        None => print!("{text}"),
    }
    Ok(ExitCode::SUCCESS)
}
