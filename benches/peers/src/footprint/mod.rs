//! The command `footprint`: instructions, memory, allocations, and what a small program takes to build.
//!
//! Each figure comes from a process of its own, which this program starts of itself, so that nothing of one engine is
//! counted for another.

mod alone;
mod build;
mod page;

use std::fs;
use std::io;
use std::process::ExitCode;

use crate::cli::FootprintOptions;
use crate::command::exit_code;
use crate::engines;
use build::Build;

/// Scenes whose instructions are counted, steps before and steps of it.
const COUNTED: [(&str, u32, u32); 3] =
    [("large-pyramid", 20, 20), ("pile-1k", 240, 40), ("one-ball", 300, 600)];

/// How many bodies the pile has of which the memory is measured, and how many ticks it is run: until it has piled up.
const REMEMBERED: (usize, u32) = (16_000, 300);

/// The scenes of which allocations are counted once they have settled, and ticks until then.
const SETTLED: [(&str, u32); 2] = [("pile-1k", 900), ("large-pyramid", 200)];

/// The engines take turns in being built so many times; the least time counts.
const BUILDS: u32 = 3;

/// What was measured: by scene, then by engine; nothing where it could not be.
#[derive(Debug, Default)]
struct Findings {
    /// Instructions per step.
    instructions: Vec<(String, Vec<Option<f64>>)>,
    /// Peak memory of a process with the scene and of one with an empty world, bytes.
    memory: Vec<[Option<f64>; 2]>,
    /// Allocations per settled step.
    allocations: Vec<(String, Vec<Option<f64>>)>,
    builds: Vec<Result<Build, String>>,
    /// A program without an engine; nothing where none was built.
    bare: Option<Build>,
    /// Why something was left out.
    left_out: Vec<String>,
}

/// Does what is asked for.
pub(crate) fn run(options: &FootprintOptions) -> ExitCode {
    if !options.alone.is_empty() {
        return alone::run(&options.alone);
    }
    if let Err(reason) = engines::fair_build() {
        eprintln!("{reason}");
        return ExitCode::FAILURE;
    }
    exit_code(&options.out, |is_stopped| command(options, is_stopped))
}

/// Whether it came to its end.
fn command(options: &FootprintOptions, is_stopped: &dyn Fn() -> bool) -> io::Result<bool> {
    fs::create_dir_all(&options.out)?;
    let engines: Vec<&'static str> = engines::all().iter().map(|engine| engine.name()).collect();
    let mut findings = Findings::default();
    let has_valgrind = alone::has_valgrind();
    if !has_valgrind {
        findings.left_out.push("Instructions are not counted: there is no valgrind here.".into());
    }
    for (scene, before, steps) in COUNTED.into_iter().filter(|_| has_valgrind) {
        let (before, steps) = if options.quick { (before / 4, steps / 4) } else { (before, steps) };
        let count = |engine: &&str| {
            eprintln!("instructions: {scene} in {engine} ...");
            (!is_stopped()).then(|| alone::instructions(engine, scene, before, steps)).flatten()
        };
        findings.instructions.push((scene.into(), engines.iter().map(count).collect()));
    }
    for engine in &engines {
        eprintln!("memory: a pile of {} in {engine} ...", REMEMBERED.0);
        let ticks = if options.quick { REMEMBERED.1 / 10 } else { REMEMBERED.1 };
        let peak =
            |scene: &str| (!is_stopped()).then(|| alone::ask("memory", engine, scene, ticks)).flatten();
        findings.memory.push([peak(alone::PILE), peak(alone::EMPTY)]);
    }
    for (scene, before) in SETTLED {
        let count = |engine: &&str| {
            eprintln!("allocations: {scene} in {engine} ...");
            (!is_stopped()).then(|| alone::ask("allocations", engine, scene, before)).flatten()
        };
        findings.allocations.push((scene.into(), engines.iter().map(count).collect()));
    }
    if options.quick {
        findings.left_out.push("The cold builds are left out of a quick run.".into());
    } else {
        findings.builds = cold_builds(&engines, is_stopped);
        findings.bare = build::cold(build::NO_ENGINE).ok();
    }
    if is_stopped() {
        return Ok(false);
    }
    let path = options.out.join("FOOTPRINT.md");
    fs::write(&path, page::page(&engines, &findings))?;
    println!("{}", path.display());
    Ok(true)
}

/// What each engine takes to build, by the build of each that took least; why not, where one of them failed.
fn cold_builds(engines: &[&str], is_stopped: &dyn Fn() -> bool) -> Vec<Result<Build, String>> {
    let cold = |engine: &&str| {
        if is_stopped() {
            return Err("stopped".to_owned());
        }
        eprintln!("cold build: a ball in {engine} ...");
        build::cold(engine)
    };
    let mut builds: Vec<_> = engines.iter().map(cold).collect();
    for _ in 1..BUILDS {
        for (engine, least) in engines.iter().zip(&mut builds) {
            if let Ok(before) = *least {
                *least =
                    cold(engine).map(|build| if build.seconds < before.seconds { build } else { before });
            }
        }
    }
    builds
}
