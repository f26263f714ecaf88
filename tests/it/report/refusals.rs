//! What a study refuses, and how it is stopped.

use std::ops::ControlFlow;

use rustycs::prelude::*;
use rustycs::report::{Exact, Measure, Study, StudyError};

use crate::report::{sliding, thrown};
use crate::support::add;

/// Runs a study that must be refused, and checks that it says why.
#[track_caller]
fn refused(study: Study<'_>, words: &str) -> StudyError {
    let error = study.run().expect_err("the study must be refused");
    let sentence = error.to_string();
    assert!(sentence.contains(words), "{sentence}");
    error
}

#[test]
fn what_cannot_be_run_is_refused_with_a_sentence() {
    for duration in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(Study::new(thrown).duration(duration), "give a positive number of seconds");
    }
    refused(Study::new(thrown).tick_rates([]), "tick rates");
    refused(Study::new(thrown).substeps([]), "substeps");
    refused(Study::new(thrown).iterations([]), "iterations");
    refused(Study::new(thrown).adaptive([]), "adaptive");
    refused(Study::new(thrown).also("nothing", []), "with a name");
    refused(Study::with_seeds([], |_, settings| thrown(settings)), "seeds");
    refused(Study::new(thrown).samples(0), "samples");
    refused(Study::new(thrown).repeats(0), "repeats");
    refused(Study::new(thrown).reference_finer(0), "finer");
    refused(Study::new(thrown).tick_rates([60.0, f32::NAN]), "tick_rate");
    refused(Study::new(thrown).tick_rates([900_000.0]).duration(1e-5), "the reference");
    refused(Study::new(World::new), "without bodies");
    refused(Study::new(|_| thrown(Settings::default())).tick_rates([30.0]), "hand on the settings");
}

#[test]
fn what_does_not_fit_together_is_refused_with_a_sentence() {
    let still = |settings| {
        let mut world = World::new(settings);
        add(&mut world, Body::fixed(Shape::circle(1.0)));
        world
    };
    assert_eq!(refused(Study::new(still), "no trajectory"), StudyError::NothingMoves);
    let two = |_| vec![Exact::at([0.0, 0.0]), Exact::at([1.0, 0.0])];
    assert_eq!(
        refused(Study::new(thrown).exact(two), "2 bodies, and 1 move"),
        StudyError::ExactCount { given: 2, moving: 1 }
    );
    refused(Study::new(thrown).exact_value(|_| 0.0), "Study::exact");
    refused(Study::new(thrown).exact(two).measure(Measure::quantity("x", "m", |_| 0.0)), "exact_value");
    refused(Study::new(thrown).exact(two).measure(Measure::Penetration), "should be 0");
    let more_when_coarse = |settings: Settings| {
        let is_coarse = settings.tick_rate < 100.0;
        let mut world = thrown(settings);
        if is_coarse {
            add(&mut world, Body::dynamic(Shape::circle(0.1)).at([9.0, 0.0]));
        }
        world
    };
    refused(Study::new(more_when_coarse).tick_rates([60.0]), "the bodies are not those");
}

/// Stopped after its first row, a study keeps that; stopped before, it has nothing to say.
#[test]
fn a_study_that_is_stopped_keeps_what_is_done() {
    let mut labels: Vec<String> = Vec::new();
    let report = Study::new(sliding)
        .tick_rates([30.0, 60.0, 120.0])
        .substeps([2])
        .progress(|progress| {
            labels.push(progress.label.into());
            if progress.label == "120 Hz × 2" { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .run()
        .unwrap();
    assert_eq!(report.rows().len(), 2);
    assert!(!report.is_complete() && report.to_markdown().contains("stopped"));
    labels.dedup();
    assert!(labels.contains(&"60 Hz × 2".into()) && labels[0].contains("reference"), "{labels:?}");
    let stopped = Study::new(sliding).progress(|_| ControlFlow::Break(())).run();
    assert_eq!(stopped.unwrap_err(), StudyError::Interrupted);
}

/// Progress goes from 0 to 1 and never back.
#[test]
fn progress_is_monotonic_and_ends_at_one() {
    let mut last = 0.0;
    Study::new(sliding)
        .tick_rates([30.0, 60.0])
        .also("classic", [Settings::classic()])
        .progress(|progress| {
            assert!(progress.done >= last, "{} after {last}", progress.done);
            last = progress.done;
            ControlFlow::Continue(())
        })
        .run()
        .unwrap();
    assert_eq!(last, 1.0);
}
