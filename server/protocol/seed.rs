//! Seeds: whole numbers below 2⁶⁴. JavaScript numbers cannot represent all of them.

use serde::de::{Error, Unexpected, Visitor};
use serde::{Deserialize, Deserializer};

/// A seed as a number, or as its digits.
struct Seed(u64);

impl<'de> Deserialize<'de> for Seed {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(SeedVisitor)
    }
}

struct SeedVisitor;

impl Visitor<'_> for SeedVisitor {
    type Value = Seed;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a whole number from 0 to 2^64 - 1, or its digits as text")
    }

    fn visit_u64<E: Error>(self, seed: u64) -> Result<Seed, E> {
        Ok(Seed(seed))
    }

    fn visit_str<E: Error>(self, digits: &str) -> Result<Seed, E> {
        digits.parse().map(Seed).map_err(|_| E::invalid_value(Unexpected::Str(digits), &self))
    }
}

/// For optional fields.
pub(super) fn number_or_text<'de, D: Deserializer<'de>>(from: D) -> Result<Option<u64>, D::Error> {
    Ok(Option::<Seed>::deserialize(from)?.map(|Seed(seed)| seed))
}
