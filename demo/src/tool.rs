//! What the left mouse button does in the scene, and what it makes.

use rustycs::math::trig::sin_cos;
use rustycs::{Attractor, Body, Material, Point, Shape, Vec2, World};

use crate::theme;

/// What the left mouse button does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Drags bodies by a spring, and the picture where there is no body.
    Hand,
    Circle,
    /// A box that never turns.
    Aabb,
    Obb,
    Polygon,
    /// An attractor that pulls from any distance.
    Global,
    /// An attractor with a range.
    Local,
    /// Removes bodies and attractors.
    Eraser,
}

impl Tool {
    /// Every tool, as they lie beside each other in the panel.
    pub(crate) const ROWS: [[Self; 2]; 4] = [
        [Self::Hand, Self::Eraser],
        [Self::Circle, Self::Polygon],
        [Self::Aabb, Self::Obb],
        [Self::Global, Self::Local],
    ];

    /// The digit that chooses it.
    pub(crate) fn digit(self) -> u8 {
        self as u8 + 1
    }

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Hand => "drag",
            Self::Circle => "circle",
            Self::Aabb => "upright",
            Self::Obb => "box",
            Self::Polygon => "polygon",
            Self::Global => "attractor",
            Self::Local => "local",
            Self::Eraser => "delete",
        }
    }

    /// Whether it adds something to the world.
    pub(crate) fn makes(self) -> bool {
        !matches!(self, Self::Hand | Self::Eraser)
    }
}

/// Corners of a polygon that is made.
const CORNERS: [u32; 2] = [3, 8];
/// Sizes that the keys go through, m: 2^(n/2).
const SIZES: [f32; 13] = [0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1, 1.6, 2.2, 3.2];
/// Bodies made at once.
const COUNTS: [u32; 4] = [1, 10, 100, 1000];
/// Distance, in units of its size, at which an attractor pulls as the Earth's gravity does: one of the usual size
/// lifts what is within 4.4 m off the ground.
const REACH: f32 = 11.0;
/// Gravity on the Earth, m/s².
const EARTH: f32 = 9.81;
/// Range of a local attractor in units of its size.
const RANGE: f32 = 6.0;

/// What is made where one clicks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mould {
    pub(crate) tool: Tool,
    size: usize,
    corners: u32,
    material: usize,
    count: usize,
    pub(crate) is_fixed: bool,
}

impl Default for Mould {
    fn default() -> Self {
        Self { tool: Tool::Hand, size: 6, corners: 5, material: 0, count: 0, is_fixed: false }
    }
}

/// An index moved by some places, without leaving its list.
fn moved(index: usize, by: i32, len: usize) -> usize {
    index.saturating_add_signed(by as isize).min(len - 1)
}

impl Mould {
    /// Radius of circles and polygons, half the width of boxes, m.
    pub(crate) fn size(self) -> f32 {
        SIZES[self.size]
    }

    pub(crate) fn resize(&mut self, by: i32) {
        self.size = moved(self.size, by, SIZES.len());
    }

    pub(crate) fn corners(self) -> u32 {
        self.corners
    }

    pub(crate) fn change_corners(&mut self, by: i32) {
        self.corners = self.corners.saturating_add_signed(by).clamp(CORNERS[0], CORNERS[1]);
    }

    pub(crate) fn count(self) -> u32 {
        COUNTS[self.count]
    }

    pub(crate) fn change_count(&mut self, by: i32) {
        self.count = moved(self.count, by, COUNTS.len());
    }

    /// The material, with its name.
    pub(crate) fn material(self) -> (Material, &'static str) {
        let (material, name, _) = theme::MATERIALS[self.material];
        (material, name)
    }

    /// Another material, round the end of the list.
    pub(crate) fn change_material(&mut self, by: i32) {
        let len = theme::MATERIALS.len() as i32;
        self.material = (self.material as i32 + by).rem_euclid(len) as usize;
    }

    /// A dynamic body of about a size, m: the shapes and materials in turn.
    pub(crate) fn add_small(world: &mut World, place: Point, size: f32, turn: u32) {
        let shapes = [Shape::circle(size), Shape::obb(1.6 * size, 1.6 * size), regular(5, size)];
        let shape = shapes[turn as usize % shapes.len()];
        let (material, ..) = theme::MATERIALS[turn as usize / shapes.len() % theme::MATERIALS.len()];
        // Where there is no room for it in the world (a place that is absurdly far) it is left out.
        world.add(Body::dynamic(shape).at(place).material(material)).ok();
    }

    /// The shape that is made, if it is one.
    pub(crate) fn shape(self) -> Option<Shape> {
        let size = self.size();
        match self.tool {
            Tool::Circle => Some(Shape::circle(size)),
            Tool::Aabb => Some(Shape::aabb(2.0 * size, 1.4 * size)),
            Tool::Obb => Some(Shape::obb(2.0 * size, 1.2 * size)),
            Tool::Polygon => Some(regular(self.corners, size)),
            Tool::Hand | Tool::Global | Tool::Local | Tool::Eraser => None,
        }
    }

