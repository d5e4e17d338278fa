//! Builds the hierarchy from the top: binned surface-area heuristic, eight parts at a time.
//!
//! I. Wald, *On fast construction of SAH-based bounding volume hierarchies*, 2007. A node begins as
//! one part; the part of the greatest area is split in two until there are eight. Below
//! [`MAX_SAH_DEPTH`] parts are halved by number, so a hierarchy of n triangles has no more than
//! [`MAX_SAH_DEPTH`] + log₈ n + 2 levels whatever they are, and building takes time proportional to
//! n log n.

use fearless_simd::Level;
use glam::DVec3;
use rayon::prelude::*;

use crate::frame::{Frame, MAX_COORDINATE, exponent, power_of_two};
use crate::nodes::{Block, IS_BLOCK, Node, WIDTH};
use crate::{Bvh, Triangle};

/// Levels of nodes split by the surface-area heuristic.
const MAX_SAH_DEPTH: u32 = 24;

/// Most bins along an axis.
const MAX_BINS: usize = 16;

/// Subtrees of fewer triangles are built by one thread.
const TASK: usize = 1 << 13;

/// Triangles, or corners, that a thread prepares at once.
const RANGE: usize = 1 << 14;

/// Most triangles used: the number of blocks stays below [`IS_BLOCK`].
const MAX_TRIANGLES: usize = 1 << 31;

type Positions = [[f64; 3]];

/// A box as least x, y, z and −(greatest x, y, z), so that the union is eight minima. Lanes 3 and 7
/// are not used.
#[derive(Clone, Copy, Debug)]
struct Bounds([f32; 8]);

impl Bounds {
    const EMPTY: Self = Self([f32::INFINITY; 8]);

    #[inline(always)]
    fn union(self, other: &Self) -> Self {
        Self(std::array::from_fn(|lane| {
            if self.0[lane] < other.0[lane] { self.0[lane] } else { other.0[lane] }
        }))
    }

    #[inline(always)]
    fn grown(self, margin: f32) -> Self {
        Self(self.0.map(|x| x - margin))
    }

    #[inline(always)]
    fn size(&self, axis: usize) -> f32 {
        -self.0[axis + 4] - self.0[axis]
    }

    /// Half the surface; 0 for an empty box.
    #[inline(always)]
    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.size(axis).max(0.0));
        x * y + y * z + z * x
    }

    /// Twice the centre.
    #[inline(always)]
    fn center(&self, axis: usize) -> f32 {
        self.0[axis] - self.0[axis + 4]
    }
}

/// A triangle to be sorted into the hierarchy.
#[derive(Clone, Copy, Debug)]
struct Item {
    bounds: Bounds,
    margin: f32,
    triangle: u32,
}

/// Data that all parts share.
struct Mesh<'a> {
    triangles: &'a [[u32; 3]],
    /// Positions in box coordinates.
    corners: Vec<[f32; 3]>,
}

/// A subtree: its root comes first.
#[derive(Default)]
struct Subtree {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
}

/// Triangles of a block: consecutive rows of the sorted items.
#[derive(Clone, Copy)]
struct Leaf {
    first: u32,
    n: u32,
}

pub fn build(positions: &[DVec3], triangles: &[[u32; 3]]) -> Bvh {
    let triangles = &triangles[..triangles.len().min(MAX_TRIANGLES)];
    let positions: Vec<[f64; 3]> = positions.iter().map(|position| position.to_array()).collect();
    let margin =
        |positions: &Positions, row: usize| is_regular(positions, triangles[row]).then_some(0.0);
    let Some((low, high)) = bounds(&positions, triangles, margin) else { return Bvh::empty() };
    with_margins(positions, triangles, [low, high], margin)
}

/// The triangles of a hierarchy with other corners, which need not be regular. `margins`: how far
/// the surface of each is from its plane triangle, at most.
pub fn displaced(bvh: &Bvh, positions: &[DVec3], margins: &[f64]) -> Bvh {
    let triangles: Vec<[u32; 3]> = bvh.triangles.iter().map(|triangle| triangle.corners).collect();
    let positions: Vec<[f64; 3]> = positions.iter().map(|position| position.to_array()).collect();
    let margin = |_: &Positions, row: usize| Some(margins[bvh.triangles[row].index as usize]);
    let Some((low, high)) = bounds(&positions, &triangles, margin) else { return Bvh::empty() };
    let mut displaced = with_margins(positions, &triangles, [low, high], margin);
    for triangle in &mut displaced.triangles {
        triangle.index = bvh.triangles[triangle.index as usize].index;
    }
    displaced
}

