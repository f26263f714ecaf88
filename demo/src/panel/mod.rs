//! The panel beside the scene: what always shows at its top, and one of five pages below.
//!
//! | page | what is on it |
//! |---|---|
//! | `figures` | how the run goes: counts, stages, curves |
//! | `scenes` | every scene, by groups |
//! | `tools` | what the mouse does and makes |
//! | `overlays` | what is drawn over the scene |
//! | `knobs` | settings, forces, two copies side by side |

mod figures;
mod knobs;
mod overlays;
mod scenes;
mod tools;

use macroquad::math::Rect;
use rustycs::Vec2;
use rustycs_scenes::Scene;

use crate::canvas::{Canvas, Face, Style};
use crate::command::Command;
use crate::icon::Icon;
use crate::overlay::Overlays;
use crate::run::Run;
use crate::theme;
use crate::tool::Mould;
use crate::ui::{FINGER, Focus, Nudge, PRESS, Place, Pointer, Ui, WORDS};

const TITLE: Style = Style::new(Face::Strong, 20, theme::TEXT);

/// Space between the border of the panel and what is on it, px.
const PADDING: f32 = 14.0;
/// Side of the button that hides the panel, px.
const FOLD: f32 = 24.0;
/// Share of its speed that a page keeps from frame to frame after a finger has let go of it.
const FRICTION: f32 = 0.94;
/// How far a notch of the wheel moves a page, px.
const NOTCH: f32 = 44.0;
/// In a window lower than this there is no room for the scene's sentence at the top, px.
pub(crate) const TALL: f32 = 660.0;

/// A page of the panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tab {
    #[default]
    Run,
    Scenes,
    Tools,
    View,
    Solver,
}

impl Tab {
    pub(crate) const ALL: [Self; 5] = [Self::Run, Self::Scenes, Self::Tools, Self::View, Self::Solver];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Run => "Run",
            Self::Scenes => "Scenes",
            Self::Tools => "Tools",
            Self::View => "View",
            Self::Solver => "Solver",
        }
    }

    pub(crate) fn next(self) -> Self {
        Self::ALL[(self as usize + 1) % Self::ALL.len()]
    }
}

/// What the panel shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown<'a> {
    pub(crate) scene: &'static Scene,
    pub(crate) seed: u64,
    /// One or two copies.
    pub(crate) runs: &'a [Run],
    /// The copy whose settings and figures are shown.
    pub(crate) copy: usize,
    pub(crate) is_paused: bool,
    /// Simulated seconds per second.
    pub(crate) speed: f64,
    pub(crate) overlays: Overlays,
    pub(crate) mould: Mould,
    pub(crate) is_following: bool,
    pub(crate) edits: usize,
    /// The time to which undoing the last edit goes back, s.
    pub(crate) undo_to: Option<f64>,
    /// CPU time to draw a frame, s.
    pub(crate) draw_time: f64,
    /// Whether there is room for the scene's sentence at the top.
    pub(crate) is_tall: bool,
    /// Whether the panel is below the scene.
    pub(crate) is_upright: bool,
    pub(crate) is_folded: bool,
    /// Whether the world falls behind the clock.
    pub(crate) is_slowed: bool,
}

impl Shown<'_> {
    fn run(&self) -> &Run {
        &self.runs[self.copy]
    }
}

/// The panel beside the scene.
#[derive(Debug, Default)]
pub(crate) struct Panel {
    pub(crate) tab: Tab,
    /// How far each page is moved up, px.
    scrolls: [f32; Tab::ALL.len()],
    focus: Focus,
    /// How many things there are above the page.
    above_page: usize,
    /// How far the page still moves in a frame after a finger has let go of it, px.
    fling: f32,
}

impl Panel {
    /// A panel that shows a page.
    pub(crate) fn new(tab: Tab) -> Self {
        Self { tab, ..Self::default() }
    }

    /// How far the page is moved up, px.
    pub(crate) fn scroll(&self) -> f32 {
        self.scrolls[self.tab as usize]
    }

    /// Chooses a thing by keys: so many further on.
    pub(crate) fn move_focus(&mut self, by: i32) {
        let count = self.focus.count.max(1) as i32;
        let next = match self.focus.index {
            None if self.above_page < self.focus.count => self.above_page as i32,
            None => 0,
            Some(index) => (index as i32 + by).rem_euclid(count),
        };
        self.focus.index = Some(next as usize);
    }

