//! The path below which a proxy has the server, such as `/ferry`.

use std::fmt;
use std::str::FromStr;

use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderValue, Uri, header};
use axum::response::Response;
use tower::util::MapRequest;

/// Text at the beginning of every address, without a slash at its end; empty for a server of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BasePath(String);

/// Why a text is no [`BasePath`].
#[derive(Debug, thiserror::Error)]
#[error("{0:?} is no path such as /ferry: it must begin with a slash, and may have letters, digits and -._~")]
pub struct BasePathError(String);

impl FromStr for BasePath {
    type Err = BasePathError;

    fn from_str(text: &str) -> Result<Self, BasePathError> {
        let path = text.strip_suffix('/').unwrap_or(text);
        let is_part = |part: &str| {
            !["", ".", ".."].contains(&part)
                && part.chars().all(|letter| letter.is_ascii_alphanumeric() || "-._~".contains(letter))
        };
        let is_path = path.strip_prefix('/').is_some_and(|rest| rest.split('/').all(is_part));
        match is_path || text == "/" {
            true => Ok(Self(path.to_owned())),
            false => Err(BasePathError(text.to_owned())),
        }
    }
}

impl fmt::Display for BasePath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl BasePath {
    /// Where a browser sends a cookie.
    pub fn cookie_path(&self) -> String {
        if self.0.is_empty() { "/".to_owned() } else { self.0.clone() }
    }

    /// A page whose addresses begin with this path.
    pub fn correct(&self, html: &str) -> String {
        html.replace("=\"/", &format!("=\"{self}/"))
    }

    /// The routes for a proxy that takes the path away, and for one that does not.
    pub fn around(self, router: Router) -> Router {
        if self.0.is_empty() {
            return router;
        }
        let own = self.clone();
        let router = router.layer(axum::middleware::map_response(move |mut response: Response| {
            if let Some(place) = response.headers_mut().get_mut(header::LOCATION)
                && let Ok(corrected) = HeaderValue::try_from([own.0.as_bytes(), place.as_bytes()].concat())
                && place.as_bytes().starts_with(b"/")
            {
                *place = corrected;
            }
            std::future::ready(response)
        }));
        let strip = move |mut request: Request| {
            if let Some(uri) = self.stripped(request.uri()) {
                *request.uri_mut() = uri;
            }
            request
        };
        Router::new().fallback_service(MapRequest::new(router, strip))
    }

    /// An address without this path; `None` if it does not have it.
    fn stripped(&self, uri: &Uri) -> Option<Uri> {
        let rest = uri.path_and_query()?.as_str().strip_prefix(&self.0)?;
        let rest = match rest.chars().next() {
            None => "/".to_owned(),
            Some('/') => rest.to_owned(),
            Some('?') => format!("/{rest}"),
            Some(_) => return None,
        };
        let mut parts = uri.clone().into_parts();
        parts.path_and_query = Some(rest.parse().ok()?);
        Uri::from_parts(parts).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_path_is_a_path() {
        for (text, path) in [("/", ""), ("/ferry", "/ferry"), ("/ferry/", "/ferry"), ("/a/b-c.d~e_", "/a/b-c.d~e_")] {
            assert_eq!(text.parse::<BasePath>().unwrap().to_string(), path);
        }
        for text in ["", "ferry", "//", "/a//b", "/a b", "/../a", "/\"", "http://lab/ferry", "/a?b"] {
            assert!(text.parse::<BasePath>().is_err(), "{text}");
        }
    }

    #[test]
    fn it_is_taken_from_addresses_that_have_it() {
        let base: BasePath = "/ferry".parse().unwrap();
        for (address, rest) in [
            ("/ferry", Some("/")),
            ("/ferry?a=b", Some("/?a=b")),
            ("/ferry/", Some("/")),
            ("/ferry/s/anna?a=/ferry", Some("/s/anna?a=/ferry")),
            ("http://lab/ferry/api", Some("http://lab/api")),
            ("/ferryman", None),
            ("/s/ferry", None),
        ] {
            let found = base.stripped(&address.parse().unwrap()).map(|uri| uri.to_string());
            assert_eq!(found.as_deref(), rest, "{address}");
        }
        assert_eq!(
            base.correct("<a href=\"/\"><img src=\"/a.svg\">"),
            "<a href=\"/ferry/\"><img src=\"/ferry/a.svg\">"
        );
    }
}
