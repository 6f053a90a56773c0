//! What the window costs: time to the first picture, processor time of the thread that draws, states a second, memory.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

/// Frames remembered.
const FRAMES: usize = 4096;

/// Times of the window since its start.
#[derive(Debug)]
pub(crate) struct Timings {
    started: Instant,
    first_picture: Option<Duration>,
    /// Processor time of this thread at the last frame.
    last: Option<Duration>,
    /// Of each of the last frames, while something ran in the background, or not.
    frames: [Vec<Duration>; 2],
    next: [usize; 2],
    /// States a second of every run, and of sheets held in the hand.
    rates: Vec<(&'static str, f64)>,
}

/// How long frames took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrameTimes {
    pub(crate) count: usize,
    pub(crate) mean_ms: f64,
    /// 95 of 100 took no longer.
    pub(crate) most_ms: f64,
}

impl Timings {
    pub(crate) fn new(started: Instant) -> Self {
        Self {
            started,
            first_picture: None,
            last: None,
            frames: [Vec::new(), Vec::new()],
            next: [0; 2],
            rates: Vec::new(),
        }
    }

    /// Takes note that a frame begins: what the thread did since the last one began belongs to that one.
    pub(crate) fn frame(&mut self, is_busy: bool, has_picture: bool) {
        if has_picture && self.first_picture.is_none() {
            self.first_picture = Some(self.started.elapsed());
        }
        let now = thread_time();
        if let (Some(last), Some(now)) = (self.last, now) {
            let kind = usize::from(is_busy);
            let (frames, next) = (&mut self.frames[kind], &mut self.next[kind]);
            let spent = now.saturating_sub(last);
            if frames.len() < FRAMES {
                frames.push(spent);
            } else {
                frames[*next % FRAMES] = spent;
            }
            *next += 1;
        }
        self.last = now;
    }

    /// Takes note of how often the state of a run was refreshed.
    pub(crate) fn rate(&mut self, what: &'static str, states_a_second: f64) {
        self.rates.push((what, states_a_second));
    }

    /// Of the frames while something ran in the background, or nothing did.
    pub(crate) fn frame_times(&self, is_busy: bool) -> Option<FrameTimes> {
        let mut times = self.frames[usize::from(is_busy)].clone();
        times.sort_unstable();
        let count = times.len();
        let most = times.get((count * 95 / 100).min(count.checked_sub(1)?))?;
        let ms = |d: &Duration| d.as_secs_f64() * 1e3;
        Some(FrameTimes {
            count,
            mean_ms: times.iter().map(ms).sum::<f64>() / count as f64,
            most_ms: ms(most),
        })
    }

    /// All of it in words, a line each.
    pub(crate) fn summary(&self) -> String {
        let mut text = String::new();
        // Writing into a string cannot fail.
        if let Some(first) = self.first_picture {
            let _ = writeln!(text, "first picture after {:.2} s", first.as_secs_f64());
        }
        for (is_busy, name) in [(false, "idle"), (true, "while work runs")] {
            if let Some(times) = self.frame_times(is_busy) {
                let _ = writeln!(
                    text,
                    "thread of the window, {name}: {:.2} ms a frame, 95 % within {:.2} ms, {} frames",
                    times.mean_ms, times.most_ms, times.count
                );
            }
        }
        for (what, rate) in &self.rates {
            let _ = writeln!(text, "{what}: {rate:.0} states a second");
        }
        if let Some([now, most]) = memory() {
            let _ = writeln!(text, "memory {now:.0} MB, at most {most:.0} MB");
        }
        text
    }
}

/// Processor time of the calling thread, where the system tells.
fn thread_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds = text.split_whitespace().next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

/// Megabytes in use, and the most there were, where the system tells.
fn memory() -> Option<[f64; 2]> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let field = |name: &str| -> Option<f64> {
        let line = text.lines().find(|line| line.starts_with(name))?;
        let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
        Some(kilobytes / 1e3)
    };
    Some([field("VmRSS:")?, field("VmHWM:")?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_counted_by_kind_and_the_summary_names_them() {
        let mut timings = Timings::new(Instant::now());
        assert!(timings.frame_times(false).is_none());
        for _ in 0..5 {
            timings.frame(false, true);
        }
        for _ in 0..FRAMES + 10 {
            timings.frame(true, true);
        }
        timings.rate("quasi-static run", 240.0);
        let text = timings.summary();
        assert!(
            text.contains("first picture") && text.contains("240 states"),
            "{text}"
        );
        if thread_time().is_some() {
            assert_eq!(timings.frame_times(false).unwrap().count, 4);
            assert_eq!(timings.frame_times(true).unwrap().count, FRAMES);
            assert!(
                text.contains("while work runs") && text.contains("memory"),
                "{text}"
            );
        }
    }
}