    /// Chooses nothing; whether something was chosen.
    pub(crate) fn lose_focus(&mut self) -> bool {
        self.focus.index.take().is_some()
    }

    /// Does something to what is chosen; whether something is.
    pub(crate) fn nudge(&mut self, nudge: Nudge) -> bool {
        self.focus.nudge = self.focus.index.map(|_| nudge);
        self.focus.index.is_some()
    }

    /// Draws the panel, and tells what was pressed in it.
    pub(crate) fn draw(
        &mut self,
        canvas: &mut Canvas,
        area: Rect,
        pointer: Pointer,
        shown: Shown<'_>,
    ) -> Vec<Command> {
        let (min, max) = (Vec2::new(area.x, area.y), Vec2::new(area.x + area.w, area.y + area.h));
        canvas.batch().rectangle(min, max, theme::PANEL.rgba(255));
        let edge =
            if shown.is_upright { Vec2::new(max.x, min.y + 1.0) } else { Vec2::new(min.x + 1.0, max.y) };
        canvas.batch().rectangle(min, edge, theme::BORDER.rgba(255));
        self.focus.count = 0;
        self.focus.hidden = 0.0;
        let mut commands = Vec::new();
        let mut ui = Ui {
            canvas,
            left: min.x + PADDING,
            right: max.x - PADDING,
            y: min.y + 10.0,
            sight: [min.y, max.y],
            pointer,
            focus: &mut self.focus,
            press: if shown.is_upright || pointer.is_touch { FINGER } else { PRESS },
            last: None,
            tip: None,
        };
        draw_fold(&mut ui, area, shown, &mut commands);
        if shown.is_folded && !shown.is_upright {
            self.focus.nudge = None;
            return commands;
        }
        draw_top(&mut ui, shown, self.tab, &mut commands);
        self.above_page = ui.focus.count;
        let scroll = &mut self.scrolls[self.tab as usize];
        let top = ui.y;
        ui.sight = [top, max.y - 8.0];
        ui.y = top - *scroll;
        if !shown.is_folded {
            draw_page(&mut ui, self.tab, shown, &mut commands);
            let height = ui.y + *scroll - top;
            let room = ui.sight[1] - top;
            let is_over = area.contains([pointer.at.x, pointer.at.y].into());
            let notches = if is_over { pointer.wheel } else { 0.0 };
            self.fling = pointer.drag.map_or(FRICTION * self.fling, |drag| -drag);
            *scroll += self.fling + ui.focus.hidden - NOTCH * notches;
            *scroll = scroll.min(height - room).max(0.0);
            let tip = ui.tip.filter(|_| !pointer.is_touch);
            draw_scroll_bar(canvas, [top, top + room], *scroll, height, max.x);
            if let Some((place, text)) = tip {
                draw_tip(canvas, area, place, text);
            }
        }
        self.focus.nudge = None;
        commands
    }
}

/// What is below the pages to choose from.
fn draw_page(ui: &mut Ui<'_>, tab: Tab, shown: Shown<'_>, commands: &mut Vec<Command>) {
    if shown.is_upright && tab == Tab::Run {
        ui.paragraph(shown.scene.summary, WORDS);
        draw_pace(ui, shown, commands);
    }
    match tab {
        Tab::Run => figures::draw(ui, shown),
        Tab::Scenes => scenes::draw(ui, shown, commands),
        Tab::Tools => tools::draw(ui, shown, commands),
        Tab::View => overlays::draw(ui, shown, commands),
        Tab::Solver => knobs::draw(ui, shown, commands),
    }
}

