//! Commands, assembled from the floors below.

mod evaluate;
mod map;
mod render;
mod serve;
mod sweep;
mod train;

use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;
use clap::{Parser, Subcommand};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::camera::{AdapterChoice, CameraError, Gpu};

/// A browser laboratory: a robot arm carries a magnetic bead through a maze.
#[derive(Parser)]
#[command(name = "ferry", version, about, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Without a command, `ferry` serves.
    #[command(flatten)]
    serve: serve::Arguments,
}

#[derive(Subcommand)]
enum Command {
    /// Serve the laboratory page (the default)
    Serve(serve::Arguments),
    /// Repeat the paper's experiment: random trials, counted
    Evaluate(evaluate::Arguments),
    /// Render one frame to a PNG file, headless
    Render(render::Arguments),
    /// Check a map and print what it is
    Map(map::Arguments),
    /// Take one camera image a centimetre of a map, as training looks at them
    Sweep(sweep::Arguments),
    /// Train a Rainbow-IQN policy: progress bar, checkpoints, learning curve
    Train(train::Arguments),
}

/// Parses the arguments and runs the command; clap's own exits (help, usage) come back as codes.
pub fn run(arguments: impl Iterator<Item = OsString>) -> anyhow::Result<ExitCode> {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(usage) => {
            usage.print()?;
            return Ok(ExitCode::from(usage.exit_code() as u8));
        }
    };
    tracing_subscriber::fmt()
        .with_env_filter(
            tracing_subscriber::EnvFilter::try_from_env("FERRY_LOG").unwrap_or_else(|_| "ferry=info,warn".into()),
        )
        .with_writer(std::io::stderr)
        .init();
    match arguments.command.unwrap_or(Command::Serve(arguments.serve)) {
        Command::Serve(arguments) => serve::run(&arguments),
        Command::Evaluate(arguments) => evaluate::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Train(arguments) => train::run(&arguments),
    }
}

/// Opens the graphics adapter; `FERRY_ADAPTER` (auto, vulkan, gl) overrides the choice.
fn open_gpu() -> Result<Arc<Gpu>, CameraError> {
    let choice = match std::env::var("FERRY_ADAPTER") {
        Ok(name) => name.parse::<AdapterChoice>()?,
        Err(_) => AdapterChoice::default(),
    };
    Gpu::open(choice)
}

/// A value with some of its fields changed by `NAME=VALUE`; a dot leads into a field's own fields.
fn with_changes<T: Serialize + DeserializeOwned>(value: &T, changes: &[String]) -> anyhow::Result<T> {
    let mut values = serde_json::to_value(value)?;
    for change in changes {
        let (name, text) = change.split_once('=').with_context(|| format!("--set {change}: it must be NAME=VALUE"))?;
        // Numbers and flags are JSON; anything else is the name of a choice.
        let new = serde_json::from_str(text).unwrap_or_else(|_| text.into());
        let (within, last) = name.rsplit_once('.').unwrap_or(("", name));
        let pointer =
            within.split('.').filter(|part| !part.is_empty()).map(|part| format!("/{part}")).collect::<String>();
        let object = values.pointer_mut(&pointer).and_then(serde_json::Value::as_object_mut);
        object.with_context(|| format!("--set {change}: there is no {within:?}"))?.insert(last.to_owned(), new);
    }
    serde_path_to_error::deserialize(values).context("--set")
}
