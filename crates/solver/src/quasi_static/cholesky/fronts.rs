//! The symbolic analysis: in which order nodes are eliminated, and which of them together.
//!
//! Nodes are ordered by approximate minimum degree (Amestoy, Davis, Duff 1996). Neighbours of the elimination tree
//! (Liu 1990, "The role of elimination trees in sparse factorization") are then merged into fronts wherever a few zeros
//! that are computed with cost less than a front of its own.

/// The most nodes eliminated in one front: wider ones are cut, so that kernels need no blocking of their own.
const WIDEST: usize = 24;
/// The cost of a front itself, of each of its columns, and of each entry that it passes to its parent, in
/// multiply-adds.
const PER_FRONT: f64 = 2_000.0;
const PER_COLUMN: f64 = 100.0;
const PER_ENTRY: f64 = 6.0;
/// No parent.
const ROOT: u32 = u32::MAX;

/// The nodes eliminated together, in the order of elimination: every front after those below it in the tree, the
/// fronts below one directly before it.
pub(super) struct Fronts {
    /// The rank of each node: its position in the order of elimination.
    pub(super) ranks: Vec<u32>,
    /// Front f eliminates the ranks `first[f]..first[f + 1]`.
    pub(super) first: Vec<u32>,
    /// The later ranks it is coupled to are `rows[starts[f]..starts[f + 1]]`, rising.
    pub(super) starts: Vec<u32>,
    pub(super) rows: Vec<u32>,
    /// The front that takes up what f leaves.
    pub(super) parents: Vec<Option<u32>>,
}

/// Nodes merged so far.
struct Group {
    nodes: Vec<u32>,
    /// The number of rows below.
    rows: usize,
    children: Vec<u32>,
}

impl Fronts {
    /// The fronts of the matrix whose node columns j have the rows `blocks[starts[j]..starts[j + 1]]`, j itself and
    /// greater ones.
    pub(super) fn new(nodes: usize, starts: &[u32], blocks: &[u32]) -> Result<Self, &'static str> {
        let order = minimum_degree(nodes, starts, blocks)?;
        let neighbours = permuted_neighbours(&order, starts, blocks);
        let parents = elimination_tree(&neighbours);
        let columns = fill(&neighbours, &parents);
        let groups = merge(&parents, &columns);
        Ok(Self::numbered(&order, &columns, &groups))
    }

    pub(super) fn count(&self) -> usize {
        self.parents.len()
    }

    /// The ranks coupled to front `f`.
    pub(super) fn rows(&self, f: usize) -> &[u32] {
        &self.rows[self.starts[f] as usize..self.starts[f + 1] as usize]
    }

    /// The number of nodes front `f` eliminates.
    pub(super) fn width(&self, f: usize) -> usize {
        (self.first[f + 1] - self.first[f]) as usize
    }

    /// Numbers the groups in postorder.
    fn numbered(order: &[u32], columns: &[Vec<u32>], groups: &[Option<Group>]) -> Self {
        let nodes = order.len();
        // Of each node in the first order: its rank in the final one.
        let mut ranks = vec![0u32; nodes];
        let (mut first, mut front_of) = (vec![0u32], vec![0u32; nodes]);
        let mut last_nodes: Vec<u32> = Vec::new();
        for group in postorder(groups) {
            let front = last_nodes.len() as u32;
            let mut rank = first[first.len() - 1];
            for &node in &group.nodes {
                ranks[node as usize] = rank;
                front_of[node as usize] = front;
                rank += 1;
            }
            first.push(rank);
            last_nodes.extend(group.nodes.last());
        }
        let (mut starts, mut rows) = (vec![0u32], Vec::new());
        let mut parents = Vec::with_capacity(last_nodes.len());
        for &last in &last_nodes {
            let below = &columns[last as usize];
            parents.push(below.first().map(|&node| front_of[node as usize]));
            let begin = rows.len();
            rows.extend(below.iter().map(|&node| ranks[node as usize]));
            rows[begin..].sort_unstable();
            starts.push(rows.len() as u32);
        }
        let mut of_nodes = vec![0u32; nodes];
        for (rank, &node) in order.iter().enumerate() {
            of_nodes[node as usize] = ranks[rank];
        }
        Self { ranks: of_nodes, first, starts, rows, parents }
    }
}

/// The nodes in the order of approximate minimum degree.
fn minimum_degree(nodes: usize, starts: &[u32], blocks: &[u32]) -> Result<Vec<u32>, &'static str> {
    let nodes = u32::try_from(nodes).map_err(|_error| "more nodes than 32-bit indices hold")?;
    let (order, _, _) = amd::order(nodes, starts, blocks, &amd::Control::default())
        .map_err(|_status| "the pattern of the matrix is invalid")?;
    Ok(order)
}

/// The neighbours of every rank.
fn permuted_neighbours(order: &[u32], starts: &[u32], blocks: &[u32]) -> Vec<Vec<u32>> {
    let mut rank_of = vec![0u32; order.len()];
    for (rank, &node) in order.iter().enumerate() {
        rank_of[node as usize] = rank as u32;
    }
    let mut neighbours = vec![Vec::new(); order.len()];
    for (column, ends) in starts.windows(2).enumerate() {
        for &row in &blocks[ends[0] as usize..ends[1] as usize] {
            let (a, b) = (rank_of[column], rank_of[row as usize]);
            if a != b {
                neighbours[a as usize].push(b);
                neighbours[b as usize].push(a);
            }
        }
    }
    neighbours
}

