//! Elements of an XML document, written with indents.

use quick_xml::Writer;
use quick_xml::events::{BytesEnd, BytesStart, BytesText, Event};

pub(super) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub(super) fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), children: Vec::new() }
    }

    #[must_use]
    pub(super) fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    /// An attribute of one or more numbers.
    #[must_use]
    pub(super) fn numbers(self, name: &'static str, values: &[f64]) -> Self {
        self.with(name, values.iter().map(|&value| number(value)).collect::<Vec<_>>().join(" "))
    }

    #[must_use]
    pub(super) fn child(self, child: Self) -> Self {
        self.children([child])
    }

    #[must_use]
    pub(super) fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// The document with this root, after a comment.
    pub(super) fn document(&self, comment: &str) -> String {
        let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
        let written = writer
            .write_event(Event::Comment(BytesText::from_escaped(format!(" {comment} "))))
            .and_then(|()| self.write(&mut writer));
        written.expect("a vector takes every byte");
        let mut text = String::from_utf8(writer.into_inner()).expect("all parts are strings");
        text.push('\n');
        text
    }

    fn write(&self, writer: &mut Writer<Vec<u8>>) -> std::io::Result<()> {
        let attributes = self.attributes.iter().map(|(name, value)| (*name, value.as_str()));
        let start = BytesStart::new(self.name).with_attributes(attributes);
        if self.children.is_empty() {
            return writer.write_event(Event::Empty(start));
        }
        writer.write_event(Event::Start(start))?;
        for child in &self.children {
            child.write(writer)?;
        }
        writer.write_event(Event::End(BytesEnd::new(self.name)))
    }
}

/// To 12 decimals.
fn number(value: f64) -> String {
    let rounded = (value * 1e12).round() / 1e12;
    // Without a minus before zero.
    (rounded + 0.0).to_string()
}

/// A colour with red, green, blue and opacity, 0 to 1.
pub(super) fn rgba(color: [u8; 3]) -> [f64; 4] {
    let [red, green, blue] = color.map(|level| (f64::from(level) / 255.0 * 1e3).round() / 1e3);
    [red, green, blue, 1.0]
}
