//! The timeline: stages, scrubbing, playing, and curves on the same axis.