/// `bounds`: of all triangles that have a margin, with it. The others are left out.
fn with_margins(
    positions: Vec<[f64; 3]>,
    triangles: &[[u32; 3]],
    [low, high]: [[f64; 3]; 2],
    margin: impl Fn(&Positions, usize) -> Option<f64> + Sync,
) -> Bvh {
    let frame = Frame::new(low, high);
    let corner = |position: &[f64; 3]| frame.to_box(*position).map(|x| x as f32);
    let corners = positions.par_iter().with_min_len(RANGE).map(corner).collect();
    let mesh = Mesh { triangles, corners };
    let mut items =
        mesh.items(|triangle| Some((margin(&positions, triangle)? * frame.scale) as f32));
    let mut tree = Subtree::default();
    build_node(&mut items, 0, 0, &mut tree);
    let Subtree { nodes, leaves } = tree;
    let leaves = leaves.par_iter().with_min_len(RANGE / WIDTH);
    let blocks = leaves.map(|leaf| mesh.block(*leaf, &items)).collect();
    let triangle =
        |item: &Item| Triangle { corners: triangles[item.triangle as usize], index: item.triangle };
    let sorted = items.par_iter().with_min_len(RANGE).map(triangle).collect();
    Bvh {
        level: Level::new(),
        frame,
        bounds: Some((DVec3::from_array(low), DVec3::from_array(high))),
        positions,
        triangles: sorted,
        nodes,
        blocks,
    }
}

/// The bounds of all triangles that have a margin, with it.
fn bounds(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    margin: impl Fn(&Positions, usize) -> Option<f64> + Sync,
) -> Option<([f64; 3], [f64; 3])> {
    let union = |[low, high]: [[f64; 3]; 2], [other_low, other_high]: [[f64; 3]; 2]| {
        [
            std::array::from_fn(|axis| f64::min(low[axis], other_low[axis])),
            std::array::from_fn(|axis| f64::max(high[axis], other_high[axis])),
        ]
    };
    let empty = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let parts = triangles.par_chunks(RANGE).enumerate().map(|(range, triangles)| {
        let mut bounds = empty;
        for (row, triangle) in (range * RANGE..).zip(triangles) {
            let Some(margin) = margin(positions, row) else { continue };
            for &corner in triangle {
                let [low, high] =
                    [-margin, margin].map(|margin| positions[corner as usize].map(|x| x + margin));
                bounds = union(bounds, [low, high]);
            }
        }
        bounds
    });
    let [low, high] = parts.collect::<Vec<_>>().into_iter().fold(empty, union);
    (low[0] <= high[0]).then_some((low, high))
}

/// Whether rays can hit a triangle: see [`Bvh::new`].
pub fn is_regular(positions: &[[f64; 3]], triangle: [u32; 3]) -> bool {
    let [Some(a), Some(b), Some(c)] = triangle.map(|row| positions.get(row as usize)) else {
        return false;
    };
    // NaN fails the comparison.
    if ![a, b, c].iter().all(|corner| corner.iter().all(|x| x.abs() <= MAX_COORDINATE)) {
        return false;
    }
    let edge = |to: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|axis| to[axis] - a[axis]) };
    let (b, c) = (edge(b), edge(c));
    let is_regular = |b: [f64; 3], c: [f64; 3]| {
        let normal =
            [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        (normal[0].abs() + normal[1].abs() + normal[2].abs(), normal != [0.0; 3])
    };
    let (size, is) = is_regular(b, c);
    if (1e-200..1e200).contains(&size) {
        return is;
    }
    // Products may have overflowed or underflowed.
    let scaled = |edge: [f64; 3]| {
        let size = edge.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        edge.map(|x| x * power_of_two(-exponent(size).clamp(-1000, 1000)))
    };
    is_regular(scaled(b), scaled(c)).1
}