/// The scene, whether it runs, the buttons that everybody needs, and the pages to choose from.
fn draw_top(ui: &mut Ui<'_>, shown: Shown<'_>, tab: Tab, commands: &mut Vec<Command>) {
    let (state, tone) = match (shown.is_paused, shown.is_slowed) {
        (true, _) => ("paused", theme::PAUSED),
        (false, true) => ("slowed", theme::DEEP),
        (false, false) => ("running", theme::ACCENT),
    };
    let base = ui.y + 20.0;
    let end = ui.right - FOLD - 6.0;
    ui.canvas.text_up_to(state, Vec2::new(end, base), WORDS.toned(tone));
    let room = end - ui.left - ui.canvas.width_of(state, WORDS) - 10.0;
    let title = ui.canvas.fitting(&shown.scene.name.replace('_', " "), room, TITLE);
    ui.canvas.text(title, Vec2::new(ui.left, base), TITLE);
    ui.gap(32.0);
    if shown.is_tall {
        ui.paragraph(shown.scene.summary, WORDS);
        ui.gap(6.0);
    }
    let run = if shown.is_paused { Icon::Play } else { Icon::Pause };
    let icons = [Icon::Previous, Icon::Restart, Icon::Rewind, run, Icon::Tick, Icon::Next];
    let actions = [
        Command::Further(-1),
        Command::Restart,
        Command::Rewind,
        Command::Pause,
        Command::Tick,
        Command::Further(1),
    ];
    let meanings = [
        "Previous scene (P)",
        "Restart (R)",
        "Back by a quarter of a second (Backspace)",
        "Pause, go on (Space)",
        "A single tick (S)",
        "Next scene (N)",
    ];
    let icons: [_; 6] =
        core::array::from_fn(|index| (icons[index], icons[index] == run && shown.is_paused, meanings[index]));
    commands.extend(ui.icons(&icons).map(|index| actions[index]));
    if !shown.is_upright {
        draw_pace(ui, shown, commands);
        ui.gap(4.0);
    }
    let tabs = Tab::ALL.map(|other| (other.name(), other == tab));
    commands.extend(ui.buttons(&tabs).map(|index| Command::Tab(Tab::ALL[index])));
    ui.gap(2.0);
}

/// The button in the upper right corner that hides the panel, and brings it back.
fn draw_fold(ui: &mut Ui<'_>, area: Rect, shown: Shown<'_>, commands: &mut Vec<Command>) {
    let icon = match (shown.is_upright, shown.is_folded) {
        (true, true) => Icon::Up,
        (true, false) => Icon::Down,
        (false, true) => Icon::Left,
        (false, false) => Icon::Right,
    };
    let min = Vec2::new(area.right() - PADDING - FOLD, area.y + 10.0);
    if ui.small_button(Place { min, max: min + Vec2::splat(FOLD) }, icon) {
        commands.push(Command::Fold);
    }
}

/// How fast time goes, and where chance begins.
fn draw_pace(ui: &mut Ui<'_>, shown: Shown<'_>, commands: &mut Vec<Command>) {
    match ui.stepper("speed", &format!("× {}", shown.speed)) {
        0 => {}
        by => commands.push(Command::Speed(by)),
    }
    ui.explain("Simulated seconds per second (keys - and =)");
    let seed = if shown.scene.is_random { shown.seed.to_string() } else { "no chance".to_owned() };
    match ui.stepper("seed", &seed) {
        0 => {}
        by => commands.push(Command::Seed(by)),
    }
    ui.explain("Where the random numbers of the scene begin (K)");
}

/// What the thing under the mouse does, on a card beside the panel, or above it.
fn draw_tip(canvas: &mut Canvas, area: Rect, place: Place, text: &str) {
    const WIDTH: f32 = 230.0;
    const LINE: f32 = 18.0;
    let lines = canvas.lines(text, WIDTH - 20.0, WORDS);
    let widest = lines.iter().map(|line| canvas.width_of(line, WORDS)).fold(0.0, f32::max);
    let size = Vec2::new(widest + 20.0, LINE * lines.len() as f32 + 12.0);
    let min = if area.x >= size.x + 8.0 {
        Vec2::new(area.x - size.x - 8.0, place.middle().y - 0.5 * size.y)
    } else {
        Vec2::new(place.min.x, place.min.y - size.y - 6.0)
    };
    let min = Vec2::new(min.x.round(), min.y.max(8.0).round());
    canvas.begin_sheet(None);
    canvas.batch().card(min, min + size);
    for (index, line) in lines.into_iter().enumerate() {
        canvas.text(line, min + Vec2::new(10.0, 19.0 + LINE * index as f32), WORDS.toned(theme::TEXT));
    }
}

/// Where the page is within all that is on it.
fn draw_scroll_bar(canvas: &mut Canvas, sight: [f32; 2], scroll: f32, height: f32, right: f32) {
    let room = sight[1] - sight[0];
    if height <= room {
        return;
    }
    let top = sight[0] + room * scroll / height;
    let bottom = top + room * room / height;
    let (min, max) = (Vec2::new(right - 6.0, top), Vec2::new(right - 3.0, bottom));
    canvas.batch().rectangle(min, max, theme::FAINT.rgba(160));
}
