//! The demo: a window that shows worlds of `rustycs`, or the same worlds stepped without a window.
//!
//! | file | what it holds |
//! |---|---|
//! | `cli` | the command line |
//! | `page` | the address of the page, in the browser |
//! | `headless` | stepping without a window: progress, summary |
//! | `svg` | a world as a picture |
//! | `window` | opening the window, frames, screenshots |
//! | `app` | what is shown and how it changes |
//! | `command` | everything that can be done, and the keys that do it |
//! | `run`, `history`, `gauges`, `trails`, `poses` | a world that runs, and what is kept about it |
//! | `tool`, `spring`, `knob` | what the mouse does and makes; what can be turned about a world |
//! | `overlay` | what can be drawn over a scene |
//! | `panel`, `ui`, `icon` | the panel beside the scene |
//! | `compare`, `hover`, `help` | cards above the scene |
//! | `report` | the state as lines of text |
//! | `layout` | where scene and panel are |
//! | `camera` | from metres to pixels and back |
//! | `scenery` | the world as triangles |
//! | `canvas`, `batch` | text and triangles, collected and drawn at once |
//! | `theme`, `quantity` | colours; figures with units |

mod app;
mod batch;
mod camera;
mod canvas;
mod cli;
mod command;
mod compare;
mod gauges;
#[cfg(not(target_family = "wasm"))]
mod headless;
mod help;
mod history;
mod hover;
mod icon;
mod knob;
mod layout;
mod overlay;
mod page;
mod panel;
mod poses;
mod quantity;
mod report;
mod run;
mod scenery;
mod spring;
#[cfg(not(target_family = "wasm"))]
mod svg;
mod theme;
mod tool;
mod trails;
mod ui;
mod window;

use std::process::ExitCode;

use clap::Parser;

use crate::cli::Cli;

/// Exit code where there is no display to open a window on; the same as for a wrong command line.
const NO_DISPLAY: u8 = 2;

/// What is asked for on the command line.
#[cfg(not(target_family = "wasm"))]
fn command_line() -> Cli {
    Cli::parse()
}

/// What is asked for in the address of the page; the default where that makes no sense.
#[cfg(target_family = "wasm")]
fn command_line() -> Cli {
    Cli::try_parse_from(page::command_line(&page::address())).unwrap_or_else(|error| {
        macroquad::miniquad::warn!("{}", error);
        Cli::parse_from(["rustycs-demo"])
    })
}

fn main() -> ExitCode {
    let cli = command_line();
    if cli.list {
        for scene in rustycs_scenes::all() {
            println!("{:<16} {}", scene.name, scene.summary);
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
