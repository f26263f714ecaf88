//! The description of a body, from which a world makes one.

use crate::body::collider::{Collider, Masses, Part};
use crate::body::error::check_range;
use crate::body::limits::{
    INERTIAS, MASSES, check_damping, check_gravity_scale, check_place, check_strength, check_vector,
};
use crate::body::{BodyError, BodyType, Filter, Material, Role};
use crate::math::{Point, Pose, Vec2};
use crate::shape::Shape;

/// A body to be added to a world: a shape with a place, a motion and a material.
///
/// ```
/// use rustycs::prelude::*;
///
/// let crate_of_stone = Body::dynamic(Shape::obb(1.0, 0.5))
///     .at([3.0, 2.0])
///     .angle(0.3)
///     .material(Material::STONE)
///     .friction(0.9);
/// # let mut world = World::new(Settings::default());
/// # world.add(crate_of_stone).unwrap();
/// ```
///
/// Nothing is checked here: [`World::add`](crate::World::add) checks all of it at once, each number that was given, whether
/// or not a body of this kind has a use for it. What a body ignores is said at each method.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(crate) body_type: BodyType,
    pub(crate) shape: Shape,
    pub(crate) center: Point,
    pub(crate) angle: f32,
    pub(crate) velocity: Vec2,
    pub(crate) angular_velocity: f32,
    pub(crate) material: Material,
    pub(crate) mass: Option<f32>,
    pub(crate) fixed_rotation: bool,
    pub(crate) gravity_scale: f32,
    pub(crate) linear_damping: f32,
    pub(crate) angular_damping: f32,
    pub(crate) may_sleep: bool,
    pub(crate) user_data: u64,
    pub(crate) role: Role,
    /// Where its own shape is in the frame that its shapes are described in, m: in the middle, but of a body made of pieces.
    pub(crate) own_at: Vec2,
    /// Its shapes beside its own.
    pub(crate) further: Vec<Collider>,
    /// Why what it was made of makes no body.
    pub(crate) flaw: Option<BodyError>,
}

impl Body {
    pub(super) fn new(body_type: BodyType, shape: Shape) -> Self {
        Self {
            body_type,
            shape,
            center: Point::ORIGIN,
            angle: 0.0,
            velocity: Vec2::ZERO,
            angular_velocity: 0.0,
            material: Material::DEFAULT,
            mass: None,
            fixed_rotation: false,
            gravity_scale: 1.0,
            linear_damping: 0.0,
            angular_damping: 0.0,
            may_sleep: true,
            user_data: 0,
            role: Role::default(),
            own_at: Vec2::ZERO,
            further: Vec::new(),
            flaw: None,
        }
    }

    /// A body that forces and contacts move.
    #[must_use]
    pub fn dynamic(shape: Shape) -> Self {
        Self::new(BodyType::Dynamic, shape)
    }

    /// A body that never moves: ground, walls.
    #[must_use]
    pub fn fixed(shape: Shape) -> Self {
        Self::new(BodyType::Fixed, shape)
    }

    /// A body that moves with the velocity it is told: lifts, paddles.
    #[must_use]
    pub fn kinematic(shape: Shape) -> Self {
        Self::new(BodyType::Kinematic, shape)
    }

    /// Place of the centre of mass, m; of the body's own shape, if it has [several](Self::with); of the frame of the points, if
    /// it is made of [pieces](Self::dynamic_pieces).
    #[must_use]
    pub fn at(mut self, center: impl Into<Point>) -> Self {
        self.center = center.into();
        self
    }

    /// Angle, rad, counter-clockwise. Axis-aligned boxes ignore it.
    #[must_use]
    pub fn angle(mut self, angle: f32) -> Self {
        self.angle = angle;
        self
    }

    /// Velocity, m/s. Fixed bodies ignore it.
    #[must_use]
    pub fn velocity(mut self, velocity: impl Into<Vec2>) -> Self {
        self.velocity = velocity.into();
        self
    }

    /// Angular velocity, rad/s, counter-clockwise. Fixed bodies, axis-aligned boxes and bodies with
    /// [fixed rotation](Self::fixed_rotation) ignore it.
    #[must_use]
    pub fn angular_velocity(mut self, angular_velocity: f32) -> Self {
        self.angular_velocity = angular_velocity;
        self
    }

    /// Density, friction and restitution together.
    #[must_use]
    pub fn material(mut self, material: Material) -> Self {
        self.material = material;
        self
    }

