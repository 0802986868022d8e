//! The server's lists, for their routes and for the `catalog` messages.

use std::time::{Duration, Instant};

use ferry_core::challenge::{ChallengeName, Difficulty};
use jiff::{Timestamp, Zoned, civil::Date, tz::TimeZone};

use super::Server;
use crate::protocol::{
    ChallengeSummary, EvaluationSummary, JobStage, JobSummary, Period, ProgramStanding, RecoverySummary,
    TrainingSummary,
};
use ferry_lab::jobs::Lane;

/// Earlier challenges in the list.
const EARLIER_MOST: usize = 50;
/// Time for which a job is listed after its end.
const ENDED_FOR: Duration = Duration::from_secs(600);

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

/// The jobs of all kinds, lane by lane, in their order.
pub fn jobs(server: &Server) -> Vec<JobSummary> {
    let is_listed = |ended: Option<Instant>| ended.is_none_or(|ended| ended.elapsed() < ENDED_FOR);
    let paces = &server.jobs.paces;
    let mut all: Vec<JobSummary> = Vec::new();
    let comparisons = server.comparisons.all().into_iter().filter(|job| is_listed(job.life.ended()));
    all.extend(comparisons.map(|job| JobSummary::from(&*job)));
    let evaluations = server.evaluations.all().into_iter().filter(|job| is_listed(job.life.ended()));
    all.extend(evaluations.map(|job| JobSummary::of_evaluation(&job, paces)));
    let recoveries = server.recoveries.all().into_iter().filter(|job| is_listed(job.life.ended()));
    all.extend(recoveries.map(|job| JobSummary::from(&*job)));
    // One that ended before the server began has no time of its end.
    let trainings = server.trainings.all().into_iter().filter(|training| {
        let status = training.status();
        !status.stage.is_final() || status.ended.is_some_and(|ended| is_listed(Some(ended)))
    });
    all.extend(trainings.map(|training| JobSummary::from(&*training)));
    in_order(all, &Lane::ALL.map(|lane| server.jobs.order(lane)))
}

/// `orders` are the ids in each lane, first the one that runs.
fn in_order(all: Vec<JobSummary>, orders: &[Vec<String>]) -> Vec<JobSummary> {
    let (mut placed, mut others): (Vec<Vec<JobSummary>>, Vec<JobSummary>) =
        (vec![Vec::new(); orders.len()], Vec::new());
    for job in all {
        let lane = orders.iter().position(|order| order.contains(&job.id));
        // Not one that has ended since, or is only about to begin.
        let is_in_line = matches!(job.stage, JobStage::Waiting | JobStage::Running);
        lane.filter(|_| is_in_line).map_or(&mut others, |lane| &mut placed[lane]).push(job);
    }
    let is_at_once = |job: &JobSummary| job.stage == JobStage::Running;
    let (first, last): (Vec<_>, Vec<_>) = others.into_iter().partition(is_at_once);
    for (lane, order) in placed.iter_mut().zip(orders) {
        lane.sort_by_key(|job| order.iter().position(|id| *id == job.id));
        let mut before_s = 0.0;
        for (job, before) in lane.iter_mut().zip(0..) {
            if job.stage == JobStage::Waiting {
                (job.before, job.starts_in_s) = (before, Some(before_s));
            }
            before_s += job.left_s.unwrap_or(0.0);
        }
    }
    first.into_iter().chain(placed.into_iter().flatten()).chain(last).collect()
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
    use crate::protocol::JobKind;
    use ferry_lab::jobs::Ticket;

    #[test]
    fn jobs_are_in_the_order_of_their_lanes_with_the_time_of_those_before() {
        let job = |id: &str, stage, left_s| {
            let ticket = Ticket { owner: None, lane: Lane::Short, estimate_s: 9.0 };
            JobSummary::new((id, JobKind::Evaluation, "posts".into()), &ticket, (stage, None), [1.0, 4.0], left_s)
        };
        let all = vec![
            job("ended", JobStage::Done, 0.0),
            job("third", JobStage::Waiting, 5.0),
            job("paused", JobStage::Paused, 6.0),
            job("first", JobStage::Running, 20.0),
            job("second", JobStage::Waiting, 30.0),
            job("long", JobStage::Waiting, 500.0),
            job("comparison", JobStage::Running, 2.0),
        ];
        let orders = [vec!["first", "second", "third"], vec!["long"]];
        let jobs = in_order(all, &orders.map(|order| order.into_iter().map(str::to_owned).collect()));
        let read = jobs.iter().map(|job| (job.id.as_str(), job.before, job.starts_in_s)).collect::<Vec<_>>();
        let expected = [
            ("comparison", 0, None),
            ("first", 0, None),
            ("second", 1, Some(20.0)),
            ("third", 2, Some(50.0)),
            ("long", 0, Some(0.0)),
            ("ended", 0, None),
            ("paused", 0, None),
        ];
        assert_eq!(read, expected);
        assert_eq!((jobs[0].share, jobs[0].left_s, jobs[5].left_s), (0.25, Some(2.0), None));
        assert!(jobs[6].left_s == Some(6.0) && !jobs[6].can_pause && jobs[1].can_pause);
    }

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
