//! How the run goes.

use crate::panel::Shown;
use crate::quantity::{milliseconds, with_unit};
use crate::theme;
use crate::ui::{FIGURE, Ui};

pub(super) fn draw(ui: &mut Ui<'_>, shown: Shown<'_>) {
    let run = shown.run();
    let world = &run.world;
    let counters = world.profile().counters();
    let touching = world.contacts().filter(rustycs::ContactRef::is_touching).count();
    // One world says it in the picture.
    let readout = shown.scene.readout(world).filter(|_| shown.runs.len() > 1);
    if let Some(readout) = readout {
        ui.paragraph(&readout, FIGURE.toned(theme::ACCENT));
        ui.gap(4.0);
    }
    ui.figure("time", &format!("{:.2} s", run.seconds), FIGURE);
    ui.figure("bodies", &world.body_count().to_string(), FIGURE);
    let awake = world.awake_count();
    let style = if awake == 0 { FIGURE.toned(theme::FAINT) } else { FIGURE };
    ui.figure("awake", &awake.to_string(), style);
    ui.figure("contacts", &touching.to_string(), FIGURE);
    ui.figure("impacts", &counters.impacts.to_string(), FIGURE);
    ui.explain("Collisions within the last tick that were resolved in order of time.");
    ui.figure("substeps", &counters.substeps.to_string(), FIGURE);
    ui.heading("STEP");
    let gauges = &run.gauges;
    ui.plot("total", &milliseconds(gauges.step), &gauges.steps, theme::ACCENT, true);
    let stages = || world.profile().stages().zip(gauges.stages);
    let ran = stages().filter(|((_, report), _)| report.ran);
    let longest = ran.map(|(_, seconds)| seconds).fold(1e-9, f64::max);
    for ((stage, report), seconds) in stages() {
        let share = if report.ran { (seconds / longest) as f32 } else { 0.0 };
        let figure = if report.ran { format!("{:.3}", seconds * 1e3) } else { "–".to_owned() };
        ui.bar(stage.name(), share, &figure, !report.ran);
    }
    ui.heading("STATE");
    let error = world.error();
    let depth = with_unit(f64::from(error.penetration), "m");
    ui.plot("penetration", &depth, &gauges.penetration, theme::DEEP, true);
    ui.explain("The deepest overlap of two bodies.");
    ui.plot("energy", &with_unit(world.energy(), "J"), &gauges.energy, theme::VELOCITY, false);
    ui.figure("kinetic", &with_unit(world.kinetic_energy(), "J"), FIGURE);
    ui.figure("residual", &with_unit(f64::from(error.velocity_residual), "m/s"), FIGURE);
    ui.explain("The greatest speed at which bodies in contact still approach each other.");
    ui.heading("PICTURE");
    ui.figure("CPU to draw", &milliseconds(shown.draw_time), FIGURE);
    ui.explain("Time of the processor to prepare a frame, without the graphics card.");
    ui.figure("rewind", &format!("{:.2} s", run.history.reach(run.seconds)), FIGURE);
}
