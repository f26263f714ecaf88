//! How an engine behaves, as a word: rows of an engine that moved otherwise are not taken for its own.

use crate::engine::{DEFAULT, Engine, State};
use crate::scene::{BodySpec, Kind, Outline, Scene, floor, on_earth};

/// A pile of boxes and discs, bouncing and not, on a floor.
fn pile() -> Scene {
    let mut bodies = vec![floor()];
    for index in 0..60 {
        let (column, row) = (f64::from(index % 6), f64::from(index / 6));
        let outline = match index % 2 {
            0 => Outline::Box { width: 0.9, height: 0.6 },
            _ => Outline::Circle { radius: 0.4 },
        };
        bodies.push(BodySpec {
            position: [1.1 * column + 0.05 * row - 3.0, 0.6 + row],
            angle: 0.1 * row,
            velocity: [0.5 * column - 1.0, 0.0],
            restitution: 0.25 * f64::from(index % 3),
            ..BodySpec::new(Kind::Dynamic, outline)
        });
    }
    on_earth(bodies)
}

/// A word for all states of a pile after two seconds.
pub(crate) fn of(engine: &dyn Engine) -> String {
    let scene = pile();
    let mut simulation = engine.simulate(&scene, DEFAULT);
    for _ in 0..120 {
        simulation.step();
    }
    let states = (0..scene.bodies.len()).map(|body| simulation.state(body));
    let numbers = states
        .flat_map(|State { position: [x, y], angle, velocity: [u, v], spin }| [x, y, angle, u, v, spin]);
    word(numbers.flat_map(f64::to_le_bytes))
}

/// A word that changes when one of the bytes does: FNV-1a, in sixteen digits.
pub(crate) fn word(bytes: impl IntoIterator<Item = u8>) -> String {
    let hash = bytes.into_iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    format!("{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_engine_has_one_fingerprint_and_two_engines_have_two() {
        let prints: Vec<String> = crate::engines::all().iter().map(|engine| of(engine.as_ref())).collect();
        let again: Vec<String> = crate::engines::all().iter().map(|engine| of(engine.as_ref())).collect();
        assert_eq!(prints, again);
        assert!(prints[0] != prints[1] && prints[1] != prints[2] && prints[0] != prints[2], "{prints:?}");
    }
}
