//! The command line.

use std::path::PathBuf;

use clap::Parser;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use rustycs_scenes::Scene;

use crate::overlay::Overlay;
use crate::panel::Tab;

/// Shows scenes of the rustycs physics engine in a window, or steps them without one.
///
/// Keys in the window: Space pauses, S takes a single tick, R restarts, N and P change the scene, H shows all
/// keys.
#[derive(Debug, Parser)]
#[command(name = "rustycs-demo", version)]
pub(crate) struct Cli {
    /// The scene to show.
    #[arg(long, value_name = "NAME", default_value = "pile", value_parser = scene_parser())]
    pub(crate) scene: &'static Scene,

    /// Names the scenes and what to look for in each.
    #[arg(long)]
    pub(crate) list: bool,

    /// Seed of the scenes with chance in them.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,

    /// Closes the window after this many frames, one tick each: the same picture in every run.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) frames: Option<u32>,

    /// Saves the last frame as a picture.
    #[arg(long, value_name = "FILE.png", requires = "frames", value_parser = png_path)]
    pub(crate) screenshot: Option<PathBuf>,

    /// Size of the window, pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = window_size)]
    pub(crate) size: [u16; 2],

    /// Samples per pixel, for smooth edges; 1 where the graphics driver offers no more.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=16))]
    pub(crate) samples: u8,

    /// What to draw over the scene, names with commas between them; `all` for everything, `none` for nothing.
    /// Without it a scene shows what it is about.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = overlay_parser())]
    pub(crate) overlays: Vec<OverlayChoice>,

    /// Shows two copies side by side, the second with the classic solver.
    #[arg(long)]
    pub(crate) compare: bool,

    /// Begins paused.
    #[arg(long)]
    pub(crate) paused: bool,

    /// Adds so many small bodies to the scene.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..=100_000))]
    pub(crate) crowd: u32,

    /// The page of the panel to begin with.
    #[arg(long, value_name = "NAME", default_value = "run", value_parser = tab_parser())]
    pub(crate) page: Tab,

    /// Writes a line about the state of the window when it changes, and every second.
    #[arg(long)]
    pub(crate) report: bool,

    /// Steps the scene without a window and prints a summary.
    #[arg(long, conflicts_with = "frames")]
    pub(crate) headless: bool,

    /// How many ticks to step.
    #[arg(long, value_name = "N", default_value_t = 600, requires = "headless")]
    pub(crate) ticks: u64,

    /// Where to save a picture of the end as SVG; none is saved without it.
    #[arg(long, value_name = "FILE", requires = "headless")]
    pub(crate) svg: Option<PathBuf>,
}

/// What the window begins with.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) scene: &'static Scene,
    pub(crate) seed: u64,
    /// What is drawn over the scene; `None` for what it is about.
    pub(crate) overlays: Option<Vec<Overlay>>,
    pub(crate) compares: bool,
    pub(crate) is_paused: bool,
    pub(crate) crowd: u32,
    pub(crate) tab: Tab,
}

impl Cli {
    pub(crate) fn start(&self) -> Start {
        let chosen = |choice: &OverlayChoice| match choice {
            OverlayChoice::One(overlay) => vec![*overlay],
            OverlayChoice::All => Overlay::ALL.to_vec(),
            OverlayChoice::None => Vec::new(),
        };
        let overlays: Vec<Overlay> = self.overlays.iter().flat_map(chosen).collect();
        Start {
            scene: self.scene,
            seed: self.seed,
            overlays: Some(overlays).filter(|_| !self.overlays.is_empty()),
            compares: self.compare,
            is_paused: self.paused,
            crowd: self.crowd,
            tab: self.page,
        }
    }
}

/// An overlay as asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OverlayChoice {
    All,
    None,
    One(Overlay),
}

fn overlay_parser() -> impl TypedValueParser<Value = OverlayChoice> {
    let names = Overlay::ALL.map(Overlay::name);
    PossibleValuesParser::new(["all", "none"].into_iter().chain(names)).map(|name| {
        let overlay = Overlay::ALL.into_iter().find(|overlay| overlay.name() == name);
        let other = if name == "all" { OverlayChoice::All } else { OverlayChoice::None };
        overlay.map_or(other, OverlayChoice::One)
    })
}

fn tab_parser() -> impl TypedValueParser<Value = Tab> {
    PossibleValuesParser::new(["run", "scenes", "tools", "view", "solver"]).map(|name| {
        let tab = Tab::ALL.into_iter().find(|tab| tab.name().eq_ignore_ascii_case(&name));
        tab.expect("only names of pages are possible")
    })
}

/// One of the scenes by its name; clap lists the right names when it is none of them.
fn scene_parser() -> impl TypedValueParser<Value = &'static Scene> {
    PossibleValuesParser::new(rustycs_scenes::all().iter().map(|scene| scene.name))
        .map(|name| rustycs_scenes::find(&name).expect("only names of scenes are possible"))
}

/// A path for a picture.
fn png_path(text: &str) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("the picture is a PNG: end the name with .png") }
}

/// A width and a height with an `x` between them.
fn window_size(text: &str) -> Result<[u16; 2], &'static str> {
    let sides = text.split_once('x').and_then(|(width, height)| {
        let sides = [width.parse().ok()?, height.parse().ok()?];
        (sides[0] >= 480 && sides[1] >= 360).then_some(sides)
    });
    sides.ok_or("give width x height in pixels, at least 480x360, for example 1280x720")
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_wrong_scene_is_refused_with_the_right_names() {
        let error = Cli::try_parse_from(["rustycs-demo", "--scene", "pyramide"]).unwrap_err().to_string();
        assert!(error.contains("pyramid") && error.contains("card_house"), "{error}");
    }

    #[test]
    fn overlays_are_asked_for_by_name() {
        let parse = |names| Cli::try_parse_from(["rustycs-demo", "--overlays", names]);
        let shown = |names| parse(names).unwrap().start().overlays.unwrap();
        assert_eq!(shown("boxes,trails"), [Overlay::Boxes, Overlay::Trails]);
        assert_eq!(shown("all"), Overlay::ALL);
        assert!(shown("none").is_empty());
        assert_eq!(Cli::try_parse_from(["rustycs-demo"]).unwrap().start().overlays, None);
        let error = parse("boxs").unwrap_err().to_string();
        assert!(error.contains("penetration"), "{error}");
    }

    #[test]
    fn sizes_and_pictures_are_checked() {
        assert_eq!(window_size("800x600"), Ok([800, 600]));
        assert!(window_size("800").is_err() && window_size("8x6").is_err());
        assert!(png_path("a.jpg").is_err() && png_path("a.PNG").is_ok());
    }
}
