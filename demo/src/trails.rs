//! Where bodies have been.

use std::collections::VecDeque;

use rustycs::{BodyId, BodyType, Point, World};

/// Places kept at most, of all bodies together.
const MOST_PLACES: usize = 60_000;
/// Moments kept, at least and at most.
const MOMENTS: [usize; 2] = [8, 480];

/// The places of the moving bodies over the last ticks, oldest first; each moment by ascending id.
#[derive(Debug, Default)]
pub(crate) struct Trails {
    moments: VecDeque<Vec<(BodyId, Point)>>,
}

impl Trails {
    /// Keeps where the bodies are.
    pub(crate) fn observe(&mut self, world: &World) {
        let most = (MOST_PLACES / world.body_count().max(1)).clamp(MOMENTS[0], MOMENTS[1]);
        let mut places = Vec::new();
        while self.moments.len() >= most {
            places = self.moments.pop_front().unwrap_or_default();
        }
        places.clear();
        let moving = world.bodies().filter(|(_, body)| body.body_type() != BodyType::Fixed);
        places.extend(moving.map(|(id, body)| (id, body.pose().center)));
        self.moments.push_back(places);
    }

    /// Forgets all places.
    pub(crate) fn clear(&mut self) {
        self.moments.clear();
    }

    /// Every piece of every trail, with its age as a share of the oldest: 0 is now.
    pub(crate) fn pieces(&self, mut draw: impl FnMut(Point, Point, f32)) {
        let count = self.moments.len();
        for index in 1..count {
            let age = (count - 1 - index) as f32 / count as f32;
            let mut later = self.moments[index].iter().peekable();
            for (id, from) in &self.moments[index - 1] {
                while later.next_if(|(other, _)| other < id).is_some() {}
                if let Some((_, to)) = later.next_if(|(other, _)| other == id) {
                    draw(*from, *to, age);
                }
            }
        }
    }
}
