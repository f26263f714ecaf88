//! A scene in words that every engine understands.

/// Outline of a body around its centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Outline {
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

/// How a body takes part in the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Never moves.
    Fixed,
    /// Keeps the velocity it is given.
    Kinematic,
    /// Moved by forces and contacts.
    Dynamic,
}

/// A body of a scene.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BodySpec {
    pub outline: Outline,
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
}

impl BodySpec {
    /// A body at rest at the origin, of density 1 kg/m² and friction 0.6, that does not bounce.
    pub(crate) fn new(kind: Kind, outline: Outline) -> Self {
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
        }
    }
}

/// A pull of every dynamic body towards a point, by the inverse square of the distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pull {
    /// m.
    pub center: [f64; 2],
    /// Acceleration times distance squared, m³/s².
    pub strength: f64,
}

/// Distance, m, below which a pull falls off linearly instead of growing.
pub(crate) const SOFTENING: f64 = 1e-3;

impl Pull {
    /// Acceleration of a body whose centre of mass is here, m/s².
    pub(crate) fn acceleration(&self, position: [f64; 2]) -> [f64; 2] {
        let [x, y] = [self.center[0] - position[0], self.center[1] - position[1]];
        let softened = x.hypot(y).max(SOFTENING);
        [x, y].map(|toward| self.strength * toward / softened.powi(3))
    }
}

/// Bodies, and what acts on them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Scene {
    /// In the order in which every engine adds them.
    pub bodies: Vec<BodySpec>,
    /// m/s².
    pub gravity: [f64; 2],
    /// Where an engine has no such force, it is applied to the bodies before each step, as its users do.
    pub pull: Option<Pull>,
    /// Whether bodies at rest may fall asleep.
    pub sleeps: bool,
}
