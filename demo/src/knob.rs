//! What can be turned about a world while it runs.

use rustycs::{Force, Mix, PositionCorrection, Settings, Vec2, World};

/// Something about a world that can be made more or less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Knob {
    Scheme,
    TickRate,
    Substeps,
    Adaptive,
    Iterations,
    Relax,
    SplitKick,
    WarmStarting,
    BlockSolve,
    Recycling,
    Positions,
    Sleep,
    BounceSpeed,
    FrictionMix,
    RestitutionMix,
    Gravity,
    ForceX,
    ForceY,
}

/// The name of the force that the knobs add to those of the scene.
const OWN_FORCE: &str = "panel";
const TICK_RATES: [f32; 8] = [15.0, 30.0, 60.0, 90.0, 120.0, 240.0, 480.0, 1000.0];
const COUNTS: [u32; 14] = [0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64, 128, 256];
const BOUNCE_SPEEDS: [f32; 7] = [0.0, 0.01, 0.05, 0.1, 0.5, 1.0, 5.0];
const GRAVITIES: [f32; 8] = [0.0, 0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 10.0];
const MIXES: [(Mix, &str); 5] = [
    (Mix::Average, "average"),
    (Mix::GeometricMean, "geometric"),
    (Mix::Min, "smaller"),
    (Mix::Max, "larger"),
    (Mix::Multiply, "product"),
];

