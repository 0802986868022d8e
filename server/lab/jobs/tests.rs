use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};

use super::*;
use ferry_camera::AdapterChoice;

/// A job that does its work once and reports.
struct Errand {
    id: String,
    lane: Lane,
    waits: AtomicBool,
    ended: AtomicBool,
    work: Box<dyn Fn(&Workshop) -> String + Send + Sync>,
    report: Mutex<Sender<String>>,
}

impl Errand {
    fn tell(&self, text: String) {
        self.report.lock().unwrap().send(text).unwrap();
    }
}

impl Job for Errand {
    fn id(&self) -> &str {
        &self.id
    }

    fn lane(&self) -> Lane {
        self.lane
    }

    fn is_waiting(&self) -> bool {
        self.waits.load(Ordering::SeqCst)
    }

    fn begin(&self) -> bool {
        self.waits.swap(false, Ordering::SeqCst)
    }

    fn run(&self, workshop: &Workshop) {
        let told = (self.work)(workshop);
        self.ended.store(true, Ordering::SeqCst);
        self.tell(told);
    }

    fn fail(&self, reason: String) {
        self.tell(reason);
    }

    fn interrupt(&self) {
        // The queue may take a job that has just ended for the running one.
        if !self.ended.load(Ordering::SeqCst) {
            self.tell("interrupted".into());
        }
    }
}

