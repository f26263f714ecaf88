use crate::report::plot::labels::Labels;
use crate::report::plot::{canvas, wrapped};

#[test]
fn words_keep_off_marks_each_other_and_the_edge() {
    let mut labels = Labels::new([0.0, 0.0, 200.0, 100.0]);
    labels.avoid_mark([100.0, 50.0]);
    let placed = (0..40).filter(|_| labels.beside([100.0, 50.0], "60 Hz × 4").is_some()).count();
    assert!((2..=8).contains(&placed), "{placed} words around one mark");
    assert!(labels.beside([-50.0, 50.0], "outside").is_none());
}

#[test]
fn facts_are_within_the_picture_and_keep_their_words() {
    let fact = "Measured: drift of the energy over 500 ms. Observed order of convergence: 4.88, plain 4.47, classic \
                4.37. Chaotic: trajectories cannot be compared.";
    let lines = wrapped(fact, 912.0);
    assert!(lines.len() == 2 && lines.iter().all(|line| canvas::width(line) <= 912.0), "{lines:?}");
    assert_eq!(lines.join(" "), fact);
}
