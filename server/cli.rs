//! The command line.

mod attempts;
mod check;
mod drive;
mod evaluate;
mod export;
mod formats;
mod map;
mod maps;
mod merge;
mod progress;
mod recovery;
mod render;
mod replay;
mod serve;
mod sweep;
mod track;
mod train;

use std::ffi::OsString;
use std::net::{IpAddr, ToSocketAddrs};
use std::ops::RangeInclusive;
use std::process::ExitCode;
use std::sync::Arc;

use anyhow::Context;
use clap::builder::RangedI64ValueParser;
use clap::{Parser, Subcommand};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::http::EmbeddedFile;
use ferry_camera::{AdapterChoice, Gpu};
use ferry_core::image::CameraError;

/// A browser laboratory: a robot arm carries a magnetic bead through a maze.
#[derive(Parser)]
#[command(name = "ferry", version, args_conflicts_with_subcommands = true)]
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
    /// Export what people did in challenges
    #[command(subcommand)]
    Attempts(attempts::Command),
    /// Run stored trials again, and fail if a controller delivers less often
    Check(check::Arguments),
    /// Serve the laboratory page with the arm as the twin of a real UR5
    Drive(drive::Arguments),
    /// Repeat the paper's experiment: random trials, counted
    Evaluate(evaluate::Arguments),
    /// Write the arm with gripper and magnet as a model for other programs
    Export(export::Arguments),
    /// Try disturbances from one moment, and map where the bead is still delivered
    Recovery(recovery::Arguments),
    /// Render one image to a PNG file, headless
    Render(render::Arguments),
    /// Check a map and print its properties
    Map(map::Arguments),
    /// Merge the shards of an evaluation
    Merge(merge::Arguments),
    /// Generate mazes
    #[command(subcommand)]
    Maps(maps::Command),
    /// Run an input log again and compare every hash
    Replay(replay::Arguments),
    /// Take a camera image of a map every centimetre, for training
    Sweep(sweep::Arguments),
    /// Print a new token, for `ferry serve --token-file`
    Token,
    /// Let the bead follow a moving point, and measure how well
    Track(track::Arguments),
    /// Train a Rainbow-IQN policy: progress bar, checkpoints, learning curve
    Train(train::Arguments),
}

/// Parses the arguments and runs the command, which may serve the page with these files. Help, version and usage errors are
/// printed by clap and returned as codes.
pub fn run(arguments: impl Iterator<Item = OsString>, files: &'static [EmbeddedFile]) -> anyhow::Result<ExitCode> {
    set_signals(false);
    // An empty variable counts as one that is not set.
    let is_empty =
        |name: &OsString, value: &OsString| value.is_empty() && name.as_encoded_bytes().starts_with(b"FERRY_");
    let empty: Vec<OsString> =
        std::env::vars_os().filter(|(name, value)| is_empty(name, value)).map(|(name, _)| name).collect();
    for name in empty {
        // SAFETY: no other thread runs yet that could read the environment.
        unsafe { std::env::remove_var(name) };
    }
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(usage) => {
            usage.print()?;
            return Ok(ExitCode::from(usage.exit_code() as u8));
        }
    };
    // Candle's own threads wait by spinning, even for small operations, and take cores from the others.
    // SAFETY: no other thread runs yet that could read the environment.
    unsafe { std::env::set_var("CANDLE_NUM_THREADS", "1") };
    begin_logging()?;
    let command = arguments.command.unwrap_or(Command::Serve(arguments.serve));
    if matches!(command, Command::Serve(_) | Command::Drive(_)) {
        set_signals(true);
    }
    match command {
        Command::Serve(arguments) => serve::run(&arguments, files, None),
        Command::Attempts(command) => attempts::run(&command),
        Command::Check(arguments) => check::run(&arguments),
        Command::Drive(arguments) => drive::run(&arguments, files),
        Command::Evaluate(arguments) => evaluate::run_command(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Recovery(arguments) => recovery::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Map(arguments) => map::run(&arguments),
        Command::Merge(arguments) => merge::run(&arguments),
        Command::Maps(command) => maps::run(&command),
        Command::Replay(arguments) => replay::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Token => {
            println!("{}", crate::http::Token::generate()?);
            Ok(ExitCode::SUCCESS)
        }
        Command::Track(arguments) => track::run(&arguments),
        Command::Train(arguments) => train::run(&arguments),
    }
}

/// Writing a file beyond the limit of its size fails, as on a full disk, instead of ending the process. A command whose output
/// is no longer read ends silently, as is usual; a server goes on.
fn set_signals(is_server: bool) {
    #[cfg(unix)]
    // SAFETY: neither action runs code of this process.
    unsafe {
        libc::signal(libc::SIGXFSZ, libc::SIG_IGN);
        libc::signal(libc::SIGPIPE, if is_server { libc::SIG_IGN } else { libc::SIG_DFL });
    }
}

