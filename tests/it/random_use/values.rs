//! Numbers for random use: usual ones, and the extremes of what is accepted.

use proptest::prelude::*;
use rustycs::prelude::*;

/// Uniform from `low` to `high`, in a million steps.
fn between(low: f64, high: f64) -> impl Strategy<Value = f64> + Clone {
    const STEPS: u32 = 1_000_000;
    (0..=STEPS).prop_map(move |step| low + (high - low) * f64::from(step) / f64::from(STEPS))
}

pub(crate) fn narrow(low: f64, high: f64) -> impl Strategy<Value = f32> + Clone {
    between(low, high).prop_map(|value| value as f32)
}

/// Log-uniform from 10^`low` to 10^`high`.
pub(crate) fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f32> + Clone {
    between(low, high).prop_map(|exponent| 10.0_f64.powf(exponent) as f32)
}

fn signed(low: f64, high: f64) -> impl Strategy<Value = f32> + Clone {
    (magnitude(low, high), any::<bool>()).prop_map(|(value, negative)| if negative { -value } else { value })
}

/// A component of a velocity, force or impulse: often of the usual size, sometimes the greatest accepted.
pub(crate) fn strength() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![3 => Just(0.0_f32), 6 => narrow(-10.0, 10.0), 2 => signed(-30.0, 18.0), 1 => Just(1e18_f32)]
}

pub(crate) fn vector() -> impl Strategy<Value = [f32; 2]> + Clone {
    [strength(), strength()]
}

/// A length: often of the usual size, sometimes from a tenth of a millimetre to ten kilometres.
pub(crate) fn length() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![4 => narrow(0.1, 2.0), 2 => magnitude(-4.0, 4.0)]
}

/// A coordinate: close to the other bodies, in one point with them, or as far as is accepted.
pub(crate) fn coordinate() -> impl Strategy<Value = f64> + Clone {
    let far = (between(-3.0, 12.0), any::<bool>())
        .prop_map(|(exponent, negative)| 10.0_f64.powf(exponent) * if negative { -1.0 } else { 1.0 });
    prop_oneof![6 => between(-3.0, 3.0), 3 => Just(0.0), 1 => far]
}

pub(crate) fn place() -> impl Strategy<Value = [f64; 2]> + Clone {
    [coordinate(), coordinate()]
}

pub(crate) fn factor() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![3 => Just(0.0_f32), 3 => narrow(0.0, 2.0), 1 => magnitude(-6.0, 6.0)]
}

/// Corners on an ellipse, which makes them convex.
fn ring(corners: u32, width: f32, height: f32) -> impl Iterator<Item = [f32; 2]> {
    (0..corners).map(move |corner| {
        let Rot { c, s } = Rot::from_angle(std::f32::consts::TAU * corner as f32 / corners as f32);
        [0.5 * width * c, 0.5 * height * s]
    })
}

/// Flat ones may be refused.
fn polygon(length: impl Strategy<Value = f32> + Clone) -> impl Strategy<Value = Shape> {
    (3_u32..=8, length.clone(), length).prop_map(|(corners, width, height)| {
        Shape::polygon(ring(corners, width, height)).unwrap_or(Shape::circle(width))
    })
}

/// A capsule, or a polygon with round corners; flat ones may be refused.
fn rounded(length: impl Strategy<Value = f32> + Clone) -> impl Strategy<Value = Shape> {
    (2_u32..=8, length.clone(), length.clone(), length).prop_map(|(corners, width, height, radius)| {
        Shape::rounded(ring(corners, width, height), radius).unwrap_or(Shape::circle(width))
    })
}

/// Of a dynamic body it is refused.
fn segment(length: impl Strategy<Value = f32> + Clone) -> impl Strategy<Value = Shape> {
    (length.clone(), length).prop_map(|(x, y)| Shape::segment([0.0, 0.0], [x, y]))
}

fn shape(length: impl Strategy<Value = f32> + Clone + 'static) -> impl Strategy<Value = Shape> {
    prop_oneof![
        length.clone().prop_map(Shape::circle),
        (length.clone(), length.clone()).prop_map(|(width, height)| Shape::aabb(width, height)),
        (length.clone(), length.clone()).prop_map(|(width, height)| Shape::obb(width, height)),
        polygon(length.clone()),
        rounded(length.clone()),
        segment(length),
    ]
}

fn body_of(shape: Shape) -> impl Strategy<Value = Body> {
    prop_oneof![
        6 => Just(Body::dynamic(shape)),
        2 => Just(Body::fixed(shape)),
        1 => Just(Body::kinematic(shape)),
    ]
}