fn queue() -> Queue {
    Queue::start(&Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter")).unwrap()
}

/// A job of the long lane.
fn errand(report: &Sender<String>, work: impl Fn(&Workshop) -> String + Send + Sync + 'static) -> Arc<Errand> {
    errand_in(Lane::Long, "one", report, work)
}

fn errand_in(
    lane: Lane,
    id: &str,
    report: &Sender<String>,
    work: impl Fn(&Workshop) -> String + Send + Sync + 'static,
) -> Arc<Errand> {
    let (waits, ended, report) = (AtomicBool::new(true), AtomicBool::new(false), Mutex::new(report.clone()));
    Arc::new(Errand { id: id.to_owned(), lane, waits, ended, work: Box::new(work), report })
}

/// A job that reports that it has begun, and ends when it is released.
fn held(lane: Lane, report: &Sender<String>) -> (Arc<Errand>, Receiver<()>, Sender<()>) {
    let ((begun, begins), (release, released)) = (channel(), channel());
    let gate = Mutex::new((begun, released));
    let job = errand_in(lane, "held", report, move |_| {
        let gate = gate.lock().unwrap();
        gate.0.send(()).unwrap();
        gate.1.recv().unwrap();
        "held".into()
    });
    (job, begins, release)
}

#[test]
fn jobs_run_in_order_and_a_panic_ends_only_its_own() {
    let queue = queue();
    let (report, reports) = channel();
    let (first, begins, release) = held(Lane::Long, &report);
    queue.submit(first).unwrap();
    begins.recv().unwrap();
    let cancelled = errand_in(Lane::Long, "two", &report, |_| "cancelled".into());
    let rest = [
        errand(&report, |workshop: &Workshop| workshop.pool.install(|| panic!("seven wings"))),
        cancelled.clone(),
        errand_in(Lane::Long, "three", &report, |_| "last".into()),
    ];
    for job in rest {
        queue.submit(job).unwrap();
    }
    cancelled.waits.store(false, Ordering::SeqCst);
    release.send(()).unwrap();
    let told: Vec<String> = reports.iter().take(3).collect();
    assert_eq!(told, ["held", "the job panicked: seven wings", "last"]);
}

#[test]
fn a_short_job_runs_beside_a_long_one_and_before_those_that_wait() {
    let queue = queue();
    let (report, reports) = channel();
    let (first, begins, release) = held(Lane::Long, &report);
    queue.submit(first).unwrap();
    begins.recv().unwrap();
    queue.submit(errand_in(Lane::Long, "waits", &report, |_| "waits".into())).unwrap();
    queue.submit(errand_in(Lane::Short, "short", &report, |_| "short".into())).unwrap();
    assert_eq!(reports.recv().unwrap(), "short");
    assert_eq!(queue.order(Lane::Long), ["held", "waits"]);
    release.send(()).unwrap();
    assert_eq!(reports.iter().take(2).collect::<Vec<_>>(), ["held", "waits"]);
}

#[test]
fn a_full_lane_refuses_beside_an_empty_one_and_a_closing_queue_interrupts() {
    let queue = queue();
    let (report, reports) = channel();
    let (running, begins, release) = held(Lane::Long, &report);
    queue.submit(running).unwrap();
    begins.recv().unwrap();
    for number in 0..WAITING_LIMIT {
        queue.submit(errand_in(Lane::Long, &format!("job-{number}"), &report, |_| "never".into())).unwrap();
    }
    let more = errand(&report, |_| "never".into());
    let refused = queue.submit(more.clone()).unwrap_err().to_string();
    assert!(refused.contains("lane of long jobs is full: 4"), "{refused}");
    queue.submit(errand_in(Lane::Short, "short", &report, |_| "short".into())).unwrap();
    assert_eq!(reports.recv().unwrap(), "short");
    queue.stop();
    release.send(()).unwrap();
    queue.close();
    assert!(matches!(queue.submit(more), Err(QueueError::Closing)));
    let told: Vec<String> = reports.try_iter().filter(|told| told != "held").collect();
    assert_eq!(told, ["interrupted"; WAITING_LIMIT + 1]);
}

#[test]
fn a_job_that_was_paused_while_it_waited_comes_once_and_last() {
    let queue = queue();
    let (report, reports) = channel();
    let (first, begins, release) = held(Lane::Short, &report);
    queue.submit(first).unwrap();
    begins.recv().unwrap();
    let [paused, other] = ["paused", "other"].map(|id| errand_in(Lane::Short, id, &report, move |_| id.into()));
    queue.submit(paused.clone()).unwrap();
    queue.submit(other).unwrap();
    paused.waits.store(false, Ordering::SeqCst);
    paused.waits.store(true, Ordering::SeqCst);
    queue.submit(paused).unwrap();
    assert_eq!(queue.order(Lane::Short).len(), 3);
    release.send(()).unwrap();
    assert_eq!(reports.iter().take(3).collect::<Vec<_>>(), ["held", "other", "paused"]);
    queue.close();
    assert!(reports.try_recv().is_err());
}

#[test]
fn a_job_pauses_goes_on_and_is_cancelled() {
    let life = Life::new(());
    assert!(life.pause() && !life.begin() && life.stage() == Stage::Paused, "while it waits");
    assert!(life.resume() && !life.resume() && life.begin());
    assert!(life.pause() && life.pause() && life.stop().load(Ordering::SeqCst), "while it runs");
    life.end(Stage::Cancelled);
    assert_eq!((life.stage(), life.ended()), (Stage::Paused, None));
    assert!(life.resume() && life.begin() && !life.stop().load(Ordering::SeqCst));
    assert!(life.pause() && life.cancel() && !life.pause(), "a cancellation is stronger");
    life.end(Stage::Cancelled);
    assert!(life.stage() == Stage::Cancelled && life.ended().is_some() && life.spent_s() > 0.0);
    assert!(!life.cancel() && !life.resume() && !life.pause());
    let done = Life::new(());
    assert!(done.begin() && done.pause());
    done.end(Stage::Done);
    assert_eq!(done.stage(), Stage::Done, "it ended before it could stop");
    let paused = Life::new(());
    assert!(paused.pause() && paused.cancel());
    assert!(paused.stage() == Stage::Cancelled && paused.ended().is_some());
}

#[cfg(target_os = "linux")]
#[test]
fn its_threads_have_low_priority_and_long_jobs_a_lower_one() {
    let niceness = || {
        let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
        // The name, in brackets, may contain anything; nice is the 17th field after it.
        stat.rsplit_once(')').unwrap().1.split_whitespace().nth(16).unwrap().to_owned()
    };
    let (report, reports) = channel();
    let queue = queue();
    for (lane, expected) in [(Lane::Short, "10"), (Lane::Long, "15")] {
        let work = move |workshop: &Workshop| [niceness(), workshop.pool.install(niceness)].join(" ");
        queue.submit(errand_in(lane, "one", &report, work)).unwrap();
        assert_eq!(reports.recv().unwrap(), [expected, expected].join(" "));
    }
}
