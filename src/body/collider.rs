//! One of the shapes of a body that has several.

use crate::body::error::check_range;
use crate::body::limits::{
    LARGEST_LENGTH, check_friction, check_one_way, check_restitution, check_rolling_resistance,
    check_surface_speed,
};
use crate::body::role::{Own, OwnRole};
use crate::body::{BodyError, Filter, Material, Role};
use crate::math::{Rot, Vec2};
use crate::shape::Shape;

crate::store::id_type! {
    /// Names one of the shapes of a body. A body of one shape has one collider.
    ///
    /// ```
    /// use rustycs::prelude::*;
    ///
    /// let mut world = World::new(Settings::default());
    /// let head = Collider::new(Shape::circle(0.2)).at([0.0, 0.8]).user_data(7);
    /// let hero = world.add(Body::dynamic(Shape::rectangle(0.6, 1.2)).with(head))?;
    /// let shot = world.ray_cast([-5.0, 0.8], [9.0, 0.0]).unwrap();
    /// let shape = world.collider(shot.collider).unwrap();
    /// assert!(shot.body == hero && shape.user_data() == 7, "it hits the head");
    /// # Ok::<(), BodyError>(())
    /// ```
    ColliderId
}

/// A further shape of a body, with its own place, for [`Body::with`](crate::Body::with). What it is not told is as the body is told:
/// density, friction, restitution, filter, and whether it is a sensor, a belt or a one-way floor.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// // A hammer: a wooden handle, and an iron head at its right end.
/// let head = Collider::new(Shape::rectangle(0.2, 0.5)).at([0.6, 0.0]).density(7.8);
/// let hammer = world.add(Body::dynamic(Shape::rectangle(1.0, 0.1)).density(0.6).with(head))?;
/// // Its centre of mass is near the head.
/// assert!(world.body(hammer).unwrap().position().x > 0.5);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collider {
    pub(crate) shape: Shape,
    /// Of the shape's centre, in the frame that the body is described in, m.
    pub(crate) at: Vec2,
    /// rad.
    pub(crate) angle: f32,
    density: Option<f32>,
    friction: Option<f32>,
    restitution: Option<f32>,
    pub(super) role: OwnRole,
    pub(crate) user_data: u64,
}

/// One of several shapes of a body, with all that it has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) shape: Shape,
    pub(crate) at: Vec2,
    pub(crate) angle: f32,
    pub(crate) material: Material,
    pub(crate) role: Role,
    pub(crate) user_data: u64,
}

impl Collider {
    /// A shape in the middle of the frame of the body, of the body's material.
    #[must_use]
    pub fn new(shape: Shape) -> Self {
        Self {
            shape,
            at: Vec2::ZERO,
            angle: 0.0,
            density: None,
            friction: None,
            restitution: None,
            role: OwnRole::default(),
            user_data: 0,
        }
    }

    /// Place of its centre in the frame of the body, m, which turns with the body. The frame begins at the centre of the body's own
    /// shape; of a body of [pieces](crate::Body::dynamic_pieces) it begins where their points count from.
    #[must_use]
    pub fn at(mut self, place: impl Into<Vec2>) -> Self {
        self.at = place.into();
        self
    }

    /// Angle against the body, rad, counter-clockwise. Axis-aligned boxes ignore it.
    #[must_use]
    pub fn angle(mut self, angle: f32) -> Self {
        self.angle = angle;
        self
    }

    /// Density, friction and restitution together.
    #[must_use]
    pub fn material(self, Material { density, friction, restitution }: Material) -> Self {
        self.density(density).friction(friction).restitution(restitution)
    }

    /// Mass per area, kg/m², instead of that of the body.
    #[must_use]
    pub fn density(mut self, density: f32) -> Self {
        self.density = Some(density);
        self
    }

    /// Coefficient of friction instead of that of the body.
    #[must_use]
    pub fn friction(mut self, friction: f32) -> Self {
        self.friction = Some(friction);
        self
    }

