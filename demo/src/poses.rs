//! Bodies between two ticks: a screen shows frames at times of its own.

use rustycs::{BodyId, BodyRef, Pose, Rot, World};

/// Where bodies were before the last tick, in the order in which the world lists them.
#[derive(Debug, Default)]
pub(crate) struct Poses {
    before: Vec<(BodyId, Pose)>,
}

impl Poses {
    /// Keeps where the bodies are: to be called before a tick.
    pub(crate) fn keep(&mut self, world: &World) {
        self.before.clear();
        self.before.extend(world.bodies().map(|(id, body)| (id, body.pose())));
    }

    /// Forgets them: bodies are shown where they are.
    pub(crate) fn forget(&mut self) {
        self.before.clear();
    }

    /// Every body of the world with the pose to show it in: where both are known, a share of the way from the
    /// pose before the last tick (0) to that after it (1).
    pub(crate) fn bodies<'w>(
        &self,
        world: &'w World,
        share: f32,
    ) -> impl Iterator<Item = (BodyId, BodyRef<'w>, Pose)> {
        let mut before = self.before.iter().peekable();
        world.bodies().map(move |(id, body)| {
            while before.peek().is_some_and(|(earlier, _)| *earlier < id) {
                before.next();
            }
            let pose = match before.next_if(|(earlier, _)| *earlier == id) {
                Some(&(_, earlier)) => between(earlier, body.pose(), share),
                None => body.pose(),
            };
            (id, body, pose)
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
        poses.keep(&world);
        world.step();
        let (_, _, pose) = poses.bodies(&world, 0.5).next().unwrap();
        assert!((pose.center.x - 0.5).abs() < 1e-5, "{}", pose.center.x);
        poses.forget();
        let (_, _, pose) = poses.bodies(&world, 0.5).next().unwrap();
        assert!((pose.center.x - 1.0).abs() < 1e-5, "{}", pose.center.x);
    }
}
