//! From the bytes of a file to text: encodings as browsers know them, and compressed drawings.

use std::io::Read;

use encoding_rs::{Encoding, UTF_8};
use flate2::read::MultiGzDecoder;

use crate::map::{MAX_SVG_BYTES, MapError};

const GZIP: [u8; 2] = [0x1f, 0x8b];

/// The text of a drawing, which may be compressed.
///
/// # Errors
/// [`MapError::TooLarge`], [`MapError::Svg`]: the encoding is unknown, or the bytes do not agree with it.
pub fn decoded(bytes: &[u8]) -> Result<String, MapError> {
    check_format(bytes)?;
    if !bytes.starts_with(&GZIP) {
        return text(bytes);
    }
    let mut unpacked = Vec::new();
    let most = MAX_SVG_BYTES as u64 + 1;
    let read = MultiGzDecoder::new(bytes).take(most).read_to_end(&mut unpacked);
    read.map_err(|error| MapError::Svg(format!("it is compressed, and damaged: {error}")))?;
    if unpacked.len() > MAX_SVG_BYTES {
        return Err(MapError::TooLarge { bytes: unpacked.len() });
    }
    text(&unpacked)
}

/// Refuses a file of another format, by its first 16 bytes.
///
/// # Errors
/// [`MapError::Svg`], with the format.
pub fn check_format(head: &[u8]) -> Result<(), MapError> {
    let reason = match head {
        [0x89, b'P', b'N', b'G', ..]
        | [0xff, 0xd8, 0xff, ..]
        | [b'G', b'I', b'F', b'8', ..]
        | [b'R', b'I', b'F', b'F', ..]
        | [b'B', b'M', ..]
        | [b'I', b'I', 0x2a, 0, ..]
        | [b'M', b'M', 0, 0x2a, ..]
        | [_, _, _, _, b'f', b't', b'y', b'p', ..] => {
            "it is an image of pixels, not a drawing; draw its walls over it in a drawing program, or on the page with Draw, \
             and save them without it as SVG"
        }
        [b'%', b'P', b'D', b'F', ..] | [b'%', b'!', b'P', b'S', ..] => {
            "it is a PDF or PostScript file; open it in a drawing program and save it as plain SVG"
        }
        [b'P', b'K', 3, 4, ..] => "it is an archive or a document of an office program; save the drawing as plain SVG",
        _ => return Ok(()),
    };
    Err(MapError::Svg(reason.to_owned()))
}

fn text(bytes: &[u8]) -> Result<String, MapError> {
    let (encoding, start) = match Encoding::for_bom(bytes) {
        Some(found) => found,
        None => (declared(bytes)?, 0),
    };
    let (text, is_broken) = encoding.decode_without_bom_handling(&bytes[start..]);
    if is_broken {
        let name = encoding.name();
        let reason = format!("it is not {name}; save it as UTF-8, or declare its encoding in the first line");
        return Err(MapError::Svg(reason));
    }
    // A declaration of another encoding would be wrong from now on.
    let rest = text.strip_prefix("<?xml").filter(|_| encoding != UTF_8).and_then(|rest| rest.split_once("?>"));
    Ok(rest.map_or_else(|| text.to_string(), |(_, rest)| rest.to_owned()))
}

/// The encoding in `<?xml … encoding="…"?>`.
fn declared(bytes: &[u8]) -> Result<&'static Encoding, MapError> {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]);
    let declaration =
        head.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")).map_or("", |(inside, _)| inside);
    let Some((_, value)) = declaration.split_once("encoding") else { return Ok(UTF_8) };
    let value = value.trim_start().strip_prefix('=').unwrap_or_default().trim_start();
    let label = value.get(1..).and_then(|rest| rest.split(['"', '\'']).next()).unwrap_or_default();
    // A text that can be read so far is not UTF-16.
    match Encoding::for_label(label.as_bytes()) {
        Some(encoding) if encoding.name().starts_with("UTF-16") => Ok(UTF_8),
        Some(encoding) => Ok(encoding),
        None => Err(MapError::Svg(format!("its encoding {label:?} is unknown; save it as UTF-8"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn encodings_are_read_or_named() {
        let drawing = |declaration: &str| format!("{declaration}<svg><title>Gänge</title></svg>");
        let utf_16 = |big: bool| {
            let units = drawing("<?xml version='1.0' encoding='UTF-16'?>");
            let mark = std::iter::once(0xfeff_u16).chain(units.encode_utf16());
            mark.flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect::<Vec<u8>>()
        };
        let latin_1 = |text: String| text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect::<Vec<u8>>();
        let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packed.write_all(drawing("").as_bytes()).unwrap();
        let declared = r#"<?xml version="1.0" encoding = "ISO-8859-1" standalone="no"?>"#;
        let packed = packed.finish().unwrap();
        for bytes in [
            drawing("").into_bytes(),
            format!("\u{feff}{}", drawing("")).into_bytes(),
            utf_16(true),
            utf_16(false),
            latin_1(drawing(declared)),
            packed.clone(),
        ] {
            let text = decoded(&bytes).unwrap();
            assert!(text.ends_with("<svg><title>Gänge</title></svg>") && text.starts_with('<'), "{text}");
        }
        for (bytes, part) in [
            (latin_1(drawing("")), "it is not UTF-8"),
            (drawing("<?xml version='1.0' encoding='EBCDIC'?>").into_bytes(), "\"EBCDIC\" is unknown"),
            (packed[..packed.len() - 9].to_vec(), "damaged"),
        ] {
            let error = decoded(&bytes).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn files_of_other_formats_are_named() {
        for (head, part) in [
            (&b"\x89PNG\r\n\x1a\n"[..], "an image of pixels"),
            (b"\xff\xd8\xff\xe0\0\x10JFIF", "an image of pixels"),
            (b"RIFF\x24\0\0\0WEBP", "an image of pixels"),
            (b"\0\0\0\x18ftypheic", "an image of pixels"),
            (b"GIF89a", "an image of pixels"),
            (b"%PDF-1.7\n", "a PDF"),
            (b"PK\x03\x04\x14\0", "an archive"),
        ] {
            let error = decoded(head).unwrap_err().to_string();
            assert!(error.contains(part) && error.contains("SVG"), "{error}");
        }
    }
}