pub(crate) fn body() -> impl Strategy<Value = Body> {
    body_with(length(), coordinate(), strength(), further_shapes(length()))
}

/// A length, over all that is accepted.
fn any_length() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![2 => magnitude(-4.9, 7.9), 1 => magnitude(-4.9, -2.0), 2 => narrow(0.1, 2.0)]
}

/// A coordinate near `base`, on any scale, m: so that bodies of all sizes meet.
pub(crate) fn coordinate_near(base: f64) -> impl Strategy<Value = f64> + Clone {
    let scales = (between(-6.0, 7.0), any::<bool>());
    let offset =
        scales.prop_map(|(exponent, negative)| 10.0_f64.powf(exponent) * if negative { -1.0 } else { 1.0 });
    prop_oneof![3 => offset, 2 => between(-3e-5, 3e-5), 1 => Just(0.0)].prop_map(move |offset| base + offset)
}

/// A component of a velocity, force or impulse: the greatest that are accepted, or usual ones.
pub(crate) fn great_strength() -> impl Strategy<Value = f32> + Clone {
    prop_oneof![2 => Just(0.0_f32), 3 => narrow(-10.0, 10.0), 3 => signed(-3.0, 18.0), 1 => Just(1e18_f32)]
}

/// A body of any size near `base`, of one shape: several that overlap on all scales take the sweeps of every substep, and minutes
/// for what else takes seconds.
pub(crate) fn extreme_body(base: f64) -> impl Strategy<Value = Body> {
    body_with(any_length(), coordinate_near(base), great_strength(), Just(Vec::new()))
}

/// Where the bodies of a program are: as far as is accepted.
pub(crate) fn base() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![2 => Just(0.0), 1 => between(0.0, 11.99).prop_map(|exponent| -(10.0_f64.powf(exponent)))]
}

/// Settings with any number of substeps, at any rate.
pub(crate) fn extreme_settings() -> impl Strategy<Value = Settings> {
    let substeps = magnitude(0.0, 2.408).prop_map(|count| count as u32);
    let rate = prop_oneof![1 => Just(60.0_f32), 2 => magnitude(-0.99, 6.0), 1 => Just(0.1_f32)];
    (settings(), rate, substeps, any::<bool>()).prop_map(|(settings, tick_rate, substeps, is_default)| {
        let base = if is_default { Settings::default() } else { settings };
        Settings { tick_rate, substeps, ..base }
    })
}

fn body_with(
    length: impl Strategy<Value = f32> + Clone + 'static,
    coordinate: impl Strategy<Value = f64> + Clone,
    strength: impl Strategy<Value = f32> + Clone,
    further: impl Strategy<Value = Vec<Collider>>,
) -> impl Strategy<Value = Body> {
    let (place, vector) = ([coordinate.clone(), coordinate], [strength.clone(), strength.clone()]);
    let motion = (place, strength.clone(), vector, strength);
    let surface = (factor(), narrow(0.0, 1.0), prop_oneof![magnitude(-1.0, 1.0), magnitude(-12.0, 12.0)]);
    let options =
        (prop::option::weighted(0.2, magnitude(-12.0, 15.0)), any::<[bool; 2]>(), factor(), factor());
    (shape(length).prop_flat_map(body_of), motion, surface, options, further).prop_map(
        |(body, motion, surface, options, further)| {
            let body = further.into_iter().fold(body, Body::with);
            let (at, angle, velocity, spin) = motion;
            let (friction, restitution, density) = surface;
            let (mass, [fixed_rotation, may_sleep], scale, damping) = options;
            let body = body.at(at).angle(angle).velocity(velocity).angular_velocity(spin);
            let body = body.friction(friction).restitution(restitution).density(density);
            let body = body.fixed_rotation(fixed_rotation).gravity_scale(1.0 - scale);
            let body = body.linear_damping(damping).angular_damping(damping).may_sleep(may_sleep);
            if let Some(mass) = mass { body.mass(mass) } else { body }
        },
    )
}

/// The further shapes of a body: of three bodies in four none.
fn further_shapes(
    length: impl Strategy<Value = f32> + Clone + 'static,
) -> impl Strategy<Value = Vec<Collider>> {
    let place =
        (length.clone(), narrow(-1.0, 1.0), narrow(-1.0, 1.0)).prop_map(|(size, x, y)| [size * x, size * y]);
    let surface = (prop::option::of(factor()), any::<[bool; 2]>(), narrow(-3.0, 3.0));
    let collider =
        (shape(length), place, narrow(-4.0, 4.0), surface).prop_map(|(shape, at, angle, surface)| {
            let (friction, [is_sensor, moves], speed) = surface;
            let collider = Collider::new(shape).at(at).angle(angle).sensor(is_sensor && moves);
            let collider = if moves { collider.surface_speed(speed) } else { collider };
            if let Some(friction) = friction { collider.friction(friction) } else { collider }
        });
    prop_oneof![3 => Just(Vec::new()), 1 => prop::collection::vec(collider, 1..4)]
}

