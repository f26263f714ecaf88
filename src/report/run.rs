//! Runs a study.

use core::ops::ControlFlow;

use crate::report::error::StudyError;
use crate::report::measure::{Invariant, Invariants, Measure, larger};
use crate::report::reference::{FineRuns, ROUNDING, Sensitivity, Source, ladder, nudge};
use crate::report::result::{Reference, Report, Row, RunTime};
use crate::report::study::{Progress, Study};
use crate::report::sweep::{Variant, sweeps_per_substep};
use crate::report::track::{PredictedMotion, Track, moving_count, ticks_to};
use crate::world::{Settings, World};

/// Timed runs that are together shorter than this, s, are repeated ...
const SHORT: f64 = 0.01;
/// ... up to this many times as often as asked for.
const MOST_MORE: u32 = 10;
/// Substeps of work between two calls of the progress function.
const PROGRESS_EVERY: f64 = 500.0;

/// A study while it runs.
pub(super) struct Runner<'a> {
    study: Study<'a>,
    variants: Vec<Variant>,
    /// Settings of the reference, if it is the scene itself.
    finest: Option<Settings>,
    times: Vec<f64>,
    /// Work done and to do, in substeps.
    done: f64,
    total: f64,
}

/// What the rows are compared with, for each seed.
struct Target {
    fine: Vec<FineRuns>,
    sensitivity: Option<Sensitivity>,
    /// What is compared instead of the trajectories.
    fallback: Option<Invariant>,
}

impl<'a> Runner<'a> {
    pub(super) fn new(study: Study<'a>) -> Result<Self, StudyError> {
        study.check()?;
        let variants = study.sweep.variants()?;
        let rows: Vec<Settings> = variants.iter().map(|variant| variant.settings.clone()).collect();
        let needs_reference = matches!(study.measure, Measure::Trajectory | Measure::Quantity(_));
        let finest = if needs_reference { study.source.settings(&rows) } else { None };
        for settings in finest.iter().flat_map(ladder) {
            let refused = |source| StudyError::Settings { label: "the reference".into(), source };
            settings.validate().map_err(refused)?;
        }
        let step = study.duration / f64::from(study.samples);
        let mut times: Vec<f64> = (1..study.samples).map(|sample| f64::from(sample) * step).collect();
        times.push(study.duration);
        let mut runner = Self { study, variants, finest, times, done: 0.0, total: 0.0 };
        runner.total = runner.work_to_do();
        Ok(runner)
    }

    /// Substeps of one run.
    fn work_of(&self, settings: &Settings) -> f64 {
        ticks_to(self.study.duration, settings.tick_seconds()) as f64 * f64::from(settings.substeps)
    }

    fn work_to_do(&self) -> f64 {
        let timed = if self.study.clock.is_some() { f64::from(self.study.repeats) } else { 0.0 };
        let rows: f64 = self.variants.iter().map(|row| self.work_of(&row.settings) * (1.0 + timed)).sum();
        let fine: f64 = self.finest.iter().flat_map(ladder).map(|settings| self.work_of(&settings)).sum();
        let nudged = if self.tests_chaos() { 2.0 * self.work_of(&self.finest_row().settings) } else { 0.0 };
        (rows + fine + nudged) * self.study.seeds.len() as f64
    }

    /// Whether to look if trajectories can be compared at all; who gives a closed form knows.
    fn tests_chaos(&self) -> bool {
        self.finest.is_some() && matches!(self.study.measure, Measure::Trajectory)
    }

    /// The row with the most substeps per second.
    fn finest_row(&self) -> &Variant {
        let fineness = |row: &Variant| f64::from(row.settings.tick_rate) * f64::from(row.settings.substeps);
        let mut rows = self.variants.iter();
        let first = rows.next().expect("a sweep has a row");
        rows.fold(first, |best, row| if fineness(row) > fineness(best) { row } else { best })
    }

