//! The program in a separate process.

use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::path::Path;
use std::process::{Child, Command, Stdio};

pub fn ferry(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ferry"));
    command.args(arguments);
    command
}

/// A server that is killed at the end of its test.
pub struct Ferry {
    pub child: Child,
    pub address: SocketAddr,
}

impl Ferry {
    /// `command` followed by the arguments of a server on a free port.
    pub fn serve(command: &mut Command, data: &Path) -> Self {
        let command = command.args(["serve", "--bind", "127.0.0.1:0", "--data"]).arg(data);
        Self::start(command.stderr(Stdio::null()))
    }

    /// Waits until the server has printed its address.
    pub fn start(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("listening on http://").expect("it prints its address").parse().unwrap();
        Self { child, address }
    }
}

impl Drop for Ferry {
    fn drop(&mut self) {
        // Like `kill -9`; it may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
