//! Lines of a connection put together to programs, and programs taken apart into statements.

use super::{PROGRAM_BYTES_MOST, ScriptError};

/// Words that begin a block, which `end` closes.
const BLOCKS: [&str; 5] = ["def", "sec", "thread", "while", "if"];

/// Finds statements: parts of lines between semicolons, without comments; in brackets, a line's end ends nothing.
#[derive(Clone, Debug, Default)]
pub struct Statements {
    /// What has begun, and the line in which it has.
    begun: String,
    line: usize,
    brackets: usize,
    /// Complete ones, with their lines.
    found: Vec<(usize, String)>,
}

impl Statements {
    /// All statements of a text.
    ///
    /// # Errors
    /// A bracket is not closed.
    pub fn of(text: &str) -> Result<Vec<(usize, String)>, ScriptError> {
        let mut statements = Self::default();
        text.lines().enumerate().for_each(|(number, line)| statements.take(number + 1, line));
        match statements.begun.is_empty() {
            true => Ok(statements.found),
            false => Err(ScriptError::Bracket { line: statements.line }),
        }
    }

    fn take(&mut self, number: usize, line: &str) {
        let mut quote = None;
        for c in line.trim_start_matches('\u{feff}').chars() {
            match (quote, c) {
                (Some(open), c) if open == c => quote = None,
                (Some(_), _) => {}
                (None, '"' | '\'') => quote = Some(c),
                (None, '#') => break,
                (None, ';') if self.brackets == 0 => {
                    self.complete();
                    continue;
                }
                (None, '(' | '[') => self.brackets += 1,
                (None, ')' | ']') => self.brackets = self.brackets.saturating_sub(1),
                _ => {}
            }
            if self.begun.is_empty() {
                self.line = number;
                if c.is_whitespace() {
                    continue;
                }
            }
            self.begun.push(c);
        }
        if self.brackets == 0 {
            self.complete();
        } else {
            self.begun.push(' ');
        }
    }

    fn complete(&mut self) {
        let statement = std::mem::take(&mut self.begun);
        if !statement.is_empty() {
            self.found.push((self.line, statement.trim_end().to_owned()));
        }
    }
}

/// The word with which a statement begins.
pub fn first_word(statement: &str) -> &str {
    statement.split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or_default()
}

/// Puts lines together to programs: a statement alone, or all from `def` or `sec` to its `end`.
#[derive(Debug, Default)]
pub struct Reader {
    text: String,
    statements: Statements,
    lines: usize,
    has_begun: bool,
    /// Blocks that are open.
    blocks: usize,
    /// A program that was refused while it came is skipped to its end.
    is_skipped: bool,
}

impl Reader {
    /// Takes a line; returns a program when it is complete.
    ///
    /// # Errors
    /// What has begun cannot be completed. The line is taken nevertheless.
    pub fn take(&mut self, line: &str) -> Result<Option<String>, ScriptError> {
        let is_program = ["def", "sec"].contains(&first_word(line.trim_start()));
        if is_program && self.blocks == 0 && self.is_open() {
            let error = ScriptError::Bracket { line: self.statements.line };
            *self = Self::default();
            self.take(line)?;
            return Err(error);
        }
        self.lines += 1;
        self.statements.take(self.lines, line);
        for (_, statement) in self.statements.found.drain(..) {
            self.has_begun = true;
            match first_word(&statement) {
                "end" => self.blocks = self.blocks.saturating_sub(1),
                word if BLOCKS.contains(&word) => self.blocks += 1,
                _ => {}
            }
        }
        if !self.is_skipped {
            self.text.push_str(line);
            self.text.push('\n');
        }
        if self.text.len().max(self.statements.begun.len()) > PROGRAM_BYTES_MOST {
            self.skip();
            return Err(ScriptError::Large);
        }
        if self.is_open() {
            return Ok(None);
        }
        let whole = std::mem::take(self);
        Ok((whole.has_begun && !whole.is_skipped).then_some(whole.text))
    }

    fn is_open(&self) -> bool {
        self.blocks > 0 || self.statements.brackets > 0
    }

    /// A line cannot be taken: the rest of its program is skipped.
    pub fn skip(&mut self) {
        *self = Self { blocks: self.blocks, is_skipped: self.blocks > 0, ..Self::default() };
    }

    /// # Errors
    /// A program has begun, and does not end.
    pub fn finish(self) -> Result<(), ScriptError> {
        match self.is_open() && !self.is_skipped {
            true => Err(ScriptError::Unfinished { lines: self.lines }),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is complete after each line.
    fn taken(lines: &str) -> Vec<Result<Option<String>, ScriptError>> {
        let mut reader = Reader::default();
        lines.lines().map(|line| reader.take(line)).filter(|taken| *taken != Ok(None)).collect()
    }

    #[test]
    fn programs_are_put_together_from_lines() {
        let programs = [
            "stopl(1)\n",
            "def a():\n  while True:\n  end\nend\n",
            "def b():\nif x: # end\n  textmsg(\"end\")\nend # of if\nend # of b\n",
            "  sec c():\n  end\n",
            "movej([0, 0,\n0])\n",
            "def d():; stopl(1); end;\n",
            "\u{feff}def e():\n  def f():\n  end\n  thread t():\n  end\nend\n",
        ];
        let expected: Vec<_> = programs.iter().map(|text| Ok(Some((*text).to_owned()))).collect();
        assert_eq!(taken(&programs.join("\n# nothing\n\n")), expected);
    }

    #[test]
    fn what_cannot_be_completed_is_refused_and_the_next_program_is_read() {
        let next = Ok(Some("def b():\nend\n".to_owned()));
        let open = Err(ScriptError::Bracket { line: 1 });
        assert_eq!(taken("movej([0, 0\n\ndef b():\nend"), [open, next.clone()]);
        let long =
            format!("def a():\n  while x:\n{}\n end\nend\ndef b():\nend", vec!["x".repeat(60_000); 6].join("\n"));
        assert_eq!(taken(&long), [Err(ScriptError::Large), next]);
        let mut reader = Reader::default();
        assert_eq!(reader.take("def a():"), Ok(None));
        assert_eq!(reader.finish(), Err(ScriptError::Unfinished { lines: 1 }));
        let mut reader = Reader::default();
        assert_eq!((reader.take("def a():"), reader.skip(), reader.take("end")), (Ok(None), (), Ok(None)));
        assert_eq!(reader.take("stopj(1)"), Ok(Some("stopj(1)\n".to_owned())));
        assert_eq!(reader.finish(), Ok(()));
    }
}