    pub(super) fn run(mut self) -> Result<Report, StudyError> {
        let target = self.target()?;
        let mut rows = Vec::new();
        let mut is_complete = true;
        for variant in self.variants.clone() {
            match self.row(&variant, &target) {
                Ok(row) => rows.push(row),
                Err(StudyError::Interrupted) => {
                    is_complete = false;
                    break;
                }
                Err(error) => return Err(error),
            }
        }
        if rows.is_empty() {
            return Err(StudyError::Interrupted);
        }
        // All is done: too late to stop it.
        _ = self.say("done");
        let (measure, unit) = match target.fallback {
            Some(invariant) => (invariant.name().to_string(), invariant.unit().to_string()),
            None => (self.study.measure.name().to_string(), self.study.measure.unit().to_string()),
        };
        let is_exact = matches!(self.study.source, Source::Exact(_) | Source::ExactValue(_));
        let reference = match self.finest {
            _ if target.fallback.is_some() => Reference::NotNeeded,
            Some(settings) => Reference::Finer(Box::new(settings)),
            None if is_exact => Reference::ClosedForm,
            None => Reference::NotNeeded,
        };
        let sensitivity = target.sensitivity;
        Ok(Report {
            name: self.study.name,
            duration: self.study.duration,
            seeds: self.study.seeds.len(),
            measure,
            unit,
            reference,
            growth: sensitivity.map(|sensitivity| sensitivity.growth),
            is_chaotic: sensitivity.is_some_and(|sensitivity| sensitivity.is_chaotic),
            is_timed: self.study.clock.is_some(),
            is_complete,
            rows,
        })
    }

    /// Runs the reference, and looks for chaos.
    fn target(&mut self) -> Result<Target, StudyError> {
        let mut target = Target { fine: Vec::new(), sensitivity: None, fallback: None };
        for seed in self.study.seeds.clone() {
            let world = self.world(seed, &self.variants[0])?;
            if matches!(self.study.measure, Measure::Trajectory) && moving_count(&world) == 0 {
                return Err(StudyError::NothingMoves);
            }
            let Some(finest) = self.finest.clone() else { continue };
            let mut tracks = Vec::new();
            for settings in ladder(&finest) {
                let label = format!("reference at {} Hz", settings.tick_rate);
                let variant = Variant { name: None, series: String::new(), label, settings };
                let world = self.world(seed, &variant)?;
                tracks.push(self.measure(world, &variant)?);
            }
            let tracks: [Track; 3] = tracks.try_into().expect("a ladder has three steps");
            let fine = FineRuns::new(tracks, &self.study.measure);
            if self.tests_chaos() {
                let sensitivity = self.sensitivity(seed, fine.converges)?;
                target.sensitivity = Some(target.sensitivity.unwrap_or_default().max(sensitivity));
                if sensitivity.is_chaotic {
                    target.fallback = target.fallback.or(Some(fine.fallback()));
                }
            }
            target.fine.push(fine);
        }
        Ok(target)
    }

    /// Runs the finest row as it is, and with bodies displaced by a hair.
    fn sensitivity(&mut self, seed: u64, converges: bool) -> Result<Sensitivity, StudyError> {
        let row = self.finest_row();
        let label = "looking for chaos".to_string();
        // Falling asleep at other ticks would look like other motion.
        let settings = Settings { sleep: false, adaptive: false, ..row.settings.clone() };
        let variant = Variant { name: None, series: String::new(), label, settings };
        let mut tracks = Vec::new();
        for is_nudged in [false, true] {
            let mut world = self.world(seed, &variant)?;
            if is_nudged {
                nudge(&mut world);
            }
            tracks.push(self.measure(world, &variant)?);
        }
        Ok(Sensitivity::new(&tracks[0], &tracks[1], converges))
    }

    /// Measures and times one row, over all seeds.
    fn row(&mut self, variant: &Variant, target: &Target) -> Result<Row, StudyError> {
        let (mut error, mut reference_error) = (0.0, 0.0);
        let (mut invariants, mut substeps) = (Invariants::default(), 0.0);
        for (index, seed) in self.study.seeds.clone().into_iter().enumerate() {
            let world = self.world(seed, variant)?;
            let track = self.measure(world, variant)?;
            let (off, uncertain) = self.error_of(&track, variant, target, index)?;
            error = larger(error, off);
            reference_error = larger(reference_error, uncertain);
            invariants = invariants.max(track.invariants);
            substeps += track.substeps / self.study.seeds.len() as f64;
        }
        let run_time = if self.study.clock.is_some() { Some(self.time(variant)?) } else { None };
        Ok(Row {
            name: variant.name.clone(),
            series: variant.series.clone(),
            label: variant.label.clone(),
            settings: variant.settings.clone(),
            error,
            reference_error,
            run_time,
            sweeps: substeps * sweeps_per_substep(&variant.settings),
            invariants,
        })
    }

