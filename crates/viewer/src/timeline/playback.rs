//! The current motion time and its playback.

use serde::{Deserialize, Serialize};

/// What happens at the end of a motion during playback.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub(crate) enum Repeat {
    Once,
    /// It starts again from the beginning.
    Loop,
    /// It runs backwards to the beginning.
    #[default]
    BackAndForth,
}

impl Repeat {
    pub(crate) const ALL: [Self; 3] = [Self::Once, Self::Loop, Self::BackAndForth];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Once => "once",
            Self::Loop => "loop",
            Self::BackAndForth => "back and forth",
        }
    }
}

/// The current motion time, and whether and how it advances.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Playback {
    /// The current motion time t.
    pub(crate) time: f64,
    /// The first and the last motion time.
    pub(crate) range: [f64; 2],
    pub(crate) is_playing: bool,
    /// The speed relative to the standard speed.
    pub(crate) speed: f64,
    pub(crate) repeat: Repeat,
    is_backward: bool,
}

impl Default for Playback {
    fn default() -> Self {
        Self {
            time: 0.0,
            range: [0.0, 2.0],
            is_playing: false,
            speed: 1.0,
            repeat: Repeat::default(),
            is_backward: false,
        }
    }
}

impl Playback {
    const STAGE_SECONDS: f64 = 4.0;
    /// The slowest and the fastest speed.
    pub(crate) const SPEEDS: [f64; 2] = [1.0 / 16.0, 16.0];

    /// Advances the motion time by `seconds` of playback.
    pub(crate) fn advance(&mut self, seconds: f64) {
        if !self.is_playing {
            return;
        }
        let [first, last] = self.range;
        let direction = seconds * self.speed / Self::STAGE_SECONDS;
        let length = last - first;
        let time = self.time + if self.is_backward { -direction } else { direction };
        if (first..=last).contains(&time) {
            self.time = time;
            return;
        }
        match self.repeat {
            Repeat::Once => {
                self.time = last;
                self.is_playing = false;
            }
            Repeat::Loop => self.time = first + (time - first).rem_euclid(length.max(1e-9)),
            Repeat::BackAndForth => {
                // Mirrored into the range; after a long pause this may be several lengths away.
                let turned = (time - first).rem_euclid(2.0 * length.max(1e-9));
                self.is_backward = turned > length;
                self.time = first + if self.is_backward { 2.0 * length - turned } else { turned };
            }
        }
        self.time = self.time.clamp(first, last);
    }

    /// Starts or pauses playback; at the end it starts over.
    pub(crate) fn toggle(&mut self) {
        self.is_playing = !self.is_playing;
        let [first, last] = self.range;
        if self.is_playing && self.time >= last {
            self.is_backward = self.repeat == Repeat::BackAndForth;
            if !self.is_backward {
                self.time = first;
            }
        }
        if self.time <= first {
            self.is_backward = false;
        }
    }

    /// Goes to `time` and pauses.
    pub(crate) fn go_to(&mut self, time: f64) {
        self.time = time.clamp(self.range[0], self.range[1]);
        self.is_playing = false;
        self.is_backward = false;
    }

    /// Goes to the next of the rising `times`, or to the previous one.
    pub(crate) fn step(&mut self, times: &[f64], is_forward: bool) {
        const SAME: f64 = 1e-12;
        let next = if is_forward {
            times.iter().find(|&&t| t > self.time + SAME)
        } else {
            times.iter().rev().find(|&&t| t < self.time - SAME)
        };
        if let Some(&time) = next {
            self.go_to(time);
        }
    }

    /// Doubles or halves the speed.
    pub(crate) fn change_speed(&mut self, is_faster: bool) {
        let factor = if is_faster { 2.0 } else { 0.5 };
        self.speed = (self.speed * factor).clamp(Self::SPEEDS[0], Self::SPEEDS[1]);
    }

    /// Sets the range of motion times, when another motion is shown.
    pub(crate) fn set_range(&mut self, range: [f64; 2]) {
        self.range = range;
        self.time = self.time.clamp(range[0], range[1]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn playing(repeat: Repeat) -> Playback {
        Playback { is_playing: true, repeat, ..Playback::default() }
    }

    #[test]
    fn a_stage_takes_four_seconds_and_half_as_long_at_twice_the_speed() {
        let mut playback = playing(Repeat::Once);
        playback.advance(4.0);
        assert_eq!(playback.time, 1.0);
        playback.change_speed(true);
        playback.advance(1.0);
        assert_eq!(playback.time, 1.5);
        playback.advance(9.0);
        assert!(playback.time == 2.0 && !playback.is_playing, "the end stops it");
    }

    #[test]
    fn a_loop_begins_again_and_back_and_forth_turns() {
        let mut playback = playing(Repeat::Loop);
        playback.advance(10.0);
        assert!((playback.time - 0.5).abs() < 1e-12);
        let mut playback = playing(Repeat::BackAndForth);
        playback.advance(10.0);
        assert!((playback.time - 1.5).abs() < 1e-12);
        playback.advance(2.0);
        assert!((playback.time - 1.0).abs() < 1e-12, "it goes backward now");
        playback.advance(6.0);
        assert!((playback.time - 0.5).abs() < 1e-12, "and forward again");
        playback.advance(1e9);
        assert!((0.0..=2.0).contains(&playback.time));
    }

    #[test]
    fn stepping_goes_frame_by_frame_and_stops_at_the_ends() {
        let times = [0.0, 0.5, 1.0, 2.0];
        let mut playback = Playback::default();
        let mut seen = Vec::new();
        for _ in 0..5 {
            playback.step(&times, true);
            seen.push(playback.time);
        }
        assert_eq!(seen, [0.5, 1.0, 2.0, 2.0, 2.0]);
        playback.time = 0.7;
        playback.step(&times, false);
        assert_eq!(playback.time, 0.5);
    }

    #[test]
    fn a_shorter_range_clamps_the_time() {
        let mut playback = Playback::default();
        playback.set_range([1.0, 2.0]);
        assert_eq!(playback.time, 1.0);
        playback.go_to(9.0);
        assert_eq!(playback.time, 2.0);
        playback.repeat = Repeat::Once;
        playback.toggle();
        assert!(playback.time == 1.0 && playback.is_playing, "it starts over");
    }
}
