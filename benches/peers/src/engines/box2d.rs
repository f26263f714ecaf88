//! Box2D: its C source, by way of the crate `boxdd-sys`.

use std::alloc::{Layout, alloc, dealloc};
use std::ffi::{c_char, c_int, c_void};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, MutexGuard, PoisonError};

use boxdd_sys::ffi;

use crate::engine::{Engine, Fineness, Simulation, State};
use crate::scene::{BodySpec, Kind, Outline, Pull, Scene};

/// Box2D at its defaults, but that everything bounces, however slow.
#[derive(Debug, Default)]
pub(crate) struct Box2d {
    /// Whether all that moves is a bullet.
    pub(crate) are_bullets: bool,
}

impl Engine for Box2d {
    fn name(&self) -> &'static str {
        if self.are_bullets { "Box2D, bullets" } else { "Box2D" }
    }

    fn version(&self) -> String {
        // SAFETY: returns a constant.
        let ffi::b2Version { major, minor, revision } = unsafe { ffi::b2GetVersion() };
        let source = &boxdd_sys::UPSTREAM_SHA[..10];
        let flags = env!("BOX2D_CFLAGS");
        format!("Box2D {major}.{minor}.{revision} (source {source}), {LANES}, {flags}, f32")
    }

    fn simulate(&self, scene: &Scene, fineness: Fineness) -> Box<dyn Simulation> {
        let mut world = Box2dWorld::new(scene, fineness, self.are_bullets);
        for spec in &scene.bodies {
            world.add(spec);
        }
        Box::new(world)
    }
}

/// The instruction set Box2D is compiled for: see its core.h.
pub(crate) const LANES: &str = if cfg!(all(feature = "avx2", target_arch = "x86_64")) {
    "AVX2"
} else if cfg!(target_arch = "x86_64") {
    "SSE2"
} else if cfg!(target_arch = "aarch64") {
    "NEON"
} else {
    "the lanes of this machine"
};

const WANTED_FLAGS: &str = "-O3 -DNDEBUG";

/// Whether Box2D is built for a fair race: optimized as far as Rust is, without assertions, from source.
///
/// # Errors
/// What is wrong with the build, and what to do.
pub(super) fn fair_build() -> Result<(), String> {
    let flags = env!("BOX2D_CFLAGS");
    let remedy = format!(
        "Build from within the repository, whose .cargo/config.toml sets them, with no CFLAGS of your own \
         (env -u CFLAGS cargo ...), or set CFLAGS=\"{WANTED_FLAGS}\"."
    );
    // Of several levels, compilers take the last.
    let level = flags.split(' ').rfind(|flag| flag.starts_with("-O"));
    if level != Some("-O3") {
        return Err(format!(
            "Box2D was compiled with the flags \"{flags}\", without -O3 at their end. {remedy}"
        ));
    }
    if *ASSERTIONS_ARE_ON {
        return Err(format!("Box2D was compiled with its assertions on (flags \"{flags}\"). {remedy}"));
    }
    let provider = boxdd_sys::PROVIDER_ADAPTER;
    if provider != "vendored" {
        return Err(format!(
            "Box2D was not compiled here, but comes from \"{provider}\". Unset BOXDD_SYS_PROVIDER."
        ));
    }
    #[cfg(all(feature = "avx2", target_arch = "x86_64"))]
    if !std::arch::is_x86_feature_detected!("avx2") {
        return Err(
            "Box2D was compiled for AVX2, which this machine does not have. Build without the feature avx2."
                .to_owned(),
        );
    }
    Ok(())
}

/// Found out by trial: a box of negative width is made, which an assertion would object to.
static ASSERTIONS_ARE_ON: LazyLock<bool> = LazyLock::new(|| {
    static OBJECTED: AtomicBool = AtomicBool::new(false);

    unsafe extern "C" fn object(_condition: *const c_char, _file: *const c_char, _line: c_int) -> c_int {
        // 0: go on. Any later assertion ends the program, as Box2D's own callback does.
        c_int::from(OBJECTED.swap(true, Ordering::Relaxed))
    }

    let _only_one = worlds();
    // SAFETY: the callback is a function, touches an atomic only and does not unwind. The box is a value that
    // Box2D computes from the numbers alone and nobody uses.
    unsafe {
        ffi::b2SetAssertFcn(Some(object));
        ffi::b2MakeBox(-1.0, 1.0);
    }
    OBJECTED.load(Ordering::Relaxed)
});

