//! Measurements of the window: time to the first picture, processor time per frame, states per second, memory.

use std::fmt::Write as _;
use std::time::{Duration, Instant};

/// The number of frames whose times are kept.
const FRAMES: usize = 4096;

/// What the window is doing in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Activity {
    /// Only what the user does.
    Idle,
    /// A motion plays.
    Playing,
    /// A job runs in the background.
    Busy,
}

impl Activity {
    const ALL: [Self; 3] = [Self::Idle, Self::Playing, Self::Busy];

    fn name(self) -> &'static str {
        match self {
            Self::Idle => "idle",
            Self::Playing => "while a motion plays",
            Self::Busy => "during background jobs",
        }
    }
}

/// Measurements since the start of the window.
#[derive(Debug)]
pub(crate) struct Timings {
    started: Instant,
    first_picture: Option<Duration>,
    /// When the last frame began, its activity, and the processor time of this thread at that moment.
    last: Option<(Instant, Activity, Option<Duration>)>,
    /// For each activity, the processor time of the last frames and the time until the next frame.
    frames: [Vec<[Duration; 2]>; 3],
    count: [usize; 3],
    /// The best number of states per second of every run and interaction.
    rates: Vec<(&'static str, f64)>,
}

/// Durations of frames, in milliseconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FrameTimes {
    pub(crate) count: usize,
    pub(crate) mean_ms: f64,
    /// 95 % of the frames took no longer.
    pub(crate) most_ms: f64,
    /// The mean time between frames.
    pub(crate) spacing_ms: f64,
}

impl Timings {
    pub(crate) fn new(started: Instant) -> Self {
        Self {
            started,
            first_picture: None,
            last: None,
            frames: [Vec::new(), Vec::new(), Vec::new()],
            count: [0; 3],
            rates: Vec::new(),
        }
    }

    /// Records that a frame begins. The time since the last call belongs to the previous frame.
    pub(crate) fn frame(&mut self, activity: Activity, has_picture: bool) {
        if has_picture && self.first_picture.is_none() {
            self.first_picture = Some(self.started.elapsed());
        }
        let now = (Instant::now(), activity, thread_time());
        if let Some((began, of, spent_before)) = self.last.replace(now)
            && let (Some(before), Some(after)) = (spent_before, now.2)
        {
            let (frames, count) = (&mut self.frames[of as usize], &mut self.count[of as usize]);
            let times = [after.saturating_sub(before), now.0 - began];
            if frames.len() < FRAMES {
                frames.push(times);
            } else {
                frames[*count % FRAMES] = times;
            }
            *count += 1;
        }
    }

    /// Records the best number of states per second of a run or an interaction.
    pub(crate) fn rate(&mut self, what: &'static str, states_a_second: f64) {
        self.rates.push((what, states_a_second));
    }

    /// Statistics of the last frames with an activity.
    pub(crate) fn frame_times(&self, activity: Activity) -> Option<FrameTimes> {
        let frames = &self.frames[activity as usize];
        let count = frames.len();
        let mut times: Vec<Duration> = frames.iter().map(|times| times[0]).collect();
        times.sort_unstable();
        let most = times.get((count * 95 / 100).min(count.checked_sub(1)?))?;
        let ms = |d: Duration| d.as_secs_f64() * 1e3;
        let mean = |k: usize| frames.iter().map(|times| ms(times[k])).sum::<f64>() / count as f64;
        Some(FrameTimes { count, mean_ms: mean(0), most_ms: ms(*most), spacing_ms: mean(1) })
    }

    /// All measurements as text, one per line.
    pub(crate) fn summary(&self) -> String {
        let mut text = String::new();
        // Writing into a string cannot fail.
        if let Some(first) = self.first_picture {
            let _ = writeln!(text, "first picture after {:.2} s", first.as_secs_f64());
        }
        for activity in Activity::ALL {
            let Some(times) = self.frame_times(activity) else {
                continue;
            };
            let _ = write!(
                text,
                "window thread, {}: {:.2} ms per frame, 95 % within {:.2} ms, {} frames",
                activity.name(),
                times.mean_ms,
                times.most_ms,
                times.count
            );
            let _ = match activity {
                Activity::Idle => writeln!(text),
                _ => writeln!(text, ", one every {:.1} ms", times.spacing_ms),
            };
        }
        for (what, rate) in &self.rates {
            let _ = writeln!(text, "{what}: {rate:.0} states in its best second");
        }
        if let Some([now, most]) = memory() {
            let _ = writeln!(text, "memory {now:.0} MB, at most {most:.0} MB");
        }
        text
    }
}

/// Processor time of the calling thread, if the system provides it.
fn thread_time() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds = text.split_whitespace().next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}

/// Memory in use now and at most, megabytes, if the system provides them.
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
    fn frames_are_counted_by_activity_and_the_summary_names_them() {
        let mut timings = Timings::new(Instant::now());
        assert!(timings.frame_times(Activity::Idle).is_none());
        for _ in 0..5 {
            timings.frame(Activity::Idle, true);
        }
        for _ in 0..FRAMES + 10 {
            timings.frame(Activity::Busy, true);
        }
        timings.rate("run", 240.0);
        let text = timings.summary();
        assert!(text.contains("first picture") && text.contains("240 states"), "{text}");
        if thread_time().is_some() {
            let count = |activity| timings.frame_times(activity).map(|times| times.count);
            assert_eq!(Activity::ALL.map(count), [Some(5), None, Some(FRAMES)]);
            assert!(text.contains("during background jobs") && text.contains("memory"), "{text}");
        }
    }
}