/// A whole number of a range that the library has.
fn within(allowed: RangeInclusive<u32>) -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(i64::from(*allowed.start())..=i64::from(*allowed.end()))
}

/// An address, or a host's name. If the name has several addresses, one of version 4 is taken.
fn host(text: &str) -> Result<IpAddr, String> {
    let found = (text, 0).to_socket_addrs().map_err(|error| error.to_string())?;
    let first = found.map(|address| address.ip()).min_by_key(IpAddr::is_ipv6);
    first.ok_or_else(|| "this name has no address".to_owned())
}

/// Logs to standard error, filtered by `FERRY_LOG`, as text or, with `FERRY_LOG_FORMAT=json`, as one JSON object per
/// line.
fn begin_logging() -> anyhow::Result<()> {
    let filter = match std::env::var("FERRY_LOG") {
        Ok(filter) => filter.parse().with_context(|| format!("FERRY_LOG is {filter:?}"))?,
        Err(_) => tracing_subscriber::EnvFilter::new("ferry=info,warn"),
    };
    let logging = tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr);
    match std::env::var("FERRY_LOG_FORMAT").as_deref() {
        Ok("json") => logging.json().init(),
        Ok("text") | Err(_) => logging.init(),
        Ok(other) => anyhow::bail!("FERRY_LOG_FORMAT is {other:?}: must be text or json"),
    }
    Ok(())
}

/// Opens the graphics adapter chosen by `FERRY_ADAPTER` (auto, vulkan, gl).
fn open_gpu() -> Result<Arc<Gpu>, CameraError> {
    let choice = match std::env::var("FERRY_ADAPTER") {
        Ok(name) => name.parse::<AdapterChoice>()?,
        Err(_) => AdapterChoice::default(),
    };
    Gpu::open(choice)
}

/// A copy of a value with fields changed by `NAME=VALUE`; dots in a name select nested fields.
fn with_changes<T: Serialize + DeserializeOwned>(value: &T, changes: &[String]) -> anyhow::Result<T> {
    let mut values = serde_json::to_value(value)?;
    for change in changes {
        let (name, text) =
            change.split_once('=').with_context(|| format!("--set {change}: must have the form NAME=VALUE"))?;
        // Numbers and flags are JSON; anything else is the name of a variant.
        let new = serde_json::from_str(text).unwrap_or_else(|_| text.into());
        let (within, last) = name.rsplit_once('.').unwrap_or(("", name));
        let pointer =
            within.split('.').filter(|part| !part.is_empty()).map(|part| format!("/{part}")).collect::<String>();
        let object = values.pointer_mut(&pointer).and_then(serde_json::Value::as_object_mut);
        object.with_context(|| format!("--set {change}: there is no field {within:?}"))?.insert(last.to_owned(), new);
    }
    serde_path_to_error::deserialize(values).context("--set")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ferry_core::policy::{Architecture, Fusion};
    use ferry_lab::learn::Recipe;

    fn changed(changes: &[&str]) -> anyhow::Result<Recipe> {
        let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
        with_changes(&Recipe::default(), &changes)
    }

    #[test]
    fn sets_fields_and_nested_fields_only() {
        assert_eq!(changed(&[]).unwrap(), Recipe::default());
        let architecture = Architecture { fusion: Fusion::Early, dueling: false, ..Architecture::default() };
        let expected = Recipe { architecture, n_step: 3, discount: 0.99, timeout_fails: true, ..Recipe::default() };
        let changes = [
            "n_step=3",
            "architecture.dueling=false",
            "discount=.5",
            "architecture.fusion=early",
            "timeout_fails=true",
            "discount=0.99",
        ];
        // The later of two values counts. `.5` is not JSON, but is replaced before it is parsed.
        assert_eq!(changed(&changes).unwrap(), expected);
    }

    #[test]
    fn refuses_unknown_fields_by_name() {
        for (change, parts) in [
            ("wings=2", &["unknown field `wings`"][..]),
            ("architecture.wings=2", &["architecture", "unknown field `wings`"]),
            ("wings.length=2", &["--set wings.length=2", "there is no field \"wings\""]),
            ("n_step.length=2", &["--set n_step.length=2", "there is no field \"n_step\""]),
            ("discount=high", &["discount", "\"high\"", "expected f64"]),
            ("n_step=-1", &["n_step", "`-1`"]),
            ("n_step=2.5", &["n_step", "`2.5`"]),
            ("architecture.fusion=none", &["architecture.fusion", "`none`", "`early`"]),
            ("architecture.dueling=1", &["architecture.dueling", "`1`", "a boolean"]),
            ("discount", &["--set discount", "NAME=VALUE"]),
            ("=1", &["unknown field ``"]),
        ] {
            let error = format!("{:#}", changed(&[change]).unwrap_err());
            assert!(parts.iter().all(|part| error.contains(part)), "{change}: {error}");
        }
    }
}
