//! Slingshot: a game in one file, on nothing but what everybody can use.
//!
//! Three eggs stand in a castle. Pull the ball back and let go: an egg breaks when something hits it hard.
//!
//! `cargo run --release -p rustycs-demo --example slingshot`, and with `-- --headless` a game without a window.

use macroquad::prelude as mq;
use rustycs::prelude::*;

/// Where the ball lies in the sling, m.
const SLING: Vec2 = Vec2::new(-9.0, 2.0);
/// How far the ball can be pulled, m, and the speed that it gets for each metre, 1/s.
const LONGEST_PULL: f32 = 2.5;
const SPEED_PER_PULL: f32 = 7.0;
/// An egg breaks when it is hit at this speed, m/s.
const BREAKING_SPEED: f32 = 4.0;
const BALLS: usize = 4;
/// Part of the world that is in sight: its middle and its width, m.
const VIEW: (Vec2, f32) = (Vec2::new(-1.5, 4.0), 24.0);

/// The game without its picture: it could run on a server.
#[derive(Clone)]
struct Game {
    world: World,
    eggs: Vec<BodyId>,
    balls_left: usize,
}

impl Game {
    /// 1. A world is settings, forces and bodies. What leaves the bounds is removed.
    fn new() -> Result<Self, BodyError> {
        let bounds = Aabb::new(Vec2::new(-40.0, -10.0), Vec2::new(40.0, 40.0));
        let mut world = World::new(Settings { bounds: Some(bounds), ..Settings::default() });
        world.add_force(Force::EARTH_GRAVITY);
        world.add(Body::fixed(Shape::aabb(30.0, 1.0)).at([0.0, -0.5]).material(Material::STONE))?;

        // The castle: three rooms of two posts and a beam, one upon the other two, with an egg in each.
        let mut eggs = Vec::new();
        for room in [[3.0, 0.0], [5.5, 0.0], [4.25, 2.3]].map(Vec2::from) {
            let stone = |width, height| Body::dynamic(Shape::obb(width, height)).material(Material::STONE);
            world.add(stone(0.3, 2.0).at(room + Vec2::new(-0.9, 1.0)))?;
            world.add(stone(0.3, 2.0).at(room + Vec2::new(0.9, 1.0)))?;
            world.add(stone(2.4, 0.3).at(room + Vec2::new(0.0, 2.15)))?;
            let egg = Body::dynamic(Shape::circle(0.4)).material(Material::RUBBER);
            eggs.push(world.add(egg.at(room + Vec2::new(0.0, 0.4)))?);
        }
        Ok(Self { world, eggs, balls_left: BALLS })
    }

    /// 2. Bodies come into the world whenever something happens, here a ball that somebody lets go.
    fn shoot(&mut self, pull: Vec2) -> Option<BodyId> {
        self.balls_left = self.balls_left.checked_sub(1)?;
        let ball = Body::dynamic(Shape::circle(0.35)).material(Material::STONE);
        self.world.add(ball.at(SLING + pull).velocity(pull * -SPEED_PER_PULL)).ok()
    }

    /// 3. Once per frame: the world takes the ticks that fit into the time, and tells what has happened in them.
    fn advance(&mut self, seconds: f32) {
        self.world.advance(seconds);
        let events = self.world.events();
        let hard = events.hits().iter().filter(|hit| hit.speed > BREAKING_SPEED);
        let mut gone: Vec<BodyId> = hard.flat_map(|hit| [hit.a, hit.b]).collect();
        gone.extend(events.left());
        for egg in self.eggs.extract_if(.., |egg| gone.contains(egg)) {
            self.world.remove(egg);
        }
    }

    /// 4. A clone goes on as the original will, to the bit: where the ball would be in each of the next ticks.
    fn foresee(&self, pull: Vec2) -> Vec<Vec2> {
        let mut future = self.clone();
        let Some(ball) = future.shoot(pull) else { return Vec::new() };
        let mut place_after_tick = || {
            future.world.step();
            Some(future.world.body(ball)?.position())
        };
        (0..50).map_while(|_| place_after_tick()).collect()
    }

    /// What to do, or how it ended.
    fn message(&self) -> String {
        match (self.eggs.len(), self.balls_left) {
            (0, left) => format!("All eggs are broken. Balls to spare: {left}. R plays again."),
            (eggs, 0) => format!("Eggs left: {eggs}, and no ball. R tries again."),
            (eggs, left) => format!("Eggs: {eggs}. Balls: {left}. Pull the ball back, and let go."),
        }
    }
}

