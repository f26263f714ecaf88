//! A world whose bodies were removed kept all memory they had taken, and so did its clones, which took as long to make.

use rustycs::prelude::*;

use crate::support::{add, add_floor, earth_with, unit_box};

const MANY: u32 = 8000;

/// In which order bodies are removed.
#[derive(Clone, Copy, Debug)]
enum Order {
    FirstToLast,
    LastToFirst,
    /// Every seventh, then those after them, and so on.
    Scattered,
}

/// A world that was large, and what it has left.
struct Crowd {
    world: World,
    /// Three boxes on a floor.
    left: [BodyId; 3],
    /// Boxes in the air, which touch each other.
    others: Vec<BodyId>,
}

impl Crowd {
    fn new(settings: &Settings, count: u32) -> Self {
        let mut world = earth_with(settings.clone());
        add_floor(&mut world, 0.5);
        let left = [0, 1, 2].map(|row| add(&mut world, unit_box(0.1 * f64::from(row), 0.5 + f64::from(row))));
        let places =
            (0..count).map(|number| [f64::from(number % 100) - 50.0, 10.5 + f64::from(number / 100)]);
        let others = places.map(|[x, y]| add(&mut world, unit_box(x, y).gravity_scale(0.0))).collect();
        Self { world, left, others }
    }

    fn step(&mut self, ticks: usize) {
        (0..ticks).for_each(|_| self.world.step());
    }

    fn remove_others(&mut self, order: Order) {
        match order {
            Order::FirstToLast => {}
            Order::LastToFirst => self.others.reverse(),
            Order::Scattered => self.others.sort_by_key(|id| id.to_bits() as u32 % 7),
        }
        for id in self.others.drain(..) {
            assert!(self.world.remove(id).is_some() && self.world.body(id).is_none());
        }
        self.world.validate().unwrap();
    }
}

/// Bytes that a clone asks for.
fn size_of_clone(world: &World) -> u64 {
    allocation_counter::measure(|| drop(world.clone())).bytes_total
}

/// Fewer than 1024 slots may stay, so that it takes no more than a world with so many bodies, once it has told which
/// contacts ended. Of the most it held, an eighth may be left: the lists of these events.
#[test]
fn a_world_that_lost_its_bodies_takes_the_memory_of_few() {
    let settings = Settings::default();
    let mut few = Crowd::new(&settings, 1024);
    few.step(5);
    let few = size_of_clone(&few.world);
    for order in [Order::FirstToLast, Order::LastToFirst, Order::Scattered] {
        let mut crowd = None;
        let memory = allocation_counter::measure(|| {
            let crowd = crowd.insert(Crowd::new(&settings, MANY));
            crowd.step(5);
            crowd.remove_others(order);
            crowd.step(2);
        });
        let clone = size_of_clone(&crowd.expect("it was made").world);
        assert!(clone <= few, "{order:?}: a clone asks for {clone} bytes, of 1024 bodies for {few}");
        let (now, most) = (memory.bytes_current, memory.bytes_max as i64);
        assert!(now <= most / 8, "{order:?}: it holds {now} bytes of {most}");
    }
}

/// It moves on as one that never was large, bit for bit; ids of bodies that are gone stay stale for good.
#[test]
fn a_world_that_lost_its_bodies_moves_on_as_if_they_had_never_been() {
    for settings in [Settings::default(), Settings::classic()] {
        let [mut large, mut small] = [MANY, 0].map(|count| Crowd::new(&settings, count));
        let stale = large.others.clone();
        for tick in 0..120 {
            if tick == 30 {
                large.remove_others(Order::Scattered);
            }
            let [one, other] = [&mut large, &mut small].map(|Crowd { world, left, .. }| {
                if tick >= 60 {
                    add(world, unit_box(0.01 * f64::from(tick), 1.0 + f64::from(tick)));
                }
                world.step();
                world.validate().unwrap();
                left.map(|id| {
                    let body = world.body(id).unwrap();
                    (body.position_f64(), body.velocity(), body.angular_velocity(), body.rotation())
                })
            });
            assert_eq!(one, other, "tick {tick}");
        }
        assert!(stale.into_iter().all(|id| large.world.body(id).is_none()));
    }
}
