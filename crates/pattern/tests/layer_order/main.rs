//! Flat states and their orders of layers: known counts, all orders tried one by one, and patterns without an order.
#![expect(clippy::unwrap_used, reason = "a test stops where a value is missing")]

mod bases;
mod counts;
mod given;
mod grids;
mod none;
mod refused;
mod several;
