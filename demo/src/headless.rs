//! Stepping a scene without a window: progress while it runs, then a summary and a picture.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use rustycs::{Settings, World};
use rustycs_scenes::Scene;

use crate::cli::Cli;
use crate::{quantity, svg};

/// Exit code after Ctrl-C, as shells give it: 128 + SIGINT.
const INTERRUPTED: u8 = 130;

/// Steps the scene, prints what came of it and saves a picture where it is told to. Ctrl-C ends the stepping, not the rest.
pub(crate) fn run(cli: &Cli) -> ExitCode {
    let mut world = cli.scene.build(cli.seed, Settings::default());
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    if let Err(error) = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed)) {
        eprintln!("Ctrl-C will end the program at once: {error}");
    }
    let times = step(cli.scene, &mut world, cli.ticks, &interrupted);

    println!("scene         {}, seed {}", cli.scene.name, cli.seed);
    print_summary(&world, &times);
    let interruption =
        if interrupted.load(Ordering::Relaxed) { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS };
    let Some(path) = &cli.svg else { return interruption };
    let seconds = world.ticks() as f64 * world.settings().tick_seconds();
    let caption = format!("{} · {} bodies · {seconds:.2} s", cli.scene.name, world.body_count());
    if let Err(error) = std::fs::write(path, svg::picture(&world, cli.scene, &caption)) {
        eprintln!("The picture could not be saved as {}: {error}", path.display());
        return ExitCode::FAILURE;
    }
    println!("picture       {}", path.display());
    interruption
}

/// How long steps took in which a body was awake.
#[derive(Debug, Default)]
struct StepTimes {
    count: u32,
    total: Duration,
    longest: Duration,
}

/// Takes `ticks` steps, or fewer if interrupted, and shows how far it is.
fn step(scene: &Scene, world: &mut World, ticks: u64, interrupted: &AtomicBool) -> StepTimes {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} ticks, {eta} to go")
        .expect("the template is a correct one");
    let bar = ProgressBar::new(ticks).with_style(style.progress_chars("━╸─"));
    // Where there is no terminal to draw a bar on, a line at each quarter.
    let quarter = ticks.div_ceil(4).max(1);
    let mut times = StepTimes::default();
    for tick in 1..=ticks {
        if interrupted.load(Ordering::Relaxed) {
            break;
        }
        let is_awake = world.awake_count() > 0;
        let start = Instant::now();
        scene.before_tick(world);
        world.step();
        let took = start.elapsed();
        if is_awake {
            times.count += 1;
            times.total += took;
            times.longest = times.longest.max(took);
        }
        bar.inc(1);
        if bar.is_hidden() && tick % quarter == 0 {
            eprintln!("{tick} of {ticks} ticks");
        }
    }
    bar.finish_and_clear();
    times
}

fn print_summary(world: &World, times: &StepTimes) {
    let asleep = world.bodies().filter(|(_, body)| body.is_sleeping()).count();
    let mean = (times.total / times.count.max(1)).as_secs_f64() * 1e3;
    let longest = times.longest.as_secs_f64() * 1e3;
    let touching = world.contacts().filter(rustycs::ContactRef::is_touching).count();
    let error = world.error();
    let seconds = world.ticks() as f64 * world.settings().tick_seconds();
    println!("time          {seconds:.2} s, {} ticks", world.ticks());
    println!("bodies        {}, {asleep} asleep", world.body_count());
    println!("contacts      {touching}");
    println!(
        "step          {mean:.4} ms, longest {longest:.3} ms, over {} ticks with bodies awake",
        times.count
    );
    println!("penetration   {}", quantity::with_unit(f64::from(error.penetration), "m"));
    println!("residual      {}", quantity::with_unit(f64::from(error.velocity_residual), "m/s"));
    println!("energy        {}", quantity::with_unit(world.energy(), "J"));
    println!("  kinetic     {}", quantity::with_unit(world.kinetic_energy(), "J"));
    println!("state hash    {:016x}", world.state_hash());
}
