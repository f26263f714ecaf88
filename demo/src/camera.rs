//! From metres of the world (y upward) to pixels of the window (y downward), and back.

use macroquad::math::Rect;
use rustycs::{Aabb, Point, Vec2};
use rustycs_scenes::View;

/// Scales of the picture, px/m: a kilometre or a centimetre fills the window.
const SCALES: [f32; 2] = [0.5, 50_000.0];
/// Room around a view that fits, as a share of the area.
const MARGIN: f32 = 0.02;

/// Which part of the world is shown where.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    /// The part of the window that shows the world, px.
    area: Rect,
    /// What is in the middle of it, m, in `f64` as places are: the difference to a body is then exact.
    center: Point,
    /// px/m.
    scale: f32,
    /// What to show while nobody has moved the camera.
    view: Option<View>,
}

impl Camera {
    /// A camera that shows all of `view`.
    pub(crate) fn new(view: View, area: Rect) -> Self {
        let mut camera = Self { area, center: Point::ORIGIN, scale: 1.0, view: None };
        camera.show(view);
        camera
    }

    /// Shows all of `view`, also when the area changes, until somebody moves the camera.
    pub(crate) fn show(&mut self, view: View) {
        self.view = Some(view);
        self.center = view.center.into();
        let fit = (self.area.w / view.width).min(self.area.h / view.height);
        self.scale = (fit * (1.0 - MARGIN)).clamp(SCALES[0], SCALES[1]);
    }

    /// The part of the window that shows the world, px.
    pub(crate) fn area(self) -> Rect {
        self.area
    }

    /// Moves to another part of the window.
    pub(crate) fn set_area(&mut self, area: Rect) {
        if area != self.area {
            self.area = area;
            if let Some(view) = self.view {
                self.show(view);
            }
        }
    }

    /// Whether somebody has moved the camera away from what it was told to show.
    pub(crate) fn is_moved(self) -> bool {
        self.view.is_none()
    }

    /// Pixels per metre.
    pub(crate) fn scale(self) -> f32 {
        self.scale
    }

    /// Where a place of the world is in the window, px.
    pub(crate) fn to_screen(self, place: Point) -> Vec2 {
        let offset = (place - self.center) * self.scale;
        self.middle() + Vec2::new(offset.x, -offset.y)
    }

    /// Which place of the world is at a pixel of the window.
    pub(crate) fn to_world(self, pixel: Vec2) -> Point {
        let offset = (pixel - self.middle()) / self.scale;
        self.center + Vec2::new(offset.x, -offset.y)
    }

    /// Zooms by a factor; what is at `pixel` stays there.
    pub(crate) fn zoom_at(&mut self, pixel: Vec2, factor: f32) {
        let before = self.to_world(pixel);
        self.scale = (self.scale * factor).clamp(SCALES[0], SCALES[1]);
        self.center += before - self.to_world(pixel);
        self.view = None;
    }

    /// Moves the picture by so many pixels.
    pub(crate) fn pan(&mut self, pixels: Vec2) {
        self.center += Vec2::new(-pixels.x, pixels.y) / self.scale;
        self.view = None;
    }

    /// Puts a place of the world in the middle of the picture.
    pub(crate) fn look_at(&mut self, place: Point) {
        self.center = place;
        self.view = None;
    }

    /// The same camera for another part of the window: for a second world beside the first.
    pub(crate) fn in_area(mut self, area: Rect) -> Self {
        self.area = area;
        self
    }

    /// The corners of a box, px: the upper left one and the lower right one.
    pub(crate) fn corners(self, aabb: Aabb) -> (Vec2, Vec2) {
        let (low, high) = (self.to_screen(aabb.min.into()), self.to_screen(aabb.max.into()));
        (Vec2::new(low.x, high.y), Vec2::new(high.x, low.y))
    }

    /// Whether a part of a box is in the picture.
    pub(crate) fn sees(self, aabb: Aabb) -> bool {
        let (min, max) = self.corners(aabb);
        let Rect { x, y, w, h } = self.area;
        min.x <= x + w && max.x >= x && min.y <= y + h && max.y >= y
    }

    fn middle(self) -> Vec2 {
        Vec2::new(self.area.x + 0.5 * self.area.w, self.area.y + 0.5 * self.area.h)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        let view = View { center: Vec2::new(3.0, 2.0), width: 20.0, height: 10.0 };
        Camera::new(view, Rect::new(0.0, 0.0, 1000.0, 700.0))
    }

    #[test]
    fn a_view_fits_with_its_middle_in_the_middle() {
        let camera = camera();
        assert_eq!(camera.to_screen(Point::new(3.0, 2.0)), Vec2::new(500.0, 350.0));
        // Up in the world is up in the window.
        assert!(camera.to_screen(Point::new(3.0, 7.0)).y > 0.0);
        assert!(camera.to_screen(Point::new(13.0, 2.0)).x < 1000.0);
    }

    #[test]
    fn what_is_under_the_mouse_stays_there() {
        let mut camera = camera();
        let mouse = Vec2::new(123.0, 456.0);
        let before = camera.to_world(mouse);
        camera.zoom_at(mouse, 3.0);
        // A pixel is 7 mm here; f32 rounds the offset of 500 px to 3e-5 px.
        assert!((camera.to_world(mouse) - before).length() < 1e-5);
        camera.pan(Vec2::new(10.0, -20.0));
        assert!((camera.to_screen(before) - (mouse + Vec2::new(10.0, -20.0))).length() < 1e-2);
    }
}
