//! Messages as frames of the WebSocket.

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use serde::Serialize;

/// Bytes before the payload of a binary frame.
pub const BINARY_HEAD: usize = 8;

pub fn json(message: &impl Serialize) -> Utf8Bytes {
    serde_json::to_string(message).expect("messages are plain data").into()
}

pub fn binary(kind: u8, tick: u64, payload: &[u8]) -> Bytes {
    let mut bytes = vec![kind, 0, 0, 0];
    bytes.extend((tick as u32).to_le_bytes());
    bytes.extend(payload);
    bytes.into()
}
