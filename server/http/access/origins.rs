//! The allowed hosts of the server and the allowed origins of pages.

use std::collections::BTreeSet;
use std::fmt;
use std::net::SocketAddr;
use std::str::FromStr;

use axum::http::Uri;

/// Why a text is not an origin.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("origin {text:?}: it must be a scheme and a host, as in https://lab.example.org or http://10.0.0.7:8080")]
pub struct OriginError {
    pub text: String,
}

/// The origin of a page: scheme, host and port (RFC 6454).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    is_https: bool,
    host: String,
    port: u16,
}

impl Origin {
    /// The origin of an HTTP server at an address.
    pub fn of(address: SocketAddr) -> Self {
        let host = match address {
            SocketAddr::V4(v4) => v4.ip().to_string(),
            SocketAddr::V6(v6) => format!("[{}]", v6.ip()),
        };
        Self { is_https: false, host, port: address.port() }
    }

    /// Whether the host is a loopback address.
    pub fn is_loopback(&self) -> bool {
        let name = self.host.trim_start_matches('[').trim_end_matches(']');
        name == "localhost" || name.parse::<std::net::IpAddr>().is_ok_and(|ip| ip.is_loopback())
    }

    fn default_port(&self) -> u16 {
        if self.is_https { 443 } else { 80 }
    }

    /// The values of `Host` that a browser or a proxy may send.
    fn hosts(&self) -> Vec<String> {
        let full = format!("{}:{}", self.host, self.port);
        if self.port == self.default_port() { vec![self.host.clone(), full] } else { vec![full] }
    }
}

/// The form that a browser sends: without the scheme's default port.
impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = if self.is_https { "https" } else { "http" };
        write!(f, "{scheme}://{}", self.hosts()[0])
    }
}

impl FromStr for Origin {
    type Err = OriginError;

    fn from_str(text: &str) -> Result<Self, OriginError> {
        let wrong = || OriginError { text: text.to_owned() };
        let uri: Uri = text.parse().map_err(|_| wrong())?;
        let authority = uri.authority().filter(|authority| !authority.as_str().contains('@')).ok_or_else(wrong)?;
        let is_https = match uri.scheme_str() {
            Some("https") => true,
            Some("http") => false,
            _ => return Err(wrong()),
        };
        if !matches!(uri.path(), "" | "/") || uri.query().is_some() {
            return Err(wrong());
        }
        let port = match authority.port_u16() {
            Some(port) => port,
            // What follows the host is no port.
            None if authority.as_str() != authority.host() => return Err(wrong()),
            None if is_https => 443,
            None => 80,
        };
        Ok(Self { is_https, host: authority.host().to_ascii_lowercase(), port })
    }
}

/// Lists of allowed hosts and origins, compared exactly.
#[derive(Debug)]
pub struct Origins {
    /// Any port of a loopback name is allowed, because ports are forwarded: by SSH, editors and containers. A page is then
    /// allowed at the address that it asks, and not at other ports of this machine.
    any_loopback: bool,
    hosts: BTreeSet<String>,
    origins: BTreeSet<String>,
}

impl Origins {
    pub fn new(all: &[Origin], any_loopback: bool) -> Self {
        Self {
            any_loopback,
            hosts: all.iter().flat_map(Origin::hosts).collect(),
            origins: all.iter().map(ToString::to_string).collect(),
        }
    }

    pub fn has_host(&self, host: &str) -> bool {
        self.hosts.contains(&host.to_ascii_lowercase()) || self.is_forwarded(host)
    }

    fn is_forwarded(&self, host: &str) -> bool {
        self.any_loopback && format!("http://{host}").parse::<Origin>().is_ok_and(|origin| origin.is_loopback())
    }

    /// The page's address for `host`; if the name is known with and without TLS, the address with TLS.
    pub fn address_of(&self, host: &str) -> String {
        let host = host.to_ascii_lowercase();
        let secure = format!("https://{}", host.strip_suffix(":443").unwrap_or(&host));
        if self.origins.contains(&secure) { secure } else { format!("http://{host}") }
    }

    /// Whether a page of `origin` may ask `host`.
    pub fn has_origin(&self, origin: &str, host: &str) -> bool {
        let is_own = origin.strip_prefix("http://").is_some_and(|asked| asked.eq_ignore_ascii_case(host));
        self.origins.contains(&origin.to_ascii_lowercase()) || self.is_forwarded(host) && is_own
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn origin(text: &str) -> Origin {
        text.parse().unwrap()
    }

    #[test]
    fn an_origin_consists_of_scheme_host_and_port() {
        for (text, written) in [
            ("http://Lab.example.org", "http://lab.example.org"),
            ("http://lab:80/", "http://lab"),
            ("https://lab:443", "https://lab"),
            ("https://lab:8443", "https://lab:8443"),
            ("http://[::1]:8080", "http://[::1]:8080"),
        ] {
            assert_eq!(origin(text).to_string(), written);
        }
        for bad in [
            "",
            "lab",
            "lab:80",
            "http://lab:80.example.org",
            "http://lab:",
            "http://lab:99999",
            "ftp://lab",
            "http://lab/a",
            "http://lab/?a",
            "http://a@lab",
            "http://",
            "null",
        ] {
            assert!(bad.parse::<Origin>().is_err(), "{bad}");
        }
    }

    #[test]
    fn hosts_and_origins_are_exact() {
        let lists = Origins::new(&[origin("http://127.0.0.1:8080"), origin("https://lab.example.org")], false);
        for good in ["127.0.0.1:8080", "lab.example.org", "lab.example.org:443", "LAB.example.org"] {
            assert!(lists.has_host(good), "{good}");
        }
        for bad in [
            "",
            "127.0.0.1",
            "127.0.0.1:8081",
            "127.0.0.1:8080.",
            "lab.example.org.evil.com",
            "lab.example.org:80",
            "evil@lab.example.org",
            "10.0.0.7:8080",
        ] {
            assert!(!lists.has_host(bad), "{bad}");
        }
        let has_origin = |origin| lists.has_origin(origin, "127.0.0.1:8080");
        assert!(has_origin("http://127.0.0.1:8080") && has_origin("https://lab.example.org"));
        for bad in ["", "null", "https://127.0.0.1:8080", "http://lab.example.org", "http://127.0.0.1", "*"] {
            assert!(!has_origin(bad), "{bad}");
        }
        // As a forwarded port is asked.
        let local = Origins::new(&[origin("http://127.0.0.1:8080")], true);
        for good in ["localhost:9000", "127.0.0.1:9000", "[::1]:1", "LOCALHOST:80", "localhost"] {
            assert!(local.has_host(good) && local.has_origin(&format!("http://{good}"), good), "{good}");
        }
        for bad in [
            "lab.example.org",
            "localhost.example.org:9000",
            "127.0.0.1:80.example.org",
            "a@localhost:9000",
            "localhost/a",
            "10.0.0.7:9000",
            "",
        ] {
            assert!(!local.has_host(bad), "{bad}");
        }
        assert!(!local.has_origin("http://localhost:3000", "localhost:8080"), "another page of this machine");
        assert!(!local.has_origin("http://evil.example.org", "evil.example.org"));
        assert!(origin("http://localhost:1").is_loopback() && origin("http://[::1]:1").is_loopback());
        assert!(!origin("http://localhost.example.org").is_loopback());
    }
}
