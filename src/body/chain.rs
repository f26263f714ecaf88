//! Ground of lines: chains, solid on one side, whose links know each other.
//!
//! A link is a segment and a one-way floor in one: as a segment it tells which normals its corners allow (see `shape::exposure`),
//! as a one-way floor whether what is near it came from its free side (see `collision::one_way`).

use crate::body::{Body, BodyType, Ground};
use crate::math::Vec2;
use crate::shape::{Segment, Shape, ShapeError};

impl Ground {
    /// A fixed body of lines from each of some points, m, to the next: hills, caves, roads.
    ///
    /// It is solid on the left, for who walks along the points from the first to the last: listed from left to right it bears what
    /// comes from above. Nothing stops what comes from the right: it passes, and is met again once it has left and comes
    /// back. What slides along the chain does not feel where its links meet; where the chain falls away it rolls over the
    /// corner, at the ends as well.
    ///
    /// Points count from where the body is [put](Body::at). What else it is told, as [friction](Body::friction) or
    /// [surface speed](Body::surface_speed), holds for all links. There may be as many points as memory holds, and each step looks
    /// only at what is near bodies that move. Places within the body are `f32`: links of 1 m meet to 0.1 mm as far as 1 km from there.
    /// To all queries both sides of a link are the same. Where an end is flush with other ground, it goes on there for what is on the
    /// left. A shape that is put into a link by less than a quarter of its width, its own centre on the left, is pushed out there.
    ///
    /// # Errors
    /// Refuses fewer than two points, coordinates that are not finite, and points that are the same as the one before or farther
    /// from it than a shape may be long.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// world.add_force(Force::EARTH_GRAVITY);
    /// let height = |x: f32| 0.05 * (x - 5.0) * (x - 5.0); // a valley
    /// let points = (0..=100).map(|number| 0.1 * number as f32).map(|x| [x, height(x)]);
    /// world.add(Ground::chain(points)?.friction(0.8))?;
    /// let ball = world.add(Body::dynamic(Shape::circle(0.2)).at([2.0, 1.0]))?;
    /// for _ in 0..600 {
    ///     world.step();
    /// }
    /// assert!((world.body(ball).unwrap().position().y - 0.2).abs() < 0.3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn chain<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Result<Body, ShapeError> {
        Self::of_links(points, false)
    }

    /// The same that goes on from the last point to the first.
    ///
    /// It is solid on the left as well: points listed counter-clockwise make a room, which holds what is within, and points listed
    /// clockwise a hill or an island, which keeps out what is around it.
    ///
    /// # Errors
    /// As of [`chain`](Self::chain), fewer than three points, and points that all lie on one line, to 1e-5 of its length: such a ring has no
    /// inside.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// world.add_force(Force::EARTH_GRAVITY);
    /// let room = world.add(Ground::ring([[-5.0, 0.0], [5.0, 0.0], [5.0, 3.0], [-5.0, 3.0]])?)?;
    /// let ball = world.add(Body::dynamic(Shape::circle(0.2)).at([0.0, 1.0]).velocity([9.0, 4.0]))?;
    /// for _ in 0..600 {
    ///     world.step();
    /// }
    /// assert!(world.body(room).unwrap().aabb().contains_point(world.body(ball).unwrap().pose().center));
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn ring<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Result<Body, ShapeError> {
        Self::of_links(points, true)
    }

    fn of_links<P: Into<Vec2>>(
        points: impl IntoIterator<Item = P>,
        is_ring: bool,
    ) -> Result<Body, ShapeError> {
        let points: Vec<Vec2> = points.into_iter().map(Into::into).collect();
        let links = Segment::chain(&points, is_ring)?;
        let placed = links.iter().map(|link| (Shape::Segment(*link), link.centroid_of_input()));
        let mut body = Body::of_placed(BodyType::Fixed, placed);
        let mut left = links.iter().map(Segment::left);
        body.role.one_way = left.next();
        body.further = body.further.into_iter().zip(left).map(|(link, left)| link.one_way(left)).collect();
        Ok(body)
    }
}
