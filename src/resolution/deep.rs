//! Which contacts are of shapes that are deep in each other, as those of bodies of several shapes may be, see [`parting`](crate::resolution::parting).

use crate::body::Bodies;
use crate::collision::Contact;

/// Two bodies are deep in each other where shapes overlap by this share of the width of the narrower body, no unit. Of shapes that
/// fit closely both sides overlap by less. From a quarter on, sixty letters in one place still came to 97 m/s; from 3 % on, light
/// bodies under heavy ones are twice as fast as from a tenth.
const DEEP_SHARE: f32 = 0.1;

/// Whether shapes are deep in each other, of bodies that are both moved by contacts, and of which one has several.
#[inline(always)]
pub(crate) fn is_deep(contact: &Contact, bodies: &Bodies) -> bool {
    let [a, b] = contact.colliders;
    if !(bodies.is_one_of_several(a) || bodies.is_one_of_several(b)) {
        return false;
    }
    let are_moved = [a, b].iter().all(|&slot| bodies.motions[slot as usize].inverse_mass > 0.0);
    let width = bodies.width_of_body(a).min(bodies.width_of_body(b));
    are_moved && contact.penetration() > DEEP_SHARE * width
}
