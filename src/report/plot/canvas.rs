//! Lines, marks and words as SVG.

use core::fmt::Write as _;

/// x to the right, y down, px.
pub(super) type Place = [f64; 2];

/// How many colours there are for series; more series share them and differ by mark.
pub(super) const COLOURS: usize = 6;

/// Colours for light and dark, told apart by people with any colour vision (after Okabe and Ito, 2008), darker
/// where they stand on white.
const STYLE: &str = "<style>
text{font:13px Inter,system-ui,'Segoe UI',Helvetica,Arial,sans-serif;fill:#1f2328}
.title{font-size:18px;font-weight:600}.dim{fill:#59636e}.name{font-size:12px;font-weight:600}
.name,.halo{paint-order:stroke;stroke:#fff;stroke-width:4px;stroke-linejoin:round}
.back{fill:#fff}.frame{fill:none;stroke:#818b98}.grid{stroke:#d1d9e0}.fine{stroke:#eff2f5}
.floor{fill:#59636e;fill-opacity:.12}.guide{stroke:#818b98;stroke-dasharray:5 5}
.front{fill:none;stroke:#1f2328;stroke-opacity:.16;stroke-width:11;stroke-linejoin:round;stroke-linecap:round}
.line{fill:none;stroke-width:1.8}.mark{stroke-width:1.8}.hollow{fill:#fff!important}
.faint{fill-opacity:.4}
.s0{stroke:#0072b2}.s1{stroke:#c04f00}.s2{stroke:#00795a}.s3{stroke:#b0568f}.s4{stroke:#8a6d00}.s5{stroke:#5b5bd6}
.f0,.t0{fill:#0072b2}.f1,.t1{fill:#c04f00}.f2,.t2{fill:#00795a}.f3,.t3{fill:#b0568f}.f4,.t4{fill:#8a6d00}
.f5,.t5{fill:#5b5bd6}
@media(prefers-color-scheme:dark){text{fill:#f0f6fc}.dim{fill:#9198a1}.name,.halo{stroke:#0d1117}.back{fill:#0d1117}
.frame,.guide{stroke:#656c76}.grid{stroke:#2f363e}.fine{stroke:#1b2128}.floor{fill:#9198a1}.front{stroke:#f0f6fc}
.hollow{fill:#0d1117!important}
.s0{stroke:#56b4e9}.s1{stroke:#f0883e}.s2{stroke:#3ddc97}.s3{stroke:#f0a6cf}.s4{stroke:#e6d84a}.s5{stroke:#a5a5ff}
.f0,.t0{fill:#56b4e9}.f1,.t1{fill:#f0883e}.f2,.t2{fill:#3ddc97}.f3,.t3{fill:#f0a6cf}.f4,.t4{fill:#e6d84a}
.f5,.t5{fill:#a5a5ff}}
</style>";

/// Classes of the names of points, by colour.
pub(super) const NAMES: [&str; COLOURS] = ["name t0", "name t1", "name t2", "name t3", "name t4", "name t5"];

/// Width of a word, px, rather too large than too small: without a font it can only be guessed.
pub(super) fn width(text: &str) -> f64 {
    7.4 * text.chars().count() as f64
}

/// A word and where it stands.
#[derive(Debug)]
pub(super) struct Text {
    place: Place,
    text: String,
    anchor: &'static str,
    class: &'static str,
}

impl Text {
    fn new(place: Place, text: impl Into<String>, anchor: &'static str) -> Self {
        Self { place, text: text.into(), anchor, class: "" }
    }

    /// A word that begins here.
    pub(super) fn start(place: Place, text: impl Into<String>) -> Self {
        Self::new(place, text, "start")
    }

    /// A word with its middle here.
    pub(super) fn middle(place: Place, text: impl Into<String>) -> Self {
        Self::new(place, text, "middle")
    }

    /// A word that ends here.
    pub(super) fn end(place: Place, text: impl Into<String>) -> Self {
        Self::new(place, text, "end")
    }

    pub(super) fn class(self, class: &'static str) -> Self {
        Self { class, ..self }
    }
}

/// The mark of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sign {
    pub(super) place: Place,
    pub(super) series: usize,
    pub(super) is_hollow: bool,
}

/// An SVG picture while it is drawn.
#[derive(Debug)]
pub(super) struct Canvas {
    svg: String,
}

fn escaped(text: &str) -> String {
    // Control characters are not allowed in XML at all.
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

impl Canvas {
    pub(super) fn new([width, height]: [f64; 2]) -> Self {
        let size = format!("width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\"");
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" {size}>\n{STYLE}\n\
             <rect class=\"back\" width=\"{width}\" height=\"{height}\"/>\n"
        );
        Self { svg }
    }

    pub(super) fn finish(mut self) -> String {
        self.svg += "</svg>\n";
        self.svg
    }

    fn push(&mut self, element: core::fmt::Arguments<'_>) {
        _ = writeln!(self.svg, "{element}");
    }

    pub(super) fn line(&mut self, [x1, y1]: Place, [x2, y2]: Place, class: &str) {
        self.push(format_args!(
            "<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>"
        ));
    }

    pub(super) fn polyline(&mut self, places: &[Place], class: &str) {
        if places.len() < 2 {
            return;
        }
        let mut points = String::new();
        for [x, y] in places {
            _ = write!(points, "{x:.1},{y:.1} ");
        }
        self.push(format_args!("<polyline class=\"{class}\" points=\"{}\"/>", points.trim_end()));
    }

    pub(super) fn rectangle(&mut self, [left, top, right, bottom]: [f64; 4], class: &str) {
        let (width, height) = (right - left, bottom - top);
        self.push(format_args!(
            "<rect class=\"{class}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>"
        ));
    }

    pub(super) fn frame(&mut self, area: [f64; 4]) {
        self.rectangle(area, "frame");
    }

    /// Circle, square, diamond, triangle, the same upside down and a hexagon in turn: series differ by form as well as by
    /// colour.
    pub(super) fn sign(&mut self, Sign { place: [x, y], series, is_hollow }: Sign) {
        let colour = series % COLOURS;
        let class = format!("mark s{colour} f{colour}{}", if is_hollow { " hollow" } else { "" });
        let corners = |offsets: &[Place]| {
            offsets
                .iter()
                .map(|[dx, dy]| format!("{:.1},{:.1}", x + dx, y + dy))
                .collect::<Vec<_>>()
                .join(" ")
        };
        let polygon: &[Place] = match series % COLOURS {
            0 => {
                self.push(format_args!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>"));
                return;
            }
            1 => &[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]],
            2 => &[[0.0, -5.5], [5.5, 0.0], [0.0, 5.5], [-5.5, 0.0]],
            3 => &[[0.0, -5.2], [5.2, 4.2], [-5.2, 4.2]],
            4 => &[[0.0, 5.2], [5.2, -4.2], [-5.2, -4.2]],
            _ => &[[5.2, 0.0], [2.6, 4.5], [-2.6, 4.5], [-5.2, 0.0], [-2.6, -4.5], [2.6, -4.5]],
        };
        let points = corners(polygon);
        self.push(format_args!("<polygon class=\"{class}\" points=\"{points}\"/>"));
    }

    /// A small faint dot in the colour of a series.
    pub(super) fn dot(&mut self, [x, y]: Place, series: usize) {
        let colour = series % COLOURS;
        self.push(format_args!("<circle class=\"faint f{colour}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\"/>"));
    }

    pub(super) fn text(&mut self, Text { place: [x, y], text, anchor, class }: Text) {
        let text = escaped(&text);
        self.push(format_args!(
            "<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>"
        ));
    }

    /// A word that is read from below, with its middle here.
    pub(super) fn upward_text(&mut self, [x, y]: Place, text: &str) {
        let text = escaped(text);
        self.push(format_args!(
            "<text text-anchor=\"middle\" transform=\"translate({x:.1} {y:.1}) rotate(-90)\">{text}</text>"
        ));
    }
}
