//! What bodies are made of, and how two materials meet.

/// Density and surface of a body.
///
/// ```
/// use rustycs::prelude::*;
///
/// let mut world = World::new(Settings::default());
/// world.add_force(Force::EARTH_GRAVITY);
/// let ice = Material { density: 917.0, friction: 0.02, restitution: 0.1 }; // kg/m² of a slab 1 m thick
/// world.add(Body::fixed(Shape::rectangle(50.0, 1.0)).at([0.0, -0.5]).material(ice))?;
/// let puck = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 0.5]).material(Material::RUBBER))?;
/// assert!((world.body(puck).unwrap().mass() - 0.9 * std::f32::consts::PI * 0.25).abs() < 1e-6);
/// # Ok::<(), BodyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Mass per area, kg/m².
    pub density: f32,
    /// Coefficient of friction (Coulomb), no unit: the tangent force is at most this times the normal force.
    pub friction: f32,
    /// Coefficient of restitution (Newton), no unit, 0 to 1: speed of separation over speed of approach.
    pub restitution: f32,
}

impl Material {
    /// The default material, light and bouncy: density 0.1 kg/m², friction 0.6, restitution 0.5.
    pub const DEFAULT: Self = Self { density: 0.1, friction: 0.6, restitution: 0.5 };
    /// Grips and bounces: density 0.9 kg/m², friction 0.8, restitution 0.6.
    pub const RUBBER: Self = Self { density: 0.9, friction: 0.8, restitution: 0.6 };
    /// A little heavier, bounces well: density 1.2 kg/m², friction 0.6, restitution 0.5.
    pub const PLASTIC: Self = Self { density: 1.2, friction: 0.6, restitution: 0.5 };
    /// Heavy and dull: density 2.5 kg/m², friction 0.4, restitution 0.2.
    pub const STONE: Self = Self { density: 2.5, friction: 0.4, restitution: 0.2 };
    /// Heaviest, slides easily: density 7.8 kg/m², friction 0.2, restitution 0.1.
    pub const METAL: Self = Self { density: 7.8, friction: 0.2, restitution: 0.1 };
}

impl Default for Material {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// How the coefficients of two touching bodies give the coefficient of their contact.
///
/// Each surface has a rule: [its own](crate::Body::friction_mix), or that of the [settings](crate::Settings::friction_mix). Of two
/// rules the [stronger](Self::stronger) one counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Mix {
    /// (a + b) / 2, and 0 where one of them is 0: what has no friction slides on everything, and from what has no restitution
    /// nothing bounces. Without the exception 0 would mean half of what the other has.
    #[default]
    Average,
    /// √(a b): 0 where one of them is, without the jump of the average there.
    GeometricMean,
    /// The smaller.
    Min,
    /// The larger.
    Max,
    /// a b.
    Multiply,
}

/// How the materials of two bodies mix.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mixes {
    pub(crate) friction: Mix,
    pub(crate) restitution: Mix,
}

/// What the coefficients of two surfaces come to, no units.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Mixed {
    pub(crate) friction: f32,
    pub(crate) restitution: f32,
    pub(crate) rolling_resistance: f32,
}

impl Mix {
    /// The stronger of two rules. From the weakest to the strongest they are [`Average`](Self::Average),
    /// [`GeometricMean`](Self::GeometricMean), [`Min`](Self::Min), [`Multiply`](Self::Multiply) and [`Max`](Self::Max): what is
    /// usual gives way to what is slippery, and that to what always grips.
    ///
    /// ```
    /// use rustycs::Mix;
    ///
    /// assert_eq!(Mix::Average.stronger(Mix::Min), Mix::Min);
    /// assert_eq!(Mix::Max.stronger(Mix::Multiply), Mix::Max);
    /// ```
    #[must_use]
    pub fn stronger(self, other: Self) -> Self {
        if other.strength() > self.strength() { other } else { self }
    }

    pub(crate) fn strength(self) -> u8 {
        match self {
            Self::Average => 0,
            Self::GeometricMean => 1,
            Self::Min => 2,
            Self::Multiply => 3,
            Self::Max => 4,
        }
    }

    /// The rule of a contact between two surfaces, of which those that have no rule of their own have this one.
    pub(super) fn of_two(self, own: [Option<Self>; 2]) -> Self {
        let [a, b] = own.map(|own| own.unwrap_or(self));
        a.stronger(b)
    }

    /// The coefficient of a contact between coefficients `a` and `b`, both 0 or more.
    pub fn mix(self, a: f32, b: f32) -> f32 {
        match self {
            Self::Average if a == 0.0 || b == 0.0 => 0.0,
            Self::Average => 0.5 * (a + b),
            Self::GeometricMean => (a * b).sqrt(),
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Multiply => a * b,
        }
    }
}
