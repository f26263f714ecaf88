//! Instructions per step, counted by callgrind in a process of its own for each world.

use std::process::{Command, Stdio};

use rustycs::World;

use crate::{Variant, WARM_UP, variants};

/// The argument that asks for one world alone; its name follows.
pub(crate) const ONE: &str = "--one";

/// Steps that are counted.
const STEPS: usize = 20;

pub(crate) fn has_valgrind() -> bool {
    let version =
        Command::new("valgrind").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Instructions per step of each world.
pub(crate) fn measure(variants: &[Variant]) -> Vec<f64> {
    variants.iter().map(|variant| instructions(&variant.name) / STEPS as f64).collect()
}

/// What callgrind counts within [`counted_steps`].
fn instructions(name: &str) -> f64 {
    eprint!("\r{name:60}\r");
    let program = std::env::current_exe().expect("a running program has a path");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=*counted_steps*"])
        .arg(program)
        .args([ONE, name])
        .output()
        .expect("valgrind was found before");
    let text = String::from_utf8_lossy(&output.stderr);
    let collected = text.lines().find_map(|line| line.split_once("Collected : "));
    let count = collected.and_then(|(_, count)| count.trim().parse::<f64>().ok());
    count.filter(|&count| count > 0.0).unwrap_or_else(|| panic!("callgrind counted nothing: {text}"))
}

/// Steps the world of a name as often as is to be counted.
pub(crate) fn run_one(name: &str) {
    let all = variants();
    let variant = all.iter().find(|variant| variant.name == name).expect("the name of a world");
    let mut world = variant.world();
    (0..WARM_UP).for_each(|_| world.step());
    counted_steps(&mut world);
}

#[inline(never)]
fn counted_steps(world: &mut World) {
    (0..STEPS).for_each(|_| world.step());
}