    /// The error of a run, and how wrong the reference is that it was found with.
    fn error_of(
        &self,
        track: &Track,
        variant: &Variant,
        target: &Target,
        seed_index: usize,
    ) -> Result<(f64, f64), StudyError> {
        let study = &self.study;
        if let Some(invariant) = target.fallback.or(study.measure.invariant()) {
            return Ok((invariant.of(&track.invariants), 0.0));
        }
        if study.measure.error_gauge().is_some() {
            return Ok((track.worst, 0.0));
        }
        match &study.source {
            Source::Exact(exact) => {
                let error = track.error_against_exact(&self.times, exact);
                let miscounted = |(given, moving)| StudyError::ExactCount { given, moving };
                Ok((error.map_err(miscounted)?, ROUNDING * track.reach))
            }
            Source::ExactValue(exact) => Ok((track.error_against_exact_value(&self.times, exact), 0.0)),
            Source::Finer { .. } | Source::Settings(_) => {
                let fine = &target.fine[seed_index];
                if !track.has_bodies_of(&fine.track) {
                    return Err(StudyError::DifferentBodies { label: variant.label.clone() });
                }
                Ok((track.error_against(&fine.track, &study.measure), fine.error))
            }
        }
    }

    /// A world to run, checked.
    fn world(&self, seed: u64, variant: &Variant) -> Result<World, StudyError> {
        let world = (self.study.build)(seed, variant.settings.clone());
        let (asked, found) = (&variant.settings, world.settings());
        for (field, asked, found) in [
            ("tick_rate", f64::from(asked.tick_rate), f64::from(found.tick_rate)),
            ("substeps", f64::from(asked.substeps), f64::from(found.substeps)),
            ("iterations", f64::from(asked.iterations), f64::from(found.iterations)),
        ] {
            if asked != found {
                let label = variant.label.clone();
                return Err(StudyError::SettingsIgnored { label, field, asked, found });
            }
        }
        if world.body_count() == 0 { Err(StudyError::NoBodies) } else { Ok(world) }
    }

    /// Tells the caller how far it is.
    fn say(&mut self, label: &str) -> ControlFlow<()> {
        (self.study.progress)(&Progress { done: (self.done / self.total).min(1.0), label })
    }

    /// Runs a world and keeps what is measured.
    fn measure(&mut self, world: World, variant: &Variant) -> Result<Track, StudyError> {
        let substeps = f64::from(variant.settings.substeps);
        let (before, total) = (self.done, self.total);
        let every = (PROGRESS_EVERY / substeps).max(1.0) as u64;
        let course = PredictedMotion {
            times: &self.times,
            measure: &self.study.measure,
            drive: self.study.drive.as_deref(),
        };
        let progress = &mut self.study.progress;
        let mut say = |done: f64| {
            let progress = progress(&Progress { done: (done / total).min(1.0), label: &variant.label });
            progress.is_continue()
        };
        if !say(before) {
            return Err(StudyError::Interrupted);
        }
        let track = course.run(world, |ticks| ticks % every != 0 || say(before + ticks as f64 * substeps));
        self.done = before + self.work_of(&variant.settings);
        track.ok_or(StudyError::Interrupted)
    }

    /// Times a row: all seeds one after the other, repeatedly.
    fn time(&mut self, variant: &Variant) -> Result<RunTime, StudyError> {
        let now = |runner: &Self| runner.study.clock.as_ref().map_or(0.0, |clock| clock());
        let repeats = self.study.repeats;
        let (mut all, mut spent) = (Vec::new(), 0.0);
        while all.len() < repeats as usize || (spent < SHORT && all.len() < (repeats * MOST_MORE) as usize) {
            let is_asked_for = all.len() < repeats as usize;
            let (mut seconds, mut simulated) = (0.0, 0.0);
            for seed in self.study.seeds.clone() {
                let mut world = self.world(seed, variant)?;
                let course = PredictedMotion {
                    times: &self.times,
                    measure: &self.study.measure,
                    drive: self.study.drive.as_deref(),
                };
                let ticks = course.ticks(&world);
                let start = now(self);
                for _ in 0..ticks {
                    course.step(&mut world);
                }
                seconds += now(self) - start;
                simulated += ticks as f64 * world.settings().tick_seconds();
                if is_asked_for {
                    self.done += self.work_of(&variant.settings);
                }
                if self.say(&variant.label).is_break() {
                    return Err(StudyError::Interrupted);
                }
            }
            spent += seconds;
            all.push(seconds / simulated);
        }
        all.sort_by(f64::total_cmp);
        Ok(RunTime { least: all[0], median: all[all.len() / 2], most: all[all.len() - 1], runs: all.len() })
    }
}
