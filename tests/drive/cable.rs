//! A cable between Ferry and a robot, which can be damaged, and which keeps what went through it.

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use bytes::BytesMut;
use futures_util::StreamExt;
use futures_util::stream::BoxStream;
use tokio::io::AsyncWriteExt;
use tokio::net::tcp::{OwnedReadHalf, OwnedWriteHalf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::{JoinHandle, JoinSet};
use tokio::time::Instant;
use tokio_util::codec::{BytesCodec, FramedRead, LengthDelimitedCodec};

/// What is wrong with a cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    None,
    /// Both connections are closed.
    Closed,
    /// Nothing passes any more; the connections stay.
    Silent,
    /// What the robot says comes 0.4 s late.
    LateReports,
    /// What Ferry says comes 0.4 s late.
    LateTargets,
    /// Of the next message to each side only a half comes, and nothing after it.
    Truncated,
    /// The same, but the following messages come.
    Torn,
    /// The last messages come again and again.
    Repeated,
    /// Each message comes twice.
    Doubled,
}

impl Fault {
    pub const ALL: [Self; 8] = [
        Self::Closed,
        Self::Silent,
        Self::LateReports,
        Self::LateTargets,
        Self::Truncated,
        Self::Torn,
        Self::Repeated,
        Self::Doubled,
    ];
}

const LATE: Duration = Duration::from_millis(400);
/// Messages that are repeated.
const REPEATED: usize = 10;
const RTDE: u16 = 30_004;
const SCRIPT: u16 = 30_002;

/// A direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Toward {
    Robot,
    Ferry,
}

/// What the robot has said, and when.
#[derive(Clone, Debug, Default)]
pub struct Recorded {
    messages: Vec<(Duration, Vec<u8>)>,
}

pub struct Cable {
    fault: watch::Sender<Fault>,
    recorded: Arc<Mutex<Recorded>>,
    laid: JoinSet<()>,
}

impl Cable {
    /// Connections to `from` reach `to`.
    pub async fn lay(from: &'static str, to: &'static str) -> Self {
        let fault = watch::Sender::new(Fault::None);
        let recorded = Arc::new(Mutex::new(Recorded::default()));
        let mut laid = JoinSet::new();
        for port in [RTDE, SCRIPT] {
            let listener = TcpListener::bind((from, port)).await.unwrap();
            let (fault, recorded) = (fault.clone(), recorded.clone());
            laid.spawn(async move {
                let mut passing = JoinSet::new();
                loop {
                    let (near, _) = listener.accept().await.unwrap();
                    let Ok(far) = TcpStream::connect((to, port)).await else { continue };
                    near.set_nodelay(true).unwrap();
                    far.set_nodelay(true).unwrap();
                    let ((near_in, near_out), (far_in, far_out)) = (near.into_split(), far.into_split());
                    let kept = (port == RTDE).then(|| recorded.clone());
                    if let Some(kept) = &kept {
                        kept.lock().unwrap().messages.clear();
                    }
                    let is_framed = port == RTDE;
                    let (one, other) = (fault.subscribe(), fault.subscribe());
                    passing.spawn(async move {
                        tokio::select! {
                            () = pass(messages(near_in, is_framed), far_out, Toward::Robot, one, None) => {}
                            () = pass(messages(far_in, is_framed), near_out, Toward::Ferry, other, kept) => {}
                        }
                    });
                }
            });
        }
        Self { fault, recorded, laid }
    }

    pub fn damage(&self, fault: Fault) {
        self.fault.send_replace(fault);
    }

    pub async fn take_up(mut self) {
        self.laid.shutdown().await;
    }

    pub fn recorded(&self) -> Recorded {
        self.recorded.lock().unwrap().clone()
    }
}

/// Messages, each with its size; of URScript, whatever comes.
fn messages(from: OwnedReadHalf, is_framed: bool) -> BoxStream<'static, Vec<u8>> {
    let read = |message: io::Result<BytesMut>| async { Some(message.ok()?.to_vec()) };
    if !is_framed {
        return FramedRead::new(from, BytesCodec::new()).filter_map(read).boxed();
    }
    let framing = LengthDelimitedCodec::builder().length_field_type::<u16>().num_skip(0).new_codec();
    FramedRead::new(from, framing).filter_map(read).boxed()
}

