//! `ferry serve`.

use std::io::Write;
use std::net::{IpAddr, SocketAddr, ToSocketAddrs};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use anyhow::Context;
use clap::builder::RangedU64ValueParser;
use tokio::sync::watch;

use crate::http::{self, EmbeddedFile, Page};
use ferry_core::scenario::Scenario;
use ferry_files::open;
use ferry_recording::Retention;
use ferry_ur::server::Ports;
use ferry_ur::{Twin, model::Model};

/// When the server has stopped: time for background work to end.
const END_WITHIN: Duration = Duration::from_secs(1);

#[derive(clap::Args, Clone)]
pub struct Arguments {
    /// Address to listen on, or the name of this host, with a port; port 0 picks a free one
    #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:8080", value_parser = listened)]
    bind: Listened,
    /// Access token that clients must send, 64 hexadecimal digits (`ferry token` makes one). Other users of this
    /// machine can read a command line: prefer --token-file or FERRY_TOKEN
    #[arg(long, env = "FERRY_TOKEN", hide_env_values = true, value_parser = secret)]
    token: Option<Secret>,
    /// File that contains only the token
    #[arg(long, value_name = "FILE", conflicts_with = "token")]
    token_file: Option<PathBuf>,
    /// Additional address that browsers use, besides that of --bind, for example https://lab.example.org; may be
    /// repeated
    #[arg(long, value_name = "URL")]
    origin: Vec<http::Origin>,
    /// Path below which a proxy has this server, such as /ferry
    #[arg(long, value_name = "PATH", default_value = "/")]
    base_path: http::BasePath,
    /// Largest number of simultaneous sessions
    #[arg(long, value_name = "COUNT", default_value_t = 32, value_parser = clap::value_parser!(u16).range(1..=256))]
    sessions: u16,
    /// Pause a session without viewers after this time; it may then be closed if another needs its place
    #[arg(long, value_name = "MINUTES", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..))]
    park_after: u32,
    /// Scenario that sessions begin with: the name of a shipped one, or the path of a JSON file. Without it, new
    /// sessions begin with `opening`, and others go on where the last server stopped
    #[arg(long, value_name = "NAME|FILE")]
    scenario: Option<String>,
    /// Folder for recordings, saved sessions and uploaded maps
    #[arg(long, default_value = "data")]
    data: PathBuf,
    /// Largest number of kept recordings; a session writes one every ten minutes
    #[arg(long, value_name = "COUNT", default_value_t = Retention::default().max_parts, value_parser = RangedU64ValueParser::<usize>::new().range(1..))]
    keep: usize,
    /// Largest total size of kept recordings, in megabytes
    #[arg(long, value_name = "MB", default_value_t = Retention::default().max_bytes >> 20, value_parser = clap::value_parser!(u64).range(1..))]
    keep_mb: u64,
    /// Answer as the controller of a UR5 would, on this address; the arm is that of the session `main`. Ports 29999
    /// (dashboard) and 30004 (RTDE) report it
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, default_missing_value = "127.0.0.1", value_parser = super::host)]
    robot_server: Option<IpAddr>,
    /// Let --robot-server listen on another address than loopback. It has no password, as a real one has none
    #[arg(long, requires = "robot_server")]
    robot_server_insecure: bool,
    /// Report poses, and a name, of another arm than a UR5: a JSON file with `name`; `d_m`, `a_m` and `alpha_rad`, six numbers
    /// each; and `tcp_m`, if its tool is not Ferry's. The joints move as before. For trying whether a client can tell arms apart
    #[arg(long, value_name = "FILE", requires = "robot_server")]
    robot_server_model: Option<PathBuf>,
    /// Open the page in the default browser
    #[arg(long)]
    open: bool,
}

/// An unchecked token. It is checked later, because clap would print a refused value.
#[derive(Clone)]
struct Secret(String);

fn secret(text: &str) -> Result<Secret, std::convert::Infallible> {
    Ok(Secret(text.to_owned()))
}

