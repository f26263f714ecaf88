//! How a case ends, as a small picture that is legible on light and on dark pages.

use std::fmt::Write as _;
use std::path::PathBuf;

use rustycs_cases::overlap::corners;
use rustycs_cases::stability::{Case, Seen, Snapshot};

use crate::engine::State;
use crate::scene::{BodySpec, Kind, Outline, Scene};

/// Longest side of a picture, and the height of its caption, pixels.
const SIDE: f64 = 280.0;
const CAPTION: f64 = 18.0;

/// Where the picture of a case in an engine is, from the page.
pub(super) fn path(case: &Case, engine: &str) -> PathBuf {
    PathBuf::from("stability").join(format!("{}-{}.svg", case.name, engine.to_lowercase()))
}

/// Lower left and upper right corner of what is shown, m.
fn view(case: &Case) -> [[f64; 2]; 2] {
    match case.seen {
        Seen::Part(view) => view,
        Seen::Whole | Seen::No => around(&case.scene),
    }
}

/// Where the bodies that move were set, with a fifth of the larger side around it.
fn around(scene: &Scene) -> [[f64; 2]; 2] {
    let mut view = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for spec in scene.bodies.iter().filter(|spec| spec.kind == Kind::Dynamic) {
        let reach = spec.outline.reach();
        for (axis, center) in spec.position.into_iter().enumerate() {
            view[0][axis] = view[0][axis].min(center - reach);
            view[1][axis] = view[1][axis].max(center + reach);
        }
    }
    let margin = 0.2 * (view[1][0] - view[0][0]).max(view[1][1] - view[0][1]);
    [view[0].map(|low| low - margin), view[1].map(|high| high + margin)]
}

/// Metres to pixels.
struct Map {
    /// Lower left corner, m.
    origin: [f64; 2],
    /// Pixels per metre.
    scale: f64,
    /// Height of the picture above the caption, pixels.
    height: f64,
}

impl Map {
    fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.origin[0]) * self.scale, self.height - (y - self.origin[1]) * self.scale]
    }

    /// The outline of a body as a path, or nothing if it is out of sight or nowhere.
    fn outline(&self, spec: &BodySpec, state: &State) -> String {
        let reach = spec.outline.reach() * self.scale;
        let [x, y] = self.place(state.position);
        // NaN is out of sight too.
        let is_near = |place: f64, side: f64| place + reach > -SIDE && place - reach < side + SIDE;
        if !(is_near(x, SIDE) && is_near(y, self.height)) {
            return String::new();
        }
        if let Outline::Circle { radius } = spec.outline {
            let r = radius * self.scale;
            if r > 100.0 * SIDE {
                // What is left of so large a circle is its top, as a line.
                return format!("M-9 {:.1}h999v999h-999z", y - r);
            }
            let (sin, cos) = state.angle.sin_cos();
            let (left, twice) = (x - r, 2.0 * r);
            return format!(
                "M{left:.1} {y:.1}a{r:.2} {r:.2} 0 1 0 {twice:.2} 0a{r:.2} {r:.2} 0 1 0 -{twice:.2} 0M{x:.1} {y:.1}l{:.1} {:.1}",
                r * cos,
                -r * sin
            );
        }
        let mut path = String::new();
        for (index, corner) in corners(&spec.outline, state).into_iter().enumerate() {
            // Grounds of kilometres would only be digits.
            let [x, y] = self.place(corner).map(|place| place.clamp(-3e3, 3e3));
            _ = write!(path, "{}{x:.1} {y:.1}", if index == 0 { 'M' } else { 'L' });
        }
        path + "z"
    }
}

/// The picture.
pub(super) fn svg(case: &Case, snapshot: &Snapshot, engine: &str) -> String {
    let [low, high] = view(case);
    let [width, height] = [high[0] - low[0], high[1] - low[1]];
    let scale = SIDE / width.max(height);
    let map = Map { origin: low, scale, height: height * scale };
    let [width, height] = [(width * scale).max(90.0), map.height];
    let mut paths = [String::new(), String::new()];
    for (spec, state) in snapshot.scene.bodies.iter().zip(&snapshot.states) {
        paths[usize::from(spec.kind == Kind::Dynamic)] += &map.outline(spec, state);
    }
    let (name, total) = (&case.name, height + CAPTION);
    let [still, moving] = paths;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {total:.0}\" width=\"{width:.0}\" \
         height=\"{total:.0}\" role=\"img\" aria-label=\"{name} in {engine}, at the end\">\n\
         <style>text{{font:12px sans-serif;fill:#1f2328}}.still{{fill:#d1d9e0;stroke:#59636e}}\
         .moving{{fill:#0969da;fill-opacity:.25;stroke:#0969da}}path{{stroke-width:.7}}.frame{{fill:none;stroke:#d1d9e0}}\
         @media(prefers-color-scheme:dark){{text{{fill:#f0f6fc}}.still{{fill:#3d444d;stroke:#9198a1}}\
         .moving{{fill:#4493f8;stroke:#4493f8}}.frame{{stroke:#3d444d}}}}</style>\n\
         <svg width=\"{width:.1}\" height=\"{height:.1}\"><path class=\"still\" d=\"{still}\"/>\n\
         <path class=\"moving\" d=\"{moving}\"/></svg>\n\
         <rect class=\"frame\" x=\".5\" y=\".5\" width=\"{:.1}\" height=\"{:.1}\"/>\n\
         <text x=\"4\" y=\"{:.1}\">{engine}</text>\n</svg>\n",
        width - 1.0,
        height - 1.0,
        height + 13.0,
    )
}
