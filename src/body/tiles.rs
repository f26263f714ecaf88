//! Ground of square tiles, as few large boxes.
//!
//! Tiles side by side are one box: first along a row as far as it goes, then as many rows as go as far; or the other way round,
//! if that makes fewer. Flush boxes are one ground, whatever their sizes (see `shape::exposure`), so that it does not matter where
//! they meet.

use crate::body::{Body, BodyError, BodyType};
use crate::math::Vec2;
use crate::shape::{MAX_SIZE, MIN_SIZE, Shape, ShapeError};

/// Ground of a map that stays as it is. One that is edited is a [`TileMap`](crate::TileMap).
#[derive(Debug)]
#[non_exhaustive]
pub struct Ground;

impl Ground {
    /// A fixed body of the solid tiles of a map, as few boxes as a simple rule finds.
    ///
    /// `solid` has `width` tiles for each row, from left to right; the lowest row comes first, as y points up. A tile has sides of
    /// `tile_size`, m, and the lower left corner of the map is where the body is [put](Body::at). Material and filter are given as
    /// to any body. Where the last row is not full the rest of it is empty, and with a `width` of 0 there are no tiles. A map
    /// without solid tiles is refused when it is added, and so is a size that no shape can have.
    ///
    /// Places within the body are `f32`: tiles of 1 m meet to 0.1 mm as far as 1 km from the corner. For larger maps, use
    /// a [`TileMap`](crate::TileMap).
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let rows = ["##....##", "########"]; // as it is drawn: the highest row first
    /// let solid: Vec<bool> = rows.iter().rev().flat_map(|row| row.chars().map(|tile| tile == '#')).collect();
    /// let mut world = World::new(Settings::default());
    /// let ground = world.add(Ground::from_tiles(&solid, 8, 1.0).at([-4.0, 0.0]).friction(0.8))?;
    /// assert_eq!(world.body(ground).unwrap().colliders().count(), 3); // the floor, and a wall at each end
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn from_tiles(solid: &[bool], width: usize, tile_size: f32) -> Body {
        let height = if width == 0 { 0 } else { solid.len().div_ceil(width) };
        let is_solid = |[x, y]: [usize; 2]| solid.get(y * width + x).copied().unwrap_or(false);
        body_of_tiles(&boxes_of_tiles([width, height], is_solid), tile_size)
    }
}

/// Tiles that are one box: from where, and how many, along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TileBox {
    pub(crate) from: [usize; 2],
    pub(crate) count: [usize; 2],
}

/// A fixed body of boxes, its middle in the lower left corner of the tile (0, 0).
pub(crate) fn body_of_tiles(boxes: &[TileBox], tile_size: f32) -> Body {
    let length = |tiles: f64| (tiles * f64::from(tile_size)) as f32;
    let middle = |from: usize, count: usize| length(from as f64 + 0.5 * count as f64);
    let pieces = boxes.iter().map(|&TileBox { from: [x, y], count: [columns, rows] }| {
        let shape = Shape::aabb(length(columns as f64), length(rows as f64));
        (shape, Vec2::new(middle(x, columns), middle(y, rows)))
    });
    let mut body = Body::of_placed(BodyType::Fixed, pieces);
    let no_tile = boxes.is_empty().then_some(BodyError::NoSolidTile);
    body.flaw = check_tile_size(tile_size).err().or(no_tile);
    body
}

/// Checks that a tile can have sides of `tile_size`, m.
pub(crate) fn check_tile_size(tile_size: f32) -> Result<(), BodyError> {
    // NaN is not within.
    if (MIN_SIZE..=MAX_SIZE).contains(&tile_size) {
        Ok(())
    } else {
        Err(BodyError::Shape(ShapeError::Size { what: "size of a tile", value: tile_size }))
    }
}

/// Boxes that cover the solid tiles of a map of so many columns and rows, each once.
pub(crate) fn boxes_of_tiles(size: [usize; 2], is_solid: impl Fn([usize; 2]) -> bool) -> Vec<TileBox> {
    let swapped = |[x, y]: [usize; 2]| [y, x];
    let along_rows = grow_boxes(size, &is_solid);
    let along_columns = grow_boxes(swapped(size), |tile| is_solid(swapped(tile)));
    if along_rows.len() <= along_columns.len() {
        return along_rows;
    }
    let swap = |TileBox { from, count }| TileBox { from: swapped(from), count: swapped(count) };
    along_columns.into_iter().map(swap).collect()
}

/// The same, along rows first.
fn grow_boxes([width, height]: [usize; 2], is_solid: impl Fn([usize; 2]) -> bool) -> Vec<TileBox> {
    let mut is_left = Vec::with_capacity(width * height);
    for y in 0..height {
        is_left.extend((0..width).map(|x| is_solid([x, y])));
    }
    let mut boxes = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let columns = (x..width).take_while(|x| is_left[y * width + x]).count();
            if columns == 0 {
                continue;
            }
            let is_whole = |y: &usize| (x..x + columns).all(|x| is_left[y * width + x]);
            let rows = (y..height).take_while(is_whole).count();
            for y in y..y + rows {
                is_left[y * width + x..y * width + x + columns].fill(false);
            }
            boxes.push(TileBox { from: [x, y], count: [columns, rows] });
        }
    }
    boxes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;

    #[test]
    fn boxes_cover_each_solid_tile_once_and_no_other() {
        let mut random = Random(5);
        for round in 0..500_usize {
            let size @ [width, height] = [1 + round % 23, 1 + round % 17];
            let solid: Vec<bool> = (0..width * height).map(|_| random.below(4) > 0).collect();
            let mut covered = vec![0; solid.len()];
            for TileBox { from: [x, y], count: [columns, rows] } in
                boxes_of_tiles(size, |[x, y]| solid[y * width + x])
            {
                for y in y..y + rows {
                    (x..x + columns).for_each(|x| covered[y * width + x] += 1);
                }
            }
            assert!(covered.iter().zip(&solid).all(|(&count, &is_solid)| count == u32::from(is_solid)));
        }
    }

    #[test]
    fn few_boxes_are_enough() {
        assert_eq!(boxes_of_tiles([40, 30], |_| true).len(), 1);
        // A room: its floor and ceiling, or its walls, are whole.
        let room = |[x, y]: [usize; 2]| x == 0 || y == 0 || x == 9 || y == 9;
        assert_eq!(boxes_of_tiles([10, 10], room).len(), 4);
        // Columns: along rows each step of a staircase would be one more box too, but gaps between columns would make many.
        assert_eq!(boxes_of_tiles([9, 20], |[x, _]| x % 2 == 0).len(), 5);
        assert_eq!(boxes_of_tiles([20, 9], |[_, y]| y % 2 == 0).len(), 5);
        assert_eq!(boxes_of_tiles([0, 0], |_| true).len(), 0);
    }
}