impl Mesh<'_> {
    /// All triangles that have a margin, in box coordinates, with their bounds.
    fn items(&self, margin: impl Fn(usize) -> Option<f32> + Sync) -> Vec<Item> {
        let item = |triangle: usize| {
            let margin = margin(triangle);
            let bounds = margin.map_or(Bounds::EMPTY, |margin| self.bounds(triangle).grown(margin));
            Item { bounds, margin: margin.unwrap_or(0.0), triangle: triangle as u32 }
        };
        let rows = (0..self.triangles.len()).into_par_iter().with_min_len(RANGE);
        let mut items: Vec<Item> = rows.map(item).collect();
        items.retain(|item| item.bounds.0[0] < f32::INFINITY);
        items
    }

    fn bounds(&self, triangle: usize) -> Bounds {
        self.triangles[triangle]
            .map(|row| self.corners[row as usize])
            .into_iter()
            .fold(Bounds::EMPTY, |bounds, [x, y, z]| {
                bounds.union(&Bounds([x, y, z, 0.0, -x, -y, -z, 0.0]))
            })
    }

    fn block(&self, leaf: Leaf, items: &[Item]) -> Block {
        let items = &items[leaf.first as usize..][..leaf.n as usize];
        let bounds = bounds_of(items);
        let extent = bounds.size(0).max(bounds.size(1)).max(bounds.size(2));
        let margin = items.iter().map(|item| item.margin).fold(0.0, f32::max);
        let mut block = Block { first: leaf.first, n: leaf.n, extent, margin, ..Block::EMPTY };
        for (lane, item) in items.iter().enumerate() {
            for (corner, row) in self.triangles[item.triangle as usize].into_iter().enumerate() {
                for axis in 0..3 {
                    block.corners[corner][axis][lane] = self.corners[row as usize][axis];
                }
            }
        }
        block
    }
}

/// Appends a node for these triangles and all below it. Returns its index. `first`: index of the
/// first triangle among all.
fn build_node(items: &mut [Item], first: usize, depth: u32, tree: &mut Subtree) -> u32 {
    let is_task = items.len() >= TASK;
    let parts = split(items, depth);
    let idx = tree.nodes.len();
    let mut node = Node::EMPTY;
    for (child, part) in parts.iter().enumerate() {
        let [x, y, z, _, minus_x, minus_y, minus_z, _] = part.bounds.0;
        node.set_box(child, [x, y, z], [-minus_x, -minus_y, -minus_z]);
    }
    tree.nodes.push(node);
    let mut rest = items;
    let mut tasks = Vec::new();
    for (child, part) in parts.iter().enumerate() {
        let (items, behind) = rest.split_at_mut(part.n);
        rest = behind;
        let first = first + part.first;
        if items.len() <= WIDTH {
            tree.nodes[idx].children_mut()[child] = tree.leaves.len() as u32 | IS_BLOCK;
            tree.leaves.push(Leaf { first: first as u32, n: part.n as u32 });
        } else if is_task {
            tasks.push((child, first, items, Subtree::default()));
        } else {
            tree.nodes[idx].children_mut()[child] = build_node(items, first, depth + 1, tree);
        }
    }
    tasks.par_iter_mut().with_max_len(1).for_each(|(_, first, items, subtree)| {
        build_node(items, *first, depth + 1, subtree);
    });
    for (child, _, _, subtree) in tasks {
        tree.nodes[idx].children_mut()[child] = tree.append(subtree);
    }
    idx as u32
}

impl Subtree {
    /// Appends another subtree. Returns the index of its root.
    fn append(&mut self, mut other: Self) -> u32 {
        let [nodes, leaves] = [self.nodes.len(), self.leaves.len()].map(|n| n as u32);
        for child in other.nodes.iter_mut().flat_map(Node::children_mut) {
            *child += if *child & IS_BLOCK == 0 { nodes } else { leaves };
        }
        self.nodes.append(&mut other.nodes);
        self.leaves.append(&mut other.leaves);
        nodes
    }
}

/// Consecutive triangles that become a child of a node.
#[derive(Clone, Copy, Debug)]
struct Part {
    first: usize,
    n: usize,
    bounds: Bounds,
}

fn bounds_of(items: &[Item]) -> Bounds {
    items.iter().fold(Bounds::EMPTY, |bounds, item| bounds.union(&item.bounds))
}

/// Sorts triangles into the parts of a node. Returns the parts in the order of the triangles.
fn split(items: &mut [Item], depth: u32) -> Vec<Part> {
    let mut parts = vec![Part { first: 0, n: items.len(), bounds: bounds_of(items) }];
    while parts.len() < WIDTH {
        let key =
            |part: &Part| if depth < MAX_SAH_DEPTH { part.bounds.area() } else { part.n as f32 };
        let greatest = (0..parts.len())
            .filter(|&idx| parts[idx].n > WIDTH)
            .reduce(|best, idx| if key(&parts[idx]) > key(&parts[best]) { idx } else { best });
        let Some(greatest) = greatest else { break };
        let Part { first, n, .. } = parts[greatest];
        let [half, other] = halve(&parts[greatest], &mut items[first..first + n], depth);
        parts[greatest] = half;
        parts.insert(greatest + 1, other);
    }
    parts
}

