//! Settings, forces, and which of two copies they are for.

use crate::command::Command;
use crate::knob::Knob;
use crate::panel::Shown;
use crate::ui::Ui;

pub(super) fn draw(ui: &mut Ui<'_>, shown: Shown<'_>, commands: &mut Vec<Command>) {
    if ui.tick_box("Two copies side by side", shown.runs.len() > 1, "X") {
        commands.push(Command::Compare);
    }
    if shown.runs.len() > 1 {
        let pressed = ui.buttons(&[("of A", shown.copy == 0), ("of B", shown.copy == 1)]);
        if pressed.is_some_and(|copy| copy != shown.copy) {
            commands.push(Command::OtherCopy);
        }
    }
    let world = &shown.run().world;
    for knob in Knob::ALL {
        match knob {
            Knob::Scheme => ui.heading("SOLVER"),
            Knob::Sleep => ui.heading("RULES"),
            Knob::FrictionMix => ui.heading("TWO MATERIALS MEET"),
            Knob::Gravity => ui.heading("FORCES"),
            _ => {}
        }
        if knob.is_switch() {
            if ui.tick_box(knob.name(), knob.is_on(world), "") {
                commands.push(Command::Turn(knob, 1));
            }
            ui.explain(knob.meaning());
            continue;
        }
        match ui.stepper(knob.name(), &knob.text(world)) {
            0 => {}
            by => commands.push(Command::Turn(knob, by)),
        }
        ui.explain(knob.meaning());
    }
    ui.heading("FORCES OF THE SCENE");
    for (_, force) in world.forces() {
        let pull = force.acceleration();
        let figure = format!("{:.1}, {:.1}", pull.x, pull.y);
        ui.figure(force.name(), &figure, crate::ui::FIGURE);
    }
}
