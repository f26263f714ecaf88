//! Bodies that are made of pieces, each at its own place in the frame of the body.

use crate::body::{Body, BodyError, BodyType, Collider};
use crate::math::Vec2;
use crate::shape::Shape;

impl Body {
    /// A body of the pieces that [`Shape::concave`] or [`Shape::with_holes`] divide an outline into, each where it was: polygons
    /// where their points were given, other shapes in the middle.
    ///
    /// [`at`](Self::at) and [`angle`](Self::angle) tell where the frame of the points goes: a body that is given neither is where
    /// its points were. Its [position](crate::BodyRef::position) is the centre of mass, and its
    /// [`origin`](crate::BodyRef::origin) where that frame is. The pieces are [several shapes](Self::with) of one body, of its
    /// material and filter; how many is limited by memory only. Without any the body is refused when it is added.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let letter = Shape::concave([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]])?;
    /// let id = world.add(Body::dynamic_pieces(letter).at([5.0, 0.0]).density(2.0))?;
    /// let body = world.body(id).unwrap();
    /// assert_eq!(body.mass(), 2.0 * 4.0);
    /// assert!((body.position().x - 5.75).abs() < 1e-6); // of 2 m² each, with their middles at 0.5 and 1 m
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn dynamic_pieces(pieces: impl IntoIterator<Item = Shape>) -> Self {
        Self::of_pieces(BodyType::Dynamic, pieces)
    }

    /// The same that never moves: ground, rooms.
    #[must_use]
    pub fn fixed_pieces(pieces: impl IntoIterator<Item = Shape>) -> Self {
        Self::of_pieces(BodyType::Fixed, pieces)
    }

    /// The same that moves with the velocity it is told.
    #[must_use]
    pub fn kinematic_pieces(pieces: impl IntoIterator<Item = Shape>) -> Self {
        Self::of_pieces(BodyType::Kinematic, pieces)
    }

    /// A body of shapes at places in its frame, m.
    pub(super) fn of_placed(body_type: BodyType, shapes: impl IntoIterator<Item = (Shape, Vec2)>) -> Self {
        let mut shapes = shapes.into_iter();
        let own = shapes.next();
        let (shape, own_at) = own.unwrap_or((Shape::circle(0.0), Vec2::ZERO));
        let flaw = own.is_none().then_some(BodyError::NoShape);
        let further = shapes.map(|(shape, at)| Collider::new(shape).at(at)).collect();
        Self { own_at, further, flaw, ..Self::new(body_type, shape) }
    }

    fn of_pieces(body_type: BodyType, pieces: impl IntoIterator<Item = Shape>) -> Self {
        Self::of_placed(body_type, pieces.into_iter().map(|piece| (piece, piece.place_of_input())))
    }
}
