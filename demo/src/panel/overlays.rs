//! What is drawn over the scene.

use crate::command::Command;
use crate::overlay::Overlay;
use crate::panel::Shown;
use crate::ui::Ui;

pub(super) fn draw(ui: &mut Ui<'_>, shown: Shown<'_>, commands: &mut Vec<Command>) {
    ui.heading("OVERLAYS");
    for overlay in Overlay::ALL {
        let (_, letter) = overlay.key();
        if ui.tick_box(overlay.meaning(), shown.overlays.has(overlay), letter) {
            commands.push(Command::Toggle(overlay));
        }
    }
    ui.heading("TWO COPIES");
    if ui.tick_box("Side by side", shown.runs.len() > 1, "X") {
        commands.push(Command::Compare);
    }
}
