//! The contact manifold: where two shapes touch, at one or two points with a common normal.
//!
//! Detection writes it, the solver pushes its points apart, and the next step recognises the points by their
//! feature ids, so that impulses carry over (warm starting). Two points are all that two convex outlines need:
//! pushing at the ends of the common stretch of two edges holds everything between.

use crate::compute::BodyState;
use crate::math::Vec2;

/// Which corners of the two shapes bound a contact point: the point's name from one step to the next.
///
/// Where an edge of one shape lies on an edge of the other, their common stretch has two ends, and at each end
/// one corner of each shape is the nearest: the id is that pair, vertex of a in the high byte, vertex of b in the
/// low one. It says neither which shape's edge was taken as the reference nor which of the two corners stands
/// out further, so that neither can rename a point that stays where it is, as in a stack of equal boxes.
///
/// A circle touches at one point only, which is always [`FeatureId::SINGLE`]: a ball that rolls over a corner
/// keeps its impulse.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(9.0, 1.0)).at([0.0, -0.5]))?;
/// let crate_ = world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 0.5]))?;
/// let corners = |world: &World| -> Vec<FeatureId> {
///     let contact = world.contacts_of(crate_).next().unwrap();
///     contact.points().iter().map(|point| point.feature).collect()
/// };
/// world.step();
/// let before = corners(&world);
/// world.step();
/// assert_eq!(corners(&world), before, "the crate stands on the same two corners");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FeatureId(u16);

impl FeatureId {
    /// The id of the only point of a manifold with a circle.
    pub const SINGLE: Self = Self(0);

    /// The point at `vertex_a` of a and `vertex_b` of b.
    #[inline(always)]
    pub(crate) const fn of_vertices(vertex_a: u8, vertex_b: u8) -> Self {
        Self((vertex_a as u16) << 8 | vertex_b as u16)
    }

    /// Whether one of the two corners is that of `other`.
    pub(crate) const fn shares_vertex(self, other: Self) -> bool {
        self.0 >> 8 == other.0 >> 8 || self.0 & 0xFF == other.0 & 0xFF
    }

    /// The id as a number.
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    /// The id with a and b exchanged.
    #[inline(always)]
    pub(crate) const fn flipped(self) -> Self {
        Self(self.0.swap_bytes())
    }
}

/// Whether a contact point is a corner of one shape on the face of the other that gives the normal, or one of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Corner {
    /// Neither: between corners, or with a circle.
    #[default]
    Neither,
    /// A corner of a on a face of b.
    OfA,
    /// A corner of b on a face of a.
    OfB,
    /// A round corner on a corner, whose line is the normal: the only point.
    OfBoth,
}

impl Corner {
    /// The same with a and b exchanged.
    #[inline(always)]
    fn flipped(self) -> Self {
        match self {
            Self::Neither => Self::Neither,
            Self::OfA => Self::OfB,
            Self::OfB => Self::OfA,
            Self::OfBoth => Self::OfBoth,
        }
    }
}

/// One point at which two shapes touch or are about to.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// world.add(Body::fixed(Shape::rectangle(9.0, 1.0)).at([0.0, -0.5]))?;
/// let crate_ = world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)).at([0.0, 0.5]).mass(6.0))?;
/// for _ in 0..30 {
///     world.step();
/// }
/// let contact = world.contacts_of(crate_).next().unwrap();
/// let borne: f32 = contact.points().iter().map(|point| point.normal_impulse).sum();
/// let substep = 1.0 / 60.0 / 4.0;
/// assert!((borne - 6.0 * 9.81 * substep).abs() < 1e-3, "in each substep its weight is borne");
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ManifoldPoint {
    /// The contact point from a's centre, turned as the world is, m: that of a shape for [`detect`](crate::collision::detect), that
    /// of mass of a body in a world. It lies halfway between the two surfaces, or on
    /// that of a circle that touches something else.
    pub anchor_a: Vec2,
    /// The same point from b's centre, m.
    pub anchor_b: Vec2,
    /// Gap between the surfaces along the normal, m; negative where they overlap. After a step it is that of the manifold with which it began,
    /// and how the bodies have moved along its normal since; [`detect`](crate::collision::detect) tells of where they are.
    pub separation: f32,
    /// Which corners of the shapes bound it.
    pub feature: FeatureId,
    pub(crate) corner: Corner,
    /// What each warm start of the last substep has applied along the normal, in 255ths of `normal_impulse`, and no more than all of it.
    pub(crate) warm_share: u8,
    /// Impulse along the normal in the last substep, N s, 0 or more.
    pub normal_impulse: f32,
    /// Impulse along the tangent in the last substep, N s.
    pub tangent_impulse: f32,
    /// What it bears along the normal without yielding, N s in half a substep: the part of its load that has lasted.
    pub(crate) lasting_impulse: f32,
}

