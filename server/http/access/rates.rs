//! Rate limits per client.

use std::net::IpAddr;
use std::num::NonZeroU32;
use std::time::Duration;

use governor::clock::{Clock, DefaultClock};
use governor::{DefaultDirectRateLimiter, DefaultKeyedRateLimiter, Quota, RateLimiter};

/// Maximum request rate of one client: far more than the page needs, far less than a program can send.
const REQUESTS_PER_S: NonZeroU32 = NonZeroU32::new(500).unwrap();
const REQUESTS_BURST: NonZeroU32 = NonZeroU32::new(2000).unwrap();
/// Maximum rate of wrong tokens per client, and in total.
const WRONG_PER_MINUTE: NonZeroU32 = NonZeroU32::new(10).unwrap();
const WRONG_OF_ALL_PER_MINUTE: NonZeroU32 = NonZeroU32::new(100).unwrap();

/// A client, identified by its login, or by its address if it has no login.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Client {
    /// The number in the client's cookie.
    Login(String),
    Address(IpAddr),
}

impl Client {
    /// The client at an address. IPv6 addresses with the same /64 prefix count as one client, because a client can have
    /// all of them.
    pub fn at(address: IpAddr) -> Self {
        Self::Address(match address {
            IpAddr::V6(v6) if v6.to_ipv4_mapped().is_none() => IpAddr::V6((u128::from(v6) & (u128::MAX << 64)).into()),
            other => other.to_canonical(),
        })
    }
}

/// Too many requests, with the time until the next one is allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooOften(pub Duration);

/// Recent requests of clients. Shared by all connections.
pub struct Rates {
    requests: DefaultKeyedRateLimiter<Client>,
    wrong: DefaultKeyedRateLimiter<Client>,
    wrong_of_all: DefaultDirectRateLimiter,
}

impl Default for Rates {
    fn default() -> Self {
        Self {
            requests: RateLimiter::keyed(Quota::per_second(REQUESTS_PER_S).allow_burst(REQUESTS_BURST)),
            wrong: RateLimiter::keyed(Quota::per_minute(WRONG_PER_MINUTE)),
            wrong_of_all: RateLimiter::direct(Quota::per_minute(WRONG_OF_ALL_PER_MINUTE)),
        }
    }
}

impl Rates {
    /// Counts a request.
    pub fn request(&self, client: &Client) -> Result<(), TooOften> {
        self.requests.check_key(client).map_err(|until| TooOften(until.wait_time_from(DefaultClock::default().now())))
    }

    /// Counts a wrong token. Correct tokens are never refused, so guessing cannot lock others out.
    pub fn wrong_token(&self, client: &Client) -> Result<(), TooOften> {
        let now = DefaultClock::default().now();
        self.wrong.check_key(client).map_err(|until| TooOften(until.wait_time_from(now)))?;
        self.wrong_of_all.check().map_err(|until| TooOften(until.wait_time_from(now)))
    }

    /// Forgets clients without recent requests, which bounds the memory.
    pub fn forget(&self) {
        self.requests.retain_recent();
        self.wrong.retain_recent();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clients_have_separate_limits() {
        let rates = Rates::default();
        let [one, other] = ["10.0.0.1", "10.0.0.2"].map(|text| Client::at(text.parse().unwrap()));
        assert!((0..10).all(|_| rates.wrong_token(&one).is_ok()));
        let TooOften(wait) = rates.wrong_token(&one).unwrap_err();
        assert!(wait > Duration::ZERO && wait <= Duration::from_secs(6), "{wait:?}");
        assert!(rates.wrong_token(&other).is_ok());
        assert!((0..2000).all(|_| rates.request(&one).is_ok()));
        // Some of the allowance is refilled meanwhile.
        assert!((0..2000).any(|_| rates.request(&one).is_err()));
        assert!(rates.request(&other).is_ok());
    }

    #[test]
    fn a_network_of_ipv6_is_one_client() {
        let client = |text: &str| Client::at(text.parse().unwrap());
        assert_eq!(client("2001:db8::1"), client("2001:db8::2:3"));
        assert_ne!(client("2001:db8::1"), client("2001:db8:0:1::1"));
        assert_eq!(client("::ffff:10.0.0.1"), client("10.0.0.1"));
    }
}
