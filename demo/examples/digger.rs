//! Digger: a platformer in one file. Run, jump, ride the lift, push the crates, and dig through the ground to find all the gold.
//!
//! `cargo run --release -p rustycs-demo --example digger`, and with `-- --headless` a game without a window.

use macroquad::prelude as mq;
use rustycs::prelude::*;

/// The level as it is seen, in tiles of 1 m: ground, planks that are passed from below, crates, gold, and the lift.
const LEVEL: [&str; 12] = [
    "#..................................#",
    "#......................o...........#",
    "#....................=====.........#",
    "#................................o.#",
    "#...........o.....................##",
    "#..........====....................#",
    "#.....................c............#",
    "#......##.........c...c..........L.#",
    "#..o...##....o....c...c...###......#",
    "#######################...######..##",
    "#####o############...####.##o###..##",
    "####################################",
];
/// Speeds, m/s, and what pulls down the hero, m/s².
const RUN: f32 = 5.0;
const JUMP: f32 = 9.0;
const FALL: f32 = 20.0;
/// How far the hero digs and grasps, m from its middle.
const REACH: f32 = 1.6;
const GRASP: f32 = 0.9;
/// A tick, s.
const TICK: f32 = 1.0 / 60.0;

/// What the keys say: which way to run, from -1 to 1; whether to jump; and where to dig.
#[derive(Clone, Copy, Default)]
struct Keys {
    run: f32,
    jumps: bool,
    digs: Option<Vec2>,
}

/// The game without its picture: it could run on a server.
#[derive(Clone)]
struct Game {
    world: World,
    map: TileMap,
    lift: BodyId,
    hero: Mover,
    /// What the others meet in the hero's place.
    body: BodyId,
    velocity: Vec2,
    gold: Vec<Vec2>,
}

impl Game {
    fn new() -> Result<Self, BodyError> {
        let mut world = World::new(Settings::default());
        world.add_force(Force::EARTH_GRAVITY);
        // 1. A map of tiles is edited while the world runs; its lowest row comes first.
        let solid = LEVEL.iter().rev().flat_map(|row| row.chars().map(|tile| tile == '#'));
        let mut map = TileMap::new(&solid.collect::<Vec<_>>(), LEVEL[0].len(), 1.0);
        map.add_to(&mut world)?;
        // 2. The rest of the level: one-way planks, crates, and a lift, which is told where to go.
        let places = |kind: char| {
            LEVEL.iter().rev().zip(0_u8..).flat_map(move |(row, y)| {
                let columns = row.chars().zip(0_u8..).filter(move |&(tile, _)| tile == kind);
                columns.map(move |(_, x)| Vec2::new(f32::from(x) + 0.5, f32::from(y) + 0.5))
            })
        };
        for place in places('=') {
            world.add(Body::fixed(Shape::aabb(1.0, 0.2)).at(place).one_way([0.0, 1.0]))?;
        }
        for place in places('c') {
            world.add(Body::dynamic(Shape::rectangle(0.96, 0.96)).at(place).density(20.0))?;
        }
        let lift = Body::kinematic(Shape::rectangle(1.9, 0.3)).at(places('L').next().unwrap_or_default());
        let lift = world.add(lift)?;
        // 3. The hero is moved by hand, and a kinematic body goes with it for others to meet.
        let (shape, start) = (Shape::capsule([0.0, -0.25], [0.0, 0.25], 0.35), [1.5, 4.0]);
        let body = world.add(Body::kinematic(shape).at(start))?;
        let hero = Character::new(shape).at(start).step_height(0.3).push_force(400.0).ignore(body);
        let gold = places('o').collect();
        Ok(Self { world, map, lift, hero: Mover::new(hero)?, body, velocity: Vec2::ZERO, gold })
    }

    /// 4. Once per frame. What the hero does is done after each tick, so that it is the same at any number of frames per second.
    fn advance(&mut self, seconds: f32, keys: Keys) {
        let Self { world, map, lift, hero, body, velocity, gold } = self;
        if let Some(tile) = keys.digs.and_then(|at| map.tile_at(at))
            && hero.position().distance(map.center_of(tile)) < f64::from(REACH)
        {
            // A tile of this size is always taken.
            _ = map.set(world, tile, false);
        }
        world.advance_then(seconds, |world| {
            velocity.x = keys.run * RUN;
            velocity.y -= FALL * TICK;
            if keys.jumps && hero.is_grounded() {
                velocity.y = JUMP + hero.ground_velocity(world).y.max(0.0);
            }
            let moved = hero.move_by(world, *velocity * TICK);
            if moved.is_grounded() || moved.ceiling.is_some() {
                velocity.y = 0.0;
            }
            if let Some(mut body) = world.body_mut(*body) {
                body.move_to(hero.pose());
            }
            let phase = 0.8 * world.time();
            if let Some(mut lift) = world.body_mut(*lift) {
                lift.move_to(Pose::at([33.0, 4.2 + 3.0 * f64::from(Vec2::from_angle(phase as f32).y)]));
            }
            gold.retain(|place| hero.position().distance(Point::from(*place)) > f64::from(GRASP));
        });
    }

