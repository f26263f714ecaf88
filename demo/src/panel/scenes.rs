//! Every scene, by groups.

use rustycs_scenes::GROUPS;

use crate::command::Command;
use crate::panel::Shown;
use crate::ui::{Ui, WORDS};

pub(super) fn draw(ui: &mut Ui<'_>, shown: Shown<'_>, commands: &mut Vec<Command>) {
    if !shown.is_tall {
        ui.paragraph(shown.scene.summary, WORDS);
    }
    for group in GROUPS {
        ui.heading(&group.to_uppercase());
        for (index, scene) in rustycs_scenes::all().iter().enumerate() {
            let is_chosen = scene.name == shown.scene.name;
            if scene.group == group && ui.list_row(&scene.name.replace('_', " "), is_chosen) {
                commands.push(Command::Scene(index));
            }
        }
    }
}