/// What `--bind` means.
#[derive(Clone)]
struct Listened {
    address: SocketAddr,
    /// The name of the host, if it is one.
    name: Option<String>,
}

fn listened(text: &str) -> Result<Listened, String> {
    let example = |error| format!("{error}; it must be like 127.0.0.1:8080, [::1]:8080 or localhost:8080");
    let found = text.to_socket_addrs().map_err(|error| example(error.to_string()))?;
    let address =
        found.min_by_key(SocketAddr::is_ipv6).ok_or_else(|| example("this name has no address".to_owned()))?;
    let name = text.rsplit_once(':').map(|(name, _)| name.to_owned());
    Ok(Listened { address, name: name.filter(|_| text.parse::<SocketAddr>().is_err()) })
}

impl Listened {
    /// The address that browsers use for a name. On loopback only `localhost` and the addresses are meant.
    fn origin(&self, port: u16) -> Option<http::Origin> {
        let name = self.name.as_ref().filter(|_| !self.address.ip().is_loopback())?;
        format!("http://{name}:{port}").parse().ok()
    }
}

/// The token from the options, if one is set.
fn token(arguments: &Arguments) -> anyhow::Result<Option<http::Token>> {
    let (text, from) = match (&arguments.token, &arguments.token_file) {
        (Some(Secret(text)), _) => (text.clone(), "--token".to_owned()),
        (None, Some(file)) => {
            let from = format!("--token-file {}", file.display());
            (std::fs::read_to_string(file).with_context(|| from.clone())?, from)
        }
        (None, None) => return Ok(None),
    };
    Ok(Some(text.parse().context(from)?))
}

/// Checks early that the folder can be written to.
fn check_folder(data: &Path) -> anyhow::Result<()> {
    let probe = data.join(".ferry-probe");
    std::fs::create_dir_all(data)
        .and_then(|()| std::fs::write(&probe, []))
        .and_then(|()| std::fs::remove_file(&probe))
        .with_context(|| format!("--data {}: the folder cannot be written to", data.display()))
}

/// The scenario of new sessions. A session has no inputs before its operator, and only maps of the library.
fn opening(name_or_path: &str) -> anyhow::Result<Scenario> {
    let case = open::case(name_or_path).context("--scenario")?;
    anyhow::ensure!(case.map.is_none(), "--scenario {name_or_path}: map is a drawing, it must be the name of a map");
    anyhow::ensure!(case.inputs.is_empty(), "--scenario {name_or_path}: inputs has items, it must be empty");
    Ok(case.scenario)
}

/// Serves; the arm of the session `main` is the twin of a robot, if there is one.
pub fn run(arguments: &Arguments, files: &'static [EmbeddedFile], twin: Option<Twin>) -> anyhow::Result<ExitCode> {
    anyhow::ensure!(
        twin.is_none() || arguments.robot_server.is_none(),
        "--robot-server: it cannot be used with `ferry drive`, because the arm follows the robot"
    );
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    let served = runtime.block_on(serve(arguments, Page::new(files), twin.map(Arc::new)));
    // A graphics device that is closed while the process ends crashes it: background work ends before, or is left behind.
    runtime.shutdown_timeout(END_WITHIN);
    served?;
    Ok(ExitCode::SUCCESS)
}

/// The arm that the robot server reports.
fn model(path: &Path) -> anyhow::Result<Model> {
    let named = || format!("--robot-server-model {}", path.display());
    Model::read(&std::fs::read_to_string(path).with_context(named)?).with_context(named)
}

/// Opens the ports of the robot's controller, if they are wanted.
async fn robot_ports(arguments: &Arguments) -> anyhow::Result<Option<Ports>> {
    let Some(address) = arguments.robot_server else { return Ok(None) };
    anyhow::ensure!(
        address.is_loopback() || arguments.robot_server_insecure,
        "--robot-server {address}: anyone who reaches this address could use it; add --robot-server-insecure if that is meant"
    );
    if !address.is_loopback() {
        tracing::warn!(%address, "the robot server has no password");
    }
    Ok(Some(Ports::open(address).await?))
}

