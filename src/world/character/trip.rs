//! One move of a character.
//!
//! It goes along its way until something is met, a gap before it, and then on along that, a few times. On the ground it follows
//! the ground and keeps its speed; in the air it keeps what is left of its way along the surface. Two surfaces that face each other
//! end it.

use crate::body::{BodyId, BodyType};
use crate::math::{Point, Vec2};
use crate::world::character::Character;
use crate::world::{ShapeHit, World};

/// Surfaces along which a character goes on in one move: more are met only where it hardly moves any more.
const MOST_SURFACES: usize = 6;

/// Of a surface that is met at a small angle the gap ends long before the surface is met: a way is looked at beyond its end for as
/// many gaps. That keeps the gap down to an angle of 7°, the arc sine of one over this; at less a character comes nearer to the
/// surface, and is lifted when it is set down.
const LOOK_AHEAD: f32 = 8.0;

/// A way at less than this sine to a surface goes along it: over a metre it comes nearer by a millimetre, which is less than the gap. The
/// rounding of two parallel surfaces is 1e-6.
pub(super) const ALONG: f32 = 1e-3;

/// A surface that leans out over the character by more than this, the sine of 1°, is above it.
const OVERHANG: f32 = 0.0175;

/// A move under way.
pub(super) struct Trip<'a> {
    pub(super) world: &'a World,
    pub(super) character: &'a Character,
    pub(super) passes_one_way: bool,
    /// The gap that is kept, m.
    pub(super) skin: f32,
    /// What moves the character with it, and so is not in its way.
    pub(super) carrier: Option<BodyId>,
    pub(super) at: Point,
    pub(super) ground: Option<ShapeHit>,
    pub(super) wall: Option<ShapeHit>,
    pub(super) ceiling: Option<ShapeHit>,
    /// Least cosine between the normal of a surface that can be walked and the direction up.
    walkable: f32,
    /// Where it walks to, across up, m.
    heading: Vec2,
}

/// What is met on a way.
#[derive(Clone, Copy)]
struct Meeting {
    hit: ShapeHit,
    /// Where it is touched, from the centre of the character there, m.
    arm: Vec2,
}

/// What a surface is to a character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Surface {
    Ground,
    Wall,
    Ceiling,
}

impl<'a> Trip<'a> {
    pub(super) fn new(world: &'a World, character: &'a Character, at: Point, passes_one_way: bool) -> Self {
        // A little more, so that rounding does not make a slope of just that angle too steep.
        let walkable = Vec2::from_angle(character.max_slope).x - 1e-4;
        let (skin, carrier) = (character.get_skin(), None);
        let (ground, wall, ceiling, heading) = (None, None, None, Vec2::ZERO);
        Self { world, character, passes_one_way, skin, carrier, at, ground, wall, ceiling, walkable, heading }
    }

    /// Goes with what the character stands on.
    pub(super) fn carry(&mut self, on: ShapeHit, way: Vec2) {
        self.carrier = Some(on.body);
        self.slide(way);
        self.carrier = None;
        (self.ground, self.wall, self.ceiling) = (Some(on), None, None);
    }

    /// Goes along a way.
    pub(super) fn go(&mut self, way: Vec2) {
        let up = self.character.up;
        let rise = way.dot(up);
        self.heading = way - up * rise;
        let Some(on) = self.ground.filter(|_| rise <= 0.0) else {
            self.ground = None;
            self.slide(way);
            if rise <= 0.0 && self.ground.is_none() {
                self.set_down(2.0 * self.skin);
            }
            return;
        };
        self.walk(self.heading, on.normal);
        if !self.set_down(self.character.snap.max(2.0 * self.skin) - rise) {
            // The ground has ended; or it stands between two slopes, which is found by going down a little.
            self.ground = None;
            self.slide(up * (rise - 2.0 * self.skin));
        }
    }

    fn surface_of(&self, met: &Meeting) -> Surface {
        let rise = met.hit.normal.dot(self.character.up);
        if rise >= self.walkable || self.is_low_edge(met) {
            Surface::Ground
        } else if rise >= -OVERHANG {
            Surface::Wall
        } else {
            Surface::Ceiling
        }
    }

