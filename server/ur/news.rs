//! What happens to a robot between two ticks, kept until the session reports it.

/// What is kept for a session that does not ask.
const MOST: usize = 100;

/// One thing that has happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    pub is_refused: bool,
    pub text: String,
}

/// Oldest first.
#[derive(Clone, Debug, Default)]
pub struct News(Vec<Item>);

impl News {
    pub fn tell(&mut self, text: String) {
        self.push(Item { is_refused: false, text });
    }

    pub fn refuse(&mut self, text: String) {
        self.push(Item { is_refused: true, text });
    }

    /// What has happened since the last call.
    pub fn take(&mut self) -> Vec<Item> {
        std::mem::take(&mut self.0)
    }

    pub fn push(&mut self, item: Item) {
        if self.0.len() < MOST {
            self.0.push(item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_oldest_in_order() {
        let mut news = News::default();
        news.refuse("first".to_owned());
        (0..2 * MOST).for_each(|i| news.tell(i.to_string()));
        let taken = news.take();
        assert_eq!(taken.len(), MOST);
        assert_eq!(taken[0], Item { is_refused: true, text: "first".to_owned() });
        assert_eq!(taken[1], Item { is_refused: false, text: "0".to_owned() });
        assert_eq!(news.take(), []);
    }
}