    fn message(&self) -> String {
        match self.gold.len() {
            0 => "All the gold is yours. R plays again.".into(),
            left => format!("Gold left: {left}. Arrows run and jump, the mouse digs, R begins again."),
        }
    }
}

fn main() -> Result<(), BodyError> {
    let mut game = Game::new()?;
    if std::env::args().any(|word| word == "--headless") {
        // To the right, over what is in the way.
        let all = game.gold.len();
        for frame in 0..900 {
            let jumps = frame % 40 < 10;
            game.advance(1.0 / 60.0, Keys { run: 1.0, jumps, ..Keys::default() });
        }
        println!("{} The hero is at {:.1}.", game.message(), game.hero.position());
        assert!(game.gold.len() < all && game.hero.position().y > 0.0);
        return Ok(());
    }
    let [window_width, window_height] = [1260, 480];
    let conf = mq::Conf { window_title: "digger".into(), window_width, window_height, ..mq::Conf::default() };
    macroquad::Window::from_config(conf, play(game));
    Ok(())
}

/// 5. The window: input, time, picture.
async fn play(beginning: Game) {
    let mut game = beginning.clone();
    loop {
        let camera = camera();
        let mouse = camera.screen_to_world(mq::mouse_position().into());
        let is_down = |key| f32::from(u8::from(mq::is_key_down(key)));
        let keys = Keys {
            run: is_down(mq::KeyCode::Right) - is_down(mq::KeyCode::Left),
            jumps: mq::is_key_down(mq::KeyCode::Up),
            digs: mq::is_mouse_button_down(mq::MouseButton::Left).then_some(Vec2::new(mouse.x, mouse.y)),
        };
        // To drop through planks.
        game.hero.set_passes_one_way(mq::is_key_down(mq::KeyCode::Down));
        if mq::is_key_pressed(mq::KeyCode::R) {
            game = beginning.clone();
        }
        game.advance(mq::get_frame_time(), keys);

        mq::clear_background(mq::Color::from_hex(0x11_141b));
        mq::set_camera(&camera);
        // 6. Ticks and frames are not in step: bodies and the hero are drawn between their last two poses.
        let alpha = game.world.alpha();
        for (_, body) in game.world.bodies().filter(|&(id, _)| id != game.body) {
            let dark = mq::Color::from_hex(0x6b_5b45);
            let color = if body.body_type() == BodyType::Fixed { dark } else { mq::SKYBLUE };
            body.colliders().for_each(|part| draw_convex(part.shape(), part.interpolated_pose(alpha), color));
        }
        for place in &game.gold {
            mq::draw_circle(place.x, place.y, 0.25, mq::GOLD);
        }
        let Vec2 { x, y } = game.hero.interpolated_pose(&game.world).center.to_vec2();
        mq::draw_rectangle(x - 0.35, y - 0.25, 0.7, 0.5, mq::ORANGE);
        for height in [-0.25, 0.25] {
            mq::draw_circle(x, y + height, 0.35, mq::ORANGE);
        }
        mq::set_default_camera();
        mq::draw_text(game.message(), 20.0, 30.0, 24.0, mq::LIGHTGRAY);
        mq::next_frame().await;
    }
}

/// Shows the level in a window of any shape; y points up in the world and down in the window.
fn camera() -> mq::Camera2D {
    let (width, height) = (LEVEL[0].len() as f32, LEVEL.len() as f32);
    let wide = width.max(height * mq::screen_width() / mq::screen_height());
    let zoom = mq::vec2(2.0 / wide, -2.0 / wide * mq::screen_width() / mq::screen_height());
    mq::Camera2D { target: mq::vec2(0.5 * width, 0.5 * height), zoom, ..mq::Camera2D::default() }
}

/// A polygon as triangles round its first corner.
fn draw_convex(shape: &Shape, pose: Pose, color: mq::Color) {
    let corners: Vec<Vec2> = shape.vertices().iter().map(|&corner| pose.to_world(corner).to_vec2()).collect();
    for pair in corners.get(1..).unwrap_or(&[]).windows(2) {
        let [a, b, c] = [corners[0], pair[0], pair[1]].map(|corner| mq::vec2(corner.x, corner.y));
        mq::draw_triangle(a, b, c, color);
    }
}
