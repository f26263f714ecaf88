//! One measurement in a process of its own.

use std::fs;
use std::process::{Command, ExitCode, Stdio};

use crate::engine::{DEFAULT, Simulation};
use crate::engines;
use crate::scene::Scene;
use crate::speed::scenes;

/// The names of the pile of which the memory is measured, and of an empty world.
pub(super) const PILE: &str = "pile";
pub(super) const EMPTY: &str = "empty";

/// Steps over which allocations are counted.
const SETTLED_STEPS: u32 = 60;

/// A command that starts this program for one measurement.
fn command(valgrind: bool, arguments: [&str; 4]) -> Option<Command> {
    let program = std::env::current_exe().ok()?;
    let mut command = if valgrind {
        let mut command = Command::new("valgrind");
        command.args([
            "--tool=callgrind",
            "--callgrind-out-file=/dev/null",
            "--toggle-collect=*counted_steps*",
        ]);
        command.arg(program);
        command
    } else {
        Command::new(program)
    };
    command.args(["footprint", "--alone"]).args(arguments);
    Some(command)
}

pub(super) fn has_valgrind() -> bool {
    let version =
        Command::new("valgrind").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Instructions per step in the `steps` after those `before`, counted by callgrind.
pub(super) fn instructions(engine: &str, scene: &str, before: u32, steps: u32) -> Option<f64> {
    let range = format!("{before}+{steps}");
    let output = command(true, ["instructions", engine, scene, &range])?.output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    let (_, count) = text.lines().find_map(|line| line.split_once("Collected : "))?;
    let count: f64 = count.trim().parse().ok()?;
    (count > 0.0).then_some(count / f64::from(steps))
}

/// What a process of its own finds: `memory` in bytes, or `allocations` per step after so many.
pub(super) fn ask(what: &str, engine: &str, scene: &str, before: u32) -> Option<f64> {
    let output = command(false, [what, engine, scene, &before.to_string()])?.output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}

/// The scene of a name. The description of the pile is in memory beside the empty world too.
fn scene(name: &str) -> Option<Scene> {
    if name == PILE || name == EMPTY {
        return Some(scenes::pile(super::REMEMBERED.0));
    }
    Some(scenes::all().into_iter().find(|course| course.name == name)?.scene)
}

/// Does one measurement and prints its figure. Only this program gives these arguments.
pub(super) fn run(arguments: &[String]) -> ExitCode {
    let [what, engine, scene, steps] = arguments else { return ExitCode::FAILURE };
    let Some(figure) = measure(what, engine, scene, steps) else { return ExitCode::FAILURE };
    println!("{figure}");
    ExitCode::SUCCESS
}

fn measure(what: &str, engine: &str, name: &str, steps: &str) -> Option<f64> {
    let (before, steps) = steps.split_once('+').unwrap_or((steps, "0"));
    let (before, steps): (u32, u32) = (before.parse().ok()?, steps.parse().ok()?);
    if what == "allocations" {
        engines::use_rust_allocator_for_box2d();
    }
    let engines = engines::all();
    let engine = engines.iter().find(|known| known.name() == engine)?;
    let described = scene(name)?;
    let empty = Scene::default();
    let mut simulation = engine.simulate(if name == EMPTY { &empty } else { &described }, DEFAULT);
    (0..before).for_each(|_| simulation.step());
    match what {
        "instructions" => {
            counted_steps(simulation.as_mut(), steps);
            Some(0.0)
        }
        "memory" => peak_memory(),
        "allocations" => {
            let counted = allocation_counter::measure(|| (0..SETTLED_STEPS).for_each(|_| simulation.step()));
            Some(counted.count_total as f64 / f64::from(SETTLED_STEPS))
        }
        _ => None,
    }
}

/// What callgrind counts: it knows the function by its name.
#[inline(never)]
fn counted_steps(simulation: &mut dyn Simulation, steps: u32) {
    (0..steps).for_each(|_| simulation.step());
}

/// The most memory that this process has had at a time, bytes.
fn peak_memory() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix(" kB")?.trim().parse().ok()?;
    Some(1024.0 * kibibytes)
}
