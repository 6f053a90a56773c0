//! Chains straightened without a crossing, uniformly and by energy.

#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod chains;
mod energy;
mod uniform;