    /// Whether a round or bevelled part of the character touches the edge of something that can be walked, low enough for a step, as
    /// it walks up over it or down to the next step. Where there is none it slides off the ledge as from a slope.
    fn is_low_edge(&self, met: &Meeting) -> bool {
        let Character { up, step_height, .. } = *self.character;
        let (rise, height) = (met.hit.normal.dot(up), met.arm.dot(up) + self.depth());
        let is_step = rise > 0.0 && height <= step_height && self.is_walkable_beyond(&met.hit);
        is_step && (self.heading.dot(met.hit.normal) < 0.0 || self.is_floor_below())
    }

    /// Whether below its lowest place there is something that can be walked, not farther than it snaps to.
    fn is_floor_below(&self) -> bool {
        let Character { up, snap, .. } = *self.character;
        let foot = self.at - up * self.depth();
        let floor = self.first_solid(foot, up * -(snap + self.skin), None);
        floor.is_some_and(|floor| floor.normal.dot(up) >= self.walkable)
    }

    /// How far below its centre the lowest place of the character is, m.
    fn depth(&self) -> f32 {
        let Character { up, ref shape, .. } = *self.character;
        let depths = shape.vertices().iter().map(|corner| -corner.dot(up));
        depths.reduce(f32::max).map_or(shape.extent(), |depth| depth + shape.corner_radius())
    }

    /// Whether the top of the body is walkable just beyond a place on its outline.
    fn is_walkable_beyond(&self, hit: &ShapeHit) -> bool {
        let up = self.character.up;
        let inward = -(hit.normal - up * hit.normal.dot(up));
        let probe = 2.0 * self.skin;
        let above = hit.point + inward.normalized_or_zero() * probe + up * probe;
        let top = self.sees(hit.body, above, up * (-2.0 * probe));
        top.is_some_and(|top| top.normal.dot(up) >= self.walkable)
    }

    /// How far there is room in a direction, m, and what is met there, if anything is within a distance: where the gap to it is
    /// smaller than it should be, there is less than none.
    fn look(&self, direction: Vec2, distance: f32) -> (f32, Option<Meeting>) {
        let reach = distance + LOOK_AHEAD * self.skin;
        let Some(hit) = self.cast(direction * reach) else { return (distance, None) };
        let approach = (-hit.normal.dot(direction)).max(1.0 / LOOK_AHEAD);
        let room = hit.fraction * reach - self.skin / approach;
        let arm = hit.point - (self.at + direction * (hit.fraction * reach));
        if room < distance { (room, Some(Meeting { hit, arm })) } else { (distance, None) }
    }

    /// Goes as far as there is room, and returns what is left of the way and what is met.
    fn advance(&mut self, way: Vec2) -> Option<(Vec2, Meeting)> {
        let (length, direction) = (way.length(), way.normalized()?);
        let (room, met) = self.look(direction, length);
        let gone = room.max(0.0);
        self.at += direction * gone;
        met.map(|met| (direction * (length - gone), met))
    }

    /// Takes note of what is met.
    fn note(&mut self, surface: Surface, hit: ShapeHit) {
        match surface {
            Surface::Ground => self.ground = Some(hit),
            Surface::Wall => self.wall = Some(hit),
            Surface::Ceiling => self.ceiling = Some(hit),
        }
    }

    /// Walks as far as a way is long, which is level, along ground with this normal.
    fn walk(&mut self, level: Vec2, normal: Vec2) {
        let up = self.character.up;
        let Some(forward) = level.normalized() else { return };
        let mut way = along(forward, normal, up) * level.length();
        for _ in 0..MOST_SURFACES {
            let Some((left, met)) = self.advance(way) else { return };
            let (surface, hit) = (self.surface_of(&met), met.hit);
            if surface == Surface::Ground {
                way = along(forward, hit.normal, up) * left.length();
                self.note(surface, hit);
            } else if surface == Surface::Wall
                && let Some((left, normal)) = self.climb(&hit, forward, left.length())
            {
                way = along(forward, normal, up) * left;
            } else {
                self.note(surface, hit);
                return;
            }
        }
    }

