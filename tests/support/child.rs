//! The program in a separate process.

use std::io::{BufRead, BufReader, Seek};
use std::net::SocketAddr;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

pub fn ferry(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ferry"));
    command.args(arguments);
    command
}

/// A value of `/proc/PID/status`, such as `VmRSS`; `None` when the process has ended.
pub fn memory_mb(child: &Child, name: &str) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).ok()?;
    // Until the program runs, its process has the memory and the name of the tests.
    let status = status.strip_prefix("Name:\tferry\n")?;
    let value = status.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(':')?.strip_suffix(" kB"))?;
    Some(value.trim().parse::<u64>().ok()? / 1000)
}

/// What a command says when it refuses, which takes less than a second and 200 MB.
pub fn refused_at_once(arguments: &[&str]) -> String {
    let (status, text) = ended_at_once(arguments);
    assert!(!status.success(), "{arguments:?}: {text}");
    text
}

/// How a command ends, which takes less than a second and 200 MB, and its errors.
pub fn ended_at_once(arguments: &[&str]) -> (ExitStatus, String) {
    let said = tempfile::tempfile().unwrap();
    let begun = Instant::now();
    let mut child = ferry(arguments).stdout(Stdio::null()).stderr(said.try_clone().unwrap()).spawn().unwrap();
    let (mut most_mb, mut status) = (0, None);
    while status.is_none() && begun.elapsed() < Duration::from_secs(1) && most_mb < 200 {
        std::thread::sleep(Duration::from_millis(2));
        most_mb = memory_mb(&child, "VmHWM").unwrap_or(0).max(most_mb);
        status = child.try_wait().unwrap();
    }
    let took = begun.elapsed();
    let _ = child.kill();
    child.wait().unwrap();
    let text = std::io::read_to_string({
        let mut said = said;
        said.rewind().unwrap();
        said
    });
    let text = text.unwrap();
    let status = status.unwrap_or_else(|| panic!("{arguments:?}: {took:?}, {most_mb} MB: {text}"));
    (status, text)
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
