//! The search for orders that no condition determines: components one by one, each by guesses that are taken back.

use super::conditions::Conditions;
use super::propagation::Propagation;

/// How far a search may go.
#[derive(Debug, Clone, Copy)]
pub(super) struct SearchLimits {
    /// The most conditions that are looked at.
    pub(super) steps: u64,
    /// The most orders of a component that are counted.
    pub(super) solutions: u64,
}

/// What a search found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Found {
    /// An order of every pair, and how many there are; `None` where they were not all counted.
    Orders { values: Vec<bool>, solutions: Option<u64> },
    /// None is possible: these pairs contradict each other.
    None { pairs: Vec<u32> },
    /// The budget ended first.
    Undecided,
}

/// A search with the number of its components and steps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Search {
    pub(super) found: Found,
    /// The number of sets of pairs that were searched independently of each other.
    pub(super) components: usize,
    pub(super) steps: u64,
}

impl Search {
    /// Searches an order of `pairs` pairs, some of which are given.
    pub(super) fn run(
        conditions: &Conditions,
        pairs: usize,
        given: &[(u32, bool)],
        limits: SearchLimits,
    ) -> Self {
        let mut propagation = Propagation::new(conditions, pairs);
        for &(pair, value) in given {
            if !propagation.assume(pair, value) {
                return Self { found: Found::None { pairs: vec![pair] }, components: 0, steps: 0 };
            }
        }
        if let Err(condition) = propagation.follow() {
            let found = Found::None { pairs: propagation.causes(condition) };
            return Self { found, components: 0, steps: propagation.steps };
        }
        let components = components(&propagation, pairs);
        let mut solutions = Some(1_u64);
        for component in &components {
            let orders = ComponentSearch::run(&mut propagation, component, limits);
            let (steps, count) = (propagation.steps, components.len());
            let end = |found| Self { found, components: count, steps };
            match orders {
                None => return end(Found::Undecided),
                Some(Counted { number: 0, .. }) => {
                    return end(Found::None { pairs: component.clone() });
                }
                Some(Counted { number, is_all }) => {
                    let number = is_all.then_some(number);
                    solutions = solutions.zip(number).and_then(|(n, m)| n.checked_mul(m));
                }
            }
        }
        let values = (0..pairs as u32).map(|pair| propagation.value(pair).unwrap_or(true));
        Self {
            found: Found::Orders { values: values.collect(), solutions },
            components: components.len(),
            steps: propagation.steps,
        }
    }
}

/// The pairs whose order is open, in sets that have no condition in common that is not met whatever they are. Within a
/// set, pairs that a condition relates follow each other.
fn components(propagation: &Propagation<'_>, pairs: usize) -> Vec<Vec<u32>> {
    let mut is_reached: Vec<bool> =
        (0..pairs as u32).map(|pair| propagation.value(pair).is_some()).collect();
    let mut components = Vec::new();
    for start in 0..pairs as u32 {
        if std::mem::replace(&mut is_reached[start as usize], true) {
            continue;
        }
        let mut component = vec![start];
        let mut next = 0;
        while let Some(&pair) = component.get(next) {
            next += 1;
            for &condition in propagation.uses(pair) {
                for other in open_pairs(propagation, condition) {
                    if !std::mem::replace(&mut is_reached[other as usize], true) {
                        component.push(other);
                    }
                }
            }
        }
        components.push(component);
    }
    components
}

/// The open pairs of a condition, unless it is met whatever their orders are.
fn open_pairs(propagation: &Propagation<'_>, condition: u32) -> Vec<u32> {
    let conditions = propagation.conditions;
    let pairs = conditions.variables(condition);
    let open: Vec<u32> = pairs.filter(|&pair| propagation.value(pair).is_none()).collect();
    let possible = conditions.possible(condition, |pair| propagation.value(pair));
    if Conditions::is_met(possible, open.len()) { Vec::new() } else { open }
}

/// How many orders of a component were found, and whether these are all.
struct Counted {
    number: u64,
    is_all: bool,
}

/// A guess that may be taken back.
struct Guess {
    pair: u32,
    /// How many orders were known before it.
    known: usize,
    /// All pairs of the component before this index were known.
    cursor: usize,
}

struct ComponentSearch<'a, 'b> {
    propagation: &'a mut Propagation<'b>,
    component: &'a [u32],
    guesses: Vec<Guess>,
    cursor: usize,
}

impl<'a, 'b> ComponentSearch<'a, 'b> {
    /// Leaves the first order found as known; `None` if the budget ended before one was found.
    fn run(
        propagation: &'a mut Propagation<'b>,
        component: &'a [u32],
        limits: SearchLimits,
    ) -> Option<Counted> {
        let start = propagation.known();
        let mut search = Self { propagation, component, guesses: Vec::new(), cursor: 0 };
        let mut first: Option<Vec<bool>> = None;
        let mut number = 0;
        let mut is_all = false;
        while search.propagation.steps < limits.steps && number < limits.solutions {
            let goes_on = if search.guess() {
                true
            } else {
                number += 1;
                first.get_or_insert_with(|| search.values());
                search.take_back()
            };
            if !goes_on || search.propagation.follow().is_err() && !search.take_back() {
                is_all = true;
                break;
            }
        }
        search.propagation.forget(start);
        let Some(first) = first else {
            return is_all.then_some(Counted { number: 0, is_all });
        };
        for (&pair, value) in component.iter().zip(first) {
            search.propagation.assume(pair, value);
        }
        // It was followed when it was found: nothing can contradict it.
        let _ = search.propagation.follow();
        Some(Counted { number, is_all })
    }

    fn values(&self) -> Vec<bool> {
        self.component.iter().map(|&pair| self.propagation.value(pair) == Some(true)).collect()
    }

    /// Guesses the order of the next open pair; returns false if none is open.
    fn guess(&mut self) -> bool {
        let open = |pair: &u32| self.propagation.value(*pair).is_none();
        let Some(ahead) = self.component[self.cursor..].iter().position(open) else {
            return false;
        };
        self.cursor += ahead;
        let pair = self.component[self.cursor];
        let known = self.propagation.known();
        self.guesses.push(Guess { pair, known, cursor: self.cursor });
        self.propagation.assume(pair, true)
    }

    /// Replaces the last guess by its opposite, and if that contradicts the rest, the one before it, and so on; returns
    /// false if none is left.
    fn take_back(&mut self) -> bool {
        while let Some(Guess { pair, known, cursor }) = self.guesses.pop() {
            self.propagation.forget(known);
            self.cursor = cursor;
            if self.propagation.assume(pair, false) && self.propagation.follow().is_ok() {
                return true;
            }
        }
        false
    }
}