async fn pass(
    mut from: BoxStream<'static, Vec<u8>>,
    mut to: OwnedWriteHalf,
    toward: Toward,
    mut fault: watch::Receiver<Fault>,
    recorded: Option<Arc<Mutex<Recorded>>>,
) {
    let begun = Instant::now();
    let mut last: VecDeque<Vec<u8>> = VecDeque::new();
    let mut late: VecDeque<(Instant, Vec<u8>)> = VecDeque::new();
    // Of the damaged connection; a new one is whole.
    let mut is_torn = false;
    loop {
        let now = *fault.borrow();
        let due = late.front().map(|(due, _)| *due);
        let repeats = now == Fault::Repeated && !last.is_empty();
        let message = tokio::select! {
            message = from.next() => match message {
                Some(message) => message,
                None => return,
            },
            // An error means that the cable is gone; `Closed` is seen at the next round.
            changed = fault.changed() => match changed {
                Ok(()) if *fault.borrow() == Fault::Closed => return,
                Ok(()) => continue,
                Err(_) => return,
            },
            () = tokio::time::sleep_until(due.unwrap_or(begun)), if due.is_some() => late.pop_front().unwrap().1,
            () = tokio::time::sleep(Duration::from_millis(8)), if repeats => {
                let message = last.pop_front().unwrap();
                last.push_back(message.clone());
                if to.write_all(&message).await.is_err() {
                    return;
                }
                continue;
            }
        };
        if let Some(recorded) = &recorded {
            recorded.lock().unwrap().messages.push((begun.elapsed(), message.clone()));
        }
        let is_late =
            matches!((now, toward), (Fault::LateReports, Toward::Ferry) | (Fault::LateTargets, Toward::Robot));
        let sent: Vec<u8> = match now {
            Fault::None => message,
            Fault::Closed => return,
            Fault::Silent | Fault::Repeated => continue,
            Fault::LateReports | Fault::LateTargets if is_late && due.is_none_or(|due| due > Instant::now()) => {
                late.push_back((Instant::now() + LATE, message));
                continue;
            }
            Fault::LateReports | Fault::LateTargets => message,
            Fault::Truncated if is_torn => continue,
            Fault::Torn if is_torn => message,
            Fault::Truncated | Fault::Torn => {
                is_torn = true;
                message[..message.len() / 2].to_vec()
            }
            Fault::Doubled => [&message[..], &message].concat(),
        };
        if now == Fault::None {
            last.push_back(sent.clone());
            if last.len() > REPEATED {
                last.pop_front();
            }
        }
        if to.write_all(&sent).await.is_err() {
            return;
        }
    }
}

impl Recorded {
    /// What the robot has reported, in a recipe that begins with `timestamp` and `actual_q`.
    pub fn joints(&self) -> Vec<[f64; 6]> {
        let data = self.messages.iter().map(|(_, message)| message).filter(|message| message[2] == b'U');
        let number = |message: &[u8], place: usize| f64::from_be_bytes(message[place..place + 8].try_into().unwrap());
        data.map(|message| std::array::from_fn(|joint| number(message, 12 + 8 * joint))).collect()
    }

    /// Says it all again, at the same times, to the first client. Returns the types of what the client has sent.
    pub async fn player(&self, address: &'static str) -> JoinHandle<Vec<u8>> {
        let listener = TcpListener::bind((address, RTDE)).await.unwrap();
        let recorded = self.messages.clone();
        tokio::spawn(async move {
            let (socket, _) = listener.accept().await.unwrap();
            let (from, mut to) = socket.into_split();
            let listening = tokio::spawn(messages(from, true).map(|message| message[2]).collect());
            let begun = Instant::now();
            for (at, message) in recorded {
                tokio::time::sleep_until(begun + at).await;
                to.write_all(&message).await.unwrap();
            }
            tokio::time::sleep(Duration::from_millis(500)).await;
            drop(to);
            listening.await.unwrap()
        })
    }
}