/// Sorts the triangles of a part, two or more, into two parts.
fn halve(part: &Part, items: &mut [Item], depth: u32) -> [Part; 2] {
    let by_area = if depth < MAX_SAH_DEPTH { split_by_area(items) } else { None };
    let (n, [bounds, other_bounds]) = by_area.unwrap_or_else(|| {
        let (half, other) = items.split_at(items.len() / 2);
        (half.len(), [half, other].map(bounds_of))
    });
    let other = Part { first: part.first + n, n: part.n - n, bounds: other_bounds };
    [Part { first: part.first, n, bounds }, other]
}

/// Sorts triangles into two parts by the surface-area heuristic. Returns the number in the first
/// and both bounds, or `None` if all have one centre.
fn split_by_area(items: &mut [Item]) -> Option<(usize, [Bounds; 2])> {
    let bins = Bins::new(items);
    let mut best = (f32::INFINITY, 0, 0);
    for axis in 0..3 {
        let (cost, bin) = bins.best_split(axis, items.len());
        if cost < best.0 {
            best = (cost, axis, bin);
        }
    }
    let (cost, axis, bin) = best;
    if cost == f32::INFINITY {
        return None;
    }
    let union =
        |bins: &[Bin]| bins.iter().fold(Bounds::EMPTY, |bounds, bin| bounds.union(&bin.bounds));
    let (first, others) = bins.bins[axis].split_at(bin);
    Some((partition(items, |item| bins.find(item, axis) < bin), [union(first), union(others)]))
}

/// The triangles whose centres are in an interval.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Bounds,
    n: u32,
}

/// Triangles by their centres.
struct Bins {
    low: [f32; 3],
    /// Bins for each unit; infinite along an axis in which all centres are equal.
    scale: [f32; 3],
    n: usize,
    bins: [[Bin; MAX_BINS]; 3],
}

impl Bins {
    fn new(items: &[Item]) -> Self {
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for item in items {
            for axis in 0..3 {
                let center = item.bounds.center(axis);
                low[axis] = if center < low[axis] { center } else { low[axis] };
                high[axis] = if center > high[axis] { center } else { high[axis] };
            }
        }
        let n = (4 + items.len() / 16).min(MAX_BINS);
        let scale = std::array::from_fn(|axis| (n - 1) as f32 / (high[axis] - low[axis]));
        let empty = Bin { bounds: Bounds::EMPTY, n: 0 };
        let mut bins = Self { low, scale, n, bins: [[empty; MAX_BINS]; 3] };
        for item in items {
            for axis in 0..3 {
                let bin = bins.find(item, axis);
                let bin = &mut bins.bins[axis][bin];
                bin.bounds = bin.bounds.union(&item.bounds);
                bin.n += 1;
            }
        }
        bins
    }

    /// The bin of a triangle, by rounding to a whole number: in 2²³…2²⁴, numbers have no fraction,
    /// and the last bits are those of the whole number.
    #[inline(always)]
    fn find(&self, item: &Item, axis: usize) -> usize {
        let at = (item.bounds.center(axis) - self.low[axis]) * self.scale[axis];
        (at + 8_388_608.0).to_bits() as usize % MAX_BINS
    }

    /// The least cost of a split along an axis, and the first bin of the second part.
    fn best_split(&self, axis: usize, n_items: usize) -> (f32, usize) {
        let mut best = (f32::INFINITY, 0);
        if self.scale[axis] == f32::INFINITY {
            return best;
        }
        let bins = &self.bins[axis][..self.n];
        let mut costs_behind = [0.0; MAX_BINS];
        let (mut bounds, mut n) = (Bounds::EMPTY, 0);
        for (idx, bin) in bins.iter().enumerate().skip(1).rev() {
            bounds = bounds.union(&bin.bounds);
            n += bin.n;
            costs_behind[idx] = bounds.area() * n_blocks(n);
        }
        let (mut bounds, mut n) = (Bounds::EMPTY, 0);
        for idx in 1..self.n {
            bounds = bounds.union(&bins[idx - 1].bounds);
            n += bins[idx - 1].n;
            let cost = bounds.area() * n_blocks(n) + costs_behind[idx];
            if n > 0 && (n as usize) < n_items && cost < best.0 {
                best = (cost, idx);
            }
        }
        best
    }
}

/// The least number of blocks for so many triangles.
#[inline(always)]
fn n_blocks(n: u32) -> f32 {
    n.div_ceil(WIDTH as u32) as f32
}

/// Moves the items for which `is_first` holds before the others. Returns their number.
fn partition(items: &mut [Item], is_first: impl Fn(&Item) -> bool) -> usize {
    let (mut first, mut end) = (0, items.len());
    loop {
        while first < end && is_first(&items[first]) {
            first += 1;
        }
        while first < end && !is_first(&items[end - 1]) {
            end -= 1;
        }
        if first == end {
            return first;
        }
        items.swap(first, end - 1);
    }
}
