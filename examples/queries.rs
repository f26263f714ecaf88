//! Questions to a world: what is here, what is in this box, what does a ray meet?
//!
//! `cargo run --example queries`

use rustycs::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut world = World::new(Settings::default());
    let disc = world.add(Body::fixed(Shape::circle(1.5)).at([7.0, 6.0]))?;
    let slab = world.add(Body::fixed(Shape::obb(8.0, 1.0)).at([20.0, 5.0]).angle(0.5))?;
    let tent = Shape::polygon([[0.0, 0.0], [6.0, 0.0], [3.0, 4.0]])?;
    let tent = world.add(Body::fixed(tent).at([32.0, 5.0]))?;
    let sign = |id| match id {
        id if id == disc => 'o',
        id if id == slab => '#',
        _ => '^',
    };

    // A picture, asked for character by character: a column is half a metre wide, a row one metre high.
    for row in (0..12).rev() {
        let at = |column: i32| world.bodies_at([0.5 * f64::from(column), f64::from(row)]);
        let line: String = (0..80).map(|column| at(column).first().map_or('.', |&id| sign(id))).collect();
        println!("{line}");
    }

    let in_box = world.bodies_in([0.0, 0.0], [22.0, 10.0]);
    println!("in the left half: {}", in_box.iter().map(|&id| sign(id)).collect::<String>());
    assert_eq!(in_box, [disc, slab]);

    println!("a ray from the left at height 6:");
    let hits = world.ray_cast_all([0.0, 6.0], [40.0, 0.0]);
    for hit in &hits {
        let (x, normal) = (hit.point.x, hit.normal);
        println!("  meets {} at x = {x:5.2} m, normal ({:5.2}, {:5.2})", sign(hit.body), normal.x, normal.y);
    }
    assert_eq!(hits.iter().map(|hit| hit.body).collect::<Vec<_>>(), [disc, slab, tent]);

    let first = world.ray_cast([0.0, 6.0], [40.0, 0.0]).ok_or("the ray meets the disc")?;
    assert_eq!(first.body, disc);
    // The ray goes through the middle of the disc: it meets the outline a radius before it.
    assert!((first.point.x - 5.5).abs() < 1e-4);

    // Answers follow every edit at once, without a step.
    world.remove(disc);
    let first = world.ray_cast([0.0, 6.0], [40.0, 0.0]).ok_or("the ray meets the slab")?;
    println!("without the disc it meets {} first", sign(first.body));
    assert_eq!(first.body, slab);
    Ok(())
}