    /// Mass per area, kg/m², instead of the material's. Fixed and kinematic bodies have no use for it, and take 0 too.
    #[must_use]
    pub fn density(mut self, density: f32) -> Self {
        self.material.density = density;
        self
    }

    /// Coefficient of friction instead of the material's. That of a contact is mixed of those of both bodies, by
    /// [`Settings::friction_mix`](crate::Settings::friction_mix): by default their average, and 0 where one of them is 0: such a body
    /// slides freely on everything.
    #[must_use]
    pub fn friction(mut self, friction: f32) -> Self {
        self.material.friction = friction;
        self
    }

    /// Coefficient of restitution, 0 to 1, instead of the material's. That of a contact is mixed of those of both bodies, by
    /// [`Settings::restitution_mix`](crate::Settings::restitution_mix): by default their average, and 0 where one of them is 0: such a
    /// body bounces off nothing.
    ///
    /// Where two bodies press on each other, as what lies on the floor does, only a blow bounces that is more than that load takes in a substep, and
    /// no blow that comes through from another body: a ball that falls on one that lies on the floor gives it its momentum, and the floor takes
    /// that. In weightlessness it comes back.
    #[must_use]
    pub fn restitution(mut self, restitution: f32) -> Self {
        self.material.restitution = restitution;
        self
    }

    /// Mass, kg, instead of density times area; the moment of inertia scales with it. Fixed and kinematic bodies have no use
    /// for it before they become dynamic.
    #[must_use]
    pub fn mass(mut self, mass: f32) -> Self {
        self.mass = Some(mass);
        self
    }

    /// Whether the body never turns: it keeps the angle it is given, and a spin that it is given is ignored. For something that
    /// turns whatever it touches, use a kinematic body.
    #[must_use]
    pub fn fixed_rotation(mut self, fixed: bool) -> Self {
        self.fixed_rotation = fixed;
        self
    }

    /// Factor on the world's forces (not on attractors); 0 floats, -1 rises. Only dynamic bodies are moved by them.
    #[must_use]
    pub fn gravity_scale(mut self, scale: f32) -> Self {
        self.gravity_scale = scale;
        self
    }

    /// Linear damping, 1/s: left alone, the velocity falls by the factor e in 1/damping seconds.
    #[must_use]
    pub fn linear_damping(mut self, damping: f32) -> Self {
        self.linear_damping = damping;
        self
    }

    /// Angular damping, 1/s: left alone, the angular velocity falls by the factor e in 1/damping seconds.
    #[must_use]
    pub fn angular_damping(mut self, damping: f32) -> Self {
        self.angular_damping = damping;
        self
    }

    /// Whether the body may be put to sleep once it is at rest; where it may not, neither may what it touches. Default true.
    #[must_use]
    pub fn may_sleep(mut self, may_sleep: bool) -> Self {
        self.may_sleep = may_sleep;
        self
    }

    /// Gives the body one more shape. Together they move as one; where they overlap, both weigh.
    ///
    /// [`at`](Self::at) and [`angle`](Self::angle) tell where the frame goes that the shapes are described in, with the body's own
    /// shape in the middle. The [position](crate::BodyRef::position) of a dynamic body is its centre of mass as always, which
    /// is elsewhere as a rule; one that contacts do not move is in the middle of the frame. Density, friction
    /// and restitution with the rules by which they mix, rolling resistance, filter, and whether it is a sensor, a belt or a one-way
    /// floor are those of the body for all shapes that are not told their own. There may be as many as memory holds.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// let tail = Collider::new(Shape::rectangle(0.2, 1.0)).at([0.0, -0.5]);
    /// let arrow = world.add(Body::dynamic(Shape::circle(0.3)).with(tail).at([3.0, 2.0]))?;
    /// for collider in world.body(arrow).unwrap().colliders() {
    ///     println!("{:?} at {:?}", collider.shape(), collider.pose());
    /// }
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn with(mut self, collider: Collider) -> Self {
        self.further.push(collider);
        self
    }

    /// Which bodies it collides with. Default: all.
    #[must_use]
    pub fn filter(mut self, filter: Filter) -> Self {
        self.role.filter = filter;
        self
    }

