//! Which joints are solved together, and in which order their rows are eliminated.
//!
//! All joints of an island are one cluster, if it is little work to factorize: trees and chains of any length, and loops of
//! moderate size. The joints of a larger one are clusters each by itself, which are swept one after the other.

use crate::joint::Pace;
use crate::resolution::joint::factor::Factor;
use crate::resolution::joint::row::Times;

/// Multiplications of a factorization: a larger one takes more than a tenth of a millisecond, twice in each substep.
const MOST_WORK: u64 = 150_000;

/// More joints than this are not even ordered: to order them takes a time that goes with the square.
const MOST_JOINTS: usize = 2048;

/// Joints that are solved together.
#[derive(Debug, Default)]
pub(super) struct Cluster {
    /// The rows, in the order of elimination.
    pub(super) rows: Vec<u32>,
    pub(super) factor: Factor,
    /// Whether other clusters push the same bodies, so that one look is not enough.
    pub(super) is_swept: bool,
    /// Which rows acted when it was factorized, in this order; of this phase.
    pub(super) acted: Vec<bool>,
}

clone_into_buffers!(Cluster { rows, factor, is_swept, acted });

/// Joints that hang together.
#[derive(Debug, Default)]
pub(super) struct Island {
    /// Which of the joints of the step, and their bodies, with those that nothing moves but without the ground.
    pub(super) joints: Vec<u32>,
    pub(super) bodies: Vec<u32>,
    pub(super) clusters: Vec<Cluster>,
    /// The rows of those joints that form loops, or are between loops, and are solved together.
    pub(super) yielding: Vec<u32>,
    /// How finely it is moved within a substep, and times of the last step in it.
    pub(super) pace: Pace,
    pub(super) times: Times,
    /// How fast the fastest of its bodies has swung in the last substep, rad/s.
    pub(super) swing: f64,
    /// Whether a body of it is in a contact.
    pub(super) touches: bool,
    /// By how much others have pushed its bodies since it was solved in full, m/s.
    pub(super) pushed: f64,
    /// Whether what it is to be after the move was found only as if bodies did not turn in it.
    pub(super) is_linear: bool,
    /// Whether that was because how they turn came to no end.
    pub(super) diverges: bool,
}

clone_into_buffers!(Island {
    joints,
    bodies,
    clusters,
    yielding,
    pace,
    times,
    swing,
    touches,
    pushed,
    is_linear,
    diverges
});

impl Island {
    /// Has what yields factorized anew.
    pub(super) fn forget_factors(&mut self) {
        for cluster in self.clusters.iter_mut().filter(|_| !self.yielding.is_empty()) {
            cluster.acted.fill(false);
        }
    }
}

/// What is asked of a joint: its rows, and its bodies by their place among those of the joints, 0 for none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) joint: u32,
    pub(super) rows: [u32; 2],
    /// Those that are moved.
    pub(super) bodies: [u32; 2],
    pub(super) ends: [u32; 2],
}

impl Place {
    fn bodies(&self) -> impl Iterator<Item = u32> {
        self.bodies.into_iter().filter(|&body| body != 0)
    }
}

/// Divides joints into islands; `body_count` is that of their bodies, the ground with them.
pub(super) fn plan(joints: &[Place], body_count: usize) -> Vec<Island> {
    let mut of_body = vec![Vec::new(); body_count];
    for (number, place) in joints.iter().enumerate() {
        for body in place.bodies() {
            of_body[body as usize].push(number as u32);
        }
    }
    let is_in_loop = find_loops(joints, &of_body);
    let mut islands = Vec::new();
    let mut is_seen = vec![false; joints.len()];
    for first in 0..joints.len() {
        if is_seen[first] {
            continue;
        }
        is_seen[first] = true;
        let (mut island, mut next) = (vec![first as u32], 0);
        while let Some(&joint) = island.get(next) {
            next += 1;
            for body in joints[joint as usize].bodies() {
                for &other in &of_body[body as usize] {
                    if !std::mem::replace(&mut is_seen[other as usize], true) {
                        island.push(other);
                    }
                }
            }
        }
        island.sort_unstable();
        let ends = island.iter().flat_map(|&joint| joints[joint as usize].ends);
        let mut bodies: Vec<u32> = ends.filter(|&body| body != 0).collect();
        bodies.sort_unstable();
        bodies.dedup();
        let clusters = clusters_of(joints, &of_body, &island);
        let is_swept = clusters.iter().any(|cluster| cluster.is_swept);
        let in_loops = island.iter().filter(|&&joint| is_in_loop[joint as usize] && !is_swept);
        let rows = |&joint: &u32| joints[joint as usize].rows;
        let yielding = in_loops.map(rows).flat_map(|[first, end]| first..end).collect();
        islands.push(Island { joints: island, bodies, clusters, yielding, ..Island::default() });
    }
    islands
}

