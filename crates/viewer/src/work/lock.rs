//! Locks that a panic does not take away.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// The guard of `mutex`. What is behind the locks of workers is whole after every statement, so a panic elsewhere leaves
/// nothing to protect.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
