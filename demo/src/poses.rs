//! Bodies between two ticks: a screen shows frames at times of its own.

use rustycs::{BodyId, BodyRef, Pose, Rot, World};

/// Where bodies were before the last tick, in the order in which the world lists them.
#[derive(Debug, Default)]
pub(crate) struct Poses {
    before: Vec<(BodyId, Pose)>,
    scratch: Vec<(BodyId, Pose)>,
}

impl Poses {
    /// Takes as many ticks as fit into `seconds`, and keeps the poses before the last of them.
    ///
    /// Time is handed over in pieces of at most a tick, so that each makes at most one.
    pub(crate) fn advance(&mut self, world: &mut World, seconds: f64, mut after_tick: impl FnMut(&World)) {
        let tick = world.settings().tick_seconds();
        // More would only be dropped by the world, which does not try to catch up after a slow frame.
        let mut left = seconds.min(8.0 * tick);
        while left > 0.0 {
            self.scratch.clear();
            self.scratch.extend(world.bodies().map(|(id, body)| (id, body.pose())));
            if world.advance(left.min(tick)) > 0 {
                core::mem::swap(&mut self.before, &mut self.scratch);
                after_tick(world);
            }
            left -= tick;
        }
    }

    /// Forgets them: bodies are shown where they are.
    pub(crate) fn forget(&mut self) {
        self.before.clear();
    }

    /// Every body of the world with the pose to show it in: between the last two ticks where both are known.
    pub(crate) fn bodies<'w>(&self, world: &'w World) -> impl Iterator<Item = (BodyRef<'w>, Pose)> {
        let alpha = world.alpha();
        let mut before = self.before.iter().peekable();
        world.bodies().map(move |(id, body)| {
            while before.peek().is_some_and(|(earlier, _)| *earlier < id) {
                before.next();
            }
            let pose = match before.next_if(|(earlier, _)| *earlier == id) {
                Some(&(_, earlier)) => between(earlier, body.pose(), alpha),
                None => body.pose(),
            };
            (body, pose)
        })
    }
}

/// The pose a share of the way from one to the next. A turn within a tick is small, so that mixing the
/// directions and making them of length 1 again is as good as turning at an even pace.
fn between(from: Pose, to: Pose, share: f32) -> Pose {
    let mix = |from: f32, to: f32| from + (to - from) * share;
    let (c, s) = (mix(from.rotation.c, to.rotation.c), mix(from.rotation.s, to.rotation.s));
    Pose { center: from.center + (to.center - from.center) * share, rotation: Rot { c, s }.normalized() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustycs::{Body, Settings, Shape};

    #[test]
    fn a_body_is_shown_between_its_last_two_places() {
        let mut world = World::new(Settings::default());
        world.add(Body::dynamic(Shape::circle(1.0)).velocity([60.0, 0.0])).unwrap();
        let mut poses = Poses::default();
        let mut ticks = 0;
        // A tick and a half: one is taken, half of the next has passed.
        poses.advance(&mut world, 1.5 / 60.0, |_| ticks += 1);
        assert_eq!(ticks, 1);
        let (_, pose) = poses.bodies(&world).next().unwrap();
        assert!((pose.center.x - 0.5).abs() < 1e-5, "{}", pose.center.x);
    }
}
