//! The scene at hand: its text, its edits and their history, its file.