impl Knob {
    pub(crate) const ALL: [Self; 18] = [
        Self::Scheme,
        Self::TickRate,
        Self::Substeps,
        Self::Adaptive,
        Self::Iterations,
        Self::Relax,
        Self::SplitKick,
        Self::WarmStarting,
        Self::BlockSolve,
        Self::Recycling,
        Self::Positions,
        Self::Sleep,
        Self::BounceSpeed,
        Self::FrictionMix,
        Self::RestitutionMix,
        Self::Gravity,
        Self::ForceX,
        Self::ForceY,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Scheme => "scheme",
            Self::TickRate => "ticks",
            Self::Substeps => "substeps",
            Self::Adaptive => "adaptive",
            Self::Iterations => "iterations",
            Self::Relax => "relax sweeps",
            Self::SplitKick => "split kick",
            Self::WarmStarting => "warm start",
            Self::BlockSolve => "block solve",
            Self::Recycling => "recycling",
            Self::Positions => "overlaps",
            Self::Sleep => "sleep",
            Self::BounceSpeed => "bounce from",
            Self::FrictionMix => "friction",
            Self::RestitutionMix => "restitution",
            Self::Gravity => "attraction",
            Self::ForceX => "gravity x",
            Self::ForceY => "gravity y",
        }
    }

    /// What it does, in a sentence.
    pub(crate) fn meaning(self) -> &'static str {
        match self {
            Self::Scheme => "The default solver, or the classic one: one substep with many iterations.",
            Self::TickRate => "Ticks in a simulated second.",
            Self::Substeps => "Parts into which the solver divides a tick.",
            Self::Adaptive => "Islands under great load are solved directly instead of by sweeps.",
            Self::Iterations => "Sweeps over all contacts in a substep.",
            Self::Relax => "Sweeps that take away the speed with which overlapping bodies were pushed apart.",
            Self::SplitKick => "Half of each force acts before a drift, half after it: second order.",
            Self::WarmStarting => "Each substep begins with the impulses of the one before.",
            Self::BlockSolve => "Both points of a contact are solved together.",
            Self::Recycling => "Contact points are kept while two bodies hardly move against each other.",
            Self::Positions => {
                "How overlaps are removed: with the velocities (bias), or by moving bodies (project)."
            }
            Self::Sleep => "Islands at rest are left out until something touches them.",
            Self::BounceSpeed => "Slower impacts do not bounce.",
            Self::FrictionMix => "How the frictions of two bodies make that of their contact.",
            Self::RestitutionMix => "How the restitutions of two bodies make that of their contact.",
            Self::Gravity => "The constant G: the strength of all attractors.",
            Self::ForceX => "What accelerates all bodies to the right.",
            Self::ForceY => "What accelerates all bodies upward; on the Earth -9.8 m/s².",
        }
    }

    /// Whether it is either on or off.
    pub(crate) fn is_switch(self) -> bool {
        let switches = [
            Self::Adaptive,
            Self::SplitKick,
            Self::WarmStarting,
            Self::BlockSolve,
            Self::Recycling,
            Self::Sleep,
        ];
        switches.contains(&self)
    }

    /// Whether a switch is on.
    pub(crate) fn is_on(self, world: &World) -> bool {
        let settings = world.settings();
        match self {
            Self::Adaptive => settings.adaptive,
            Self::SplitKick => settings.split_kick,
            Self::WarmStarting => settings.warm_starting,
            Self::BlockSolve => settings.block_solve,
            Self::Recycling => settings.recycling,
            Self::Sleep => settings.sleep,
            _ => false,
        }
    }

    /// Where it stands.
    pub(crate) fn text(self, world: &World) -> String {
        let settings = world.settings();
        let mix_name = |mix| MIXES.iter().find(|(other, _)| *other == mix).map_or("", |(_, name)| name);
        match self {
            Self::Scheme => scheme_name(settings).to_owned(),
            Self::TickRate => format!("{} /s", settings.tick_rate),
            Self::Substeps => settings.substeps.to_string(),
            Self::Iterations => settings.iterations.to_string(),
            Self::Relax => settings.relax_iterations.to_string(),
            Self::Positions => match settings.position_correction {
                PositionCorrection::Projection { iterations } => format!("project {iterations}"),
                _ => "bias".to_owned(),
            },
            Self::BounceSpeed => format!("{} m/s", settings.restitution_threshold),
            Self::FrictionMix => mix_name(settings.friction_mix).to_owned(),
            Self::RestitutionMix => mix_name(settings.restitution_mix).to_owned(),
            Self::Gravity => format!("{}", settings.gravitational_constant),
            Self::ForceX => format!("{:.1} m/s²", world.acceleration().x),
            Self::ForceY => format!("{:.1} m/s²", world.acceleration().y),
            switch => if switch.is_on(world) { "on" } else { "off" }.to_owned(),
        }
    }

    /// Turns it up (positive) or down; at its end it stays. A switch changes over.
    pub(crate) fn turn(self, world: &mut World, by: i32) {
        let step = match self {
            Self::ForceX => Some(Vec2::new(by as f32, 0.0)),
            Self::ForceY => Some(Vec2::new(0.0, by as f32)),
            _ => None,
        };
        if let Some(step) = step {
            add_to_own_force(world, step);
            return;
        }
        let mut settings = world.settings().clone();
        self.turn_settings(&mut settings, by);
        // A combination that makes no sense (a split kick without a relax sweep) is refused; all stays as it was.
        world.set_settings(settings).ok();
    }

    fn turn_settings(self, settings: &mut Settings, by: i32) {
        match self {
            Self::Scheme => turn_scheme(settings),
            Self::TickRate => settings.tick_rate = neighbour(&TICK_RATES, settings.tick_rate, by),
            Self::Substeps => settings.substeps = neighbour(&COUNTS, settings.substeps, by).max(1),
            Self::Iterations => settings.iterations = neighbour(&COUNTS, settings.iterations, by).max(1),
            Self::Relax => settings.relax_iterations = neighbour(&COUNTS, settings.relax_iterations, by),
            Self::Adaptive => settings.adaptive ^= true,
            Self::SplitKick => settings.split_kick ^= true,
            Self::WarmStarting => settings.warm_starting ^= true,
            Self::BlockSolve => settings.block_solve ^= true,
            Self::Recycling => settings.recycling ^= true,
            Self::Sleep => settings.sleep ^= true,
            Self::Positions => {
                let now = match settings.position_correction {
                    PositionCorrection::Projection { iterations } => iterations,
                    _ => 0,
                };
                settings.position_correction = match neighbour(&COUNTS, now, by) {
                    0 => PositionCorrection::Bias,
                    iterations => PositionCorrection::Projection { iterations },
                };
            }
            Self::BounceSpeed => {
                let speed = &mut settings.restitution_threshold;
                *speed = neighbour(&BOUNCE_SPEEDS, *speed, by);
            }
            Self::FrictionMix => settings.friction_mix = next_mix(settings.friction_mix, by),
            Self::RestitutionMix => settings.restitution_mix = next_mix(settings.restitution_mix, by),
            Self::Gravity => {
                let constant = &mut settings.gravitational_constant;
                *constant = neighbour(&GRAVITIES, *constant, by);
            }
            Self::ForceX | Self::ForceY => {}
        }
    }
}

