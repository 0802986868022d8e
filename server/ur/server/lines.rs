//! Lines of URScript: ended by a line feed, a carriage return or both, of any encoding.

use std::io;

use bytes::{Buf, BytesMut};
use tokio_util::codec::Decoder;

use crate::script::LINE_BYTES_MOST;

/// What is not UTF-8 is replaced: it can only stand in comments and texts.
#[derive(Debug, Default)]
pub struct Lines {
    /// The line feed behind a carriage return belongs to it.
    skips_feed: bool,
    /// The rest of a line that is too long.
    skips_line: bool,
}

#[derive(Debug, PartialEq)]
pub enum Taken {
    Line(String),
    /// A line has more than [`LINE_BYTES_MOST`] bytes.
    TooLong,
}

impl Decoder for Lines {
    type Item = Taken;
    type Error = io::Error;

    fn decode(&mut self, bytes: &mut BytesMut) -> io::Result<Option<Taken>> {
        loop {
            if std::mem::take(&mut self.skips_feed) {
                match bytes.first() {
                    None => self.skips_feed = true,
                    Some(b'\n') => bytes.advance(1),
                    Some(_) => {}
                }
            }
            let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            if end.unwrap_or(bytes.len()) > LINE_BYTES_MOST {
                bytes.advance(end.unwrap_or(bytes.len()));
                if !std::mem::replace(&mut self.skips_line, true) {
                    return Ok(Some(Taken::TooLong));
                }
                continue;
            }
            let Some(end) = end else {
                if self.skips_line {
                    bytes.clear();
                }
                return Ok(None);
            };
            let line = bytes.split_to(end);
            self.skips_feed = bytes.get_u8() == b'\r';
            if !std::mem::take(&mut self.skips_line) {
                return Ok(Some(Taken::Line(String::from_utf8_lossy(&line).into_owned())));
            }
        }
    }

    fn decode_eof(&mut self, bytes: &mut BytesMut) -> io::Result<Option<Taken>> {
        if let Some(taken) = self.decode(bytes)? {
            return Ok(Some(taken));
        }
        let line = bytes.split();
        Ok((!line.is_empty()).then(|| Taken::Line(String::from_utf8_lossy(&line).into_owned())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the pieces in which they come.
    fn taken(text: &[u8]) -> Vec<Taken> {
        let each = [1, 2, 7, text.len()].map(|size| {
            let (mut lines, mut bytes, mut all) = (Lines::default(), BytesMut::new(), Vec::new());
            for piece in text.chunks(size) {
                bytes.extend_from_slice(piece);
                while let Some(one) = lines.decode(&mut bytes).unwrap() {
                    all.push(one);
                }
            }
            while let Some(one) = lines.decode_eof(&mut bytes).unwrap() {
                all.push(one);
            }
            all
        });
        let [first, others @ ..] = each;
        assert!(others.iter().all(|other| *other == first), "{first:?} {others:?}");
        first
    }

    #[test]
    fn lines_end_as_on_any_system_and_may_be_too_long() {
        let lines = |lines: &[&str]| lines.iter().map(|line| Taken::Line((*line).to_owned())).collect::<Vec<_>>();
        assert_eq!(taken(b"a\nb\r\nc\rd\n\n\r\r\ne"), lines(&["a", "b", "c", "d", "", "", "", "e"]));
        assert_eq!(taken(b"# zur\xfcck\n"), lines(&["# zur\u{fffd}ck"]));
        let long = [&b"x\n"[..], &vec![b'y'; 2 * LINE_BYTES_MOST + 9], b"\r\nz\n"].concat();
        let [first, Taken::TooLong, last] = &taken(&long)[..] else { panic!() };
        assert_eq!((first, last), (&lines(&["x"])[0], &lines(&["z"])[0]));
    }
}
