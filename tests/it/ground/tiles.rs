//! Ground of tiles is covered by few boxes, is as smooth as one floor, and an edit changes one chunk of it.

use rustycs::prelude::*;

use crate::support::{add, earth, place, run, velocity};

/// The numbers of a linear congruential generator (the multiplier of MMIX), 0 to 99.
fn percentages(mut state: u64) -> impl Iterator<Item = u64> {
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % 100
    })
}

fn random_map(seed: u64, count: usize, percentage: u64) -> Vec<bool> {
    percentages(seed).take(count).map(|number| number < percentage).collect()
}

/// Half a tile around, each solid tile has one box there, and no other tile has any.
fn check_cover(world: &World, bodies: &[BodyId], corner: [f64; 2], size: f64, map: &[bool], width: usize) {
    for (index, &is_solid) in map.iter().enumerate() {
        let [x, y] = [index % width, index / width].map(|at| (at as f64 + 0.5) * size);
        let place = [corner[0] + x, corner[1] + y];
        let colliders = bodies.iter().flat_map(|&id| world.body(id).unwrap().colliders());
        let count = colliders.filter(|collider| collider.contains(place)).count();
        assert_eq!(count, usize::from(is_solid), "tile {index}");
    }
    let area: f32 = bodies
        .iter()
        .flat_map(|&id| world.body(id).unwrap().colliders())
        .map(|collider| collider.shape().area())
        .sum();
    let expected = map.iter().filter(|&&is_solid| is_solid).count() as f64 * size * size;
    assert!((f64::from(area) - expected).abs() <= 1e-5 * expected, "{area} m², not {expected}");
}

#[test]
fn every_solid_tile_is_covered_once() {
    for (seed, percentage) in [(1, 30), (2, 60), (3, 95)] {
        let (width, height) = (37, 21);
        let map = random_map(seed, width * height, percentage);
        let mut world = World::new(Settings::default());
        let id = add(&mut world, Ground::from_tiles(&map, width, 0.5).at([100.0, -50.0]));
        check_cover(&world, &[id], [100.0, -50.0], 0.5, &map, width);

        let mut world = World::new(Settings::default());
        let mut tiles = TileMap::new(&map, width, 0.5).at([100.0, -50.0]);
        tiles.add_to(&mut world).unwrap();
        let bodies: Vec<BodyId> = tiles.bodies().collect();
        assert_eq!(bodies.len(), 3 * 2, "a body for each chunk of 16 x 16");
        check_cover(&world, &bodies, [100.0, -50.0], 0.5, &map, width);
        world.validate().unwrap();
    }
}

#[test]
fn an_edit_changes_one_chunk() {
    let (width, height) = (50, 40);
    let mut map = random_map(4, width * height, 50);
    let mut world = World::new(Settings::default());
    let mut tiles = TileMap::new(&map, width, 1.0);
    tiles.add_to(&mut world).unwrap();
    for (number, random) in percentages(5).take(200).enumerate() {
        let index = (number * 97 + random as usize) % map.len();
        let tile = [index % width, index / width];
        let before: Vec<BodyId> = tiles.bodies().collect();
        map[index] = !map[index];
        assert_eq!(tiles.set(&mut world, tile, map[index]), Ok(true));
        assert_eq!(tiles.set(&mut world, tile, map[index]), Ok(false), "it is so already");
        assert_eq!(tiles.tile_at(tiles.center_of(tile)), Some(tile));
        let after: Vec<BodyId> = tiles.bodies().collect();
        assert_eq!(before.iter().filter(|id| !after.contains(id)).count(), 1);
        assert_eq!((world.bodies().count(), tiles.is_solid(tile)), (after.len(), map[index]));
    }
    check_cover(&world, &tiles.bodies().collect::<Vec<_>>(), [0.0, 0.0], 1.0, &map, width);
    world.validate().unwrap();
    assert_eq!(tiles.set(&mut world, [width, 0], true), Ok(false), "beyond the map");
    assert_eq!((tiles.tile_at([-0.1, 3.0]), tiles.tile_at([f64::NAN, 3.0])), (None, None));
    tiles.remove_from(&mut world);
    assert_eq!(world.bodies().count(), 0);
}

/// The last tile of a chunk leaves, and comes back.
#[test]
fn a_chunk_without_tiles_is_no_body() {
    let mut world = World::new(Settings::default());
    let mut tiles = TileMap::new(&[false; 20 * 3], 20, 1.0);
    tiles.add_to(&mut world).unwrap();
    assert_eq!(world.bodies().count(), 0);
    assert_eq!(tiles.set(&mut world, [18, 1], true), Ok(true));
    assert_eq!(world.bodies().count(), 1);
    assert_eq!(tiles.set(&mut world, [18, 1], false), Ok(true));
    assert_eq!(world.bodies().count(), 0);
}

/// It is the size of the tiles that is told, and not what follows from it; that of a map without tiles as well.
#[test]
fn a_bad_size_of_tiles_is_told_as_such() {
    let mut world = World::new(Settings::default());
    for size in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
        for is_solid in [true, false] {
            let ground = world.add(Ground::from_tiles(&[is_solid; 4], 2, size)).map(|_| ());
            for refused in [ground, TileMap::new(&[is_solid; 4], 2, size).add_to(&mut world)] {
                let text = refused.unwrap_err().to_string();
                let told = format!("the size of a tile is {size} m: choose");
                assert!(text.contains(&told), "{size}, {is_solid}: {text}");
            }
        }
    }
    let nowhere = TileMap::new(&[false; 4], 2, 1.0).at([f64::NAN, 0.0]).add_to(&mut world).unwrap_err();
    assert!(nowhere.to_string().contains("x of the position"), "{nowhere}");
}

