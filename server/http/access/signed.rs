//! Signed cookies.

use axum::http::{HeaderMap, header};
use cookie::{Cookie, CookieJar, Key};

/// The cookie as `Set-Cookie` has it.
pub fn written(cookie: Cookie<'static>, key: &Key) -> String {
    let name = cookie.name().to_owned();
    let mut jar = CookieJar::new();
    jar.signed_mut(key).add(cookie);
    jar.get(&name).map(ToString::to_string).unwrap_or_default()
}

/// The values of a request's cookies of this name that have a valid signature.
pub fn values(headers: &HeaderMap, name: &str, key: &Key) -> Vec<String> {
    let texts = headers.get_all(header::COOKIE).iter().filter_map(|value| value.to_str().ok());
    let signed = texts.flat_map(Cookie::split_parse).flatten().filter(|cookie| cookie.name() == name);
    let valid = signed.filter_map(|cookie| {
        let mut jar = CookieJar::new();
        jar.add_original(cookie.into_owned());
        Some(jar.signed(key).get(name)?.value().to_owned())
    });
    valid.collect()
}