/// Has Box2D take its memory from the allocator of this program, where it is counted. To be called before the first
/// world is made.
pub(crate) fn use_rust_allocator() {
    /// What Box2D asks for: a multiple of 32 bytes, aligned to as many. It frees by the size before rounding.
    fn layout(size: usize, alignment: usize) -> Layout {
        let rounded = size.next_multiple_of(32);
        Layout::from_size_align(rounded, alignment).expect("a size that Box2D can ask for")
    }

    extern "C" fn allocate(size: usize, alignment: c_int) -> *mut c_void {
        let layout = layout(size, alignment as usize);
        // SAFETY: Box2D asks for no empty block.
        unsafe { alloc(layout) }.cast()
    }

    extern "C" fn free(memory: *mut c_void, size: usize) {
        // SAFETY: Box2D gives back what `allocate` gave it, with the size it asked for, which rounds to the same
        // layout: its alignment is always 32.
        unsafe { dealloc(memory.cast(), layout(size, 32)) }
    }

    let _only_one = worlds();
    // SAFETY: the functions are valid for as long as the program runs, and there is no memory of another kind yet.
    unsafe { ffi::b2SetAllocator(Some(allocate), Some(free)) }
}

/// Box2D keeps its worlds in a table that it does not guard: they are made and destroyed one at a time.
fn worlds() -> MutexGuard<'static, ()> {
    static WORLDS: Mutex<()> = Mutex::new(());
    WORLDS.lock().unwrap_or_else(PoisonError::into_inner)
}

fn vector(v: [f64; 2]) -> ffi::b2Vec2 {
    let [x, y] = v.map(|x| x as f32);
    ffi::b2Vec2 { x, y }
}

fn numbers(v: ffi::b2Vec2) -> [f64; 2] {
    [v.x, v.y].map(f64::from)
}

struct Box2dWorld {
    world: ffi::b2WorldId,
    bodies: Vec<ffi::b2BodyId>,
    /// s.
    dt: f32,
    substeps: c_int,
    pull: Option<Pull>,
    are_bullets: bool,
}

impl Box2dWorld {
    fn new(scene: &Scene, fineness: Fineness, are_bullets: bool) -> Self {
        let _only_one = worlds();
        // SAFETY: the definition is Box2D's own with plain numbers changed, and lives through the call.
        let world = unsafe {
            let mut definition = ffi::b2DefaultWorldDef();
            definition.gravity = vector(scene.gravity);
            definition.enableSleep = scene.sleeps;
            definition.restitutionThreshold = 0.0;
            ffi::b2CreateWorld(&raw const definition)
        };
        assert!(world.index1 != 0, "Box2D keeps no more than 128 worlds at a time; drop some");
        Self {
            world,
            bodies: Vec::with_capacity(scene.bodies.len()),
            dt: (1.0 / fineness.tick_rate) as f32,
            substeps: fineness.substeps as c_int,
            pull: scene.pull,
            are_bullets,
        }
    }

    fn add(&mut self, spec: &BodySpec) {
        // SAFETY: the world is alive until `self` is dropped. The definitions are Box2D's own with plain numbers
        // changed; they and the shape live through the calls, which copy them.
        unsafe {
            let mut definition = ffi::b2DefaultBodyDef();
            definition.type_ = match spec.kind {
                Kind::Fixed => ffi::b2BodyType_b2_staticBody,
                Kind::Kinematic => ffi::b2BodyType_b2_kinematicBody,
                Kind::Dynamic => ffi::b2BodyType_b2_dynamicBody,
            };
            definition.position = vector(spec.position);
            // Better than b2MakeRot, which is off by up to 1e-4.
            definition.rotation = ffi::b2Rot { c: spec.angle.cos() as f32, s: spec.angle.sin() as f32 };
            definition.linearVelocity = vector(spec.velocity);
            definition.angularVelocity = spec.spin as f32;
            definition.angularDamping = spec.angular_damping as f32;
            // Bullets do not see each other, and a wall may be one.
            definition.isBullet = self.are_bullets && spec.kind == Kind::Dynamic;
            let body = ffi::b2CreateBody(self.world, &raw const definition);

            let mut surface = ffi::b2DefaultShapeDef();
            surface.density = spec.density as f32;
            surface.material.friction = spec.friction as f32;
            surface.material.restitution = spec.restitution as f32;
            if let Outline::Circle { radius } = spec.outline {
                let circle = ffi::b2Circle { center: vector([0.0; 2]), radius: radius as f32 };
                ffi::b2CreateCircleShape(body, &raw const surface, &raw const circle);
            } else {
                let polygon = polygon(&spec.outline);
                ffi::b2CreatePolygonShape(body, &raw const surface, &raw const polygon);
            }
            self.bodies.push(body);
        }
    }

