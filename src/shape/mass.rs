//! Area, mass and moment of inertia.
//!
//! Once per body and in `f64`. A polygon is summed over the triangles between its centre and its edges
//! (B. Mirtich, 1996, in two dimensions).

use crate::math::Vec2;
use crate::shape::Shape;

/// What a shape weighs and how hard it is to turn.
///
/// ```
/// use rustycs::Shape;
///
/// // Half a metre of a beam, 10 kg/m²: m = 10 · 2 · 0.5, I = m (2² + 0.5²)/12.
/// let beam = Shape::rectangle(2.0, 0.5).mass_properties(10.0);
/// assert_eq!(beam.mass, 10.0);
/// assert!((beam.inertia - 10.0 * 4.25 / 12.0).abs() < 1e-5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f32,
    /// Moment of inertia about the centre of mass, kg m².
    pub inertia: f32,
}

impl Shape {
    /// Area, m²; 0 for a segment.
    pub fn area(&self) -> f32 {
        self.moments().0 as f32
    }

    /// Mass and moment of inertia at `density`, kg/m², about the centre of mass, which is the origin of the
    /// body's frame.
    pub fn mass_properties(&self, density: f32) -> MassProperties {
        let (area, second_moment) = self.moments();
        let density = f64::from(density);
        MassProperties { mass: (density * area) as f32, inertia: (density * second_moment) as f32 }
    }

    /// Area, m², and its second moment about the centre, m⁴.
    fn moments(&self) -> (f64, f64) {
        match self {
            Self::Circle(circle) => {
                let squared = f64::from(circle.radius()) * f64::from(circle.radius());
                let area = core::f64::consts::PI * squared;
                (area, 0.5 * area * squared)
            }
            Self::Aabb(rectangle) | Self::Obb(rectangle) => {
                let (w, h) = (f64::from(rectangle.width()), f64::from(rectangle.height()));
                (w * h, w * h * (w * w + h * h) / 12.0)
            }
            Self::Polygon(polygon) => polygon_moments(polygon.vertices()),
            Self::Rounded(rounded) => rounded.moments(),
            Self::Segment(_) => (0.0, 0.0),
        }
    }
}

/// For the triangle of the centre and an edge from p to q, with D = p × q (twice its area):
/// area D/2, second moment D/12 · (p·p + p·q + q·q).
fn polygon_moments(vertices: &[Vec2]) -> (f64, f64) {
    let (mut area, mut second_moment) = (0.0, 0.0);
    for (i, p) in vertices.iter().enumerate() {
        let q = vertices[(i + 1) % vertices.len()];
        let (px, py, qx, qy) = (f64::from(p.x), f64::from(p.y), f64::from(q.x), f64::from(q.y));
        let doubled = px * qy - py * qx;
        area += 0.5 * doubled;
        second_moment += doubled / 12.0 * (px * px + py * py + px * qx + py * qy + qx * qx + qy * qy);
    }
    (area, second_moment)
}
