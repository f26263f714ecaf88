//! A scene in words that every engine understands.

/// Outline of a body around its centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A disc.
    Circle {
        /// m.
        radius: f64,
    },
    /// A box that may turn.
    Box {
        /// m.
        width: f64,
        /// m.
        height: f64,
    },
    /// A convex polygon: corners counter-clockwise, m, with the centre of mass at the origin.
    Polygon(Vec<[f64; 2]>),
}

impl Outline {
    /// A regular polygon with its corners this far from the centre, m, one of them to the right.
    #[must_use]
    pub fn regular(corners: u32, radius: f64) -> Self {
        let corner = |index: u32| {
            let angle = std::f64::consts::TAU * f64::from(index) / f64::from(corners);
            [radius * angle.cos(), radius * angle.sin()]
        };
        Self::Polygon((0..corners).map(corner).collect())
    }

    /// Distance of the farthest point from the centre, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self {
            Self::Circle { radius } => *radius,
            Self::Box { width, height } => 0.5 * width.hypot(*height),
            Self::Polygon(corners) => corners.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max),
        }
    }
}

/// How a body takes part in the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Never moves.
    Fixed,
    /// Keeps the velocity it is given.
    Kinematic,
    /// Moved by forces and contacts.
    Dynamic,
}

/// A body of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySpec {
    /// What it looks like.
    pub outline: Outline,
    /// How it takes part.
    pub kind: Kind,
    /// Of the centre of mass, m.
    pub position: [f64; 2],
    /// rad, counter-clockwise.
    pub angle: f64,
    /// m/s.
    pub velocity: [f64; 2],
    /// rad/s.
    pub spin: f64,
    /// kg/m².
    pub density: f64,
    /// Coefficient of Coulomb friction. Pairs take the geometric mean.
    pub friction: f64,
    /// Coefficient of restitution. Pairs take the larger one.
    pub restitution: f64,
    /// How fast spin is lost to the air, 1/s.
    pub angular_damping: f64,
}

impl BodySpec {
    /// A body at rest at the origin, of density 1 kg/m² and friction 0.6, that does not bounce.
    #[must_use]
    pub fn new(kind: Kind, outline: Outline) -> Self {
        Self {
            outline,
            kind,
            position: [0.0; 2],
            angle: 0.0,
            velocity: [0.0; 2],
            spin: 0.0,
            density: 1.0,
            friction: 0.6,
            restitution: 0.0,
            angular_damping: 0.0,
        }
    }
}

/// A pull of every dynamic body towards a point, by the inverse square of the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// m.
    pub center: [f64; 2],
    /// Acceleration times distance squared, m³/s².
    pub strength: f64,
}

/// Distance, m, below which a pull falls off linearly instead of growing.
pub const SOFTENING: f64 = 1e-3;

impl Pull {
    /// Acceleration of a body whose centre of mass is here, m/s².
    pub fn acceleration(&self, position: [f64; 2]) -> [f64; 2] {
        let [x, y] = [self.center[0] - position[0], self.center[1] - position[1]];
        let softened = x.hypot(y).max(SOFTENING);
        [x, y].map(|toward| self.strength * toward / softened.powi(3))
    }
}

/// Bodies, and what acts on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// In the order in which every engine adds them.
    pub bodies: Vec<BodySpec>,
    /// m/s².
    pub gravity: [f64; 2],
    /// Where an engine has no such force, it is applied to the bodies before each step, as its users do.
    pub pull: Option<Pull>,
    /// Whether bodies at rest may fall asleep.
    pub sleeps: bool,
}

/// Gravity of the Earth, m/s².
pub const G: f64 = 9.81;

/// These bodies under the gravity of the Earth.
#[must_use]
pub fn on_earth(bodies: impl IntoIterator<Item = BodySpec>) -> Scene {
    Scene { bodies: bodies.into_iter().collect(), gravity: [0.0, -G], ..Scene::default() }
}

/// A dynamic disc.
#[must_use]
pub fn disc(radius: f64) -> BodySpec {
    BodySpec::new(Kind::Dynamic, Outline::Circle { radius })
}

/// A dynamic box.
#[must_use]
pub fn rectangle(width: f64, height: f64) -> BodySpec {
    BodySpec::new(Kind::Dynamic, Outline::Box { width, height })
}

/// A fixed box.
#[must_use]
pub fn block(width: f64, height: f64) -> BodySpec {
    BodySpec::new(Kind::Fixed, Outline::Box { width, height })
}

/// A floor of 40 m, with its surface at height 0.
#[must_use]
pub fn floor() -> BodySpec {
    BodySpec { position: [0.0, -1.0], ..block(40.0, 2.0) }
}