/// Which joints form loops, or are between loops: those that are left when, one after the other, each is taken away of which a body
/// has no other. What is not moved counts as one body, which all loops may go through.
fn find_loops(joints: &[Place], of_body: &[Vec<u32>]) -> Vec<bool> {
    let mut is_left = vec![true; joints.len()];
    let mut degrees: Vec<usize> = of_body.iter().map(Vec::len).collect();
    let mut ends: Vec<u32> = (0..degrees.len() as u32).filter(|&body| degrees[body as usize] == 1).collect();
    while let Some(end) = ends.pop() {
        for &joint in &of_body[end as usize] {
            if !std::mem::replace(&mut is_left[joint as usize], false) {
                continue;
            }
            for body in joints[joint as usize].bodies() {
                degrees[body as usize] -= 1;
                if degrees[body as usize] == 1 {
                    ends.push(body);
                }
            }
        }
    }
    is_left
}

/// An island as one cluster, or joint by joint.
fn clusters_of(joints: &[Place], of_body: &[Vec<u32>], island: &[u32]) -> Vec<Cluster> {
    if island.len() <= MOST_JOINTS {
        let (cluster, work) = cluster(joints, &order(joints, of_body, island));
        if work <= MOST_WORK {
            return vec![cluster];
        }
    }
    let alone = island.iter().map(|&joint| cluster(joints, &[joint]).0);
    alone.map(|cluster| Cluster { is_swept: true, ..cluster }).collect()
}

/// The order of elimination: that joint first which shares bodies with fewest, which then all share with each other (D. Rose,
/// 1972). A tree is taken from its leaves on.
fn order(joints: &[Place], of_body: &[Vec<u32>], island: &[u32]) -> Vec<u32> {
    let number_of = |joint: u32| island.binary_search(&joint).expect("it is of the island");
    let mut neighbours: Vec<Vec<usize>> = island
        .iter()
        .map(|&joint| {
            let shared = joints[joint as usize].bodies().flat_map(|body| &of_body[body as usize]);
            let mut others: Vec<_> =
                shared.filter(|&&other| other != joint).map(|&other| number_of(other)).collect();
            others.sort_unstable();
            others.dedup();
            others
        })
        .collect();
    let mut left: Vec<usize> = (0..island.len()).collect();
    let mut order = Vec::new();
    while let Some(place) = (0..left.len()).min_by_key(|&place| (neighbours[left[place]].len(), left[place]))
    {
        let least = left.remove(place);
        let around = std::mem::take(&mut neighbours[least]);
        for &joint in &around {
            let mut of_joint = std::mem::take(&mut neighbours[joint]);
            of_joint.extend(&around);
            of_joint.sort_unstable();
            of_joint.dedup();
            of_joint.retain(|&other| other != joint && other != least);
            neighbours[joint] = of_joint;
        }
        order.push(island[least]);
    }
    order
}

/// The rows of some joints in this order, and what a factorization of them takes.
fn cluster(joints: &[Place], order: &[u32]) -> (Cluster, u64) {
    let (mut rows, mut entries): (Vec<u32>, Vec<Vec<u32>>) = (Vec::new(), Vec::new());
    // For each joint so far, its bodies and where its rows are.
    let mut before: Vec<(&Place, u32)> = Vec::new();
    for &joint in order {
        let place = &joints[joint as usize];
        let first = rows.len() as u32;
        let sharing =
            before.iter().filter(|(other, _)| other.bodies().any(|body| place.bodies.contains(&body)));
        let mut columns: Vec<u32> =
            sharing.flat_map(|(other, first)| *first..first + other.rows[1] - other.rows[0]).collect();
        for row in place.rows[0]..place.rows[1] {
            entries.push(columns.clone());
            columns.push(rows.len() as u32);
            rows.push(row);
        }
        before.push((place, first));
    }
    let (factor, work) = Factor::new(&entries);
    (Cluster { acted: vec![false; rows.len()], rows, factor, is_swept: false }, work)
}