async fn serve(arguments: &Arguments, page: Page, twin: Option<Arc<Twin>>) -> anyhow::Result<()> {
    let token = token(arguments)?;
    let opening = opening(arguments.scenario.as_deref().unwrap_or("opening"))?;
    let listener = http::listen(arguments.bind.address).await?;
    let address = listener.local_addr()?;
    let origins: Vec<_> = arguments.origin.iter().cloned().chain(arguments.bind.origin(address.port())).collect();
    let access = http::Access::new(address, token, &origins)?;
    let model = arguments.robot_server_model.as_deref().map(model).transpose()?;
    let ports = robot_ports(arguments).await?;
    // Only after the checks above, so that a refused start leaves no folder behind.
    check_folder(&arguments.data)?;
    let gpu = super::open_gpu()?;
    tracing::info!(adapter = gpu.adapter_name(), "rendering");
    let (stop, stopping) = watch::channel(false);
    let retention = Retention { max_parts: arguments.keep, max_bytes: arguments.keep_mb.saturating_mul(1 << 20) };
    let settings = http::Settings {
        retention,
        sessions: arguments.sessions.into(),
        park_after: Duration::from_secs(60 * u64::from(arguments.park_after)),
        shows_main: arguments.scenario.is_some() || twin.is_some() || arguments.robot_server.is_some(),
        opening,
        start_over: arguments.scenario.is_some(),
        twin: twin.clone(),
        page,
        base: arguments.base_path.clone(),
        ..http::Settings::in_folder(arguments.data.clone())
    };
    let server = http::Server::new(gpu, settings, access, stopping.clone())?;
    if let Some(model) = model {
        server.robot().set_model(model);
    }
    if let Some(ports) = ports {
        tokio::spawn(ferry_ur::server::serve(ports, server.robot().clone(), stopping.clone()));
    }
    if let Some(twin) = twin {
        tokio::spawn(ferry_ur::client::keep(twin, stopping));
    }
    // A full disk behind standard output, or a reader that is gone, does not end the server.
    let _ = writeln!(std::io::stdout(), "listening on http://{address}");
    if arguments.open
        && let Err(error) = opener::open(format!("http://{address}"))
    {
        tracing::warn!(%error, "the browser could not be opened");
    }
    tokio::spawn(async move {
        stop_requested().await;
        // The server may already have ended.
        let _ = stop.send(true);
    });
    http::serve(listener, server).await?;
    Ok(())
}

/// Waits for Ctrl-C or SIGTERM.
async fn stop_requested() {
    #[cfg(unix)]
    {
        use tokio::signal::unix::{SignalKind, signal};
        if let Ok(mut terminate) = signal(SignalKind::terminate()) {
            tokio::select! {
                _ = terminate.recv() => return,
                _ = tokio::signal::ctrl_c() => return,
            }
        }
    }
    let _ = tokio::signal::ctrl_c().await;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_and_names_are_listened_on() {
        for (text, address) in
            [("127.0.0.1:80", "127.0.0.1:80"), ("[::1]:80", "[::1]:80"), ("localhost:0", "127.0.0.1:0")]
        {
            let found = listened(text).unwrap();
            assert_eq!(found.address, address.parse().unwrap());
            assert!(found.origin(80).is_none(), "loopback has its own names");
        }
        let lab = Listened { address: "10.0.0.7:0".parse().unwrap(), name: Some("lab.local".to_owned()) };
        assert_eq!(lab.origin(8080).unwrap().to_string(), "http://lab.local:8080");
        for text in ["localhost", "80", "127.0.0.1", "localhost:99999", "no such host:80", ""] {
            let error = listened(text).err().unwrap();
            assert!(error.contains("localhost:8080"), "{text:?}: {error}");
        }
        assert!(super::super::host("localhost").unwrap().is_loopback());
        assert!(super::super::host("no such host").is_err());
    }
}
