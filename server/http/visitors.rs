//! Who comes again: a signed cookie with a random number and the name of the visitor's own session.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use axum::http::{HeaderMap, HeaderValue, header};
use axum::response::Response;
use cookie::{Cookie, Key, SameSite};

use super::Server;
use super::access::signed;
use super::sessions::is_name;

const NAME: &str = "ferry-visitor";
/// How long a browser keeps the cookie.
const LASTS: Duration = Duration::from_secs(30 * 24 * 3600);
const KEY_BYTES: usize = 64;

/// The browser of one person, or of several who share it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Visitor {
    /// A random number.
    pub id: Arc<str>,
    /// The session that was opened for it last.
    pub own: Option<String>,
}

impl Visitor {
    fn new() -> io::Result<Self> {
        let mut number = [0; 16];
        getrandom::fill(&mut number)?;
        Ok(Self { id: hex::encode(number).into(), own: None })
    }

    fn parse(value: &str) -> Option<Self> {
        let (id, own) = value.split_once('.')?;
        Some(Self { id: id.into(), own: Some(own.to_owned()).filter(|own| is_name(own)) })
    }
}

/// The key that signs the cookies.
pub struct Visitors(Key);

impl Visitors {
    /// With the key in a file, which is made if it is missing. Without one, visitors are new ones after a restart.
    pub fn in_file(path: &Path) -> io::Result<Self> {
        if let Ok(bytes) = std::fs::read(path)
            && bytes.len() == KEY_BYTES
        {
            return Ok(Self(Key::from(&bytes)));
        }
        let mut bytes = [0; KEY_BYTES];
        getrandom::fill(&mut bytes)?;
        if let Err(error) = write(path, &bytes) {
            tracing::warn!(%error, path = %path.display(), "the key of visitors is not saved");
        }
        Ok(Self(Key::from(&bytes)))
    }

    /// The visitor of a request; `None` for a program, and for a browser that is new.
    pub fn of(&self, headers: &HeaderMap) -> Option<Visitor> {
        signed::values(headers, NAME, &self.0).iter().find_map(|value| Visitor::parse(value))
    }

    /// The visitor of a request, perhaps a new one.
    ///
    /// # Errors
    /// The system provides no random numbers.
    pub fn meet(&self, headers: &HeaderMap) -> io::Result<Visitor> {
        self.of(headers).map_or_else(Visitor::new, Ok)
    }
}

impl Server {
    /// Sends a visitor its cookie.
    pub fn remember(&self, visitor: &Visitor, headers: &HeaderMap, response: &mut Response) {
        let host = headers.get(header::HOST).and_then(|host| host.to_str().ok()).unwrap_or_default();
        let value = format!("{}.{}", visitor.id, visitor.own.as_deref().unwrap_or_default());
        // Lax: a link of another site leads to the same visitor, but that site's page asks nothing in its name.
        let cookie = Cookie::build((NAME, value))
            .http_only(true)
            .same_site(SameSite::Lax)
            .secure(self.access.address_of(host).starts_with("https:"))
            .path(self.base.cookie_path())
            .max_age(cookie::time::Duration::seconds(LASTS.as_secs() as i64));
        if let Ok(value) = HeaderValue::from_str(&signed::written(cookie.build(), &self.visitors.0)) {
            response.headers_mut().append(header::SET_COOKIE, value);
        }
    }
}

/// Others cannot read it.
fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut options = std::fs::OpenOptions::new();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)?.write_all(bytes)
}
