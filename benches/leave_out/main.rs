//! What a scene does not need costs nothing: each optional thing absent, set out, and in use, on the same scene.
//!
//! ```text
//! cargo bench --bench leave_out                 times
//! cargo bench --bench leave_out -- --count      instructions, by callgrind: these decide, as they are repeatable
//! cargo bench --bench leave_out -- --quick      a first look
//! ```
//!
//! "Set out" is there but has nothing to do: switched on where nobody asks for it, or added and empty. It may cost
//! 1 % more than "absent". The second table shows what kernels gain that leave out what no contact has; the others
//! what more lanes do. Variants take turns in one process, and of each part of a run the least counts, since other
//! work on the machine only ever adds time.

mod count;
mod scenes;
mod time;

use std::process::ExitCode;

use scenes::{Build, FEW_LANES, KERNELS, LANES, ROWS};

/// What "set out" may cost, as a part of "absent".
const LIMIT: f64 = 1.01;
/// What the kernel without friction and second points is to gain on the general one.
const GAIN: f64 = 1.5;
/// Sweeps more, to tell what one of them costs.
const MORE_SWEEPS: u32 = 20;

/// Steps before those that are measured: bodies have met, and what is to sleep sleeps.
const WARM_UP: usize = 60;

/// What a step of each world takes, in s or in instructions.
type Measure = Box<dyn Fn(&[Variant]) -> Vec<f64>>;

/// How a world's step is measured: by time, s, or by count of instructions.
struct Meter {
    unit: &'static str,
    /// What a figure is divided by before it is printed.
    scale: f64,
    measure: Measure,
}

/// A world to be measured: the name by which another process finds it, and the world.
struct Variant {
    name: String,
    build: Build,
    /// Sweeps before the bodies move.
    iterations: u32,
}