/// A map that no world takes is not edited either, before it is added and after it was refused.
#[test]
fn a_map_of_a_bad_size_takes_no_edit() {
    let mut world = World::new(Settings::default());
    for size in [0.0, f32::NAN, f32::INFINITY] {
        let mut map = TileMap::new(&[false; 4], 2, size);
        for _ in 0..2 {
            let text = map.set(&mut world, [0, 1], true).unwrap_err().to_string();
            assert!(text.contains(&format!("the size of a tile is {size} m: choose")), "{size}: {text}");
            assert!(!map.is_solid([0, 1]) && map.add_to(&mut world).is_err());
        }
    }
    let mut nowhere = TileMap::new(&[false; 4], 2, 1.0).at([f64::NAN, 0.0]);
    assert!(nowhere.set(&mut world, [0, 1], true).is_err());
    let mut map = TileMap::new(&[false; 4], 2, 1.0);
    assert_eq!(map.set(&mut world, [0, 1], true), Ok(true), "before it is added");
    map.add_to(&mut world).unwrap();
    assert_eq!(world.bodies().count(), 1);
}

#[test]
fn a_map_that_cannot_be_is_refused_as_a_whole() {
    let mut world = World::new(Settings::default());
    for size in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e9] {
        assert!(world.add(Ground::from_tiles(&[true; 4], 2, size)).is_err(), "{size}");
        assert!(TileMap::new(&[true; 4], 2, size).add_to(&mut world).is_err(), "{size}");
    }
    assert_eq!(world.add(Ground::from_tiles(&[false; 4], 2, 1.0)), Err(BodyError::NoSolidTile));
    assert_eq!(world.add(Ground::from_tiles(&[true; 4], 0, 1.0)), Err(BodyError::NoSolidTile));
    assert!(BodyError::NoSolidTile.to_string().contains("no tile of the map is solid: give it one"));
    // The last chunk is out of range, the first is not.
    let mut map = TileMap::new(&[true; 64], 64, 1e6).at([1e12 - 2e7, 0.0]);
    assert!(map.add_to(&mut world).is_err());
    assert_eq!((world.bodies().count(), map.bodies().count()), (0, 0));
}

/// An uneven floor below a level top: boxes of many sizes, and chunks, that meet below what slides.
fn terraces(width: usize, height: usize) -> Vec<bool> {
    let depths: Vec<u64> = percentages(6).take(width).collect();
    let tile = |index: usize| (index / width) as u64 + depths[index % width] % 3 >= 2;
    (0..width * height).map(tile).collect()
}

#[test]
fn what_slides_over_a_map_does_not_feel_its_boxes_and_chunks() {
    let (width, height) = (100, 4);
    let map = terraces(width, height);
    for is_in_chunks in [false, true] {
        for shape in [Shape::rectangle(0.8, 0.8), Shape::aabb(0.8, 0.8), Shape::circle(0.4)] {
            for speed in [1.0_f32, 8.0, 20.0] {
                let mut world = earth();
                let corner = [-5.0, -4.0];
                let smooth = Material { friction: 0.0, restitution: 0.0, ..Material::STONE };
                if is_in_chunks {
                    let mut tiles = TileMap::new(&map, width, 1.0).at(corner).material(smooth);
                    tiles.add_to(&mut world).unwrap();
                } else {
                    let ground = Ground::from_tiles(&map, width, 1.0).at(corner).material(smooth);
                    let ground = add(&mut world, ground);
                    assert!(world.body(ground).unwrap().colliders().count() > 30);
                }
                let body = Body::dynamic(shape).at([0.1, 0.4]).velocity([speed, 0.0]);
                let id = add(&mut world, body.friction(0.0).restitution(0.0));
                let mut kick = 0.0_f64;
                let seconds = (80.0 / speed).min(8.0);
                for _ in 0..(seconds * 60.0) as u32 {
                    world.step();
                    kick = kick.max(velocity(&world, id)[1]);
                }
                // As over flush tiles, see `seams`: 0.5 mm/s by the sag of contacts, and 1e-4 of the speed.
                let loss = (f64::from(speed) - velocity(&world, id)[0]).abs() / f64::from(speed);
                assert!(kick < 5e-4 && loss < 1e-4, "{shape:?} at {speed} m/s: {kick} m/s up, {loss} lost");
            }
        }
    }
}

/// A box lies over a chunk that is edited: it falls into the hole, and what is filled bears again.
#[test]
fn what_lies_on_a_map_follows_its_edits() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    let mut tiles = TileMap::new(&[true; 20 * 3], 20, 1.0).at([0.0, -3.0]);
    tiles.add_to(&mut world).unwrap();
    let id = add(&mut world, Body::dynamic(Shape::rectangle(0.6, 0.6)).at([8.5, 0.3]).restitution(0.0));
    run(&mut world, 3.0);
    assert!(world.body(id).unwrap().is_sleeping());
    tiles.set(&mut world, [8, 2], false).unwrap();
    run(&mut world, 3.0);
    assert!((place(&world, id)[1] + 0.7).abs() < 2e-3, "{:?}", place(&world, id));
    tiles.set(&mut world, [8, 1], false).unwrap();
    run(&mut world, 3.0);
    assert!((place(&world, id)[1] + 1.7).abs() < 2e-3, "{:?}", place(&world, id));
}
