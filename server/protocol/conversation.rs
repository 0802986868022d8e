//! What is said to a program, and what it answers, without the connection.

use std::collections::{BTreeMap, HashMap};

use super::{ErrorMessage, ProgramAnswer, ProgramMessage};
use ferry_core::control::transport::program::Answer;
use ferry_core::trial::{Leg, REASON_BYTES_MOST};
use ferry_lab::program::{Reply, Sent};

/// The questions and answers of one program.
pub struct Conversation {
    name: String,
    /// Questions that are not answered yet, oldest first.
    open: BTreeMap<u64, Reply>,
    next: u64,
    /// The leg that each trial is in.
    legs: HashMap<String, Leg>,
}

/// A message to the program.
pub enum Outgoing {
    Text(String),
    /// The gray image, row by row from the top.
    Image(Vec<u8>),
}

impl Outgoing {
    pub fn error(error: ErrorMessage) -> Self {
        Self::from(&ProgramMessage::Error(error))
    }
}

impl From<&ProgramMessage> for Outgoing {
    fn from(message: &ProgramMessage) -> Self {
        Self::Text(serde_json::to_string(message).expect("its fields are numbers, texts and lists"))
    }
}

impl Conversation {
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), open: BTreeMap::new(), next: 0, legs: HashMap::new() }
    }

    pub fn hello(&self) -> Outgoing {
        Outgoing::from(&ProgramMessage::hello(&self.name))
    }

    /// The messages for something that the program gets.
    pub fn tell(&mut self, sent: Sent) -> Vec<Outgoing> {
        let asked = match sent {
            Sent::Question(asked) => asked,
            Sent::Ended(trial) => {
                let is_known = self.legs.remove(&trial).is_some();
                return is_known.then(|| Outgoing::from(&ProgramMessage::End { trial })).into_iter().collect();
            }
        };
        let mut messages = Vec::with_capacity(3);
        if self.legs.get(&asked.trial) != Some(&asked.query.leg) {
            messages.push(Outgoing::from(&ProgramMessage::start(&asked.trial, &asked.query.leg)));
            self.legs.insert(asked.trial.clone(), asked.query.leg.clone());
        }
        self.next += 1;
        messages.push(Outgoing::from(&ProgramMessage::observe(self.next, &asked)));
        messages.push(Outgoing::Image(asked.query.percept.gray.pixels));
        self.open.insert(self.next, asked.reply);
        messages
    }

    /// Takes an answer. After a message that cannot be used, the arm holds in the step that was asked first.
    pub fn take(&mut self, text: &str) -> Result<(), ErrorMessage> {
        // Those whose trial has gone on are over.
        self.open.retain(|_, reply| reply.is_open());
        let answer = match ProgramAnswer::parse(text) {
            Ok(answer) => answer,
            Err(error) => {
                if let Some((_, oldest)) = self.open.pop_first() {
                    let mut reason = format!("{} sent a message that cannot be used: {}", self.name, error.message);
                    reason.truncate(reason.floor_char_boundary(REASON_BYTES_MOST));
                    oldest.give(Answer::Hold { reason });
                }
                return Err(error);
            }
        };
        let request = answer.request();
        let over = || ErrorMessage {
            code: "over".to_owned(),
            message: format!(
                "request is {request}, which is not open: it was never asked, is answered, or its time is over"
            ),
            field: Some("request".to_owned()),
        };
        let reply = self.open.remove(&request).ok_or_else(over)?;
        if reply.give(answer.answer(&self.name)) { Ok(()) } else { Err(over()) }
    }

    pub fn malformed(message: &str) -> ErrorMessage {
        ErrorMessage { code: "malformed".to_owned(), message: message.to_owned(), field: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_find_their_questions() {
        let mut conversation = Conversation::new("mine");
        let mut ask = |request: u64| {
            let (reply, answered) = Reply::new();
            conversation.open.insert(request, reply);
            answered
        };
        let (mut first, mut second, mut third) = (ask(1), ask(2), ask(3));
        conversation.take(r#"{"type":"act","request":2,"target_m":[0.1,-0.3]}"#).unwrap();
        assert_eq!(second.try_recv(), Ok(Answer::Go { target_m: ferry_core::geometry::Point2::new(0.1, -0.3) }));
        conversation.take(r#"{"type":"hold","request":1,"reason":"no idea"}"#).unwrap();
        assert_eq!(first.try_recv(), Ok(Answer::Hold { reason: "mine: no idea".to_owned() }));
        for request in [2, 9] {
            let text = format!(r#"{{"type":"act","request":{request},"target_m":[0.1,-0.3]}}"#);
            let error = conversation.take(&text).unwrap_err();
            assert_eq!((error.code.as_str(), error.field.as_deref()), ("over", Some("request")));
        }
        let error = conversation.take(r#"{"type":"act","request":3,"target_m":[0.1]}"#).unwrap_err();
        assert_eq!(error.field.as_deref(), Some("target_m"), "{error:?}");
        let Ok(Answer::Hold { reason }) = third.try_recv() else { panic!("the arm holds") };
        assert!(reason.starts_with("mine sent a message that cannot be used: target_m: invalid length 1"), "{reason}");
        assert!(conversation.take(r#"{"type":"act","request":3,"target_m":[NaN,0]}"#).is_err());
    }
}
