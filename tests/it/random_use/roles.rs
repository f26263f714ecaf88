//! Changes of what bodies are to what they meet.

use proptest::prelude::*;
use rustycs::prelude::*;

use super::values::narrow;

/// A change of the role of one body.
#[derive(Clone, Debug)]
pub(crate) enum RoleChange {
    Filter(Filter),
    Sensor(bool),
    OneWay(Option<[f32; 2]>),
    SurfaceSpeed(f32),
    /// With another body.
    Collision(usize, bool),
}

pub(crate) fn role_change() -> impl Strategy<Value = RoleChange> {
    let filter = (0_u64..4, 0_u64..8, -1_i32..2)
        .prop_map(|(bit, mask, group)| RoleChange::Filter(Filter { category: 1 << bit, mask, group }));
    let direction = [narrow(-1.0, 1.0), narrow(0.1, 1.0)];
    prop_oneof![
        2 => filter,
        1 => any::<bool>().prop_map(RoleChange::Sensor),
        2 => prop::option::of(direction).prop_map(RoleChange::OneWay),
        2 => prop_oneof![narrow(-5.0, 5.0), narrow(-1e6, 1e6)].prop_map(RoleChange::SurfaceSpeed),
        1 => (any::<usize>(), any::<bool>()).prop_map(|(other, collide)| RoleChange::Collision(other, collide)),
    ]
}

/// Changes the role of a body, which may be gone.
pub(crate) fn change_role(world: &mut World, id: BodyId, change: &RoleChange, all: &[BodyId]) {
    if let RoleChange::Collision(other, collide) = *change {
        let other = all[other % all.len()];
        let before = world.set_collision(id, other, collide);
        assert_eq!(before.is_some(), world.may_collide(other, id).is_some());
        return;
    }
    let Some(mut body) = world.body_mut(id) else { return };
    match *change {
        RoleChange::Filter(filter) => body.set_filter(filter),
        RoleChange::Sensor(is_sensor) => body.set_sensor(is_sensor),
        RoleChange::OneWay(direction) => {
            body.set_one_way(direction.map(Vec2::from)).expect("it has a length");
        }
        RoleChange::SurfaceSpeed(speed) => _ = body.set_surface_speed(speed),
        RoleChange::Collision(..) => {}
    }
}