    /// Box2D forgets the forces on a body at the end of each step.
    fn apply_pull(&mut self, pull: Pull) {
        for &body in &self.bodies {
            // SAFETY: the body is one of this world, which is alive; bodies that are not dynamic are passed over.
            unsafe {
                let mass = ffi::b2Body_GetMass(body);
                let center = numbers(ffi::b2Body_GetWorldCenter(body));
                let force = pull.acceleration(center).map(|a| a * f64::from(mass));
                ffi::b2Body_ApplyForceToCenter(body, vector(force), true);
            }
        }
    }
}

fn polygon(outline: &Outline) -> ffi::b2Polygon {
    match outline {
        Outline::Circle { .. } => unreachable!("a circle is no polygon"),
        // SAFETY: a function of two numbers.
        Outline::Box { width, height } => unsafe {
            ffi::b2MakeBox((0.5 * width) as f32, (0.5 * height) as f32)
        },
        Outline::Polygon(corners) => {
            let points: Vec<_> = corners.iter().copied().map(vector).collect();
            // SAFETY: the pointer is to as many points as are said; Box2D reads them within the call, and
            // answers with an empty hull where there are more than eight.
            let hull = unsafe { ffi::b2ComputeHull(points.as_ptr(), points.len() as c_int) };
            // Box2D joins corners that are less than 2 cm apart.
            assert_eq!(hull.count as usize, corners.len(), "Box2D takes no such polygon: {corners:?}");
            // SAFETY: the hull is one that b2ComputeHull made.
            unsafe { ffi::b2MakePolygon(&raw const hull, 0.0) }
        }
    }
}

impl Drop for Box2dWorld {
    fn drop(&mut self) {
        let _only_one = worlds();
        // SAFETY: the world is alive, and nobody has the id but this value, which is going.
        unsafe { ffi::b2DestroyWorld(self.world) }
    }
}

impl Simulation for Box2dWorld {
    fn step(&mut self) {
        if let Some(pull) = self.pull {
            self.apply_pull(pull);
        }
        // SAFETY: the world is alive, and `&mut self` says that nobody else reads it now.
        unsafe { ffi::b2World_Step(self.world, self.dt, self.substeps) }
    }

    fn state(&self, body: usize) -> State {
        let body = self.bodies[body];
        // SAFETY: the body is one of this world, which is alive.
        let (center, rotation, velocity, spin) = unsafe {
            (
                ffi::b2Body_GetWorldCenter(body),
                ffi::b2Body_GetRotation(body),
                ffi::b2Body_GetLinearVelocity(body),
                ffi::b2Body_GetAngularVelocity(body),
            )
        };
        State {
            position: numbers(center),
            angle: f64::from(rotation.s).atan2(f64::from(rotation.c)),
            velocity: numbers(velocity),
            spin: f64::from(spin),
        }
    }

    fn set_velocity(&mut self, body: usize, velocity: [f64; 2]) {
        // SAFETY: the body is one of this world, which is alive.
        unsafe { ffi::b2Body_SetLinearVelocity(self.bodies[body], vector(velocity)) }
    }

    fn mass(&self, body: usize) -> [f64; 2] {
        let body = self.bodies[body];
        // SAFETY: the body is one of this world, which is alive.
        unsafe {
            if ffi::b2Body_GetType(body) != ffi::b2BodyType_b2_dynamicBody {
                return [f64::INFINITY; 2];
            }
            [ffi::b2Body_GetMass(body), ffi::b2Body_GetRotationalInertia(body)].map(f64::from)
        }
    }

    fn contact_points(&self) -> usize {
        let mut contacts: Vec<ffi::b2ContactData> = Vec::new();
        let mut points = 0;
        for &body in &self.bodies {
            // SAFETY: the body is one of this world, which is alive; Box2D writes whole contacts, as many as it
            // says and no more than there is room for.
            unsafe {
                let capacity = ffi::b2Body_GetContactCapacity(body);
                contacts.clear();
                contacts.reserve(capacity as usize);
                let count = ffi::b2Body_GetContactData(body, contacts.as_mut_ptr(), capacity);
                contacts.set_len(count as usize);
            }
            points += contacts.iter().map(|contact| contact.manifold.pointCount as usize).sum::<usize>();
        }
        // Each contact is one of two bodies.
        points / 2
    }
}
