//! Ground of square tiles that is edited: dug, built, blown up.
//!
//! The map is kept in chunks of 16 x 16 tiles, each a fixed body of its own: an edit makes the boxes of one chunk anew. Where
//! chunks meet, the ground is as smooth as within them.

use crate::body::limits::check_place;
use crate::body::{
    Body, BodyError, BodyId, Filter, Material, body_of_tiles, boxes_of_tiles, check_tile_size,
};
use crate::math::Point;
use crate::world::World;

/// Tiles along each side of a chunk: an edit looks at 256 of them, which takes microseconds, and a screen has few chunks.
const CHUNK: usize = 16;

/// Ground of square tiles that can be edited while the world runs. For a map that stays as it is, there is
/// [`Ground::from_tiles`](crate::Ground::from_tiles).
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// let mut map = TileMap::new(&[true; 100 * 2], 100, 0.5).at([-25.0, -1.0]);
/// map.add_to(&mut world)?;
/// // A hole where something was dug.
/// let tile = map.tile_at([3.2, -0.1]).unwrap();
/// map.set(&mut world, tile, false)?;
/// assert!(world.bodies_at([3.2, -0.1]).is_empty());
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TileMap {
    solid: Vec<bool>,
    width: usize,
    height: usize,
    tile_size: f32,
    corner: Point,
    material: Material,
    filter: Filter,
    /// By chunk, row by row; `None` where none of its tiles is solid.
    chunks: Vec<Option<BodyId>>,
    is_added: bool,
}

impl TileMap {
    /// A map, which is in no world yet. The tiles are given as to [`Ground::from_tiles`](crate::Ground::from_tiles): `width` for
    /// each row, the lowest row first, with sides of `tile_size`, m.
    #[must_use]
    pub fn new(solid: &[bool], width: usize, tile_size: f32) -> Self {
        let height = if width == 0 { 0 } else { solid.len().div_ceil(width) };
        let mut solid = solid.to_vec();
        solid.resize(width * height, false);
        let chunks = vec![None; width.div_ceil(CHUNK) * height.div_ceil(CHUNK)];
        let (corner, material, filter) = (Point::ORIGIN, Material::DEFAULT, Filter::DEFAULT);
        Self { solid, width, height, tile_size, corner, material, filter, chunks, is_added: false }
    }

    /// Place of its lower left corner, m; at first the origin. To be told before it is added.
    #[must_use]
    pub fn at(mut self, corner: impl Into<Point>) -> Self {
        self.corner = corner.into();
        self
    }

    /// Material of its tiles. To be told before it is added.
    #[must_use]
    pub fn material(mut self, material: Material) -> Self {
        self.material = material;
        self
    }

    /// What its tiles collide with. To be told before it is added.
    #[must_use]
    pub fn filter(mut self, filter: Filter) -> Self {
        self.filter = filter;
        self
    }

    /// Adds the map to a world. One that was added before has its bodies made anew, in a world that has lost them too.
    ///
    /// # Errors
    /// [`BodyError`], if the size of the tiles is one that no shape can have, the corner is out of range, or a number of the
    /// material is; the map is in no world then.
    pub fn add_to(&mut self, world: &mut World) -> Result<(), BodyError> {
        self.remove_from(world);
        self.check()?;
        self.is_added = true;
        for chunk in 0..self.chunks.len() {
            if let Err(error) = self.make(world, chunk) {
                self.remove_from(world);
                return Err(error);
            }
        }
        Ok(())
    }

    /// Takes the map out of the world that it was added to.
    pub fn remove_from(&mut self, world: &mut World) {
        for body in self.chunks.iter_mut().filter_map(Option::take) {
            world.remove(body);
        }
        self.is_added = false;
    }

    /// Makes a tile solid or empty. The tile is given by its column and row.
    ///
    /// `world` is the one that the map was [added](Self::add_to) to. The body of the tile's chunk is made anew there, and what rests on that
    /// chunk wakes. A map that is in no world changes too, and shows the change once it is added.
    ///
    /// Returns whether the tile has changed. It has not if it was so before, or if it lies beyond the map.
    ///
    /// # Errors
    /// [`BodyError`], if the size of the tiles or the corner of the map is one that [`add_to`](Self::add_to) refuses. The tile stays as it was.
    pub fn set(&mut self, world: &mut World, tile: [usize; 2], is_solid: bool) -> Result<bool, BodyError> {
        self.check()?;
        let Some(index) = self.index_of(tile).filter(|&index| self.solid[index] != is_solid) else {
            return Ok(false);
        };
        self.solid[index] = is_solid;
        if self.is_added {
            let [x, y] = tile.map(|at| at / CHUNK);
            let chunk = y * self.width.div_ceil(CHUNK) + x;
            self.make(world, chunk).inspect_err(|_| self.solid[index] = !is_solid)?;
        }
        Ok(true)
    }

    /// Whether a tile, by its column and row, is solid; not beyond the map.
    pub fn is_solid(&self, tile: [usize; 2]) -> bool {
        self.index_of(tile).is_some_and(|index| self.solid[index])
    }

    /// Column and row of the tile at a place, m; `None` beyond the map.
    pub fn tile_at(&self, place: impl Into<Point>) -> Option<[usize; 2]> {
        let (Point { x, y }, size) = (place.into(), f64::from(self.tile_size));
        let [column, row] =
            [x - self.corner.x, y - self.corner.y].map(|from_corner| (from_corner / size).floor());
        // NaN is not within.
        let is_within = column >= 0.0 && column < self.width as f64 && row >= 0.0 && row < self.height as f64;
        is_within.then_some([column as usize, row as usize])
    }

    /// The middle of a tile, m, by its column and row.
    pub fn center_of(&self, tile: [usize; 2]) -> Point {
        let [x, y] = tile.map(|at| (at as f64 + 0.5) * f64::from(self.tile_size));
        Point::new(self.corner.x + x, self.corner.y + y)
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// The bodies that it consists of, one for each chunk that has solid tiles.
    pub fn bodies(&self) -> impl Iterator<Item = BodyId> {
        self.chunks.iter().filter_map(|chunk| *chunk)
    }

    /// Checks what all tiles share.
    fn check(&self) -> Result<(), BodyError> {
        check_tile_size(self.tile_size)?;
        check_place(self.corner)
    }

    fn index_of(&self, [x, y]: [usize; 2]) -> Option<usize> {
        (x < self.width && y < self.height).then(|| y * self.width + x)
    }

    /// Puts what a chunk is now in the place of the body that it was.
    fn make(&mut self, world: &mut World, chunk: usize) -> Result<(), BodyError> {
        let body = self.body_of(chunk).map(|body| world.add(body)).transpose()?;
        if let Some(old) = std::mem::replace(&mut self.chunks[chunk], body) {
            world.remove(old);
        }
        Ok(())
    }

    fn body_of(&self, chunk: usize) -> Option<Body> {
        let columns = self.width.div_ceil(CHUNK);
        let first = [chunk % columns, chunk / columns].map(|at| at * CHUNK);
        let size = [(self.width - first[0]).min(CHUNK), (self.height - first[1]).min(CHUNK)];
        let boxes = boxes_of_tiles(size, |[x, y]| self.is_solid([first[0] + x, first[1] + y]));
        let [x, y] = first.map(|at| at as f64 * f64::from(self.tile_size));
        let corner = Point::new(self.corner.x + x, self.corner.y + y);
        let body = || body_of_tiles(&boxes, self.tile_size).at(corner);
        (!boxes.is_empty()).then(|| body().material(self.material).filter(self.filter))
    }
}
