//! Why rustycs does not meet some cases.

/// What the page says of a case where rustycs fails; empty where nothing is known.
pub(super) fn of(case: &str) -> &'static str {
    match case {
        "plate-on-balls" | "plate-on-heap" => {
            "The island has more contacts than the direct solve takes on, and sweeps carry a load of hundreds of times a ball's \
             weight only after as many steps as there are bodies that share it, by overlap."
        }
        "pyramid-40" | "pyramid-100" => {
            "More than 256 bodies, so sweeps only: a load climbs by some rows per step, the top falls meanwhile, rocks, and a \
             pyramid has nothing that damps it but its contacts."
        }
        "leaning-inside" => {
            "It falls with 64 substeps too, so it is not the sag at rest. In the first steps, before sweeps have built up the load, \
             the upper nine begin to turn, and a margin of 1 cm, 2 mrad, does not stop them."
        }
        "crowd-of-50" => {
            "Each pair is pushed apart as if it were alone. A box that 49 others push the same way gets the sum, of which the \
             relax sweep takes out what the contacts can see at the end of the substep, not what has made them part."
        }
        "tower-1mm" => {
            "In a substep of 1/240 s a box of 1 mm falls by 8 % of itself: what rounding leaves of it trembles."
        }
        "gravel-middle" | "gravel-edge" => {
            "The weight of some stones of 1 cm makes a contact sag by more than an eightieth of it within a substep, so the heap is \
             solved directly while it still moves, and is too large for it once it lies."
        }
        "planet-as-ground" => {
            "The gap to a circle is the distance of the centres less its radius. In f32 that moves by half a metre at a time at \
             6,400 km, so contacts do not see that they sink, and yield at 1 cm/s."
        }
        "random-worlds-100" | "random-worlds-10000" => {
            "Light bodies wedged under ones up to a hundred times as heavy. Solved by sweeps alone, twice as many worlds do not \
             hold; these are what the direct solve leaves."
        }
        _ => "",
    }
}
