//! A worker that only answers the latest question.

use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use super::lock::lock;
use super::threads::{caught, part_from, start};
use super::{Wake, WorkError};

/// Answers questions `Q` with an `A`; one that comes while it works on another takes the place of those before it.
#[derive(Debug)]
pub(super) struct Latest<Q, A> {
    shared: Arc<Shared<Q, A>>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct Shared<Q, A> {
    slots: Mutex<Slots<Q, A>>,
    asked: Condvar,
    wake: Wake,
}

#[derive(Debug)]
struct Slots<Q, A> {
    question: Option<(u64, Q)>,
    answer: Option<(u64, Result<A, WorkError>)>,
    is_at_work: bool,
    is_over: bool,
}

impl<Q: Send + 'static, A: Send + 'static> Latest<Q, A> {
    /// Answers with `work`, once no newer question has come for `rest`.
    pub(super) fn new(
        name: &str,
        rest: Duration,
        wake: Wake,
        work: impl Fn(Q) -> Result<A, WorkError> + Send + 'static,
    ) -> Self {
        let shared = Arc::new(Shared {
            slots: Mutex::new(Slots {
                question: None,
                answer: None,
                is_at_work: false,
                is_over: false,
            }),
            asked: Condvar::new(),
            wake,
        });
        let held = Arc::clone(&shared);
        let thread = start(name, move || {
            while let Some((serial, question)) = held.next(rest) {
                let answer = caught(|| work(question));
                held.give(serial, answer);
            }
        });
        match thread {
            Ok(thread) => Self {
                shared,
                thread: Some(thread),
            },
            Err(error) => {
                shared.give(0, Err(error));
                Self {
                    shared,
                    thread: None,
                }
            }
        }
    }

    /// Asks, in the place of every question not yet begun.
    pub(super) fn ask(&self, serial: u64, question: Q) {
        lock(&self.shared.slots).question = Some((serial, question));
        self.shared.asked.notify_one();
    }

    /// The last answer with the serial of its question; none if that was taken before.
    pub(super) fn take(&self) -> Option<(u64, Result<A, WorkError>)> {
        lock(&self.shared.slots).answer.take()
    }

    /// Whether an answer is still to come.
    pub(super) fn is_busy(&self) -> bool {
        let slots = lock(&self.shared.slots);
        slots.is_at_work || slots.question.is_some()
    }
}

impl<Q, A> Shared<Q, A> {
    /// Waits for a question that rests; none when it is over.
    fn next(&self, rest: Duration) -> Option<(u64, Q)> {
        let mut slots = lock(&self.slots);
        loop {
            if slots.is_over {
                return None;
            }
            let Some((serial, _)) = &slots.question else {
                let waited = self.asked.wait(slots);
                slots = waited.unwrap_or_else(PoisonError::into_inner);
                continue;
            };
            let serial = *serial;
            if !rest.is_zero() {
                let waited = self.asked.wait_timeout(slots, rest);
                let (woken, timeout) = waited.unwrap_or_else(PoisonError::into_inner);
                slots = woken;
                if !timeout.timed_out() {
                    continue;
                }
            }
            if slots.question.as_ref().is_some_and(|(s, _)| *s == serial) && !slots.is_over {
                slots.is_at_work = true;
                return slots.question.take();
            }
        }
    }

    fn give(&self, serial: u64, answer: Result<A, WorkError>) {
        let mut slots = lock(&self.slots);
        slots.is_at_work = false;
        slots.answer = Some((serial, answer));
        drop(slots);
        self.wake.now();
    }
}

impl<Q, A> Drop for Latest<Q, A> {
    fn drop(&mut self) {
        lock(&self.shared.slots).is_over = true;
        self.shared.asked.notify_one();
        part_from(self.thread.take());
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::super::job::tests::wait;
    use super::*;

    #[test]
    fn questions_that_come_meanwhile_are_answered_by_the_last_of_them() {
        let (go, may) = channel::<()>();
        let (heard, hears) = channel::<u32>();
        let latest = Latest::new("latest", Duration::ZERO, Wake::new(|| {}), move |q: u32| {
            heard.send(q).unwrap();
            may.recv().unwrap();
            Ok(q * 2)
        });
        latest.ask(1, 10);
        assert_eq!(hears.recv(), Ok(10));
        (2..=9).for_each(|serial| latest.ask(serial, 10 * serial as u32));
        assert!(latest.is_busy());
        go.send(()).unwrap();
        assert_eq!(hears.recv(), Ok(90));
        go.send(()).unwrap();
        wait(|| !latest.is_busy());
        assert!(matches!(latest.take(), Some((9, Ok(180)))));
        assert!(latest.take().is_none());
    }

    #[test]
    fn a_panic_is_an_answer_and_the_next_question_is_answered() {
        let latest = Latest::new(
            "latest",
            Duration::from_millis(1),
            Wake::new(|| {}),
            |q: u32| {
                assert!(q != 1, "one is too few");
                Ok(q)
            },
        );
        latest.ask(1, 1);
        wait(|| !latest.is_busy());
        let (_, answer) = latest.take().unwrap();
        assert!(answer.unwrap_err().to_string().contains("one is too few"));
        latest.ask(2, 2);
        wait(|| !latest.is_busy());
        assert!(matches!(latest.take(), Some((2, Ok(2)))));
    }
}
