//! What follows from the orders that are known.

use super::conditions::Conditions;

/// Where an order comes from that follows from no condition.
const GIVEN: u32 = u32::MAX;

/// Orders that are known, with what follows from them.
#[derive(Debug)]
pub(super) struct Propagation<'a> {
    pub(super) conditions: &'a Conditions,
    /// The conditions that speak of each pair, and where those of a pair start.
    uses: Vec<u32>,
    starts: Vec<u32>,
    values: Vec<Option<bool>>,
    /// The condition from which each order follows.
    reasons: Vec<u32>,
    /// The pairs whose order is known, in the order in which it became known.
    trail: Vec<u32>,
    /// How many of them have been followed.
    followed: usize,
    /// How many conditions have been looked at.
    pub(super) steps: u64,
}

impl<'a> Propagation<'a> {
    pub(super) fn new(conditions: &'a Conditions, pairs: usize) -> Self {
        let mut starts = vec![0; pairs + 1];
        let all = || 0..conditions.len() as u32;
        for pair in all().flat_map(|condition| conditions.variables(condition)) {
            starts[pair as usize + 1] += 1;
        }
        for pair in 0..pairs {
            starts[pair + 1] += starts[pair];
        }
        let mut next = starts.clone();
        let mut uses = vec![0; starts[pairs] as usize];
        for condition in all() {
            for pair in conditions.variables(condition) {
                uses[next[pair as usize] as usize] = condition;
                next[pair as usize] += 1;
            }
        }
        Self {
            conditions,
            uses,
            starts,
            values: vec![None; pairs],
            reasons: vec![GIVEN; pairs],
            trail: Vec::with_capacity(pairs),
            followed: 0,
            steps: 0,
        }
    }

    /// Whether the second piece of a pair lies above the first, where this is known.
    pub(super) fn value(&self, pair: u32) -> Option<bool> {
        self.values[pair as usize]
    }

    /// The number of pairs whose order is known.
    pub(super) fn known(&self) -> usize {
        self.trail.len()
    }

    /// The conditions that speak of a pair.
    pub(super) fn uses(&self, pair: u32) -> &[u32] {
        let [start, end] = [pair, pair + 1].map(|k| self.starts[k as usize] as usize);
        &self.uses[start..end]
    }

    /// Takes an order as known. Returns false if the opposite is known.
    pub(super) fn assume(&mut self, pair: u32, value: bool) -> bool {
        self.set(pair, value, GIVEN)
    }

    fn set(&mut self, pair: u32, value: bool, reason: u32) -> bool {
        if let Some(known) = self.values[pair as usize] {
            return known == value;
        }
        self.values[pair as usize] = Some(value);
        self.reasons[pair as usize] = reason;
        self.trail.push(pair);
        true
    }

    /// Finds all that follows.
    ///
    /// # Errors
    /// The condition that cannot be met.
    pub(super) fn follow(&mut self) -> Result<(), u32> {
        while let Some(&pair) = self.trail.get(self.followed) {
            self.followed += 1;
            let [start, end] = [pair, pair + 1].map(|k| self.starts[k as usize] as usize);
            for use_index in start..end {
                self.look_at(self.uses[use_index])?;
            }
        }
        Ok(())
    }

    fn look_at(&mut self, condition: u32) -> Result<(), u32> {
        self.steps += 1;
        let conditions = self.conditions;
        let possible = conditions.possible(condition, |pair| self.value(pair));
        if possible == 0 {
            return Err(condition);
        }
        for (pair, value) in conditions.implied(condition, possible) {
            self.set(pair, value, condition);
        }
        Ok(())
    }

    /// Forgets all orders but the first `known`.
    pub(super) fn forget(&mut self, known: usize) {
        for pair in self.trail.drain(known..) {
            self.values[pair as usize] = None;
            self.reasons[pair as usize] = GIVEN;
        }
        self.followed = known;
    }

    /// The pairs from whose orders it follows that a condition cannot be met, in order.
    pub(super) fn causes(&self, condition: u32) -> Vec<u32> {
        let mut is_cause = vec![false; self.values.len()];
        let mut open: Vec<u32> = vec![condition];
        while let Some(condition) = open.pop() {
            for pair in self.conditions.variables(condition) {
                let is_new = !std::mem::replace(&mut is_cause[pair as usize], true);
                let reason = self.reasons[pair as usize];
                if is_new && reason != GIVEN && self.value(pair).is_some() {
                    open.push(reason);
                }
            }
        }
        (0..).zip(is_cause).filter(|(_, is_cause)| *is_cause).map(|(pair, _)| pair).collect()
    }
}
