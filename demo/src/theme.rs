//! Colours and sizes: everything that makes the window and the pictures look of one piece.

use std::fmt;

use rustycs::{BodyRef, BodyType, Material, Shape};

/// A colour without transparency.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tone {
    r: u8,
    g: u8,
    b: u8,
}

impl Tone {
    /// The colour that `rgb`, 0xRRGGBB, names.
    pub(crate) const fn hex(rgb: u32) -> Self {
        Self { r: (rgb >> 16) as u8, g: (rgb >> 8) as u8, b: rgb as u8 }
    }

    /// The colour of these parts.
    pub(crate) const fn rgb(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b }
    }

    /// This colour with a share of another in it, 0 to 1.
    pub(crate) fn mixed(self, other: Self, share: f32) -> Self {
        let channel = |from: u8, to: u8| {
            let (from, to) = (f32::from(from), f32::from(to));
            (from + (to - from) * share).round() as u8
        };
        Self { r: channel(self.r, other.r), g: channel(self.g, other.g), b: channel(self.b, other.b) }
    }

    /// Red, green, blue, and how opaque: 255 hides what is beneath.
    pub(crate) fn rgba(self, alpha: u8) -> [u8; 4] {
        [self.r, self.g, self.b, alpha]
    }
}

/// `#rrggbb`.
impl fmt::Display for Tone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.r, self.g, self.b)
    }
}

pub(crate) const BACKGROUND: Tone = Tone::hex(0x11_141b);
pub(crate) const GRID: Tone = Tone::hex(0x17_1b24);
pub(crate) const GRID_STRONG: Tone = Tone::hex(0x1e_232e);
pub(crate) const PANEL: Tone = Tone::hex(0x16_1a22);
pub(crate) const BORDER: Tone = Tone::hex(0x29_303c);
pub(crate) const TEXT: Tone = Tone::hex(0xe4_e8ef);
pub(crate) const MUTED: Tone = Tone::hex(0x99_a3b3);
pub(crate) const FAINT: Tone = Tone::hex(0x62_6c7c);
pub(crate) const ACCENT: Tone = Tone::hex(0x7c_b2f0);
pub(crate) const PAUSED: Tone = Tone::hex(0xe0_b567);
pub(crate) const CONTACT: Tone = Tone::hex(0xff_d28a);
pub(crate) const BODY_BOX: Tone = Tone::hex(0x7f_d1b9);
pub(crate) const FAT_BOX: Tone = Tone::hex(0x5b_6f96);

pub(crate) const ATTRACTOR: Tone = Tone::hex(0xf2_c14e);
pub(crate) const TREE: Tone = Tone::hex(0xd7_7fc0);
pub(crate) const TANGENT: Tone = Tone::hex(0x8f_c9ff);
pub(crate) const JOINT: Tone = Tone::hex(0xc8_d2e2);
pub(crate) const DEEP: Tone = Tone::hex(0xff_5c5c);
pub(crate) const VELOCITY: Tone = Tone::hex(0x9a_e08a);
pub(crate) const SPIN: Tone = Tone::hex(0xe0_9ae0);
pub(crate) const TRAIL: Tone = Tone::hex(0x8f_b7e8);
pub(crate) const SLEEP: Tone = Tone::hex(0xb3_a1ff);
pub(crate) const AXIS: Tone = Tone::hex(0x46_5062);
/// A thing that can be pressed; while the mouse is over it; that is chosen.
pub(crate) const BUTTON: Tone = Tone::hex(0x20_2632);
pub(crate) const HOVERED: Tone = Tone::hex(0x2b_3342);
pub(crate) const CHOSEN: Tone = Tone::hex(0x2a_4468);
/// A body that is connected to none.
pub(crate) const ALONE: Tone = Tone::hex(0x56_5f6e);

/// Colours for things that are told apart by number only.
pub(crate) const PALETTE: [Tone; 12] = [
    Tone::hex(0x5a_9bd8),
    Tone::hex(0xd9_7a5b),
    Tone::hex(0x63_b878),
    Tone::hex(0xb9_79c9),
    Tone::hex(0xd6_b44c),
    Tone::hex(0x4f_b3b5),
    Tone::hex(0xd2_6488),
    Tone::hex(0x8c_a24f),
    Tone::hex(0x8a_82d8),
    Tone::hex(0xb3_8a63),
    Tone::hex(0x6f_c7a4),
    Tone::hex(0xc9_c1b1),
];

/// What does not move.
const FIXED: Tone = Tone::hex(0x2c_3340);
/// What moves as it is told.
const KINEMATIC: Tone = Tone::hex(0x70_62a8);
/// What is of no material with a name: circles, boxes, polygons.
const OTHERS: [Tone; 3] = [Tone::hex(0x6f_8f5c), Tone::hex(0xa5_7650), Tone::hex(0x83_6fae)];

/// The materials with a name, and the colour of each.
pub(crate) const MATERIALS: [(Material, &str, Tone); 5] = [
    (Material::DEFAULT, "default", Tone::hex(0x4e_7cb3)),
    (Material::RUBBER, "rubber", Tone::hex(0xb0_5c6e)),
    (Material::PLASTIC, "plastic", Tone::hex(0xc2_9650)),
    (Material::STONE, "stone", Tone::hex(0x80_858f)),
    (Material::METAL, "metal", Tone::hex(0x4a_9793)),
];

/// How a body is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BodyStyle {
    pub(crate) fill: Tone,
    pub(crate) outline: Tone,
}

/// The colours of a body: those it was painted with, or by its material, or else by its shape; while it sleeps its
/// outline is dim. What a body is made of shows in its density; friction and restitution are often changed.
pub(crate) fn style_of(body: &BodyRef<'_>, painted: Option<Tone>) -> BodyStyle {
    let density = body.material().density;
    let of_material = || {
        let named = MATERIALS.iter().find(|(material, ..)| material.density == density);
        named.map_or_else(|| OTHERS[kind_of(body.shape())], |&(_, _, tone)| tone)
    };
    let tone = match (body.body_type(), painted) {
        (_, Some(tone)) => tone,
        (BodyType::Fixed, None) => return BodyStyle { fill: FIXED, outline: FIXED.mixed(TEXT, 0.18) },
        (BodyType::Kinematic, None) => KINEMATIC,
        (BodyType::Dynamic, None) => of_material(),
    };
    let brightness = if body.is_sleeping() { 0.12 } else { 0.45 };
    BodyStyle { fill: tone.mixed(BACKGROUND, 0.22), outline: tone.mixed(TEXT, brightness) }
}

/// Circles, boxes, all others.
fn kind_of(shape: &Shape) -> usize {
    match shape {
        Shape::Circle(_) => 0,
        Shape::Aabb(_) | Shape::Obb(_) => 1,
        _ => 2,
    }
}