    /// Distance at which an attractor that is made pulls as the Earth's gravity does, m.
    pub(crate) fn reach(self) -> f32 {
        REACH * self.size()
    }

    /// Where what is made by a click at a place comes to lie, m: there, or in a square around it, of which the places are
    /// left out where something lies already.
    pub(crate) fn places(self, world: &World, place: Point) -> Vec<Point> {
        if self.count() == 1 {
            return vec![place];
        }
        let reach = self.shape().map_or(0.0, |shape| shape.extent());
        let side = f64::from(self.count()).sqrt().ceil() as u32;
        let pitch = 2.1 * reach;
        let first = place + Vec2::splat(-0.5 * pitch * (side - 1) as f32);
        let places = (0..self.count())
            .map(|index| first + Vec2::new((index % side) as f32, (index / side) as f32) * pitch);
        let is_free = |place: &Point| {
            world.bodies_in(*place + Vec2::splat(-reach), *place + Vec2::splat(reach)).is_empty()
        };
        places.filter(is_free).collect()
    }

    /// The attractor that is made, if it is one.
    pub(crate) fn attractor(self, place: Point, gravitational_constant: f32) -> Option<Attractor> {
        let mass = EARTH * self.reach() * self.reach() / gravitational_constant.max(1e-6);
        let range = match self.tool {
            Tool::Global => None,
            Tool::Local => Some(RANGE * self.size()),
            _ => return None,
        };
        Attractor::try_new(place, mass, range).ok()
    }

    /// Adds what is made to a world, moving at `velocity`. Whether there was anything to add, and room for it.
    pub(crate) fn cast(self, world: &mut World, place: Point, velocity: Vec2) -> bool {
        if let Some(attractor) = self.attractor(place, world.settings().gravitational_constant) {
            world.add_attractor(attractor);
            return true;
        }
        let Some(shape) = self.shape() else { return false };
        let (material, _) = self.material();
        let mut is_any = false;
        for place in self.places(world, place) {
            let body = if self.is_fixed { Body::fixed(shape) } else { Body::dynamic(shape) };
            is_any |= world.add(body.at(place).velocity(velocity).material(material)).is_ok();
        }
        is_any
    }
}

/// A polygon with equal sides in a circle of a radius, m.
fn regular(corners: u32, radius: f32) -> Shape {
    let step = core::f32::consts::TAU / corners as f32;
    let corner = |index: u32| {
        let (sin, cos) = sin_cos(index as f32 * step + 0.3);
        Vec2::new(cos, sin) * radius
    };
    Shape::polygon((0..corners).map(corner)).expect("a regular polygon is convex")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::Settings;

    #[test]
    fn an_attractor_of_the_usual_size_lifts_a_body_three_metres_below_it() {
        let mut world = World::new(Settings::default());
        world.add_force(rustycs::Force::EARTH_GRAVITY);
        let ball = world.add(Body::dynamic(Shape::circle(0.4))).unwrap();
        let mould = Mould { tool: Tool::Global, ..Mould::default() };
        mould.cast(&mut world, Point::new(0.0, 3.0), Vec2::ZERO);
        for _ in 0..30 {
            world.step();
        }
        // 9.81 (11 · 0.4 / 3)² - 9.81 = 11.3 m/s² at the start, and more on the way.
        assert!(world.body(ball).unwrap().position().y > 0.5 * 11.3 * 0.25);
    }

    #[test]
    fn many_bodies_are_not_put_into_a_wall() {
        let mut world = World::new(Settings::default());
        world.add(Body::fixed(Shape::aabb(1.0, 40.0))).unwrap();
        let mut mould = Mould { tool: Tool::Circle, ..Mould::default() };
        mould.change_count(2);
        assert!(mould.cast(&mut world, Point::ORIGIN, Vec2::ZERO));
        assert!((50..100).contains(&world.body_count()), "{}", world.body_count());
        world.step();
        assert_eq!(world.contacts().filter(rustycs::ContactRef::is_touching).count(), 0);
    }

    #[test]
    fn every_tool_that_makes_something_does() {
        for tool in Tool::ROWS.into_iter().flatten() {
            let mut world = World::new(Settings::default());
            let mut mould = Mould { tool, ..Mould::default() };
            mould.change_count(1);
            assert_eq!(mould.cast(&mut world, Point::ORIGIN, Vec2::ZERO), tool.makes());
            let made = world.body_count() + world.attractors().count();
            let expected = match tool {
                Tool::Hand | Tool::Eraser => 0,
                Tool::Global | Tool::Local => 1,
                _ => 10,
            };
            assert_eq!(made, expected, "{}", tool.name());
            world.step();
            // They are apart.
            assert_eq!(world.contacts().count(), 0);
        }
    }
}
