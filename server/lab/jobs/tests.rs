use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};

use super::*;
use ferry_camera::AdapterChoice;

/// A job that does its work once and reports.
struct Errand {
    waits: AtomicBool,
    work: Box<dyn Fn(&Workshop) -> String + Send + Sync>,
    report: Mutex<Sender<String>>,
}

impl Errand {
    fn tell(&self, text: String) {
        // At the end of a test the queue may interrupt a job that has ended, and then no receiver waits.
        let _ = self.report.lock().unwrap().send(text);
    }
}

impl Job for Errand {
    fn is_waiting(&self) -> bool {
        self.waits.load(Ordering::SeqCst)
    }

    fn begin(&self) -> bool {
        self.waits.swap(false, Ordering::SeqCst)
    }

    fn run(&self, workshop: &Workshop) {
        self.tell((self.work)(workshop));
    }

    fn fail(&self, reason: String) {
        self.tell(reason);
    }

    fn interrupt(&self) {
        self.tell("interrupted".into());
    }
}

fn queue() -> Queue {
    Queue::start(Gpu::open(AdapterChoice::Auto).expect("the tests need a graphics adapter")).unwrap()
}

fn errand(report: &Sender<String>, work: impl Fn(&Workshop) -> String + Send + Sync + 'static) -> Arc<Errand> {
    Arc::new(Errand { waits: AtomicBool::new(true), work: Box::new(work), report: Mutex::new(report.clone()) })
}

#[test]
fn jobs_run_in_order_and_a_panic_ends_only_its_own() {
    let queue = queue();
    let (report, reports) = channel();
    let (open, gate) = channel::<()>();
    let gate = Mutex::new(gate);
    let first = errand(&report, move |_| {
        gate.lock().unwrap().recv().unwrap();
        "first".into()
    });
    queue.submit(first).unwrap();
    let cancelled = errand(&report, |_| "cancelled".into());
    let rest = [
        errand(&report, |workshop: &Workshop| workshop.pool.install(|| panic!("seven wings"))),
        cancelled.clone(),
        errand(&report, |_| "last".into()),
    ];
    for job in rest {
        queue.submit(job).unwrap();
    }
    cancelled.waits.store(false, Ordering::SeqCst);
    open.send(()).unwrap();
    let told: Vec<String> = reports.iter().take(3).collect();
    assert_eq!(told, ["first", "the job panicked: seven wings", "last"]);
}

#[test]
fn a_full_queue_refuses_and_a_closing_one_interrupts() {
    let queue = queue();
    let (report, reports) = channel();
    let (begun, begins) = channel::<()>();
    let (open, gate) = channel::<()>();
    let gate = Mutex::new((begun, gate));
    let running = errand(&report, move |_| {
        let gate = gate.lock().unwrap();
        gate.0.send(()).unwrap();
        gate.1.recv().unwrap();
        "ran".into()
    });
    queue.submit(running).unwrap();
    begins.recv().unwrap();
    for _ in 0..WAITING_LIMIT {
        queue.submit(errand(&report, |_| "never".into())).unwrap();
    }
    let more = errand(&report, |_| "never".into());
    assert!(matches!(queue.submit(more.clone()), Err(QueueError::Full)));
    queue.stop();
    open.send(()).unwrap();
    queue.close();
    assert!(matches!(queue.submit(more), Err(QueueError::Closing)));
    let told: Vec<String> = reports.try_iter().collect();
    assert_eq!(told.len(), WAITING_LIMIT + 2, "{told:?}");
    assert!(!told.contains(&"never".into()) && told.contains(&"ran".into()), "{told:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn its_threads_have_low_priority() {
    let niceness = || {
        let stat = std::fs::read_to_string("/proc/thread-self/stat").unwrap();
        // The name, in brackets, may contain anything; nice is the 17th field after it.
        stat.rsplit_once(')').unwrap().1.split_whitespace().nth(16).unwrap().to_owned()
    };
    let (report, reports) = channel();
    let queue = queue();
    queue.submit(errand(&report, move |workshop: &Workshop| workshop.pool.install(niceness))).unwrap();
    assert_eq!(reports.recv().unwrap(), "10");
}
