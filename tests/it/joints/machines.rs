//! Machines of heavy and light bodies that fall.

use rustycs::prelude::*;

use crate::support::{add, earth};

/// Half a width without its corners, and their radius, m.
fn rounded(half: f32, radius: f32) -> Shape {
    Shape::rounded([[-half, -half], [half, -half], [half, half], [-half, half]], radius).unwrap()
}

fn capsule(half: f32, radius: f32) -> Shape {
    Shape::capsule([-half, 0.0], [half, 0.0], radius)
}

/// A line between walls, and on it two loose bodies of 0.3 and 0.1 kg.
fn ground() -> World {
    let mut world = earth();
    add(&mut world, Body::fixed(Shape::segment([-20.0, 0.0], [20.0, 0.0])));
    for side in [-1.0, 1.0] {
        add(&mut world, Body::fixed(Shape::aabb(1.0, 12.0)).at([8.0 * side, 5.0]));
    }
    let loose = [
        (
            rounded(0.080_755_09, 0.024_226_53),
            [-1.579_095_125_198_364_3, 0.258_494_973_182_678_2],
            0.332_880_1,
        ),
        (
            rounded(0.034_080_096, 0.010_224_029),
            [2.169_604_301_452_636_7, 0.178_447_365_760_803_22],
            0.109_846_76,
        ),
    ];
    for (shape, place, mass) in loose {
        add(&mut world, Body::dynamic(shape).at(place).mass(mass).rolling_resistance(0.05));
    }
    world
}

/// Corners of the plate.
const PENTAGON: [[f32; 2]; 5] = [
    [0.345_503, 0.0],
    [0.106_766_29, 0.328_592_9],
    [-0.279_517_83, 0.203_081_55],
    [-0.279_517_77, -0.203_081_61],
    [0.106_766_34, -0.328_592_87],
];

/// The bodies of the machine: hub, tip, plate, a heavy one, a weight, a wheel; and a slide and its rail.
fn fall(world: &mut World) -> [BodyId; 8] {
    [
        (
            Shape::circle(0.451_724_3),
            [4.304_767_608_642_578, 4.560_060_977_935_791],
            0.689_670_3,
            0.937_832_24,
        ),
        (
            Shape::obb(0.204_772_17, 0.077_207_13),
            [4.685_135_364_532_471, 5.068_822_860_717_773],
            1.326_724,
            0.289_356_23,
        ),
        (
            Shape::polygon(PENTAGON).unwrap(),
            [4.395_499_229_431_152, 3.593_335_628_509_521_5],
            2.613_122_5,
            2.256_823_8,
        ),
        (
            capsule(0.236_001_9, 0.157_334_6),
            [3.537_225_723_266_601_6, 4.116_393_566_131_592],
            0.739_105_2,
            866.952_45,
        ),
        (
            capsule(0.258_700_76, 0.172_467_17),
            [4.719_564_437_866_211, 2.748_603_582_382_202],
            1.698_524_5,
            351.397_64,
        ),
        (
            rounded(0.144_406_54, 0.043_321_963),
            [3.910_931_348_800_659, 3.149_160_861_968_994],
            2.428_813,
            0.558_784_07,
        ),
        (
            rounded(0.109_778_404, 0.032_933_522),
            [0.244_918_584_823_608_4, 4.577_849_388_122_559],
            2.190_573_7,
            1.436_322_6,
        ),
        (
            capsule(0.247_839_73, 0.165_226_49),
            [0.816_273_987_293_243_4, 5.062_477_111_816_406],
            -0.642_575_74,
            0.664_553_8,
        ),
    ]
    .map(|(shape, place, angle, mass)| {
        let velocity =
            if place[0] > 1.0 { [-2.428_285_4, -0.999_751_1] } else { [-1.800_235_7, -1.705_920_7] };
        let body = Body::dynamic(shape).at(place).angle(angle).mass(mass).velocity(velocity);
        add(world, body.rolling_resistance(0.05))
    })
}

/// A machine of six bodies of 0.3 to 867 kg, with limits, falls beside a loose slide. A limit that is met bears nothing more: where the others were
/// to bear what they would with it, each turn of contacts and joints had three times the energy of the one before.
#[test]
fn a_machine_that_falls_on_its_limits_does_not_explode() {
    let mut world = ground();
    let [hub, tip, plate, heavy, weight, wheel, slide, rail] = fall(&mut world);
    let knee = Joint::revolute(plate, hub).at([4.356_177_806_854_248, 4.012_295_722_961_426]);
    let arm = Joint::prismatic(heavy, hub).at([3.894_480_705_261_230_5, 4.322_900_295_257_568]);
    let hip = Joint::revolute(plate, weight).at([4.539_659_976_959_228_5, 3.217_555_522_918_701]);
    let axle = Joint::wheel(wheel, weight).at([4.205_946_922_302_246, 3.003_024_578_094_482_4]);
    let loose = Joint::prismatic(rail, slide).at([0.704_883_337_020_874, 4.967_994_689_941_406]);
    for joint in [
        Joint::distance(tip, hub),
        knee.limits(-0.5..=0.7).collide_connected(true),
        arm.axis([-0.355_112_08, 0.379_806_97]).limits(-0.15..=0.2),
        hip.limits(-0.5..=0.7),
        axle.axis([-0.441_213_37, 0.595_013_4]).travel(-0.1..=0.1),
        Joint::distance(hub, wheel),
        loose.axis([-0.927_815_44, 0.816_288_9]).limits(-0.15..=0.2),
    ] {
        world.add_joint(joint).unwrap();
    }
    let (mut least, mut deepest) = (world.energy(), 0.0_f64);
    for _ in 0..150 {
        world.step();
        let energy = world.energy();
        deepest = deepest.max(world.error().penetration.into());
        // What overlaps is lifted, no farther than it was deep; beside that, energy is kept to a thousandth.
        let most = 1.001 * least + 867.0 * 9.81 * deepest;
        assert!(energy < most, "{} s: {energy} J of {least} J, {deepest} m deep", world.time());
        least = least.min(energy);
    }
    // It strikes the ground at 6 m/s through parts of a thousandth of its mass, and is to be stopped within two thirds of their width.
    assert!(deepest < 0.2, "{deepest} m");
}
