//! `ferry serve`.

use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;

use tokio::sync::watch;

use crate::http;
use crate::recording::Retention;

/// Arguments of `ferry serve`.
#[derive(clap::Args, Clone)]
pub struct Arguments {
    /// Address to listen on; port 0 picks a free one
    #[arg(long, default_value = "127.0.0.1:8080")]
    bind: SocketAddr,
    /// Folder of the recordings
    #[arg(long, default_value = "data")]
    data: PathBuf,
    /// Recordings that are kept; a session writes one in ten minutes
    #[arg(long, value_name = "COUNT", default_value_t = Retention::default().most)]
    keep: usize,
    /// Megabytes of recordings that are kept
    #[arg(long, value_name = "MB", default_value_t = Retention::default().most_bytes >> 20)]
    keep_mb: u64,
    /// Open the page in the default browser
    #[arg(long)]
    open: bool,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<ExitCode> {
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    runtime.block_on(serve(arguments))?;
    Ok(ExitCode::SUCCESS)
}

async fn serve(arguments: &Arguments) -> anyhow::Result<()> {
    let listener = http::listen(arguments.bind).await?;
    let address = listener.local_addr()?;
    let gpu = super::open_gpu()?;
    tracing::info!(adapter = gpu.adapter_name(), "rendering");
    let (stop, stopping) = watch::channel(false);
    let retention = Retention { most: arguments.keep, most_bytes: arguments.keep_mb.saturating_mul(1 << 20) };
    let server = http::Server::new(gpu, arguments.data.clone(), retention, stopping)?;
    println!("listening on http://{address}");
    if arguments.open
        && let Err(error) = opener::open(format!("http://{address}"))
    {
        tracing::warn!(%error, "the browser could not be opened");
    }
    tokio::spawn(async move {
        asked_to_stop().await;
        // The server may have ended by itself.
        let _ = stop.send(true);
    });
    http::serve(listener, server).await?;
    Ok(())
}

/// Waits for Ctrl-C or SIGTERM.
async fn asked_to_stop() {
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
