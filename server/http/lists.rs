//! The server's lists, for their routes and for the `catalog` messages.

use ferry_core::challenge::{ChallengeName, Difficulty};
use jiff::{Timestamp, Zoned, civil::Date, tz::TimeZone};

use super::Server;
use crate::protocol::{ChallengeSummary, EvaluationSummary, Period, ProgramStanding, RecoverySummary, TrainingSummary};

/// Earlier challenges in the list.
const EARLIER_MOST: usize = 50;

pub fn programs(server: &Server) -> Vec<ProgramStanding> {
    server.programs.all().iter().map(|program| ProgramStanding::from(&**program)).collect()
}

pub fn evaluations(server: &Server) -> Vec<EvaluationSummary> {
    server.evaluations.all().iter().map(|evaluation| EvaluationSummary::from(&**evaluation)).collect()
}

pub fn recoveries(server: &Server) -> Vec<RecoverySummary> {
    server.recoveries.all().iter().map(|job| RecoverySummary::from(&**job)).collect()
}

pub fn trainings(server: &Server) -> Vec<TrainingSummary> {
    server.trainings.all().iter().map(|training| TrainingSummary::from(&**training)).collect()
}

pub fn today() -> Date {
    date(Timestamp::now())
}

fn date(now: Timestamp) -> Date {
    Zoned::new(now, TimeZone::UTC).date()
}

/// Those of the day and of the week, in UTC.
fn offered(now: Timestamp) -> Vec<(ChallengeName, Period)> {
    let today = date(now);
    let week = today.iso_week_date();
    let seeds = [(today.to_string(), Period::Day), (format!("{:04}-w{:02}", week.year(), week.week()), Period::Week)];
    let all = seeds.into_iter().flat_map(|(seed, period)| {
        Difficulty::ALL.map(|difficulty| (ChallengeName { difficulty, seed: seed.clone() }, period))
    });
    all.collect()
}

/// Reads files.
pub fn challenges(server: &Server) -> Vec<ChallengeSummary> {
    let boards = &server.contests.boards;
    let offered = offered(Timestamp::now());
    let mut earlier = boards.names();
    earlier.retain(|name| offered.iter().all(|(other, _)| other != name));
    let earlier = earlier.into_iter().rev().take(EARLIER_MOST).map(|name| (name, None));
    let all = offered.into_iter().map(|(name, period)| (name, Some(period))).chain(earlier);
    all.map(|(name, period)| ChallengeSummary::of(&name, period, &boards.of(&name))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_a_day_and_three_a_week_are_offered_also_at_the_turn_of_the_year() {
        let names = |now: &str| {
            let all = offered(now.parse().unwrap());
            all.into_iter().map(|(name, _)| name.to_string()).collect::<Vec<_>>()
        };
        assert_eq!(
            names("2026-11-26T23:59:59Z"),
            [
                "easy-2026-11-26",
                "medium-2026-11-26",
                "hard-2026-11-26",
                "easy-2026-w48",
                "medium-2026-w48",
                "hard-2026-w48"
            ]
        );
        assert_eq!(names("2027-01-01T00:00:00Z")[3], "easy-2026-w53");
    }
}
