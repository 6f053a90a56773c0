//! Work in the background: drafts, runs, sheets held in the hand.
