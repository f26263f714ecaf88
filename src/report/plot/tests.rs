use crate::report::plot::labels::Labels;

#[test]
fn words_keep_off_marks_each_other_and_the_edge() {
    let mut labels = Labels::new([0.0, 0.0, 200.0, 100.0]);
    labels.avoid_mark([100.0, 50.0]);
    let placed = (0..40).filter(|_| labels.beside([100.0, 50.0], "60 Hz × 4").is_some()).count();
    assert!((2..=8).contains(&placed), "{placed} words around one mark");
    assert!(labels.beside([-50.0, 50.0], "outside").is_none());
}
