//! Colours and sizes: everything that makes the window and the pictures look of one piece.

use std::fmt;

use rustycs::{BodyRef, BodyType, Material};

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

/// What does not move.
const FIXED: Tone = Tone::hex(0x2c_3340);
/// What moves as it is told.
const KINEMATIC: Tone = Tone::hex(0x70_62a8);
/// What is of no material with a name.
const OTHER: Tone = Tone::hex(0x6f_7f5c);

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

/// The colours of a body: by its material, dimmer while it sleeps. What a body is made of shows in its density;
/// friction and restitution are often changed.
pub(crate) fn style_of(body: &BodyRef<'_>) -> BodyStyle {
    let density = body.material().density;
    let tone = match body.body_type() {
        BodyType::Fixed => return BodyStyle { fill: FIXED, outline: FIXED.mixed(TEXT, 0.18) },
        BodyType::Kinematic => KINEMATIC,
        BodyType::Dynamic => MATERIALS
            .iter()
            .find(|(material, ..)| material.density == density)
            .map_or(OTHER, |&(_, _, tone)| tone),
    };
    let awake = BodyStyle { fill: tone.mixed(BACKGROUND, 0.22), outline: tone.mixed(TEXT, 0.45) };
    if body.is_sleeping() {
        let dimmer = |tone: Tone| tone.mixed(BACKGROUND, 0.42);
        BodyStyle { fill: dimmer(awake.fill), outline: dimmer(awake.outline) }
    } else {
        awake
    }
}
