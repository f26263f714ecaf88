//! A convex outline with its edge normals: what detection works on.

use crate::math::Vec2;

/// Most corners a polygon can have. Eight keep a hull in three cache lines and its loops short; rounder
/// things are better circles.
pub const MAX_VERTICES: usize = 8;

/// A convex outline about the centre of mass, counter-clockwise. Edge i runs from vertex i to vertex i + 1.
///
/// The arrays are longer than the outline; entries from `count` on are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Hull {
    /// Corners, m.
    pub(crate) vertices: [Vec2; MAX_VERTICES],
    /// Outward unit normals of the edges.
    pub(crate) normals: [Vec2; MAX_VERTICES],
    /// Distances of the edges' lines from the centre, m: normal · vertex. A gap is measured from here and
    /// not from a vertex, which on a long thin hull lies far away and would bring its rounding along.
    pub(crate) planes: [f32; MAX_VERTICES],
    /// Distance of the nearest edge's line from the centre, m.
    pub(crate) inradius: f32,
    extent: f32,
    thickness: f32,
    /// Number of corners, 3 to 8; 2 for the core of a capsule, whose two edges are its two sides.
    pub(crate) count: u8,
}

impl Hull {
    const EMPTY: Self = Self {
        vertices: [Vec2::ZERO; MAX_VERTICES],
        normals: [Vec2::ZERO; MAX_VERTICES],
        planes: [0.0; MAX_VERTICES],
        inradius: f32::INFINITY,
        extent: 0.0,
        thickness: 0.0,
        count: 0,
    };

    /// The hull of `corners`: 3 to 8, convex, counter-clockwise, about the centre of mass. Or 2, whose hull is a line.
    pub(crate) fn new(corners: &[Vec2]) -> Self {
        debug_assert!((2..=MAX_VERTICES).contains(&corners.len()));
        let mut hull = Self { count: corners.len() as u8, ..Self::EMPTY };
        for (i, &v) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            // In f64, so that the normal is the exact one rounded once.
            let (x, y) = (f64::from(v.x), f64::from(v.y));
            let (edge_x, edge_y) = (f64::from(next.x) - x, f64::from(next.y) - y);
            let length = (edge_x * edge_x + edge_y * edge_y).sqrt();
            let (normal_x, normal_y) = (edge_y / length, -edge_x / length);
            hull.vertices[i] = v;
            hull.normals[i] = Vec2::new(normal_x as f32, normal_y as f32);
            hull.planes[i] = (normal_x * x + normal_y * y) as f32;
            hull.inradius = hull.inradius.min(hull.planes[i]);
        }
        hull.measured()
    }

    /// The hull of the line from `a` to `b`, m, about its middle, and where that is. Ends that are not finite stay as they are, to be told of.
    pub(crate) fn line(a: Vec2, b: Vec2) -> (Self, Vec2) {
        if !a.is_finite() || !b.is_finite() {
            return (Self::new(&[a, b]), Vec2::ZERO);
        }
        let middle = |a: f32, b: f32| 0.5 * (f64::from(a) + f64::from(b));
        let (x, y) = (middle(a.x, b.x), middle(a.y, b.y));
        let half = Vec2::new((f64::from(b.x) - x) as f32, (f64::from(b.y) - y) as f32);
        (Self::new(&[-half, half]), Vec2::new(x as f32, y as f32))
    }

    /// The hull of a box of half width `half.x` and half height `half.y`, m: corners from the lower left one
    /// on, edges bottom, right, top, left.
    pub(crate) fn rectangle(half: Vec2) -> Self {
        let corners = [-half, Vec2::new(half.x, -half.y), half, Vec2::new(-half.x, half.y)];
        let normals = [(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)];
        let planes = [half.y, half.x, half.y, half.x];
        let mut hull = Self { inradius: half.x.min(half.y), count: 4, ..Self::EMPTY };
        for i in 0..4 {
            hull.vertices[i] = corners[i];
            hull.normals[i] = normals[i].into();
            hull.planes[i] = planes[i];
        }
        hull.measured()
    }

    /// It, with its sizes.
    fn measured(mut self) -> Self {
        self.extent = self.vertices().iter().map(|v| v.length()).fold(0.0, f32::max);
        // The narrowest strip that holds a convex outline has an edge on one of its sides, so it is enough to measure from each edge.
        let width_from = |(&normal, &plane): (&Vec2, &f32)| {
            self.vertices().iter().map(|&v| plane - normal.dot(v)).fold(0.0, f32::max)
        };
        self.thickness =
            self.normals().iter().zip(&self.planes).map(width_from).fold(f32::INFINITY, f32::min);
        self
    }

    /// Whether it is a line, and has no inside.
    #[inline(always)]
    pub(crate) fn is_segment(&self) -> bool {
        self.count == 2
    }

    /// The corners, m.
    #[inline(always)]
    pub(crate) fn vertices(&self) -> &[Vec2] {
        &self.vertices[..self.count as usize]
    }

    /// The outward unit normals, one for each edge.
    #[inline(always)]
    pub(crate) fn normals(&self) -> &[Vec2] {
        &self.normals[..self.count as usize]
    }

    /// The vertex after `index`, which is the end of that edge.
    #[inline(always)]
    pub(crate) fn next(&self, index: usize) -> usize {
        if index + 1 < self.count as usize { index + 1 } else { 0 }
    }

    /// The index before.
    #[inline(always)]
    pub(crate) fn previous(&self, index: usize) -> usize {
        if index > 0 { index - 1 } else { self.count as usize - 1 }
    }

    /// How far a point, m, is in front of the edge's line that it is furthest in front of, and which edge that is;
    /// minus infinity for a point that is NaN.
    #[inline(always)]
    pub(crate) fn nearest_face(&self, point: Vec2) -> (f32, usize) {
        let mut nearest = (f32::NEG_INFINITY, 0);
        for (index, (normal, plane)) in self.normals().iter().zip(&self.planes).enumerate() {
            let gap = normal.dot(point) - plane;
            if gap > nearest.0 {
                nearest = (gap, index);
            }
        }
        nearest
    }

    /// How far an edge goes on to both sides of a point, m: to its start, below 0 in front of the edge, and to its end.
    #[inline(always)]
    pub(crate) fn ends_from(&self, edge: usize, point: Vec2) -> [f32; 2] {
        let along = self.normals[edge].perp();
        [edge, self.next(edge)].map(|corner| along.dot(self.vertices[corner] - point))
    }

    /// Smallest width across, m.
    #[inline(always)]
    pub(crate) fn thickness(&self) -> f32 {
        self.thickness
    }

    /// Greatest distance of a corner from the centre, m.
    #[inline(always)]
    pub(crate) fn extent(&self) -> f32 {
        self.extent
    }
}
