//! Writes down how Box2D is compiled, and which engines these are, for the program to check and to print.

use std::env;
use std::fs;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rustc-env=BOX2D_CFLAGS={}", c_flags());

    let lock = concat!(env!("CARGO_MANIFEST_DIR"), "/../../Cargo.lock");
    println!("cargo:rerun-if-changed={lock}");
    let lock = fs::read_to_string(lock).expect("the workspace has a Cargo.lock beside its Cargo.toml");
    println!("cargo:rustc-env=RAPIER_VERSION={}", version_of("rapier2d", &lock));
}

/// The flags that the crate `cc` takes from the environment, in its order: the last of a kind wins.
fn c_flags() -> String {
    let variable = |name: &str| env::var(name).expect("Cargo sets it for build scripts");
    let (host, target) = (variable("HOST"), variable("TARGET"));
    let kind = if host == target { "HOST" } else { "TARGET" };
    let names = [
        "CFLAGS".to_owned(),
        format!("{kind}_CFLAGS"),
        format!("CFLAGS_{}", target.replace(['-', '.'], "_")),
        format!("CFLAGS_{target}"),
    ];
    for name in &names {
        println!("cargo:rerun-if-env-changed={name}");
    }
    let given: Vec<_> = names.iter().filter_map(|name| env::var(name).ok()).collect();
    given.join(" ").split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The version of a package in the text of a Cargo.lock.
fn version_of(package: &str, lock: &str) -> String {
    let name = format!("name = \"{package}\"");
    let mut lines = lock.lines().skip_while(|line| *line != name);
    let version = lines.nth(1).and_then(|line| line.strip_prefix("version = \""));
    version.map_or("of unknown version", |version| version.trim_end_matches('"')).to_owned()
}
