//! The map of an engine: speeds to the right, what is thrown and at how thick a wall downwards, and how much of it passes as a
//! colour.

use std::fmt::Write as _;

use crate::continuous::rows::Row;
use crate::continuous::trial::{SPEEDS, THICKNESSES, THROWS};

/// Sides of a cell, room for names on the left and for speeds above, pixels.
const CELL: [f64; 2] = [34.0, 11.0];
const NAMES: f64 = 150.0;
const TOP: f64 = 34.0;
/// Between two things that are thrown, pixels.
const GAP: f64 = 4.0;

/// The picture.
pub(super) fn svg(engine: &str, rows: &[Row]) -> String {
    let group = THICKNESSES.len() as f64 * CELL[1] + GAP;
    let [width, height] =
        [NAMES + SPEEDS.len() as f64 * CELL[0] + 4.0, TOP + THROWS.len() as f64 * group + 4.0];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" role=\"img\" aria-label=\"What passes in {engine}\">\n\
         <style>text{{font:11px sans-serif;fill:#1f2328}}.head{{font-weight:bold}}.none{{fill:#d1d9e0}}.some{{fill:#cf222e}}\
         @media(prefers-color-scheme:dark){{text{{fill:#f0f6fc}}.none{{fill:#3d444d}}.some{{fill:#f85149}}}}</style>\n\
         <text class=\"head\" x=\"4\" y=\"13\">{engine}</text>\n"
    );
    for (column, speed) in SPEEDS.into_iter().enumerate() {
        let x = NAMES + (column as f64 + 0.5) * CELL[0];
        _ = writeln!(svg, "<text x=\"{x:.0}\" y=\"28\" text-anchor=\"middle\">{speed}</text>");
    }
    for (index, throw) in THROWS.iter().enumerate() {
        let y = TOP + index as f64 * group;
        _ = writeln!(svg, "<text x=\"4\" y=\"{:.0}\">{}</text>", y + 20.0, throw.name);
        for (line, thickness) in THICKNESSES.into_iter().enumerate() {
            let y = y + line as f64 * CELL[1];
            let name = if thickness < 0.01 {
                "1 mm"
            } else if thickness < 0.1 {
                "1 cm"
            } else {
                "20 cm"
            };
            _ = writeln!(
                svg,
                "<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"end\">{name}</text>",
                NAMES - 4.0,
                y + 9.0
            );
            let is_of =
                |row: &&Row| row.engine == engine && row.throw == throw.name && row.thickness == thickness;
            let Some(row) = rows.iter().find(is_of) else { continue };
            for (column, passed) in row.passed.into_iter().enumerate() {
                let x = NAMES + column as f64 * CELL[0];
                let share = f64::from(passed) / f64::from(row.trials);
                // Even one of a hundred is seen.
                let (class, opacity) =
                    if passed == 0 { ("none", 1.0) } else { ("some", 0.25 + 0.75 * share) };
                _ = writeln!(
                    svg,
                    "<rect class=\"{class}\" fill-opacity=\"{opacity:.2}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
                    CELL[0] - 1.0,
                    CELL[1] - 1.0
                );
            }
        }
    }
    svg + "</svg>\n"
}
