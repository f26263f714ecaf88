//! The demo: a window that shows worlds of `rustycs`, or the same worlds stepped without a window.
//!
//! | file | what it holds |
//! |---|---|
//! | `cli` | the command line |
//! | `headless` | stepping without a window: progress, summary |
//! | `svg` | a world as a picture |
//! | `window` | opening the window, frames, screenshots |
//! | `app` | what is shown and how keys and mouse change it |
//! | `camera` | from metres to pixels and back |
//! | `poses` | bodies between two ticks |
//! | `scenery` | the world as triangles: bodies, contacts, boxes |
//! | `panel`, `help` | figures beside the scene, keys above it |
//! | `canvas`, `batch` | text and triangles, collected and drawn at once |
//! | `theme`, `quantity` | colours; figures with units |

mod app;
mod batch;
mod camera;
mod canvas;
mod cli;
#[cfg(not(target_family = "wasm"))]
mod headless;
mod help;
mod panel;
mod poses;
mod quantity;
mod scenery;
#[cfg(not(target_family = "wasm"))]
mod svg;
mod theme;
mod window;

use std::process::ExitCode;

use clap::Parser;

use crate::cli::Cli;

/// Exit code where there is no display to open a window on; the same as for a wrong command line.
const NO_DISPLAY: u8 = 2;

fn main() -> ExitCode {
    let cli = Cli::parse();
    if cli.list {
        for scene in rustycs_scenes::all() {
            println!("{:<12} {}", scene.name, scene.summary);
        }
        return ExitCode::SUCCESS;
    }
    #[cfg(not(target_family = "wasm"))]
    if cli.headless {
        return headless::run(&cli);
    }
    if !window::has_display() {
        eprintln!(
            "There is no display to open a window on (neither DISPLAY nor WAYLAND_DISPLAY is set); \
             add --headless to step the scene without one."
        );
        return ExitCode::from(NO_DISPLAY);
    }
    window::run(cli)
}