    /// Climbs a step: up, forward and down again, to where it can stand. Returns what is left to walk, m, and the normal of the
    /// ground there; `None` if it cannot, and is where it was.
    fn climb(&mut self, hit: &ShapeHit, forward: Vec2, left: f32) -> Option<(f32, Vec2)> {
        let Character { up, step_height, .. } = *self.character;
        let is_step = self.world.body(hit.body).is_some_and(|body| body.body_type() != BodyType::Dynamic);
        if step_height == 0.0 || !is_step {
            return None;
        }
        let (start, ground) = (self.at, self.ground);
        // As far as it takes to be above the step.
        let distance = left.max(2.0 * self.skin);
        self.advance(up * (step_height + self.skin));
        let risen = (self.at - start).dot(up);
        self.advance(forward * distance);
        let gone = (self.at - start).dot(forward);
        let is_there = gone > self.skin && self.set_down(risen);
        if is_there && let Some(on) = self.ground {
            // What is round could rest on an edge that is higher.
            let height = (on.point - start).dot(up) + self.depth();
            if (0.0..=step_height).contains(&height) {
                return Some(((left - gone).max(0.0), on.normal));
            }
        }
        (self.at, self.ground) = (start, ground);
        None
    }

    /// Sets the character down to ground that is not farther below than a distance, m; returns whether there is any. If there is
    /// none, it stays where it is. What is too near to the ground, as after a landing at a small angle, is lifted to the gap.
    fn set_down(&mut self, distance: f32) -> bool {
        let up = self.character.up;
        let (room, met) = self.look(-up, distance + self.skin);
        let Some(met) = met.filter(|met| self.surface_of(met) == Surface::Ground) else { return false };
        if room >= 0.0 {
            self.at -= up * room;
        } else {
            self.advance(up * -room);
        }
        self.note(Surface::Ground, met.hit);
        true
    }

    /// Goes through the air, and along what is met.
    fn slide(&mut self, way: Vec2) {
        let up = self.character.up;
        let mut way = way;
        let mut last: Option<Vec2> = None;
        for _ in 0..MOST_SURFACES {
            let Some((left, met)) = self.advance(way) else { return };
            let (surface, hit) = (self.surface_of(&met), met.hit);
            let (rise, level) = (left.dot(up), left - up * left.dot(up));
            // What jumps towards a slope goes on up along it.
            let is_passed = surface == Surface::Ground && rise > 0.0;
            if !is_passed {
                self.note(surface, hit);
            }
            way = match surface {
                Surface::Ground if is_passed => left - hit.normal * left.dot(hit.normal),
                // It has landed, and walks on.
                Surface::Ground => return self.walk(level, hit.normal),
                // What would go up a steep slope stops at it as at a wall; what falls goes down along it.
                Surface::Wall => {
                    let kept = if level.dot(hit.normal) < 0.0 { up * rise } else { left };
                    kept - hit.normal * kept.dot(hit.normal).min(0.0)
                }
                Surface::Ceiling => {
                    let kept = level + up * rise.min(0.0);
                    kept - hit.normal * kept.dot(hit.normal).min(0.0)
                }
            };
            if last.is_some_and(|normal| way.dot(normal) < -ALONG * way.length()) {
                // Between two slopes that face each other it stands, as on the level.
                if last.is_some_and(|normal| (normal + hit.normal).dot(up) > 0.0) && surface == Surface::Wall
                {
                    self.ground = Some(ShapeHit { normal: up, ..hit });
                }
                return;
            }
            last = Some(hit.normal);
        }
    }
}

/// The direction forward along a surface.
fn along(forward: Vec2, normal: Vec2, up: Vec2) -> Vec2 {
    let tangent = normal.perp();
    // From up to forward the turn is as from the normal to the way along the surface.
    tangent * if up.perp().dot(forward) < 0.0 { -1.0 } else { 1.0 }
}
