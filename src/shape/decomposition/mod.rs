//! Concave outlines, with holes or without, as convex pieces.
//!
//! Once, when a body is made; never in the step. Every decision about the outline is exact, see `orientation`. Thousands of points
//! take tens of milliseconds; the time grows as n log n where a line meets few edges and triangles need few exchanges, and as n² at worst:
//! of a gear of 16,000 points about nine times as long as of one of 4,000.
//!
//! 1. Check: no point twice, no edges that cross or touch, an area.
//! 2. Cut into parts that are monotone, then into triangles, then exchange diagonals so that few are thin.
//! 3. Join triangles to pieces that are convex and have at most [`MAX_VERTICES`](crate::shape::MAX_VERTICES) corners.

mod crossings;
mod monotone;
mod orientation;
mod pieces;
mod rings;
#[cfg(test)]
mod tests;
mod triangles;

pub use rings::MAX_OUTLINE_POINTS;

use crate::math::Vec2;
use crate::shape::{Shape, ShapeError};
use monotone::cut_into_monotone;
use pieces::pieces_of;
use rings::rings_of;
use triangles::Triangles;

impl Shape {
    /// Convex pieces that make up an outline of any form, from its points in order, m, either way round, anywhere: at most
    /// 65,536 of them. Flush pieces of one body have no inner edges that anything could be caught at.
    ///
    /// [`Body::dynamic_pieces`](crate::Body::dynamic_pieces) and its like make a body of them. Each piece is a
    /// [`Shape::Polygon`] of 3 to 8 corners, and [`Polygon::centroid_of_input`](crate::shape::Polygon::centroid_of_input) tells
    /// where its centre was. No corners are added; there are at most about four times as many pieces as a division without
    /// a limit of corners needs. What is thinner than 1e-5 of its length, or than 1e-5 m, and would be refused as a polygon, is
    /// left out.
    ///
    /// # Errors
    ///
    /// Refuses coordinates that are not finite, fewer than 3 points, a point that is given twice (the first again at the end
    /// too), edges that cross or touch, and an area that is too small for its size; the error names the points and edges.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let arrow = Shape::concave([[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]])?;
    /// assert_eq!(arrow.len(), 2);
    /// assert_eq!(arrow.iter().map(Shape::area).sum::<f32>(), 1.0);
    ///
    /// let crossed = Shape::concave([[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 2.0]]).unwrap_err();
    /// println!("{crossed}"); // edge 0 of the outline crosses or touches edge 2 of the outline ...
    /// # assert!(crossed.to_string().starts_with("edge 0 of the outline crosses or touches edge 2 of the outline"));
    /// # Ok::<(), ShapeError>(())
    /// ```
    pub fn concave<P: Into<Vec2>>(outline: impl IntoIterator<Item = P>) -> Result<Vec<Self>, ShapeError> {
        pieces(read(outline), Vec::new())
    }

    /// The same of an outline with holes, which lie in it and neither touch it nor each other.
    ///
    /// # Errors
    ///
    /// As of [`concave`](Self::concave); and a hole that is not in the outline, or in another hole.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let square = |half: f32| [[-half, -half], [half, -half], [half, half], [-half, half]];
    /// let frame = Shape::with_holes(square(2.0), [square(1.0)])?;
    /// assert_eq!(frame.iter().map(Shape::area).sum::<f32>(), 12.0);
    /// # Ok::<(), ShapeError>(())
    /// ```
    pub fn with_holes<P: Into<Vec2>, Q: Into<Vec2>, H: IntoIterator<Item = Q>>(
        outline: impl IntoIterator<Item = P>,
        holes: impl IntoIterator<Item = H>,
    ) -> Result<Vec<Self>, ShapeError> {
        // Each hole has points, so that more holes are too many points.
        let holes = holes.into_iter().take(MAX_OUTLINE_POINTS + 1).map(read).collect();
        pieces(read(outline), holes)
    }
}

/// The points of a ring; of too many only one too many.
fn read<P: Into<Vec2>>(points: impl IntoIterator<Item = P>) -> Vec<Vec2> {
    points.into_iter().take(MAX_OUTLINE_POINTS + 1).map(Into::into).collect()
}

fn pieces(outline: Vec<Vec2>, holes: Vec<Vec<Vec2>>) -> Result<Vec<Shape>, ShapeError> {
    let mut nodes = rings_of(outline, holes)?;
    cut_into_monotone(&mut nodes);
    let triangles = Triangles::new(&nodes);
    // A piece that is no polygon is all but a line, or too thin for any shape.
    let mut refused = None;
    let polygon = |outline| {
        let shape = Shape::polygon(outline).and_then(|shape| shape.validate().map(|()| shape));
        shape.map_err(|error| refused = Some(error)).ok()
    };
    let shapes: Vec<Shape> = pieces_of(&triangles).into_iter().filter_map(polygon).collect();
    match refused {
        Some(error) if shapes.is_empty() => Err(error),
        _ => Ok(shapes),
    }
}
