//! A ball that falls onto a floor, as a program of its own: how long it takes to build, and how large it is.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{fs, io};

/// What a cold build took.
#[derive(Clone, Copy, Debug)]
pub(super) struct Build {
    /// s.
    pub(super) seconds: f64,
    /// Of the program, stripped, bytes.
    pub(super) size: u64,
    /// Packages that were compiled, the program itself included.
    pub(super) packages: usize,
}

const RUSTYCS: &str = r#"use rustycs::prelude::*;

fn main() {
    let mut world = World::new(Settings::default());
    world.add_force(Force::EARTH_GRAVITY);
    world.add(Body::fixed(Shape::aabb(20.0, 1.0))).expect("a floor");
    let ball = world.add(Body::dynamic(Shape::circle(0.5)).at([0.0, 5.0])).expect("a ball");
    for _ in 0..60 {
        world.step();
    }
    println!("{:?}", world.body(ball).map(|ball| ball.position()));
}
"#;

const RAPIER: &str = r#"use rapier2d::prelude::*;

fn main() {
    let mut world = PhysicsWorld::new();
    world.insert(RigidBodyBuilder::fixed(), ColliderBuilder::cuboid(10.0, 0.5));
    let ball = RigidBodyBuilder::dynamic().translation(Vector::new(0.0, 5.0));
    let (ball, _) = world.insert(ball, ColliderBuilder::ball(0.5));
    for _ in 0..60 {
        world.step();
    }
    println!("{:?}", world.bodies[ball].translation());
}
"#;

const BOX2D: &str = r#"use boxdd_sys::ffi::*;

fn main() {
    unsafe {
        let mut definition = b2DefaultWorldDef();
        definition.gravity = b2Vec2 { x: 0.0, y: -10.0 };
        let world = b2CreateWorld(&definition);
        let floor = b2CreateBody(world, &b2DefaultBodyDef());
        b2CreatePolygonShape(floor, &b2DefaultShapeDef(), &b2MakeBox(10.0, 0.5));
        let mut definition = b2DefaultBodyDef();
        definition.type_ = b2BodyType_b2_dynamicBody;
        definition.position = b2Vec2 { x: 0.0, y: 5.0 };
        let ball = b2CreateBody(world, &definition);
        let circle = b2Circle { center: b2Vec2 { x: 0.0, y: 0.0 }, radius: 0.5 };
        b2CreateCircleShape(ball, &b2DefaultShapeDef(), &circle);
        for _ in 0..60 {
            b2World_Step(world, 1.0 / 60.0, 4);
        }
        println!("{}", b2Body_GetPosition(ball).y);
    }
}
"#;

const BARE: &str = r#"fn main() {
    println!("{:?}", Some([0.0_f32; 2]));
}
"#;

/// What stands for an engine where there is none.
pub(super) const NO_ENGINE: &str = "none";

/// Builds the ball with an engine's default features, from nothing, with packages that were downloaded before.
///
/// # Errors
/// Why it could not be built.
pub(super) fn cold(engine: &str) -> Result<Build, String> {
    let folder = std::env::temp_dir().join(format!("rustycs-footprint-{}-{engine}", std::process::id()));
    let built = in_folder(&folder, engine);
    // What is left in a temporary folder does no harm.
    _ = fs::remove_dir_all(&folder);
    built
}

fn in_folder(folder: &Path, engine: &str) -> Result<Build, String> {
    write(folder, engine)
        .map_err(|error| format!("nothing could be written to {}: {error}", folder.display()))?;
    let start = Instant::now();
    let cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--release", "--offline"])
        .current_dir(folder)
        .env("CARGO_TARGET_DIR", folder.join("target"))
        // As Box2D is compiled here.
        .env("CFLAGS", env!("BOX2D_CFLAGS"))
        .output()
        .map_err(|error| format!("cargo could not be run: {error}"))?;
    let seconds = start.elapsed().as_secs_f64();
    let said = String::from_utf8_lossy(&cargo.stderr).into_owned();
    if !cargo.status.success() {
        return Err(said.lines().find(|line| line.starts_with("error")).unwrap_or("cargo failed").to_owned());
    }
    let program = fs::metadata(folder.join("target/release/ball")).map_err(|error| error.to_string())?;
    let packages = said.lines().filter(|line| line.trim_start().starts_with("Compiling")).count();
    Ok(Build { seconds, size: program.len(), packages })
}

fn write(folder: &Path, engine: &str) -> io::Result<()> {
    let workspace = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let (dependency, program) = match engine {
        "rustycs" => (format!("rustycs = {{ path = {:?} }}", workspace.display().to_string()), RUSTYCS),
        "Rapier" => (format!("rapier2d = \"={}\"", env!("RAPIER_VERSION")), RAPIER),
        NO_ENGINE => (String::new(), BARE),
        _ => ("boxdd-sys = \"0.6\"".to_owned(), BOX2D),
    };
    fs::create_dir_all(folder.join("src"))?;
    let manifest = format!(
        "[package]\nname = \"ball\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n[dependencies]\n{dependency}\n\n\
         [profile.release]\nstrip = true\n\n[workspace]\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest)?;
    fs::write(folder.join("src/main.rs"), program)?;
    // The same versions as here.
    fs::copy(workspace.join("Cargo.lock"), folder.join("Cargo.lock"))?;
    Ok(())
}
