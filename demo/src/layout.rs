//! Where the scene and the panel are in the window.

use macroquad::math::Rect;
use macroquad::window::{screen_height, screen_width};

/// Widths of a panel beside the scene, px: at least, at most, and as a share of the window.
const WIDTHS: [f32; 2] = [244.0, 288.0];
const WIDTH_SHARE: f32 = 0.22;
/// A window narrower than this that is higher than wide has its panel below the scene, px: a phone held upright.
const NARROW: f32 = 600.0;
/// Height of a folded panel below the scene, px: title, buttons and pages to choose from.
pub(crate) const STRIP: f32 = 142.0;
/// Share of the window that an unfolded panel below the scene takes.
const HEIGHT_SHARE: f32 = 0.48;
/// Side of what is left of a folded panel beside the scene, px: the button that unfolds it.
const CORNER: f32 = 44.0;

/// Where the scene and the panel are in the window, px.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) scene: Rect,
    pub(crate) panel: Rect,
    /// Whether the panel is below the scene.
    pub(crate) is_upright: bool,
    pub(crate) is_folded: bool,
}

impl Layout {
    /// The layout of the window as it is now; without a choice a panel below the scene is folded, one beside it is
    /// not.
    pub(crate) fn of_window(is_folded: Option<bool>) -> Self {
        Self::of([screen_width(), screen_height()], is_folded)
    }

    fn of([width, height]: [f32; 2], is_folded: Option<bool>) -> Self {
        let is_upright = width < NARROW && height > width;
        let is_folded = is_folded.unwrap_or(is_upright);
        let (scene, panel) = match (is_upright, is_folded) {
            (true, _) => {
                let panel = if is_folded { STRIP } else { (HEIGHT_SHARE * height).round().max(STRIP) };
                let top = height - panel;
                (Rect::new(0.0, 0.0, width, top), Rect::new(0.0, top, width, panel))
            }
            (false, true) => {
                (Rect::new(0.0, 0.0, width, height), Rect::new(width - CORNER, 0.0, CORNER, CORNER))
            }
            (false, false) => {
                let panel = (WIDTH_SHARE * width).clamp(WIDTHS[0], WIDTHS[1]).round();
                let left = width - panel;
                (Rect::new(0.0, 0.0, left, height), Rect::new(left, 0.0, panel, height))
            }
        };
        Self { scene, panel, is_upright, is_folded }
    }

    /// All of the window.
    pub(crate) fn window(&self) -> Rect {
        self.scene.combine_with(self.panel)
    }

    /// Whether a place is in the scene, and not on what lies over it.
    pub(crate) fn is_scene(&self, at: rustycs::Vec2) -> bool {
        let at = [at.x, at.y].into();
        self.scene.contains(at) && !self.panel.contains(at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn most_of_a_phone_is_the_scene() {
        let area = |rect: Rect| rect.w * rect.h;
        let upright = Layout::of([390.0, 844.0], None);
        assert!(upright.is_upright && area(upright.scene) > 0.8 * area(upright.window()));
        let desktop = Layout::of([1280.0, 720.0], None);
        assert!(!desktop.is_upright && desktop.scene.w == 998.0);
        let folded = Layout::of([1280.0, 720.0], Some(true));
        assert_eq!(folded.scene, folded.window());
        assert!(!folded.is_scene(rustycs::Vec2::new(1270.0, 10.0)));
    }
}