impl ManifoldPoint {
    /// A point without impulses, `anchor_a` from a's centre; b's centre is `offset` from a's.
    #[inline(always)]
    pub(crate) fn new(anchor_a: Vec2, offset: Vec2, separation: f32, feature: FeatureId) -> Self {
        let anchor_b = anchor_a - offset;
        Self { anchor_a, anchor_b, separation, feature, ..Self::default() }
    }

    /// Takes over what another point has borne.
    pub(crate) fn take_impulses(&mut self, from: &Self) {
        self.normal_impulse = from.normal_impulse;
        self.tangent_impulse = from.tangent_impulse;
        self.lasting_impulse = from.lasting_impulse;
        self.warm_share = from.warm_share;
    }

    /// Has borne so many times as much, no unit. What the warm starts did is a share of it, and goes along.
    pub(crate) fn scale_impulses(&mut self, factor: f32) {
        self.normal_impulse *= factor;
        self.tangent_impulse *= factor;
        self.lasting_impulse *= factor;
    }

    /// What each warm start of the last substep has applied along the normal, N s, or the whole impulse, if that is less.
    #[inline(always)]
    pub(crate) fn warm_start(&self) -> f32 {
        f32::from(self.warm_share) * (1.0 / 255.0) * self.normal_impulse
    }

    /// Takes note of what the point has borne in the last substep along the normal, and of what of that each warm start applied, N s. The share
    /// is rounded down to a 255th: it only matters where it is below a quarter, see
    /// [`LOAD_GROWTH`](crate::resolution::constraint::warm_start::LOAD_GROWTH), and a load that is guessed a little too small is found by the sweeps.
    #[inline(always)]
    pub(crate) fn set_normal_impulse(&mut self, impulse: f32, warm_start: f32) {
        self.normal_impulse = impulse;
        // A conversion from a float ends at 255, and gives 0 for 0/0.
        self.warm_share = (255.0 * warm_start / impulse) as u8;
    }

    /// Velocity of b against a at the point, m/s, with anchors from their centres of mass.
    pub(crate) fn relative_velocity(&self, a: &BodyState, b: &BodyState) -> Vec2 {
        (b.velocity_at(self.anchor_b.into()) - a.velocity_at(self.anchor_a.into())).to_vec2()
    }
}

/// One or two contact points with a common normal.
///
/// ```
/// use rustycs::prelude::*;
///
/// let crate_ = Shape::rectangle(1.0, 1.0);
/// // One stands on the other, 1 cm deep in it.
/// let manifold = collision::detect(&crate_, Pose::at([0.0, 0.0]), &crate_, Pose::at([0.2, 0.99])).unwrap();
/// assert_eq!(manifold.normal, Vec2::new(0.0, 1.0), "from the first to the second");
/// assert_eq!(manifold.points().len(), 2, "along an edge");
/// assert!(manifold.points().iter().all(|point| (point.separation + 0.01).abs() < 1e-6));
/// ```
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Manifold {
    count: u8,
    /// Unit vector from a to b, along which the two are pushed apart.
    pub normal: Vec2,
    points: [ManifoldPoint; 2],
}

impl Manifold {
    /// What a point has given b in the last substep, N s: along the normal and by friction.
    pub(crate) fn impulse_on_b(&self, point: &ManifoldPoint) -> Vec2 {
        self.normal * point.normal_impulse + self.normal.perp() * point.tangent_impulse
    }