/// The pull for the way that the mouse has gone, m: no longer than the sling allows.
fn pull_of(way: Vec2) -> Vec2 {
    way * (LONGEST_PULL / way.length().max(LONGEST_PULL))
}

fn main() -> Result<(), BodyError> {
    let mut game = Game::new()?;
    if std::env::args().any(|word| word == "--headless") {
        for pull in [[-2.4, -0.1], [-2.4, -0.3], [-2.4, -0.5], [-2.3, -0.8]].map(Vec2::from) {
            game.shoot(pull);
            (0..240).for_each(|_| game.advance(1.0 / 60.0));
            println!("{}", game.message());
        }
        assert!(game.eggs.len() < 3, "four balls break an egg");
        return Ok(());
    }
    let conf = mq::Conf {
        window_title: "slingshot".into(),
        window_width: 1200,
        sample_count: 4,
        ..mq::Conf::default()
    };
    macroquad::Window::from_config(conf, play(game));
    Ok(())
}

/// 5. The window: input, time, picture, sixty times a second.
async fn play(beginning: Game) {
    let mut game = beginning.clone();
    let mut pressed_at = None::<Vec2>;
    loop {
        let camera = camera();
        let mouse = camera.screen_to_world(mq::mouse_position().into());
        let mouse = Vec2::new(mouse.x, mouse.y);
        if mq::is_mouse_button_pressed(mq::MouseButton::Left) {
            pressed_at = Some(mouse);
        }
        let pull = pressed_at.map(|from| pull_of(mouse - from));
        if mq::is_mouse_button_released(mq::MouseButton::Left) {
            pressed_at = None;
            pull.and_then(|pull| game.shoot(pull));
        }
        if mq::is_key_pressed(mq::KeyCode::R) {
            game = beginning.clone();
        }
        game.advance(mq::get_frame_time());

        mq::clear_background(mq::Color::from_hex(0x11_141b));
        mq::set_camera(&camera);
        draw_sling(&game, pull);
        // 6. Ticks and frames are not in step: bodies are drawn between their last two poses.
        for (id, body) in game.world.bodies() {
            for part in body.colliders() {
                draw_shape(part.shape(), part.interpolated_pose(game.world.alpha()), color(&game, id, body));
            }
        }
        mq::set_default_camera();
        mq::draw_text(game.message(), 20.0, 36.0, 28.0, mq::LIGHTGRAY);
        mq::next_frame().await;
    }
}

/// Shows the view in a window of any shape; y points up in the world and down in the window.
fn camera() -> mq::Camera2D {
    let (middle, width) = VIEW;
    let height = width * mq::screen_height() / mq::screen_width();
    let zoom = mq::vec2(2.0 / width, -2.0 / height);
    mq::Camera2D { target: mq::vec2(middle.x, middle.y), zoom, ..mq::Camera2D::default() }
}

fn draw_sling(game: &Game, pull: Option<Vec2>) {
    mq::draw_line(SLING.x, 0.0, SLING.x, SLING.y, 0.2, mq::BROWN);
    let ball = SLING + pull.unwrap_or(Vec2::ZERO);
    if game.balls_left > 0 {
        mq::draw_line(SLING.x, SLING.y, ball.x, ball.y, 0.1, mq::BROWN);
        mq::draw_circle(ball.x, ball.y, 0.35, mq::SKYBLUE);
    }
    for place in pull.map_or_else(Vec::new, |pull| game.foresee(pull)).iter().step_by(3) {
        mq::draw_circle(place.x, place.y, 0.07, mq::GRAY);
    }
}

fn color(game: &Game, id: BodyId, body: BodyRef<'_>) -> mq::Color {
    match body.shape() {
        _ if body.body_type() == BodyType::Fixed => mq::DARKGRAY,
        Shape::Circle(_) if game.eggs.contains(&id) => mq::YELLOW,
        Shape::Circle(_) => mq::SKYBLUE,
        _ => mq::ORANGE,
    }
}

/// A circle, or a polygon as triangles round its first corner.
fn draw_shape(shape: &Shape, pose: Pose, color: mq::Color) {
    if let Some(radius) = shape.radius() {
        mq::draw_circle(pose.center.x as f32, pose.center.y as f32, radius, color);
    }
    let corner = |&vertex: &Vec2| {
        let place = pose.to_world(vertex);
        mq::vec2(place.x as f32, place.y as f32)
    };
    let corners: Vec<mq::Vec2> = shape.vertices().iter().map(corner).collect();
    for pair in corners.get(1..).unwrap_or(&[]).windows(2) {
        mq::draw_triangle(corners[0], pair[0], pair[1], color);
    }
}
