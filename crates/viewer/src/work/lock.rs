//! Locking mutexes that a panic does not make unusable.

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks `mutex`. The data behind the locks of workers is consistent after every statement, so a poisoned lock can be
/// used.
pub(super) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