    /// Coefficient of restitution, 0 to 1, instead of that of the body.
    #[must_use]
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.restitution = Some(restitution);
        self
    }

    /// What it collides with instead of what the body does, see [`Filter`].
    #[must_use]
    pub fn filter(mut self, filter: Filter) -> Self {
        self.role.filter = Some(filter);
        self
    }

    /// Whether it is a sensor, as [`Body::sensor`](crate::Body::sensor) says: then it weighs nothing.
    #[must_use]
    pub fn sensor(mut self, is_sensor: bool) -> Self {
        self.role.is_sensor = Some(is_sensor);
        self
    }

    /// Makes it a one-way floor, as [`Body::one_way`](crate::Body::one_way) says. The direction turns with the collider.
    #[must_use]
    pub fn one_way(mut self, direction: impl Into<Vec2>) -> Self {
        let direction = direction.into();
        self.role.one_way = Own::Set(Some(direction.direction().unwrap_or(direction)));
        self
    }

    /// Speed of its surface, m/s, as [`Body::surface_speed`](crate::Body::surface_speed) says.
    #[must_use]
    pub fn surface_speed(mut self, speed: f32) -> Self {
        self.role.surface_speed = Some(speed);
        self
    }

    /// Coefficient of rolling resistance, no unit, as [`Body::rolling_resistance`](crate::Body::rolling_resistance) says. It is of
    /// what rolls, a circle around the centre of mass of its body, or of what is rolled on: any other shape.
    #[must_use]
    pub fn rolling_resistance(mut self, coefficient: f32) -> Self {
        self.role.rolling_resistance = Own::Set(Some(coefficient));
        self
    }

    /// A number of the caller's own, which the engine keeps and never reads.
    #[must_use]
    pub fn user_data(mut self, user_data: u64) -> Self {
        self.user_data = user_data;
        self
    }

    /// Its shape; this and the following tell what was given.
    pub fn get_shape(&self) -> &Shape {
        &self.shape
    }

    /// Place of its centre, m.
    pub fn get_position(&self) -> Vec2 {
        self.at
    }

    /// Angle against the body, rad.
    pub fn get_angle(&self) -> f32 {
        self.angle
    }

    /// The caller's own number.
    pub fn get_user_data(&self) -> u64 {
        self.user_data
    }

    /// It on a body of a material and a role.
    pub(crate) fn on(&self, material: Material, of_body: Role) -> Part {
        let Self { shape, at, angle, density, friction, restitution, user_data, .. } = *self;
        let material = Material {
            density: density.unwrap_or(material.density),
            friction: friction.unwrap_or(material.friction),
            restitution: restitution.unwrap_or(material.restitution),
        };
        Part { shape, at, angle, material, role: self.role.on(of_body), user_data }
    }
}

impl Part {
    /// The description of it, with all that it has given.
    pub(crate) fn describe(self) -> Collider {
        let Self { shape, at, angle, material, role, user_data } = self;
        let Material { density, friction, restitution } = material;
        let [density, friction, restitution] = [density, friction, restitution].map(Some);
        Collider { shape, at, angle, density, friction, restitution, role: role.into(), user_data }
    }

    /// How it is turned against the body.
    pub(crate) fn rotation(&self) -> Rot {
        if self.shape.can_rotate() { Rot::from_angle(self.angle) } else { Rot::IDENTITY }
    }

    /// Checks every number of it; the density only where it must weigh something.
    pub(crate) fn validate(&self, must_weigh: bool) -> Result<(), BodyError> {
        self.shape.validate()?;
        for (quantity, value) in [("the x of a collider", self.at.x), ("the y of a collider", self.at.y)] {
            check_range(quantity, f64::from(value), [-LARGEST_LENGTH, LARGEST_LENGTH], "m")?;
        }
        check_range("the angle of a collider", f64::from(self.angle), [-1e6, 1e6], "rad")?;
        let least_density = if must_weigh { 1e-12 } else { 0.0 };
        check_range("the density", f64::from(self.material.density), [least_density, 1e12], "kg/m²")?;
        check_friction(self.material.friction)?;
        check_restitution(self.material.restitution)?;
        check_surface_speed(self.role.surface_speed)?;
        check_one_way(self.role.one_way)?;
        check_rolling_resistance(self.role.rolling_resistance_or_usual())
    }
}

/// What the shapes of a body weigh together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Masses {
    /// kg.
    pub(crate) mass: f32,
    /// About the centre of mass, kg m².
    pub(crate) inertia: f32,
    /// The centre of mass in the frame that the body is described in, m.
    pub(crate) center: Vec2,
}

impl Masses {
    /// Of several shapes. Where they overlap, both weigh; sensors do not, unless all are.
    ///
    /// About the common centre c each has the moment of inertia I + m |x - c|² (parallel axes).
    pub(crate) fn of(parts: &[Part]) -> Self {
        let has_weight = parts.iter().any(|part| !part.role.is_sensor);
        let weights = || {
            parts.iter().filter(|part| !(has_weight && part.role.is_sensor)).map(|part| {
                let of_shape = part.shape.mass_properties(1.0);
                let density = f64::from(part.material.density);
                let [x, y] = [f64::from(part.at.x), f64::from(part.at.y)];
                (density * f64::from(of_shape.mass), density * f64::from(of_shape.inertia), x, y)
            })
        };
        let (mass, x, y) = weights()
            .fold((0.0, 0.0, 0.0), |(mass, x, y), (m, _, at_x, at_y)| (mass + m, x + m * at_x, y + m * at_y));
        if mass == 0.0 {
            return Self::default();
        }
        let (x, y) = (x / mass, y / mass);
        let inertia = weights()
            .map(|(m, inertia, at_x, at_y)| inertia + m * ((at_x - x).powi(2) + (at_y - y).powi(2)))
            .sum::<f64>();
        Self { mass: mass as f32, inertia: inertia as f32, center: Vec2::new(x as f32, y as f32) }
    }
}
