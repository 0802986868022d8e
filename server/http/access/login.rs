//! Login: the browser exchanges the token once for a cookie that scripts cannot read and other sites cannot use.

use std::collections::VecDeque;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use axum::extract::{ConnectInfo, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use cookie::{Cookie, Key, SameSite};
use serde::Deserialize;
use utoipa::ToSchema;

use super::{Client, signed};
use crate::http::Server;
use crate::http::body::{WholeBody, parse};
use crate::http::problem::Problem;
use crate::http::refusals::{Conflict, TooMany};

const NAME: &str = "ferry";
/// Number of ended logins that are remembered.
const LOGGED_OUT_MOST: usize = 1000;
/// Duration of a login: sixty days.
const LASTS: Duration = Duration::from_secs(60 * 24 * 3600);

/// Body of `POST /login`.
#[derive(Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct Login {
    token: String,
}

/// The login page.
#[utoipa::path(get, path = "/login", tag = "access",
    responses((status = 200, description = "The login page.", content_type = "text/html", body = String)))]
pub async fn form(State(server): State<Arc<Server>>) -> Response {
    server.page.login(StatusCode::OK)
}

/// Exchanges the token for a cookie.
#[utoipa::path(post, path = "/login", tag = "access", request_body = Login,
    responses((status = 204, description = "The cookie is in `Set-Cookie`."), Conflict, TooMany))]
pub async fn login(
    State(server): State<Arc<Server>>,
    ConnectInfo(address): ConnectInfo<SocketAddr>,
    headers: HeaderMap,
    WholeBody(body): WholeBody,
) -> Result<Response, Problem> {
    let Login { token: presented } = parse(&body)?;
    let access = &server.access;
    let (Some(token), Some(key)) = (&access.token, &access.cookie_key) else {
        let detail = "this server has no token: every client that can reach it has access";
        return Err(Problem::new(StatusCode::CONFLICT, "no_login", detail));
    };
    let origin = headers.get(header::ORIGIN).and_then(|origin| origin.to_str().ok());
    let Some(origin) = origin else {
        let detail = "a login needs the header Origin; programs send the token as Authorization: Bearer";
        return Err(Problem::new(StatusCode::FORBIDDEN, "no_origin", detail).field("Origin"));
    };
    if !token.matches(&presented) {
        server.counters.login(false);
        tracing::warn!(%address, "login refused");
        return Err(access.wrong_token(&Client::at(address.ip())));
    }
    server.counters.login(true);
    tracing::info!(%address, "login");
    let cookie = Cookie::build((NAME, value(SystemTime::now() + LASTS).map_err(Problem::internal)?))
        .http_only(true)
        .same_site(SameSite::Strict)
        .secure(origin.starts_with("https:"))
        .path(server.base.cookie_path())
        .max_age(LASTS.try_into().map_err(Problem::internal)?);
    Ok(set(cookie.build(), key))
}

/// Logins that were ended, until the server stops. The oldest are forgotten first.
#[derive(Default)]
pub struct LoggedOut(Mutex<VecDeque<String>>);

impl LoggedOut {
    pub fn contains(&self, login: &str) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().any(|ended| ended == login)
    }

    fn add(&self, login: String) {
        let mut ended = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !ended.contains(&login) {
            ended.push_back(login);
        }
        if ended.len() > LOGGED_OUT_MOST {
            ended.pop_front();
        }
    }
}

/// Ends the login, also for copies of its cookie, and deletes the cookie in this browser.
#[utoipa::path(post, path = "/logout", tag = "access", responses((status = 204, description = "The login has ended.")))]
pub async fn logout(State(server): State<Arc<Server>>, headers: HeaderMap) -> Response {
    if let Some(login) = server.access.login(&headers) {
        server.access.logged_out.add(login);
    }
    let expired = Cookie::build((NAME, "")).http_only(true).same_site(SameSite::Strict).path(server.base.cookie_path());
    (StatusCode::NO_CONTENT, [(header::SET_COOKIE, expired.removal().build().to_string())]).into_response()
}

/// Content of the cookie: a random number, and the time when the login ends.
fn value(ends: SystemTime) -> Result<String, std::io::Error> {
    let mut number = [0; 16];
    getrandom::fill(&mut number)?;
    Ok(format!("{}.{}", hex::encode(number), seconds(ends)))
}

fn seconds(time: SystemTime) -> u64 {
    time.duration_since(UNIX_EPOCH).unwrap_or_default().as_secs()
}

fn set(cookie: Cookie<'static>, key: &Key) -> Response {
    (StatusCode::NO_CONTENT, [(header::SET_COOKIE, signed::written(cookie, key))]).into_response()
}

/// The number in a cookie with a valid signature that has not expired.
pub fn valid_login(headers: &HeaderMap, key: &Key) -> Option<String> {
    signed::values(headers, NAME, key).into_iter().find_map(|value| {
        let (number, ends) = value.split_once('.')?;
        (ends.parse::<u64>().ok()? > seconds(SystemTime::now())).then(|| number.to_owned())
    })
}

#[cfg(test)]
mod tests {
    use super::super::Token;
    use super::*;

    fn key() -> Key {
        Token::generate().unwrap().parse::<Token>().unwrap().cookie_key()
    }

    fn sent(set: &Response) -> HeaderMap {
        let text = set.headers()[header::SET_COOKIE].to_str().unwrap();
        let mut headers = HeaderMap::new();
        headers.insert(header::COOKIE, format!("other=1; {}", text.split(';').next().unwrap()).parse().unwrap());
        headers
    }

    fn cookie(ends: SystemTime, key: &Key) -> Response {
        set(Cookie::build((NAME, value(ends).unwrap())).build(), key)
    }

    #[test]
    fn a_cookie_is_valid_until_it_expires_and_with_its_key_only() {
        let (now, hour, key) = (SystemTime::now(), Duration::from_secs(3600), self::key());
        let lasting = sent(&cookie(now + hour, &key));
        let number = valid_login(&lasting, &key).unwrap();
        assert_eq!(number.len(), 32);
        assert_eq!(valid_login(&lasting, &self::key()), None, "signed with another key");
        assert_eq!(valid_login(&sent(&cookie(now - hour, &key)), &key), None, "expired");
        assert_eq!(valid_login(&HeaderMap::new(), &key), None);
        let text = lasting[header::COOKIE].to_str().unwrap();
        let later = text.replace(&format!(".{}", seconds(now + hour)), &format!(".{}", seconds(now + 2 * hour)));
        assert_ne!(later, text);
        let mut changed = HeaderMap::new();
        changed.insert(header::COOKIE, later.parse().unwrap());
        assert_eq!(valid_login(&changed, &key), None, "changed after signing");
    }
}
