//! The progress of long work: a bar in a terminal, otherwise lines on standard error.

use std::io::Write;
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

/// Time to the first line. Each wait is twice the last one, up to the longest.
const FIRST_WAIT: Duration = Duration::from_secs(2);
const LONGEST_WAIT: Duration = Duration::from_secs(30);

/// Shows how many of `length` are done; 0 is a length that is not yet known. The bar's message is shown after the counts and
/// ends in a comma.
pub fn progress(length: u64, what: &'static str) -> anyhow::Result<ProgressBar> {
    let style = format!("{{bar:30}} {{pos}}/{{len}} {what}, {{msg}}{{elapsed}}, {{eta}} left");
    let bar = ProgressBar::new(length).with_style(ProgressStyle::with_template(&style)?);
    bar.enable_steady_tick(Duration::from_millis(500));
    if bar.is_hidden() {
        let bar = bar.downgrade();
        std::thread::spawn(move || {
            let mut wait = FIRST_WAIT;
            loop {
                std::thread::sleep(wait);
                wait = (2 * wait).min(LONGEST_WAIT);
                let Some(bar) = bar.upgrade().filter(|bar| !bar.is_finished()) else { return };
                let (done, length, said) = (bar.position(), bar.length().unwrap_or(0), bar.message());
                let [elapsed, left] = [bar.elapsed(), bar.eta()].map(HumanDuration);
                // A reader that is gone does not end the work.
                let _ = writeln!(std::io::stderr(), "{done}/{length} {what}, {said}{elapsed:#}, {left:#} left");
            }
        });
    }
    Ok(bar)
}
