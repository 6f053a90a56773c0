//! Numbers in lanes: the arithmetic of the passes, for as many elements at a time as the machine's vectors hold.
//!
//! Every operation acts on each lane alone and rounds as IEEE 754 says, so an element's result does not depend on its
//! lane. Products are fused with sums where the machine can; so results depend on the instruction set, and on nothing
//! else. Everything is inlined into the pass that [`pulp::Arch`] dispatches, which is what compiles it for that set.

use std::ops::{Add, Mul, Sub};

use pulp::{Arch, Simd, WithSimd};

/// Elements in a group of records: a multiple of the lanes of every instruction set.
pub(super) const WIDTH: usize = 8;

/// f64 numbers, one for each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    value: S::f64s,
}

impl<S: Simd> Lanes<S> {
    /// Groups are worked on in this many parts.
    pub(super) const PARTS: usize = WIDTH / S::F64_LANES;

    #[inline(always)]
    pub(super) fn splat(simd: S, value: f64) -> Self {
        Self { simd, value: simd.splat_f64s(value) }
    }

    /// A part of a group of numbers.
    #[inline(always)]
    pub(super) fn load(simd: S, group: &[f64; WIDTH], part: usize) -> Self {
        let (parts, _) = S::as_simd_f64s(group);
        Self { simd, value: parts[part] }
    }

    #[inline(always)]
    pub(super) fn store(self, group: &mut [f64; WIDTH], part: usize) {
        let (parts, _) = S::as_mut_simd_f64s(group);
        parts[part] = self.value;
    }

    /// The numbers one by one; those past the last lane are 0.
    #[inline(always)]
    pub(super) fn to_array(self) -> [f64; WIDTH] {
        let mut array = [0.0; WIDTH];
        self.store(&mut array, 0);
        array
    }

    /// self × factor + term.
    #[inline(always)]
    pub(super) fn mul_add(self, factor: Self, term: Self) -> Self {
        self.with(self.simd.mul_add_e_f64s(self.value, factor.value, term.value))
    }

    #[inline(always)]
    pub(super) fn over(self, divisor: Self) -> Self {
        self.with(self.simd.div_f64s(self.value, divisor.value))
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        self.with(self.simd.sqrt_f64s(self.value))
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.with(self.simd.abs_f64s(self.value))
    }

    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        self.with(self.simd.max_f64s(self.value, other.value))
    }

    #[inline(always)]
    pub(super) fn constant(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    /// `yes` in the lanes where self < `limit`, `no` in the others.
    #[inline(always)]
    pub(super) fn select_below(self, limit: Self, yes: Self, no: Self) -> Self {
        let mask = self.simd.less_than_f64s(self.value, limit.value);
        self.with(self.simd.select_f64s(mask, yes.value, no.value))
    }

    /// −self in the lanes where `sign` is below 0 or −0, self in the others.
    #[inline(always)]
    pub(super) fn times_sign_of(self, sign: Self) -> Self {
        let simd = self.simd;
        let bit = simd.and_f64s(simd.splat_f64s(-0.0), sign.value);
        self.with(simd.xor_f64s(self.value, bit))
    }

    /// The nearest whole number, ties to even.
    ///
    /// Precondition: |self| < 2⁵¹.
    #[inline(always)]
    pub(super) fn round(self) -> Self {
        // Adding 3·2⁵¹ leaves no bits for the fraction.
        let shift = self.constant(6_755_399_441_055_744.0);
        (self + shift) - shift
    }

    #[inline(always)]
    fn with(self, value: S::f64s) -> Self {
        Self { simd: self.simd, value }
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.simd.add_f64s(self.value, other.value))
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.simd.sub_f64s(self.value, other.value))
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(self.simd.mul_f64s(self.value, other.value))
    }
}

/// Vectors in space, one for each lane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Vectors<S: Simd> {
    pub(super) x: Lanes<S>,
    pub(super) y: Lanes<S>,
    pub(super) z: Lanes<S>,
}

/// A vector as the passes keep it; the last number is 0.
pub(super) type Quad = [f64; 4];