/// The parent of each node in the elimination tree, by Liu's algorithm with path compression.
fn elimination_tree(neighbours: &[Vec<u32>]) -> Vec<u32> {
    let mut parents = vec![ROOT; neighbours.len()];
    let mut ancestors = vec![ROOT; neighbours.len()];
    for (j, around) in neighbours.iter().enumerate() {
        let j = j as u32;
        for &i in around.iter().filter(|&&i| i < j) {
            let mut at = i;
            loop {
                let next = std::mem::replace(&mut ancestors[at as usize], j);
                if next == ROOT {
                    parents[at as usize] = j;
                }
                if next == ROOT || next == j {
                    break;
                }
                at = next;
            }
        }
    }
    parents
}

/// The rows below the diagonal of every column of the factor, rising.
fn fill(neighbours: &[Vec<u32>], parents: &[u32]) -> Vec<Vec<u32>> {
    let nodes = neighbours.len();
    let mut columns: Vec<Vec<u32>> = vec![Vec::new(); nodes];
    let mut seen = vec![ROOT; nodes];
    let mut children = vec![Vec::new(); nodes];
    for j in 0..nodes {
        let mut rows = Vec::new();
        let below: &[u32] = &children[j];
        let handed = below.iter().flat_map(|&c: &u32| &columns[c as usize]);
        for &i in neighbours[j].iter().chain(handed) {
            if i > j as u32 && seen[i as usize] != j as u32 {
                seen[i as usize] = j as u32;
                rows.push(i);
            }
        }
        rows.sort_unstable();
        columns[j] = rows;
        if parents[j] != ROOT {
            children[parents[j] as usize].push(j as u32);
        }
    }
    columns
}

/// The nodes merged into groups, each at the index of its last node.
fn merge(parents: &[u32], columns: &[Vec<u32>]) -> Vec<Option<Group>> {
    let mut groups: Vec<Option<Group>> = Vec::with_capacity(parents.len());
    let mut below: Vec<Vec<u32>> = vec![Vec::new(); parents.len()];
    for (node, &parent) in parents.iter().enumerate() {
        let mut group =
            Group { nodes: vec![node as u32], rows: columns[node].len(), children: Vec::new() };
        for child in std::mem::take(&mut below[node]) {
            let apart = groups[child as usize].take_if(|child| is_cheaper_merged(&group, child));
            match apart {
                Some(mut child) => {
                    child.nodes.append(&mut group.nodes);
                    group.nodes = child.nodes;
                    group.children.append(&mut child.children);
                }
                None => group.children.push(child),
            }
        }
        groups.push(Some(group));
        if parent != ROOT {
            below[parent as usize].push(node as u32);
        }
    }
    groups
}

/// Whether eliminating the nodes of both in one front costs less than in two.
fn is_cheaper_merged(group: &Group, child: &Group) -> bool {
    let [own, other] = [group, child].map(|g| g.nodes.len());
    own + other <= WIDEST
        && cost(own + other, group.rows) <= cost(own, group.rows) + cost(other, child.rows)
}

/// The cost of eliminating `columns` nodes with `rows` below, in multiply-adds.
fn cost(columns: usize, rows: usize) -> f64 {
    let [k, u] = [columns, rows].map(|nodes| 3.0 * nodes as f64);
    0.5 * k * u * (u + k) + k * k * k / 6.0 + PER_ENTRY * u * u + PER_COLUMN * k + PER_FRONT
}

/// The groups, each after its children.
fn postorder(groups: &[Option<Group>]) -> Vec<&Group> {
    let mut is_child = vec![false; groups.len()];
    for group in groups.iter().flatten() {
        for &child in &group.children {
            is_child[child as usize] = true;
        }
    }
    // Parents before children and the last child first, then turned round.
    let mut reversed = Vec::new();
    for (root, group) in groups.iter().enumerate().rev() {
        if is_child[root] || group.is_none() {
            continue;
        }
        let mut open = vec![root as u32];
        while let Some(next) = open.pop() {
            if let Some(group) = &groups[next as usize] {
                open.extend(&group.children);
                reversed.push(group);
            }
        }
    }
    reversed.reverse();
    reversed
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn every_pattern_has_an_order_of_all_its_nodes(
            nodes in 1u32..40,
            pairs in prop::collection::vec((0u32..40, 0u32..40), 0..200),
        ) {
            let mut columns: Vec<Vec<u32>> = (0..nodes).map(|node| vec![node]).collect();
            for (a, b) in pairs {
                let (a, b) = (a % nodes, b % nodes);
                columns[a.min(b) as usize].push(a.max(b));
            }
            let (mut starts, mut blocks) = (vec![0], Vec::new());
            for column in &mut columns {
                column.sort_unstable();
                column.dedup();
                blocks.append(column);
                starts.push(blocks.len() as u32);
            }
            let mut order = minimum_degree(nodes as usize, &starts, &blocks).unwrap();
            order.sort_unstable();
            prop_assert_eq!(order, (0..nodes).collect::<Vec<_>>());
        }
    }

    #[test]
    fn a_matrix_without_nodes_has_no_fronts() {
        assert_eq!(Fronts::new(0, &[0], &[]).map(|fronts| fronts.count()).ok(), Some(0));
    }
}
