//! The token, which clients need if other machines have access.

use std::fmt;
use std::str::FromStr;

use subtle::ConstantTimeEq;

/// Bytes of a token: 256 bits.
const BYTES: usize = 32;

/// Why a text is not a token. The message never contains the text, which may be a mistyped token.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the token must be {} hexadecimal digits, as `ferry token` prints them; this text has {characters} characters", 2 * BYTES)]
pub struct TokenError {
    /// Length of the text.
    pub characters: usize,
}

/// A shared secret of 256 bits, written as 64 hexadecimal digits. It is never printed or logged.
#[derive(Clone)]
pub struct Token([u8; BYTES]);

impl Token {
    /// A new token from the system's random generator, as text. Only this function returns a token as text.
    ///
    /// # Errors
    /// The system provides no random numbers.
    pub fn generate() -> std::io::Result<String> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)?;
        Ok(hex::encode(bytes))
    }

    /// Whether a text is this token. The comparison takes the same time for every well-formed token.
    pub fn matches(&self, presented: &str) -> bool {
        presented.parse::<Self>().is_ok_and(|other| self.0.ct_eq(&other.0).into())
    }

    /// The key that signs login cookies.
    pub fn cookie_key(&self) -> cookie::Key {
        cookie::Key::derive_from(&self.0)
    }
}

impl FromStr for Token {
    type Err = TokenError;

    fn from_str(text: &str) -> Result<Self, TokenError> {
        let text = text.trim();
        let mut bytes = [0; BYTES];
        let decoded = hex::decode_to_slice(text, &mut bytes);
        decoded.map(|()| Self(bytes)).map_err(|_| TokenError { characters: text.chars().count() })
    }
}

impl fmt::Debug for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Token")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_same_256_bits_match() {
        let text = Token::generate().unwrap();
        let token: Token = text.parse().unwrap();
        assert!(token.matches(&text) && token.matches(&text.to_uppercase()) && token.matches(&format!("{text}\n")));
        assert!(!token.matches(&Token::generate().unwrap()));
        assert!(!token.matches("") && !token.matches(&text[1..]) && !token.matches(&format!("{text}0")));
    }

    #[test]
    fn errors_do_not_repeat_the_text() {
        let error = "secret-but-short".parse::<Token>().unwrap_err();
        assert_eq!(error, TokenError { characters: 16 });
        assert!(!error.to_string().contains("secret"));
        assert_eq!(format!("{:?}", "ab".repeat(32).parse::<Token>().unwrap()), "Token");
    }
}
