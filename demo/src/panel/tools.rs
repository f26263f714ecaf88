//! What the mouse does and makes.

use crate::command::Command;
use crate::knob::Knob;
use crate::panel::Shown;
use crate::theme;
use crate::tool::Tool;
use crate::ui::{Ui, WORDS};

pub(super) fn draw(ui: &mut Ui<'_>, shown: Shown<'_>, commands: &mut Vec<Command>) {
    let mould = shown.mould;
    ui.heading("LEFT MOUSE BUTTON");
    for pair in Tool::ROWS {
        let labels = pair.map(|tool| format!("{}  {}", tool.digit(), tool.name()));
        let labels = [0, 1].map(|index| (labels[index].as_str(), pair[index] == mould.tool));
        commands.extend(ui.buttons(&labels).map(|index| Command::Tool(pair[index])));
    }
    ui.paragraph(hint(mould.tool), WORDS);
    ui.heading("WHAT IS MADE");
    let mut step = |by: i32, command: fn(i32) -> Command| {
        if by != 0 {
            commands.push(command(by));
        }
    };
    step(ui.stepper("size", &format!("{} m", mould.size())), Command::Size);
    step(ui.stepper("corners", &mould.corners().to_string()), Command::Corners);
    step(ui.stepper("material", mould.material().1), Command::Material);
    step(ui.stepper("number", &mould.count().to_string()), Command::Count);
    if ui.tick_box("fixed", mould.is_fixed, "Y") {
        commands.push(Command::Kind);
    }
    ui.swatches(theme::MATERIALS.map(|(_, name, tone)| (name, tone)));
    ui.heading("WORLD");
    match ui.stepper("gravity", &Knob::ForceY.text(&shown.run().world)) {
        0 => {}
        by => commands.push(Command::Turn(Knob::ForceY, by)),
    }
    ui.explain(Knob::ForceY.meaning());
    ui.heading("EDITS");
    let undo = match shown.undo_to {
        Some(seconds) => format!("undo {}, to {seconds:.1} s", shown.edits),
        None => "undo".to_owned(),
    };
    let pressed = ui.buttons(&[(&undo, false), ("rewind", false)]);
    commands.extend(pressed.map(|index| [Command::Undo, Command::Rewind][index]));
    ui.heading("CAMERA");
    let pressed = ui.buttons(&[("follow", shown.is_following), ("whole scene", false)]);
    commands.extend(pressed.map(|index| [Command::Follow, Command::WholeScene][index]));
    let pressed = ui.buttons(&[("zoom in", false), ("zoom out", false)]);
    commands.extend(pressed.map(|index| [Command::Zoom(1), Command::Zoom(-1)][index]));
    if ui.buttons(&[("all keys   H", false)]).is_some() {
        commands.push(Command::Help);
    }
}

/// What a tool does, in a sentence.
fn hint(tool: Tool) -> &'static str {
    match tool {
        Tool::Hand => "Pull a body by a spring and throw it; drag the ground to move the picture.",
        Tool::Circle | Tool::Obb | Tool::Polygon => "Click to make it; pull before letting go to throw it.",
        Tool::Aabb => "Click to make a box that never turns; pull before letting go to throw it.",
        Tool::Global => {
            "Click to put an attractor; at its ring it pulls as strongly as gravity on the Earth. Drag moves it."
        }
        Tool::Local => "Click to put an attractor that pulls within its ring only.",
        Tool::Eraser => "Click a body or an attractor to remove it.",
    }
}
