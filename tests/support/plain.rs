//! HTTP over plain sockets.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

/// Sends these bytes; returns status and text of the answer until the server closes or the body is complete.
pub fn exchange(address: SocketAddr, request: &[u8]) -> (u16, String) {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
    // A server that has refused may have closed already.
    let _ = stream.write_all(request);
    read_answer(&mut stream)
}

/// Head and body up to its stated length; status 0 when no answer came.
pub fn read_answer(stream: &mut TcpStream) -> (u16, String) {
    let (mut bytes, mut chunk) = (Vec::new(), [0; 4096]);
    loop {
        let text = String::from_utf8_lossy(&bytes);
        if let Some(head) = text.find("\r\n\r\n") {
            let length = text[..head].to_lowercase().find("content-length: ").map_or(0, |at| {
                let rest = &text[at + "content-length: ".len()..head];
                rest.lines().next().unwrap_or(rest).trim().parse().unwrap()
            });
            if bytes.len() >= head + 4 + length {
                break;
            }
        }
        match stream.read(&mut chunk) {
            Ok(0) | Err(_) => break,
            Ok(count) => bytes.extend_from_slice(&chunk[..count]),
        }
    }
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let status = text.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    (status, text)
}