/// Whether the settings are those of one of the two schemes, as far as the solver goes.
pub(crate) fn scheme_name(settings: &Settings) -> &'static str {
    let is_like = |scheme: Settings| solver_of(settings, &scheme) == *settings;
    match () {
        () if is_like(Settings::default()) => "default",
        () if is_like(Settings::classic()) => "classic",
        () => "own",
    }
}

/// Settings with the solver of a scheme.
fn solver_of(settings: &Settings, scheme: &Settings) -> Settings {
    Settings {
        substeps: scheme.substeps,
        adaptive: scheme.adaptive,
        iterations: scheme.iterations,
        relax_iterations: scheme.relax_iterations,
        split_kick: scheme.split_kick,
        warm_starting: scheme.warm_starting,
        block_solve: scheme.block_solve,
        recycling: scheme.recycling,
        position_correction: scheme.position_correction,
        ..settings.clone()
    }
}

/// The classic scheme instead of the default one; the default one instead of all others.
pub(crate) fn turn_scheme(settings: &mut Settings) {
    let is_default = scheme_name(settings) == "default";
    let scheme = if is_default { Settings::classic() } else { Settings::default() };
    *settings = solver_of(settings, &scheme);
}

/// The next value up or down a list in ascending order, from a value that need not be in it.
fn neighbour<T: Copy + PartialOrd>(list: &[T], value: T, by: i32) -> T {
    let next = if by > 0 {
        list.iter().find(|&&other| other > value)
    } else {
        list.iter().rev().find(|&&other| other < value)
    };
    next.copied().unwrap_or(value)
}

fn next_mix(mix: Mix, by: i32) -> Mix {
    let place = MIXES.iter().position(|(other, _)| *other == mix).unwrap_or(0) as i32;
    MIXES[(place + by).rem_euclid(MIXES.len() as i32) as usize].0
}

fn add_to_own_force(world: &mut World, step: Vec2) {
    let own = world.forces().find(|(_, force)| force.name() == OWN_FORCE).map(|(id, _)| id);
    let before = own.and_then(|id| world.remove_force(id)).map_or(Vec2::ZERO, |force| force.acceleration());
    if let Ok(force) = Force::try_new(OWN_FORCE, before + step) {
        world.add_force(force);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_knob_turns_and_leaves_a_world_that_steps() {
        for knob in Knob::ALL {
            let mut world = World::new(Settings::default());
            let before = knob.text(&world);
            knob.turn(&mut world, 1);
            assert_ne!(before, knob.text(&world), "{}", knob.name());
            for by in [-1, 1] {
                for _ in 0..40 {
                    knob.turn(&mut world, by);
                }
            }
            world.settings().validate().unwrap();
            world.step();
        }
    }

    #[test]
    fn the_scheme_changes_over_and_back() {
        let mut settings = Settings { tick_rate: 30.0, ..Settings::default() };
        assert_eq!(scheme_name(&settings), "default");
        turn_scheme(&mut settings);
        assert_eq!((scheme_name(&settings), settings.tick_rate), ("classic", 30.0));
        turn_scheme(&mut settings);
        assert_eq!(settings, Settings { tick_rate: 30.0, ..Settings::default() });
    }
}