    /// The manifold of one point.
    #[inline(always)]
    pub(crate) fn of_one(normal: Vec2, point: ManifoldPoint) -> Self {
        Self { normal, points: [point, ManifoldPoint::default()], count: 1 }
    }

    /// The manifold of two points, `first` being the one that comes first along the outline of a.
    #[inline(always)]
    pub(crate) fn of_two(normal: Vec2, first: ManifoldPoint, second: ManifoldPoint) -> Self {
        Self { normal, points: [first, second], count: 2 }
    }

    /// The points, one or two, in the order of their places along the outline of a.
    #[inline(always)]
    pub fn points(&self) -> &[ManifoldPoint] {
        &self.points[..self.count as usize]
    }

    /// Whether two corners touch, of which one is round.
    pub(crate) fn is_of_corners(&self) -> bool {
        self.points[0].corner == Corner::OfBoth
    }

    /// Whether it has points of the same features as `other`, in the same order.
    pub(crate) fn has_features_of(&self, other: &Self) -> bool {
        self.points().iter().map(|point| point.feature).eq(other.points().iter().map(|point| point.feature))
    }

    /// The manifold with only the points whose features `other` has, in its order; `None` if one is missing.
    pub(crate) fn restricted_to(&self, other: &Self) -> Option<Self> {
        let mut restricted = Self { normal: self.normal, count: other.count, ..*other };
        for wanted in restricted.points_mut() {
            *wanted = *self.points().iter().find(|point| point.feature == wanted.feature)?;
        }
        Some(restricted)
    }

    /// The manifold with those of its points that pass; `None` if none does.
    pub(crate) fn filtered(&self, passes: impl Fn(&ManifoldPoint) -> bool) -> Option<Self> {
        let mut kept = self.points().iter().filter(|point| passes(point));
        let first = *kept.next()?;
        Some(match kept.next() {
            Some(&second) => Self::of_two(self.normal, first, second),
            None => Self::of_one(self.normal, first),
        })
    }

    /// The points, to write impulses into.
    #[inline(always)]
    pub fn points_mut(&mut self) -> &mut [ManifoldPoint] {
        &mut self.points[..self.count as usize]
    }

    /// Makes the manifold of two cores that of shapes with sharp corners, on which nothing rolls.
    pub(crate) fn forget_round_corners(&mut self) {
        for point in self.points_mut().iter_mut().filter(|point| point.corner == Corner::OfBoth) {
            point.corner = Corner::Neither;
        }
    }

    /// Makes the manifold of two cores that of the shapes, which have these radii around them, m.
    pub(crate) fn take_off(&mut self, [radius_a, radius_b]: [f32; 2]) {
        let shift = self.normal * (0.5 * (radius_a - radius_b));
        for point in self.points_mut() {
            point.separation -= radius_a + radius_b;
            point.anchor_a += shift;
            point.anchor_b += shift;
        }
    }

    /// The centres of the round corners that touch at a point, with these radii, m, from the centres of their bodies: the point is
    /// halfway between the two surfaces.
    pub(crate) fn corner_centers(&self, point: &ManifoldPoint, radii: [f32; 2]) -> [Vec2; 2] {
        let [to_a, to_b] = radii.map(|radius| self.normal * (0.5 * point.separation + radius));
        [point.anchor_a - to_a, point.anchor_b + to_b]
    }

    /// Has the anchors count from elsewhere: by so much more, m.
    #[inline]
    pub(crate) fn move_anchors(&mut self, [by_a, by_b]: [Vec2; 2]) {
        for point in self.points_mut() {
            point.anchor_a += by_a;
            point.anchor_b += by_b;
        }
    }

    /// The manifold as b sees it: a and b exchanged, and with them the order of the points.
    #[inline]
    #[must_use]
    pub fn flipped(&self) -> Self {
        let flip = |p: ManifoldPoint| ManifoldPoint {
            anchor_a: p.anchor_b,
            anchor_b: p.anchor_a,
            feature: p.feature.flipped(),
            corner: p.corner.flipped(),
            ..p
        };
        let [first, second] = self.points;
        let points = if self.count == 2 { [flip(second), flip(first)] } else { [flip(first), second] };
        Self { normal: -self.normal, points, count: self.count }
    }
}
