//! A ball on a chain, of ten times the mass of a link, a breakable weld, and a wheel that a motor drives.
//!
//! `cargo run --release --example joints`

use rustycs::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);

    // A chain of ten links from (0, 0) to the right, and the ball at its end.
    let (mut before, mut pins) = (None, Vec::new());
    for number in 0..10_u8 {
        let x = f64::from(number);
        let link = world.add(Body::dynamic(Shape::obb(1.0, 0.25)).at([x + 0.5, 0.0]).mass(6.0))?;
        pins.push(world.add_joint(Joint::revolute(link, before).at([x, 0.0]))?);
        before = Some(link);
    }
    let ball = world.add(Body::dynamic(Shape::circle(2.0)).at([12.0, 0.0]).mass(60.0))?;
    pins.push(world.add_joint(Joint::revolute(ball, before).at([10.0, 0.0]))?);

    // A sign that is welded to the world, and a wheel on a motor.
    let sign = world.add(Body::dynamic(Shape::obb(1.0, 1.0)).at([-5.0, 0.0]).mass(10.0))?;
    let weld = world.add_joint(Joint::weld(sign, None).break_at(90.0, f32::INFINITY))?;
    let wheel = world.add(Body::dynamic(Shape::circle(0.5)).at([-10.0, 0.0]).mass(2.0))?;
    let motor = world.add_joint(Joint::revolute(wheel, None).motor(10.0, 5.0))?;

    for tick in 0..180 {
        world.step();
        if world.events().broken().contains(&weld) {
            println!("tick {tick}: the weld broke: 98 N are more than 90 N");
        }
        if tick % 30 == 29 {
            let joints = pins.iter().filter_map(|&pin| world.joint(pin));
            let gap = joints.map(|joint| joint.error().distance).fold(0.0, f32::max);
            let force = world.joint(pins[0]).map_or(0.0, |joint| joint.force().length());
            println!("{:.1} s: largest gap {:.1e} m, {:.0} N in the first pin", world.time(), gap, force);
        }
    }
    let turned = world.joint(motor).map_or(0.0, |joint| joint.angle());
    println!(
        "the wheel has turned by {turned:.2} rad, clockwise: the angle is that of the world as the wheel sees it"
    );
    Ok(())
}
