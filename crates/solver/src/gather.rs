//! Which element corners meet at each node: the tables by which nodes gather their forces.
//!
//! Each element writes the force on each of its corners once; each node then sums its own corners in the order of
//! this table. No two threads write the same number, so a sum never depends on how many there are.

/// Compressed rows: the corner slots of node i are `slots[starts[i]..starts[i + 1]]`.
///
/// The slot of corner c of element e with n corners is e·n + c. Slots rise within a row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Gather {
    starts: Vec<u32>,
    slots: Vec<u32>,
}

impl Gather {
    /// The table for `elements`, each with the nodes at its N corners.
    pub(crate) fn new<'a, const N: usize>(
        node_count: usize,
        elements: impl Iterator<Item = &'a [u32; N]> + Clone,
    ) -> Self {
        let mut starts = vec![0u32; node_count + 1];
        for node in elements.clone().flatten() {
            starts[*node as usize + 1] += 1;
        }
        for i in 0..node_count {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut slots = vec![0u32; starts[node_count] as usize];
        for (slot, node) in elements.flatten().enumerate() {
            let slot_index = &mut next[*node as usize];
            slots[*slot_index as usize] = slot as u32;
            *slot_index += 1;
        }
        Self { starts, slots }
    }

    /// The corner slots of `node`, rising.
    pub(crate) fn slots(&self, node: usize) -> &[u32] {
        &self.slots[self.starts[node] as usize..self.starts[node + 1] as usize]
    }
}
