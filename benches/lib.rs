//! The benches are `steps` (criterion: whole steps and single detections) and `scaling` (how the time per body
//! grows with the number of bodies); this package only holds them.
