//! What can go wrong, with its evidence.

/// Why a model, a schedule or a run was refused or ended early.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolverError {
    /// A material constant is not finite or out of range.
    #[error("{name} is {value}; it must lie between {minimum} and {maximum}")]
    MaterialOutOfRange {
        /// The key of the constant.
        name: &'static str,
        /// The value that was given.
        value: f64,
        /// The smallest value taken.
        minimum: f64,
        /// The largest value taken.
        maximum: f64,
    },
    /// The sheet's unit length is not a positive number.
    #[error("the unit length of the sheet is {value}; it must be finite and above 0")]
    UnitLength {
        /// Its value, in the unit of the sheet.
        value: f64,
    },
    /// The sheet has no triangles.
    #[error("the sheet has no facets; at least one is needed")]
    NoFacets,
    /// A bar has no usable length in the crease pattern.
    #[error(
        "edge {edge} (vertices {vertices:?}) is {length} unit lengths long; it must be finite and at least {minimum}"
    )]
    DegenerateEdge {
        /// The index of the edge in the sheet.
        edge: usize,
        /// The vertices at its ends.
        vertices: [u32; 2],
        /// Its length over the unit length.
        length: f64,
        /// The smallest length taken.
        minimum: f64,
    },
    /// A triangle has no usable height in the crease pattern.
    #[error(
        "triangle {face} (vertices {vertices:?}) is {height} unit lengths high; it must be at least {minimum}"
    )]
    DegenerateFace {
        /// The triangle of the sheet.
        face: usize,
        /// The vertices at its corners.
        vertices: [u32; 3],
        /// Its smallest height over the unit length.
        height: f64,
        /// The smallest height taken.
        minimum: f64,
    },
    /// A list does not have one entry for each element.
    #[error("{found} {what} were given; {expected} are needed")]
    Count {
        /// The elements that were counted.
        what: &'static str,
        /// The number that the model needs.
        expected: usize,
        /// The number that was given.
        found: usize,
    },
    /// A number of the input is NaN or infinite.
    #[error("{what} {index} is not finite; every one must be a finite number")]
    NotFinite {
        /// The kind of value that is not finite.
        what: &'static str,
        /// The index of the element.
        index: usize,
    },
    /// A target fold angle lies beyond what a hinge can turn.
    #[error("{what} {index} is {value} rad; it must lie within ±{limit} rad")]
    AngleOutOfRange {
        /// The kind of angle that is out of range.
        what: &'static str,
        /// The index of the element.
        index: usize,
        /// The value that was given, radians.
        value: f64,
        /// The largest magnitude taken.
        limit: f64,
    },
    /// A step of the schedule begins or ends outside its stage.
    #[error("step {step} of the schedule: {name} is {value}; it must lie between 0 and 1")]
    StepTime {
        /// The index of the step in the schedule.
        step: usize,
        /// Which of its two times.
        name: &'static str,
        /// Its value, in stage-local time.
        value: f64,
    },
    /// A step of the schedule ends before it begins, or too soon after.
    #[error(
        "step {step} of the schedule goes from {from} to {to}; it must end at least {minimum} after it begins"
    )]
    StepDuration {
        /// The index of the step in the schedule.
        step: usize,
        /// The stage-local time at which it begins.
        from: f64,
        /// The stage-local time at which it ends.
        to: f64,
        /// The shortest duration taken.
        minimum: f64,
    },
    /// A step of the schedule names rows or columns that the sheet does not have.
    #[error(
        "step {step} of the schedule names {what} {first} to {last}; the first must not lie after the last, and the \
         sheet has {count} {what}, counted from 0"
    )]
    StepRange {
        /// The index of the step in the schedule.
        step: usize,
        /// Whether rows or columns are out of range.
        what: &'static str,
        /// The first one named.
        first: u32,
        /// The last one named.
        last: u32,
        /// The number of them in the sheet.
        count: u32,
    },
    /// A step of the schedule names no crease.
    #[error(
        "step {step} of the schedule names no crease; its kind of crease must occur in its rows and columns"
    )]
    StepNamesNone {
        /// The index of the step in the schedule.
        step: usize,
    },
    /// Two steps of the schedule name the same crease in the same stage.
    #[error(
        "steps {} and {} of the schedule overlap: both move edge {edge} in stage {stage}; a crease may be named once a \
         stage",
        steps[0],
        steps[1]
    )]
    StepsOverlap {
        /// The two steps, the earlier one first.
        steps: [usize; 2],
        /// The name of the stage.
        stage: &'static str,
        /// The edge of the sheet that both name.
        edge: usize,
    },
    /// The knots of an unfold path are out of order.
    #[error(
        "knot {knot} of the unfold path has progress {value}; it must ascend strictly from 0 at the first knot to 1 at the last"
    )]
    PathProgress {
        /// The knot, from 0.
        knot: usize,
        /// The progress of the knot.
        value: f64,
    },
    /// An unfold path does not lead from the deployed angle of a crease to 0.
    #[error(
        "the unfold path leads edge {edge} from {} to {}; it must start at its deployed angle {deployed} and end at 0 (radians)",
        ends[0],
        ends[1]
    )]
    PathEnds {
        /// The index of the edge in the sheet.
        edge: usize,
        /// The angles at the ends of the path, radians.
        ends: [f64; 2],
        /// The deployed angle, radians.
        deployed: f64,
    },
    /// The number of frames cannot be recorded.
    #[error("{frames} frames were requested; an even number from 2 to {maximum} is needed")]
    Frames {
        /// The number of frames that was requested.
        frames: usize,
        /// The largest number taken.
        maximum: usize,
    },
    /// An option of the engine is out of range.
    #[error("{name} is {value}; it must be finite and above 0")]
    Option {
        /// The name of the option.
        name: &'static str,
        /// The value that was given.
        value: f64,
    },
    /// The stiffness matrix is too large to factorise.
    #[error("the stiffness matrix of {nodes} nodes cannot be factorised: {reason}")]
    Factorisation {
        /// The number of nodes.
        nodes: usize,
        /// The reason why it failed.
        reason: &'static str,
    },
    /// The gap between layers cannot be kept.
    #[error(
        "the gap is {gap} unit lengths; it must be above 0 and at most {maximum}, a quarter of the smallest height of a \
         triangle of the sheet"
    )]
    GapTooLarge {
        /// The gap that was requested.
        gap: f64,
        /// The largest the sheet can close to.
        maximum: f64,
    },
    /// A final gap that is no distance, or larger than the gap it closes from.
    #[error(
        "the final gap is {final_gap} unit lengths; it must be above 0 and at most the gap of {gap}"
    )]
    FinalGap {
        /// The final gap that was requested.
        final_gap: f64,
        /// The gap.
        gap: f64,
    },
    /// The start state crosses itself, so that contact cannot keep its layers apart.
    #[error(
        "triangles {} and {} cross each other in the start state; contact needs a start free of crossings, or must be \
         switched off",
        faces[0],
        faces[1]
    )]
    StartCrosses {
        /// Two triangles of the sheet that cross.
        faces: [u32; 2],
    },
    /// The motion grew without bound.
    #[error(
        "the motion diverged at node {node}, t = {time}: one step moved it by {displacement} unit lengths; \
         lower the stiffness or raise the damping ratio"
    )]
    Diverged {
        /// The node that moved furthest in one step.
        node: usize,
        /// Motion time.
        time: f64,
        /// Its displacement in that step over the unit length; NaN if it is not a number.
        displacement: f64,
    },
    /// There is no GPU that can be used.
    #[error(
        "no GPU can be used: {reason}; install a Vulkan driver (Mesa has one in software, in Debian's package \
         mesa-vulkan-drivers), or run on the CPU"
    )]
    NoGpu {
        /// The message of the adapters or the driver.
        reason: String,
    },
    /// The sheet does not fit the GPU.
    #[error(
        "{what} of the sheet take {bytes} bytes on the GPU, which allows {limit} in one buffer; run on the CPU"
    )]
    GpuTooSmall {
        /// The records that do not fit.
        what: &'static str,
        /// The size of the records, bytes.
        bytes: u64,
        /// The size of the largest buffer, bytes.
        limit: u64,
    },
    /// The GPU gave up.
    #[error("the GPU {gpu} stopped: {reason}; run on the CPU")]
    GpuLost {
        /// The name of the GPU.
        gpu: String,
        /// The message of the driver.
        reason: String,
    },
    /// The caller asked to stop.
    #[error("the run was cancelled at t = {time}")]
    Cancelled {
        /// Motion time.
        time: f64,
    },
}
