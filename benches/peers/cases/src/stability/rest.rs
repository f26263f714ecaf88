//! What is asked of everything that stands: see the allowances in the module above.

use crate::scene::{BodySpec, Outline, Scene};
use crate::stability::case::{Check, SHARE};
use crate::stability::run::Run;
use crate::stability::{G, on_earth};

/// Speed at rest, for bodies of 1 m on the Earth, m/s.
const SPEED: f64 = 1e-3;
/// Sinking, as a share of the height.
const SINKING: f64 = 0.01;
/// Drifting, as a share of a body's size.
const DRIFTING: f64 = 1e-3;
/// Overlap, as a share of a body's size.
const OVERLAP: f64 = 0.01;

/// How large things are, and how heavy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Size of a body, m.
    pub(super) size: f64,
    /// Of all, m.
    pub(super) height: f64,
    /// m/s².
    pub(super) gravity: f64,
}

impl Scale {
    /// Bodies of 1 m on the Earth, so high together, m.
    pub(super) fn of_height(height: f64) -> Self {
        Self { size: 1.0, height, gravity: G }
    }

    /// Speed at rest, m/s.
    pub(super) fn speed(self) -> f64 {
        SPEED * (self.size * self.gravity / G).sqrt()
    }
}

/// How the check is called that nothing moves.
pub const SPEED_AT_REST: &str = "speed in the last second";

/// Runs to the end, and checks that nothing moves in the last second.
pub(super) fn calm(run: &mut Run, seconds: f64, scale: Scale) -> Check {
    run.until(seconds - 1.0);
    let fastest = run.largest(seconds, Run::fastest);
    Check::at_most(SPEED_AT_REST, fastest, scale.speed(), "m/s")
}

/// That no body is deeper in another than is allowed.
pub(super) fn apart(run: &Run, scale: Scale) -> Check {
    Check::at_most("deepest overlap", run.deepest_overlap(), OVERLAP * scale.size, "m")
}

/// That no body has sunk, or drifted aside.
pub(super) fn in_place(run: &Run, scale: Scale) -> Vec<Check> {
    let sinking = run.most(|body, _| run.shift(body)[1].abs());
    let drifting = run.most(|body, _| run.shift(body)[0].abs());
    vec![
        Check::at_most("sinking / height", sinking / scale.height, SINKING, SHARE),
        Check::at_most("drifting", drifting, DRIFTING * scale.size, "m"),
    ]
}

/// Runs to the end and checks that all stands where it was put, at rest.
pub(super) fn stands(run: &mut Run, seconds: f64, scale: Scale) -> Vec<Check> {
    let calm = calm(run, seconds, scale);
    let mut checks = in_place(run, scale);
    checks.push(calm);
    checks
}

/// The same for what leans, or stands by thrust, where sinking turns into drifting: both are allowed alike.
pub(super) fn bears(run: &mut Run, seconds: f64, scale: Scale) -> Vec<Check> {
    let calm = calm(run, seconds, scale);
    let shift = run.most(|body, _| {
        let [x, y] = run.shift(body);
        x.hypot(y)
    });
    vec![Check::at_most("off its place / height", shift / scale.height, SINKING, SHARE), calm]
}

/// What the checks of [`bears`] say, in words.
pub(super) const BEARS: &str =
    "stays within 1 % of the height from where it was set and is at rest in the last second";

/// What the checks of [`stands`] say, in words.
pub(super) const STANDS: &str = "sinks by less than 1 % of the height, drifts by less than a thousandth of its size and is \
                                 at rest in the last second";

/// Boxes with these sides and densities, from the bottom up, each on the one before.
pub(super) fn tower(boxes: impl IntoIterator<Item = (f64, f64)>) -> Vec<BodySpec> {
    let mut height = 0.0;
    let mut bodies = Vec::new();
    for (side, density) in boxes {
        let outline = Outline::Box { width: side, height: side };
        let spec = BodySpec::new(crate::scene::Kind::Dynamic, outline);
        bodies.push(BodySpec { position: [0.0, height + 0.5 * side], density, ..spec });
        height += side;
    }
    bodies
}

/// Equal boxes on a floor, on the Earth.
pub(super) fn stack(count: usize) -> Scene {
    on_earth([crate::scene::floor()].into_iter().chain(tower(std::iter::repeat_n((1.0, 1.0), count))))
}