impl<S: Simd> Vectors<S> {
    /// The vectors of `points` that `indices` names, one for each lane.
    #[inline(always)]
    pub(super) fn gather(simd: S, points: &[Quad], indices: &[u16]) -> Self {
        let elements = elements(simd);
        let mut quads = [[0.0; 4]; WIDTH];
        for place in 0..S::F64_LANES {
            quads[place] = points[indices[elements[place]] as usize];
        }
        Self::of_rows(simd, rows::<S>(&quads))
    }

    /// The vectors of a part of a group of quads, in any order.
    #[inline(always)]
    pub(super) fn load(simd: S, group: &[Quad; WIDTH], part: usize) -> Self {
        let (rows, _) = S::as_simd_f64s(group.as_flattened());
        let rows = &rows[4 * part..4 * part + 4];
        Self::of_rows(simd, [rows[0], rows[1], rows[2], rows[3]])
    }

    #[inline(always)]
    fn of_rows(simd: S, rows: [S::f64s; 4]) -> Self {
        let [x, y, z, _] = simd.deinterleave_shfl_f64s(rows);
        let lanes = Lanes { simd, value: x };
        Self { x: lanes, y: lanes.with(y), z: lanes.with(z) }
    }

    /// Writes the vectors of a part into a group of quads.
    #[inline(always)]
    pub(super) fn store(self, group: &mut [Quad; WIDTH], part: usize) {
        let simd = self.x.simd;
        let zero = simd.splat_f64s(0.0);
        let elements = elements(simd);
        let mut quads = [[0.0; 4]; WIDTH];
        let (rows, _) = S::as_mut_simd_f64s(quads.as_flattened_mut());
        rows[..4].copy_from_slice(&simd.interleave_shfl_f64s([
            self.x.value,
            self.y.value,
            self.z.value,
            zero,
        ]));
        for place in 0..S::F64_LANES {
            group[part * S::F64_LANES + elements[place]] = quads[place];
        }
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Lanes<S> {
        let sum = self.x.mul_add(other.x, self.y * other.y);
        self.z.mul_add(other.z, sum)
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub(super) fn scaled(self, factor: Lanes<S>) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }

    /// self × factor + term.
    #[inline(always)]
    pub(super) fn mul_add(self, factor: Lanes<S>, term: Self) -> Self {
        Self {
            x: self.x.mul_add(factor, term.x),
            y: self.y.mul_add(factor, term.y),
            z: self.z.mul_add(factor, term.z),
        }
    }
}

impl<S: Simd> Sub for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// Quads as the vectors that hold them.
#[inline(always)]
fn rows<S: Simd>(quads: &[Quad; WIDTH]) -> [S::f64s; 4] {
    let (rows, _) = S::as_simd_f64s(quads.as_flattened());
    [rows[0], rows[1], rows[2], rows[3]]
}

/// The element whose quad stands at each place of a part, since taking quads apart may exchange lanes.
#[expect(clippy::cast_sign_loss, reason = "places count from 0")]
#[inline(always)]
fn elements<S: Simd>(simd: S) -> [usize; WIDTH] {
    let mut quads = [[0.0; 4]; WIDTH];
    for (place, quad) in quads.iter_mut().enumerate() {
        *quad = [place as f64; 4];
    }
    let [x, ..] = simd.deinterleave_shfl_f64s(rows::<S>(&quads));
    let places = Lanes { simd, value: x }.to_array();
    let mut elements = [0; WIDTH];
    for lane in 0..S::F64_LANES {
        elements[places[lane] as usize] = lane;
    }
    elements
}

/// The processor and the vectors of this machine that the passes use.
pub fn instruction_set() -> String {
    struct LaneCount;
    impl WithSimd for LaneCount {
        type Output = usize;

        fn with_simd<S: Simd>(self, _simd: S) -> usize {
            S::F64_LANES
        }
    }
    let lanes = Arch::new().dispatch(LaneCount);
    format!("{}, {lanes} f64 a vector", std::env::consts::ARCH)
}
