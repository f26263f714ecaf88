//! The command line.

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, ValueEnum};
use rustycs::report::Measure;
use rustycs_scenes::Scene;

/// Runs a scene over a range of settings, measures how wrong and how slow each is, and names the cheapest that
/// is good enough.
#[derive(Debug, Parser)]
#[command(name = "error_report", version)]
pub(crate) struct Cli {
    /// The scene to run.
    #[arg(long, value_name = "NAME", default_value = "tower", value_parser = scene_parser())]
    pub(crate) scene: &'static Scene,

    /// Names the scenes and what to look for in each.
    #[arg(long)]
    pub(crate) list: bool,

    /// How wrong the result may be: a length (1mm, 0.5cm), a speed (2mm/s), per cent (0.1%) or a number in the
    /// unit of the measure (1e-3).
    #[arg(long, value_name = "ERROR", default_value = "1mm", value_parser = tolerance)]
    pub(crate) tolerance: Tolerance,

    /// How long the scene runs, s.
    #[arg(long, value_name = "SECONDS", default_value_t = 2.0)]
    pub(crate) duration: f64,

    /// What is measured.
    #[arg(long, value_enum, default_value_t = What::Trajectory)]
    pub(crate) measure: What,

    /// Seeds to run scenes with chance with; the worst counts.
    #[arg(long, value_name = "N,N,...", value_delimiter = ',', default_value = "1")]
    pub(crate) seeds: Vec<u64>,

    /// Runs fewer settings, each timed once.
    #[arg(long)]
    pub(crate) quick: bool,

    /// Writes SCENE.csv, SCENE.md and SCENE.svg there.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum What {
    /// How far bodies are from where much finer settings put them, m.
    Trajectory,
    /// Change of the energy, as a part of the largest kinetic energy.
    Energy,
    /// Energy that comes from nowhere, as a part of the largest kinetic energy.
    EnergyGain,
    /// Change of the momentum, as a part of it.
    Momentum,
    /// Change of the angular momentum, as a part of it.
    AngularMomentum,
    /// Deepest overlap, m.
    Penetration,
    /// Speed with which touching points still approach each other, m/s.
    Residual,
}

impl What {
    pub(crate) fn measure(self) -> Measure<'static> {
        match self {
            Self::Trajectory => Measure::Trajectory,
            Self::Energy => Measure::EnergyDrift,
            Self::EnergyGain => Measure::EnergyGain,
            Self::Momentum => Measure::MomentumDrift,
            Self::AngularMomentum => Measure::AngularMomentumDrift,
            Self::Penetration => Measure::Penetration,
            Self::Residual => Measure::Residual,
        }
    }
}

/// How wrong a result may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tolerance {
    /// In SI units.
    pub(crate) value: f64,
    /// `m`, `m/s`, `` for a part of a whole; `None` where nothing was said.
    pub(crate) unit: Option<&'static str>,
}

/// A number with or without a unit.
fn tolerance(text: &str) -> Result<Tolerance, String> {
    const UNITS: [(&str, f64, &str); 9] = [
        ("mm/s", 1e-3, "m/s"),
        ("cm/s", 1e-2, "m/s"),
        ("m/s", 1.0, "m/s"),
        ("nm", 1e-9, "m"),
        ("um", 1e-6, "m"),
        ("µm", 1e-6, "m"),
        ("mm", 1e-3, "m"),
        ("cm", 1e-2, "m"),
        ("%", 1e-2, ""),
    ];
    let with_unit =
        UNITS.iter().find_map(|&(name, scale, unit)| Some((text.strip_suffix(name)?, scale, Some(unit))));
    let in_metres = || Some((text.strip_suffix('m')?, 1.0, Some("m")));
    let (number, scale, unit) = with_unit.or_else(in_metres).unwrap_or((text, 1.0, None));
    match number.trim().parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(Tolerance { value: number * scale, unit }),
        _ => {
            Err("give a positive number with or without a unit, for example 1mm, 0.5cm, 0.1% or 1e-3".into())
        }
    }
}

/// One of the scenes by its name; clap lists the right names when it is none of them.
fn scene_parser() -> impl TypedValueParser<Value = &'static Scene> {
    PossibleValuesParser::new(rustycs_scenes::all().iter().map(|scene| scene.name))
        .map(|name| rustycs_scenes::find(&name).expect("only names of scenes are possible"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn tolerances_have_units() {
        for (text, value, unit) in [
            ("1mm", 1e-3, Some("m")),
            ("0.5 cm", 5e-3, Some("m")),
            ("2m", 2.0, Some("m")),
            ("3µm", 3e-6, Some("m")),
            ("0.1%", 1e-3, Some("")),
            ("2mm/s", 2e-3, Some("m/s")),
            ("1e-3", 1e-3, None),
        ] {
            let Tolerance { value: found, unit: found_unit } = tolerance(text).unwrap();
            assert!((found / value - 1.0).abs() < 1e-12 && found_unit == unit, "{text}");
        }
        for text in ["", "mm", "-1mm", "0", "nan", "inf", "1 parsec"] {
            assert!(tolerance(text).is_err(), "{text}");
        }
    }
}