    /// Whether the body is a sensor: it touches nothing and nothing touches it, and the world takes note of what overlaps it, as
    /// [`Events::sensor_began`](crate::Events::sensor_began), [`sensor_ended`](crate::Events::sensor_ended) and
    /// [`World::sensor_overlaps`](crate::World::sensor_overlaps) tell. Default false.
    ///
    /// It may be of any type and moves as another of that type; it sees bodies of every type, asleep or awake, and other
    /// sensors, as far as [filters](Self::filter) let the two meet. What it overlaps is found at the end of each step, touching
    /// included. A body that flies straight through a slow sensor within one step is reported as begun and ended in that step. One that is
    /// thrown aside on its way, or that a sensor as fast as itself passes, may be missed.
    #[must_use]
    pub fn sensor(mut self, is_sensor: bool) -> Self {
        self.role.is_sensor = is_sensor;
        self
    }

    /// Makes the body a one-way floor: bodies pass that move along this `direction`, and those that come against it are borne.
    /// It is of any length, in the frame of the body, and turns with it.
    ///
    /// Each body decides for itself. What comes from the free side is borne until it leaves the surface or slips off the end. What
    /// comes from below or from the side, or began within the floor, passes until it has left. To let one body drop through, part
    /// the two for a moment by [`World::set_collision`](crate::World::set_collision).
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// world.add(Body::fixed(Shape::aabb(4.0, 0.2)).one_way([0.0, 1.0]))?; // can be jumped through from below
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn one_way(mut self, direction: impl Into<Vec2>) -> Self {
        let direction = direction.into();
        // What has no direction is refused when it is added.
        self.role.one_way = Some(direction.direction().unwrap_or(direction));
        self
    }

    /// Speed of the surface against the body, m/s, as that of a conveyor belt, which goes round while the body stays: friction
    /// draws what touches it along. Positive goes clockwise, so that it takes what lies on top to the right. Default 0.
    ///
    /// ```
    /// # use rustycs::prelude::*;
    /// # let mut world = World::new(Settings::default());
    /// let belt = world.add(Body::fixed(Shape::aabb(20.0, 1.0)).surface_speed(2.0))?;
    /// world.body_mut(belt).unwrap().set_surface_speed(-2.0);
    /// # Ok::<(), BodyError>(())
    /// ```
    #[must_use]
    pub fn surface_speed(mut self, speed: f32) -> Self {
        self.role.surface_speed = speed;
        self
    }

    /// A number of the caller's own, which the engine keeps and never reads.
    #[must_use]
    pub fn user_data(mut self, user_data: u64) -> Self {
        self.user_data = user_data;
        self
    }

    /// What the body was told to be: dynamic, fixed or kinematic. This and the following tell what was given, or what holds
    /// where nothing was; `get_`, as the methods that give it have the plain names.
    pub fn get_body_type(&self) -> BodyType {
        self.body_type
    }

    /// Its shape.
    pub fn get_shape(&self) -> &Shape {
        &self.shape
    }

    /// Place of its own shape, m: its centre of mass, if it has only that; of the frame of its points, if it is made of pieces.
    pub fn get_position(&self) -> Point {
        self.center
    }

    /// Angle, rad.
    pub fn get_angle(&self) -> f32 {
        self.angle
    }

    /// Velocity, m/s.
    pub fn get_velocity(&self) -> Vec2 {
        self.velocity
    }

    /// Angular velocity, rad/s.
    pub fn get_angular_velocity(&self) -> f32 {
        self.angular_velocity
    }

    /// Density, friction and restitution.
    pub fn get_material(&self) -> Material {
        self.material
    }

    /// The mass that was given, kg; `None` where it follows from density and area.
    pub fn get_mass(&self) -> Option<f32> {
        self.mass
    }

    /// Whether it never turns.
    pub fn get_fixed_rotation(&self) -> bool {
        self.fixed_rotation
    }

    /// Factor on the world's forces.
    pub fn get_gravity_scale(&self) -> f32 {
        self.gravity_scale
    }

    /// Linear damping, 1/s.
    pub fn get_linear_damping(&self) -> f32 {
        self.linear_damping
    }

    /// Angular damping, 1/s.
    pub fn get_angular_damping(&self) -> f32 {
        self.angular_damping
    }

    /// Whether it may be put to sleep.
    pub fn get_may_sleep(&self) -> bool {
        self.may_sleep
    }

    /// Which bodies it collides with.
    pub fn get_filter(&self) -> Filter {
        self.role.filter
    }

    /// Whether it is a sensor.
    pub fn get_sensor(&self) -> bool {
        self.role.is_sensor
    }

