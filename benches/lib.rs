//! The benches are `steps` (criterion: whole steps and single detections), `scaling` (how the time per body grows with
//! the number of bodies) and `leave_out` (what is optional costs nothing where it is absent); this package only holds
//! them.
