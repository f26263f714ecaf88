//! Opening the window, one frame after the other, and saving the last one.

use std::path::Path;
use std::process::ExitCode;

use macroquad::conf::Conf;
use macroquad::miniquad;
use macroquad::texture::get_screen_data;
use macroquad::time::{get_frame_time, get_time};
use macroquad::window::next_frame;

use crate::app::{App, FrameTime};
use crate::batch::{MOST_INDICES, MOST_VERTICES};
use crate::cli::Cli;
use crate::report::{self, Reporter};

/// Whether there is something to open a window on. Only Unix desktops may be without; elsewhere there is.
pub(crate) fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(target_os = "linux") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}

/// Opens the window and shows frames until it is closed.
pub(crate) fn run(cli: Cli) -> ExitCode {
    // Better to know before the frames than after them.
    if let Some(error) = cli.screenshot.as_deref().and_then(|path| std::fs::File::create(path).err()) {
        eprintln!("The picture cannot be saved: {error}");
        return ExitCode::FAILURE;
    }
    let [width, height] = cli.size.map(i32::from);
    let miniquad_conf = miniquad::conf::Conf {
        window_title: "rustycs".to_owned(),
        window_width: width,
        window_height: height,
        high_dpi: true,
        sample_count: i32::from(cli.samples),
        platform: miniquad::conf::Platform {
            swap_interval: Some(1),
            linux_wm_class: "rustycs",
            ..Default::default()
        },
        ..Default::default()
    };
    let conf = Conf {
        miniquad_conf,
        draw_call_vertex_capacity: MOST_VERTICES,
        draw_call_index_capacity: MOST_INDICES,
        ..Default::default()
    };
    macroquad::Window::from_config(conf, show_frames(cli));
    ExitCode::SUCCESS
}

async fn show_frames(cli: Cli) {
    let mut app = App::new(&cli.start());
    let mut reporter = Reporter::default();
    let mut frames = 0_u32;
    loop {
        let time = match cli.frames {
            Some(_) => FrameTime::OneTick,
            None => FrameTime::Seconds(f64::from(get_frame_time())),
        };
        app.frame(time);
        frames += 1;
        // A page has no command line: it always reports.
        if cli.report || cfg!(target_family = "wasm") {
            reporter.observe(app.state(), get_time(), || app.hash());
        }
        if cli.frames == Some(frames) {
            if cli.report {
                report::say(&app.state(), app.hash());
            }
            if let Some(path) = &cli.screenshot {
                save_screen(path);
            }
            return;
        }
        rest();
        next_frame().await;
    }
}

/// Where nothing waits for the screen (a driver without vertical synchronisation), frames would follow each
/// other as fast as they can be drawn, and keep a processor busy for nothing.
fn rest() {
    #[cfg(not(target_family = "wasm"))]
    {
        const SHORTEST_FRAME: f32 = 1.0 / 250.0;
        let spare = SHORTEST_FRAME - get_frame_time();
        if spare > 0.0 {
            std::thread::sleep(std::time::Duration::from_secs_f32(spare));
        }
    }
}

/// Saves what was drawn in this frame. The window's own opacity is not part of the picture.
fn save_screen(path: &Path) {
    let mut image = get_screen_data();
    for pixel in image.bytes.chunks_exact_mut(4) {
        pixel[3] = 255;
    }
    image.export_png(&path.to_string_lossy());
}