    /// The direction, of length 1, in which bodies pass it, if it is a one-way floor.
    pub fn get_one_way(&self) -> Option<Vec2> {
        self.role.one_way
    }

    /// Speed of its surface, m/s.
    pub fn get_surface_speed(&self) -> f32 {
        self.role.surface_speed
    }

    /// The caller's own number.
    pub fn get_user_data(&self) -> u64 {
        self.user_data
    }

    /// The shapes that it has beside its own.
    pub fn get_colliders(&self) -> &[Collider] {
        &self.further
    }

    /// All its shapes, its own first.
    pub(crate) fn parts(&self) -> Vec<Part> {
        let Self { shape, material, role, .. } = *self;
        let own = Part { shape, at: self.own_at, angle: 0.0, material, role, user_data: 0 };
        let further = self.further.iter().map(|collider| collider.on(material, role));
        std::iter::once(own).chain(further).collect()
    }

    /// Whether the body can turn: not if one of its shapes never does.
    pub(crate) fn can_turn(&self) -> bool {
        self.can_be_turned() && !self.fixed_rotation
    }

    /// Whether the body can have an angle.
    pub(crate) fn can_be_turned(&self) -> bool {
        self.shape.can_rotate() && self.further.iter().all(|collider| collider.shape.can_rotate())
    }

    /// Where the centre of mass is; a body with an axis-aligned box is never turned.
    pub(crate) fn pose(&self) -> Pose {
        let frame =
            if self.can_be_turned() { Pose::new(self.center, self.angle) } else { Pose::at(self.center) };
        let from_frame = if self.further.is_empty() { self.own_at } else { self.masses().center };
        if from_frame == Vec2::ZERO { frame } else { Pose { center: frame.to_world(from_frame), ..frame } }
    }

    /// Mass and moment of inertia of the body, were it free to move and turn; and its centre of mass in the frame that it is
    /// described in, if it has several shapes: what contacts do not move turns about the middle of the frame.
    pub(crate) fn masses(&self) -> Masses {
        let by_density = if self.further.is_empty() {
            let of_shape = self.shape.mass_properties(self.material.density);
            Masses { mass: of_shape.mass, inertia: of_shape.inertia, center: Vec2::ZERO }
        } else {
            self.masses_of_all()
        };
        match self.mass {
            None => by_density,
            Some(mass) if self.further.is_empty() => {
                let area = self.shape.area();
                let inertia =
                    if area > 0.0 { self.shape.mass_properties(1.0).inertia * (mass / area) } else { 0.0 };
                Masses { mass, inertia, ..by_density }
            }
            // What does not move may weigh nothing.
            Some(mass) if by_density.mass == 0.0 => Masses { mass, ..by_density },
            Some(mass) => {
                Masses { mass, inertia: by_density.inertia * (mass / by_density.mass), ..by_density }
            }
        }
    }

    fn masses_of_all(&self) -> Masses {
        let of_all = Masses::of(&self.parts());
        let is_dynamic = self.body_type == BodyType::Dynamic;
        Masses { center: if is_dynamic { of_all.center } else { Vec2::ZERO }, ..of_all }
    }

    /// Checks every number of the description.
    pub(crate) fn validate(&self) -> Result<(), BodyError> {
        if let Some(flaw) = &self.flaw {
            return Err(flaw.clone());
        }
        check_place(self.center)?;
        check_strength("the angle", self.angle, "rad")?;
        check_vector("the velocity", self.velocity, "m/s")?;
        check_strength("the angular velocity", self.angular_velocity, "rad/s")?;
        // What does not move may weigh nothing.
        let is_dynamic = self.body_type == BodyType::Dynamic;
        for part in self.parts() {
            part.validate(is_dynamic)?;
            if is_dynamic && part.shape.is_segment() {
                return Err(BodyError::DynamicSegment);
            }
        }
        if let Some(mass) = self.mass {
            check_range("the mass", f64::from(mass), MASSES, "kg")?;
        }
        check_gravity_scale(self.gravity_scale)?;
        check_damping("the linear damping", self.linear_damping)?;
        check_damping("the angular damping", self.angular_damping)?;
        if is_dynamic {
            let Masses { mass, inertia, .. } = self.masses();
            check_range("the mass", f64::from(mass), MASSES, "kg")?;
            check_range("the moment of inertia", f64::from(inertia), INERTIAS, "kg m²")?;
        }
        Ok(())
    }
}
