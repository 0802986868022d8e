//! The connection with a robot outside of Ferry: RTDE for reports and targets, URScript for the program that follows them,
//! and the dashboard for the robot's model.

use std::io;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;
use std::time::{Duration, Instant};

use bytes::Bytes;
use futures_util::{SinkExt, StreamExt};
use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;
use tokio::sync::watch;
use tokio_util::codec::{Framed, LengthDelimitedCodec, LinesCodec};

use crate::peer::Peer;
use crate::twin::Answer;
use crate::{Twin, dashboard, drive_script, rtde};

const DASHBOARD_PORT: u16 = 29_999;
const RTDE_PORT: u16 = 30_004;
const SCRIPT_PORT: u16 = 30_002;
/// For a connection, and for each answer while it is set up.
const ANSWER_WITHIN: Duration = Duration::from_secs(2);
/// A robot that reports nothing for this long is connected again.
const REPORT_WITHIN: Duration = Duration::from_secs(2);
/// Characters of a model's name that are kept.
const MODEL_MOST: usize = 40;
/// Before the next attempt to connect.
const RETRY_AFTER: Duration = Duration::from_secs(1);

type Frames = Framed<TcpStream, LengthDelimitedCodec>;

/// Keeps the connection until `stopping` becomes true.
pub async fn keep(twin: Arc<Twin>, mut stopping: watch::Receiver<bool>) {
    loop {
        let ended = tokio::select! {
            ended = exchange(&twin) => ended,
            // An error means that the server is gone.
            _ = stopping.wait_for(|&stop| stop) => return,
        };
        let Err(error) = ended;
        tracing::info!(address = %twin.address(), %error, "robot: not connected");
        twin.connected(Err(error.to_string()));
        tokio::select! {
            () = tokio::time::sleep(RETRY_AFTER) => {}
            _ = stopping.wait_for(|&stop| stop) => return,
        }
    }
}

/// One connection, from its setup to its end.
async fn exchange(twin: &Arc<Twin>) -> io::Result<std::convert::Infallible> {
    let socket = connect(twin.address(), RTDE_PORT).await?;
    socket.set_nodelay(true)?;
    let mut frames = Framed::new(socket, rtde::framing());
    let mut peer = Peer::new(twin.allows_motion());
    for &step in peer.steps() {
        frames.send(Bytes::from(peer.request(step))).await?;
        while !peer.accept(step, &next(&mut frames, ANSWER_WITHIN).await?).map_err(io::Error::other)? {}
    }
    let asked = twin.clone();
    tokio::spawn(async move { asked.found_model(model(asked.address()).await) });
    let mut answers = twin.answers();
    let mut programs = answers.borrow_and_update().programs;
    twin.connected(Ok(()));
    loop {
        tokio::select! {
            frame = next(&mut frames, REPORT_WITHIN) => {
                if let Some(report) = peer.report(&frame?).map_err(io::Error::other)? {
                    twin.hear(report, Instant::now());
                }
            }
            _ = answers.changed() => {
                let answer = *answers.borrow_and_update();
                if answer.programs != programs {
                    programs = answer.programs;
                    tokio::spawn(send_program(twin.clone()));
                }
                send(&mut frames, &peer, &answer).await?;
            }
        }
    }
}

async fn send(frames: &mut Frames, peer: &Peer, answer: &Answer) -> io::Result<()> {
    frames.send(Bytes::from(peer.target(answer.period, &answer.joints_rad))).await
}

async fn next(frames: &mut Frames, within: Duration) -> io::Result<Bytes> {
    let frame = tokio::time::timeout(within, frames.next()).await;
    let frame = frame.map_err(|_| io::Error::other(format!("it says nothing for {} s", within.as_secs())))?;
    let frame = frame.ok_or_else(|| io::Error::other("it has closed the connection"))?;
    Ok(frame.map_err(|error| io::Error::other(format!("the connection is broken: {error}")))?.freeze())
}

async fn connect(address: IpAddr, port: u16) -> io::Result<TcpStream> {
    let connecting = TcpStream::connect(SocketAddr::new(address, port));
    let connected = tokio::time::timeout(ANSWER_WITHIN, connecting).await;
    let late = |_| io::Error::other(format!("port {port} does not answer within {} s", ANSWER_WITHIN.as_secs()));
    connected.map_err(late)?.map_err(|error| io::Error::new(error.kind(), format!("port {port}: {error}")))
}

/// What the dashboard answers, if it does.
async fn model(address: IpAddr) -> Option<String> {
    let asking = async {
        let socket = connect(address, DASHBOARD_PORT).await.ok()?;
        let mut lines = Framed::new(socket, LinesCodec::new_with_max_length(dashboard::LINE_BYTES_MOST));
        let _greeting = lines.next().await?.ok()?;
        lines.send("get robot model").await.ok()?;
        lines.next().await?.ok()
    };
    let answer = tokio::time::timeout(ANSWER_WITHIN, asking).await.ok()??;
    Some(answer.trim().chars().take(MODEL_MOST).collect()).filter(|model: &String| !model.is_empty())
}

/// Sends the program. The robot's reports show whether it has begun.
async fn send_program(twin: Arc<Twin>) {
    let sent = async {
        let mut socket = connect(twin.address(), SCRIPT_PORT).await?;
        socket.write_all(drive_script::TEXT.as_bytes()).await?;
        socket.shutdown().await
    };
    if let Err(error) = sent.await {
        twin.not_sent(error.to_string());
    }
}
