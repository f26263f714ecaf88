//! Why rustycs does not meet some cases.

/// What the page says of a case where rustycs fails; empty where nothing is known.
pub(super) fn of(case: &str) -> &'static str {
    match case {
        "plate-on-heap" => {
            "The island is more work than the direct solve takes on, and where it is let, Newton's method goes to and fro between \
             points that stick and that slide. Sweeps carry a load of hundreds of times a ball's weight by overlap, of which 5 mm \
             and a tenth are left once the load has lasted."
        }
        "pyramid-40" | "pyramid-100" => {
            "More than 256 bodies, so sweeps only. By them each contact sags under its load, the middle, which bears most, by more \
             than the sides, so the rows tilt and drift; and in the first steps the top falls, and rocks for more than 10 s. A hundred \
             rows go up and down once in 10 s, which is where contacts that yield less to a load as it lasts give the most energy back: \
             where loads have to last eight times as long, that decays, but heaps of different masses do not come to rest."
        }
        "leaning-inside" => {
            "It falls with 64 substeps too, so it is not the sag at rest. In the first steps, before sweeps have built up the load, \
             the upper nine begin to turn, and a margin of 1 cm, 2 mrad, does not stop them. A start from loads solved directly \
             does not last: sweeps take them back by an eighth in each substep until the contacts have sagged."
        }
        "crowd-of-50" => {
            "Each pair is pushed apart as if it were alone. A box that 49 others push the same way gets the sum, of which the \
             relax sweep takes out what the contacts can see at the end of the substep, not what has made them part."
        }
        "random-worlds-100" | "random-worlds-10000" => {
            "Light bodies under ones up to a hundred times as heavy sag at rest: most where they are swept, some of them as a load on a \
             single corner does not count as lasting and so is not solved directly; others in islands that Newton's method \
             does not solve. A few still move after 10 s, under little gravity."
        }
        "10-piles" | "30-piles" => {
            "One trembles for minutes at 0.1 mm/s, where rest begins. Of 200 piles seven do."
        }
        "gravel-edge" | "gravel-middle" => {
            "Sweeps leave a hundredth of a stone of overlap, or half of it, as chance will have it. And in one of eight such heaps stones that lean on each \
             other at the limit of friction creep for seconds, and slip as they are watched."
        }
        _ => "",
    }
}
