//! A world as lines, for a game to draw in its own renderer.

use crate::body::BodyType;
use crate::math::{Point, Pose, Rot, Vec2};
use crate::shape::Shape;
use crate::world::{BodyRef, ContactRef, World};

/// How many lines a circle is drawn with.
const LINES_OF_CIRCLE: usize = 24;

/// Length of the line that shows the normal of a contact, as a share of the extent of the smaller body, no unit.
const NORMAL_SHARE: f32 = 0.5;

/// What a line of [`World::draw_lines`] belongs to: choose a colour by it.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)))?;
/// world.add(Body::fixed(Shape::circle(3.0)).sensor(true))?;
/// let (mut solid, mut zones) = (Vec::new(), Vec::new());
/// world.draw_lines(1.0, |part, from, to| match part {
///     DrawnPart::Body(_) | DrawnPart::SleepingBody => solid.push([from, to]),
///     DrawnPart::Sensor => zones.push([from, to]),
///     _ => {}
/// });
/// assert!(solid.len() == 4 && zones.len() > 12);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DrawnPart {
    /// The outline of a body of this type that is awake, or fixed.
    Body(BodyType),
    /// The outline of a body that sleeps.
    SleepingBody,
    /// The outline of a sensor.
    Sensor,
    /// The normal of a contact of bodies that touch, from one of its points on.
    Contact,
    /// From the anchor of a joint on one body to that on the other; of a pulley by way of its wheels.
    Joint,
}

impl World {
    /// Tells all that there is as lines, from place to place: outlines of bodies, contacts, and joints. Bodies are where they are
    /// `alpha` of the way from the tick before to the last, see [`alpha`](Self::alpha); 1 is the last. Circles have a radius, by
    /// which their turning shows. It allocates nothing.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// # world.add(Body::dynamic(Shape::rectangle(1.0, 1.0)))?;
    /// # let mut lines = 0;
    /// # struct Colour; const GREY: Colour = Colour; const RED: Colour = Colour; const GREEN: Colour = Colour;
    /// # let mut draw_line = |_: [f64; 4], _: Colour| lines += 1;
    /// world.draw_lines(world.alpha(), |part, from, to| {
    ///     let colour = match part {
    ///         DrawnPart::Body(BodyType::Dynamic) => GREEN,
    ///         DrawnPart::Contact => RED,
    ///         _ => GREY,
    ///     };
    ///     draw_line([from.x, from.y, to.x, to.y], colour);
    /// });
    /// # assert_eq!(lines, 4);
    /// # Ok::<(), BodyError>(())
    /// ```
    pub fn draw_lines(&self, alpha: f32, mut line: impl FnMut(DrawnPart, Point, Point)) {
        for (_, body) in self.bodies() {
            let part = part_of(&body);
            for collider in body.colliders() {
                let part = if collider.is_sensor() { DrawnPart::Sensor } else { part };
                draw_outline(collider.shape(), collider.interpolated_pose(alpha), |from, to| {
                    line(part, from, to);
                });
            }
        }
        for contact in self.contacts().filter(ContactRef::is_touching) {
            let extents =
                [contact.a(), contact.b()].map(|id| self.body(id).map(|body| body.shape().extent()));
            let extent = extents.into_iter().flatten().fold(f32::INFINITY, f32::min);
            for place in contact.positions() {
                line(DrawnPart::Contact, place, place + contact.normal() * (NORMAL_SHARE * extent));
            }
        }
        for (_, joint) in self.joints() {
            let [a, b] = joint.anchors();
            let mut from = a;
            for to in joint.wheels().into_iter().flatten().chain([b]) {
                line(DrawnPart::Joint, from, to);
                from = to;
            }
        }
    }
}

fn part_of(body: &BodyRef<'_>) -> DrawnPart {
    if body.is_sensor() {
        DrawnPart::Sensor
    } else if body.is_sleeping() {
        DrawnPart::SleepingBody
    } else {
        DrawnPart::Body(body.body_type())
    }
}

fn draw_outline(shape: &Shape, pose: Pose, mut line: impl FnMut(Point, Point)) {
    let mut circle = [Vec2::ZERO; LINES_OF_CIRCLE];
    if let Shape::Rounded(rounded) = shape {
        let (mut last, mut first) = (None, None);
        for corner in rounded.outline().map(|corner| pose.to_world(corner)) {
            first = first.or(Some(corner));
            if let Some(last) = last.replace(corner) {
                line(last, corner);
            }
        }
        if let (Some(last), Some(first)) = (last, first) {
            line(last, first);
        }
        return;
    }
    let corners = match shape.radius() {
        None => shape.vertices(),
        Some(radius) => {
            let step = Rot::from_angle(core::f32::consts::TAU / LINES_OF_CIRCLE as f32);
            let mut corner = Vec2::new(radius, 0.0);
            for place in &mut circle {
                *place = corner;
                corner = step.rotate(corner);
            }
            line(pose.center, pose.to_world(circle[0]));
            &circle[..]
        }
    };
    if let &[from, to] = corners {
        return line(pose.to_world(from), pose.to_world(to));
    }
    for (number, &corner) in corners.iter().enumerate() {
        let next = corners[(number + 1) % corners.len()];
        line(pose.to_world(corner), pose.to_world(next));
    }
}