impl Variant {
    fn world(&self) -> rustycs::World {
        let mut world = (self.build)();
        let iterations = self.iterations;
        let settings = rustycs::Settings { iterations, ..world.settings().clone() };
        world.set_settings(settings).expect("settings that a world takes");
        world
    }
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    let has = |name: &str| arguments.iter().any(|argument| argument == name);
    if let Some(place) = arguments.iter().position(|argument| argument == count::ONE) {
        count::run_one(&arguments[place + 1]);
        return ExitCode::SUCCESS;
    }
    let is_quick = has("--quick");
    if !has("--count") {
        println!("Times vary by more than 1 % on a machine that does other work; -- --count decides.");
        let measure = Box::new(move |variants: &[Variant]| time::measure(variants, is_quick));
        print_all(&Meter { unit: "µs", scale: 1e-6, measure });
        return ExitCode::SUCCESS;
    }
    if !count::has_valgrind() {
        println!(
            "Instructions are counted by valgrind, which is not here: install it, or leave out --count."
        );
        return ExitCode::SUCCESS;
    }
    let measure = Box::new(count::measure);
    let is_within = print_all(&Meter { unit: "k instr.", scale: 1e3, measure });
    if is_within { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Prints the tables. Whether nothing that is set out costs more than it may.
fn print_all(meter: &Meter) -> bool {
    let too_dear = print_things(meter);
    print_kernels(meter);
    print_lanes("lanes", LANES, meter);
    print_lanes("lanes of a small world", FEW_LANES, meter);
    if too_dear.is_empty() {
        println!("\nNothing that is set out costs more than {LIMIT} of its absence.");
    } else {
        println!("\nOver {LIMIT} when set out: {}.", too_dear.join(", "));
    }
    too_dear.is_empty()
}

/// The names of all variants, by which another process finds them.
fn variants() -> Vec<Variant> {
    let of_row = |row: &scenes::Row| -> Vec<Variant> {
        let builds = [Some(row.absent), row.set_out, row.in_use];
        let names = ["absent", "set out", "in use"];
        let named = builds.into_iter().zip(names).filter_map(|(build, name)| Some((build?, name)));
        named.map(|(build, name)| plain(format!("{}: {name}", row.name), build)).collect()
    };
    let mut all: Vec<Variant> = ROWS.iter().flat_map(of_row).collect();
    all.extend(KERNELS.iter().flat_map(of_kernel));
    all.extend(LANES.iter().chain(FEW_LANES).map(|(name, build)| plain((*name).to_owned(), *build)));
    all
}

fn plain(name: String, build: Build) -> Variant {
    Variant { name, build, iterations: 1 }
}

/// General and fitted, with one sweep and with more.
fn of_kernel(kernel: &scenes::Kernel) -> [Variant; 4] {
    let named = |kind: &str, build, iterations| Variant {
        name: format!("{}: {kind}, {iterations}", kernel.name),
        build,
        iterations,
    };
    [
        named("general", kernel.general, 1),
        named("fitted", kernel.fitted, 1),
        named("general", kernel.general, 1 + MORE_SWEEPS),
        named("fitted", kernel.fitted, 1 + MORE_SWEEPS),
    ]
}

/// Prints what each thing costs; returns the names of those that cost too much when they are set out.
fn print_things(meter: &Meter) -> Vec<&'static str> {
    println!("\n{:24} {:>12} {:>8} {:>8}", "", format!("absent, {}", meter.unit), "set out", "in use");
    let all = variants();
    let mut too_dear = Vec::new();
    for row in ROWS {
        let is_of_row = |variant: &&Variant| {
            variant.name.strip_prefix(row.name).is_some_and(|rest| rest.starts_with(':'))
        };
        let variants: Vec<Variant> =
            all.iter().filter(is_of_row).map(|variant| plain(variant.name.clone(), variant.build)).collect();
        let measured = (meter.measure)(&variants);
        let factor = |name: &str| {
            let place = variants.iter().position(|variant| variant.name.ends_with(name));
            place.map(|place| measured[place] / measured[0])
        };
        let text = |factor: Option<f64>| factor.map_or("-".to_owned(), |factor| format!("{factor:.3}"));
        let set_out = factor("set out");
        println!(
            "{:24} {:12.1} {:>8} {:>8}   {}",
            row.name,
            measured[0] / meter.scale,
            text(set_out),
            text(factor("in use")),
            row.statement
        );
        if set_out.is_some_and(|factor| factor > LIMIT) {
            too_dear.push(row.name);
        }
    }
    too_dear
}

fn print_kernels(meter: &Meter) {
    println!(
        "\n{:36} {:>14} {:>6} {:>18} {:>6}",
        "kernels: general against fitted",
        format!("step, {}", meter.unit),
        "gain",
        format!("a sweep, {}", meter.unit),
        "gain"
    );
    for kernel in KERNELS {
        let measured = (meter.measure)(&of_kernel(kernel));
        let [general, fitted, general_more, fitted_more] =
            [0, 1, 2, 3].map(|place: usize| measured[place] / meter.scale);
        // Of all four substeps.
        let of_sweep = |more: f64, one: f64| (more - one) / f64::from(MORE_SWEEPS);
        let (general_sweep, fitted_sweep) = (of_sweep(general_more, general), of_sweep(fitted_more, fitted));
        println!(
            "{:36} {:>14} {:6.2} {:>18} {:6.2}   {}",
            kernel.name,
            format!("{general:.1} {fitted:.1}"),
            general / fitted,
            format!("{general_sweep:.2} {fitted_sweep:.2}"),
            general_sweep / fitted_sweep,
            kernel.statement
        );
    }
    println!("A sweep over a gas without friction is to gain {GAIN} or more.");
}

fn print_lanes(name: &str, widths: &[(&str, Build)], meter: &Meter) {
    let variants: Vec<Variant> =
        widths.iter().map(|(name, build)| plain((*name).to_owned(), *build)).collect();
    let measured = (meter.measure)(&variants);
    println!("\n{:24} {:>12} {:>8}", name, format!("step, {}", meter.unit), "gain");
    for (variant, figure) in variants.iter().zip(&measured) {
        println!("{:24} {:12.1} {:8.2}", variant.name, figure / meter.scale, measured[0] / figure);
    }
}
