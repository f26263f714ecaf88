//! Watches what a world should keep, tick by tick.

use crate::report::measure::Invariants;
use crate::world::World;

/// Energy and momenta of a world, and the sizes that their changes are measured against.
#[derive(Clone, Copy, Debug, Default)]
struct Totals {
    energy: f64,
    kinetic: f64,
    momentum: [f64; 2],
    angular_momentum: f64,
    /// Σ m |v|, kg m/s.
    momentum_size: f64,
    /// Σ m |x| |v| + I |w|, kg m²/s.
    angular_size: f64,
}

impl Totals {
    fn of(world: &World) -> Self {
        let (mut momentum, mut momentum_size, mut angular_size) = ([0.0; 2], 0.0, 0.0);
        for (_, body) in world.bodies() {
            let (mass, inertia) = (f64::from(body.mass()), f64::from(body.inertia()));
            if !mass.is_finite() {
                continue;
            }
            let velocity = [body.velocity().x, body.velocity().y].map(f64::from);
            let [x, y] = body.position_f64();
            let speed = velocity[0].hypot(velocity[1]);
            momentum = [momentum[0] + mass * velocity[0], momentum[1] + mass * velocity[1]];
            momentum_size += mass * speed;
            angular_size += mass * x.hypot(y) * speed;
            if inertia.is_finite() {
                angular_size += inertia * f64::from(body.angular_velocity()).abs();
            }
        }
        Self {
            energy: world.energy(),
            kinetic: world.kinetic_energy(),
            momentum,
            angular_momentum: world.angular_momentum(),
            momentum_size,
            angular_size,
        }
    }
}

/// The largest changes so far.
#[derive(Debug)]
pub(super) struct Watch {
    start: Totals,
    /// Largest of each size so far; the energy is the lowest so far.
    sizes: Totals,
    /// Largest changes so far, in their own units.
    changes: Invariants,
}

impl Watch {
    pub(super) fn begin(world: &World) -> Self {
        let start = Totals::of(world);
        Self { start, sizes: start, changes: Invariants::default() }
    }

    pub(super) fn after_tick(&mut self, world: &World) {
        let (start, now) = (&self.start, Totals::of(world));
        self.sizes.energy = self.sizes.energy.min(now.energy);
        self.sizes.kinetic = self.sizes.kinetic.max(now.kinetic);
        self.sizes.momentum_size = self.sizes.momentum_size.max(now.momentum_size);
        self.sizes.angular_size = self.sizes.angular_size.max(now.angular_size);
        let [dx, dy] = [0, 1].map(|axis| now.momentum[axis] - start.momentum[axis]);
        self.changes = self.changes.max(Invariants {
            energy_drift: (now.energy - start.energy).abs(),
            energy_gain: now.energy - self.sizes.energy,
            momentum_drift: dx.hypot(dy),
            angular_momentum_drift: (now.angular_momentum - start.angular_momentum).abs(),
            penetration: f64::from(world.error().penetration),
            residual: f64::from(world.error().velocity_residual),
        });
    }

    /// The changes as parts of the sizes.
    pub(super) fn end(&self) -> Invariants {
        // Where nothing ever moved nothing changed either.
        let part = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
        Invariants {
            energy_drift: part(self.changes.energy_drift, self.sizes.kinetic),
            energy_gain: part(self.changes.energy_gain, self.sizes.kinetic),
            momentum_drift: part(self.changes.momentum_drift, self.sizes.momentum_size),
            angular_momentum_drift: part(self.changes.angular_momentum_drift, self.sizes.angular_size),
            ..self.changes
        }
    }
}