/// A body as games have it, somewhere in a pool of 10 m.
pub(crate) fn usual_body() -> impl Strategy<Value = Body> {
    let size = || narrow(0.2, 1.2);
    let shape = prop_oneof![
        size().prop_map(|size| Shape::circle(0.5 * size)),
        (size(), size()).prop_map(|(width, height)| Shape::aabb(width, height)),
        (size(), size()).prop_map(|(width, height)| Shape::obb(width, height)),
        (3_u32..=8, size()).prop_map(|(corners, size)| Shape::polygon(ring(corners, size, size)).unwrap()),
        (2_u32..=8, size(), narrow(0.05, 0.3)).prop_map(|(corners, size, radius)| {
            Shape::rounded(ring(corners, 0.6 * size, 0.6 * size), radius).unwrap()
        }),
    ];
    let materials =
        [Material::DEFAULT, Material::RUBBER, Material::PLASTIC, Material::STONE, Material::METAL];
    let motion = ([between(-4.0, 4.0), between(0.5, 6.0)], narrow(-3.0, 3.0), narrow(-5.0, 5.0));
    let further = further_shapes(size());
    (shape, prop::sample::select(materials.to_vec()), motion, 0..10_u8, further).prop_map(
        |(shape, material, (at, angle, speed), kind, further)| {
            let body = match kind {
                0 => Body::fixed(shape),
                1 => Body::kinematic(shape),
                _ => Body::dynamic(shape),
            };
            let body = further.into_iter().fold(body, Body::with);
            body.at(at).angle(angle).velocity([speed, 0.0]).angular_velocity(-speed).material(material)
        },
    )
}

pub(crate) fn settings() -> impl Strategy<Value = Settings> {
    let rate = prop_oneof![3 => Just(60.0_f32), 1 => magnitude(-0.99, 6.0), 1 => Just(0.1_f32)];
    let numbers = (rate, 1_u32..12, 1_u32..4, 1_u32..3);
    let thresholds = (factor(), factor(), magnitude(-6.0, 12.0), magnitude(-3.0, 6.0));
    let rest = (magnitude(-6.0, 1.0), narrow(0.0, 1.0));
    let mixes =
        prop::sample::select(vec![Mix::Average, Mix::GeometricMean, Mix::Min, Mix::Max, Mix::Multiply]);
    (any::<bool>(), any::<[bool; 7]>(), numbers, thresholds, mixes, rest).prop_map(
        |(classic, flags, numbers, thresholds, mix, (sleep_speed, sleep_time))| {
            let [sleep, warm_starting, block_solve, recycling, projection, split_kick, adaptive] = flags;
            let (tick_rate, substeps, iterations, relax_iterations) = numbers;
            let (restitution_threshold, hit_threshold, gravitational_constant, limit) = thresholds;
            let base = if classic { Settings::classic() } else { Settings::default() };
            let base = Settings { tick_rate, sleep, restitution_threshold, hit_threshold, ..base };
            let base = Settings { friction_mix: mix, restitution_mix: mix, gravitational_constant, ..base };
            let base = Settings { max_speed: limit, max_spin: limit, adaptive, ..base };
            let base = Settings { sleep_speed, sleep_time, ..base };
            if classic {
                return base;
            }
            let position_correction = if projection {
                PositionCorrection::Projection { iterations }
            } else {
                PositionCorrection::Bias
            };
            let base = Settings { substeps, iterations, relax_iterations, split_kick, ..base };
            Settings { warm_starting, block_solve, recycling, position_correction, ..base }
        },
    )
}

pub(crate) fn attractor() -> impl Strategy<Value = Attractor> {
    let mass = prop_oneof![narrow(-100.0, 100.0), signed(-3.0, 18.0)];
    (place(), mass, prop::option::of(magnitude(-3.0, 12.0)), magnitude(-3.0, 3.0)).prop_map(
        |(at, mass, range, soft)| {
            let attractor = Attractor::try_new(at, mass, range).expect("within the limits");
            attractor.with_min_distance(soft).unwrap_or(Attractor::global(at, mass))
        },
    )
}
