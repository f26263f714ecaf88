//! Conversions from and to the vectors of other crates, each by its feature.

/// Both ways between our vector and theirs, and from theirs to a place.
macro_rules! vectors_convert {
    ($feature:literal, $theirs:ty, $theirs_f64:ty) => {
        #[cfg(feature = $feature)]
        const _: () = {
            use crate::math::{Point, Vec2};

            impl From<$theirs> for Vec2 {
                fn from(vector: $theirs) -> Self {
                    Self::new(vector.x, vector.y)
                }
            }

            impl From<Vec2> for $theirs {
                fn from(vector: Vec2) -> Self {
                    Self { x: vector.x, y: vector.y }
                }
            }

            impl From<$theirs> for Point {
                fn from(vector: $theirs) -> Self {
                    Self::new(f64::from(vector.x), f64::from(vector.y))
                }
            }

            impl From<$theirs_f64> for Point {
                fn from(vector: $theirs_f64) -> Self {
                    Self::new(vector.x, vector.y)
                }
            }

            impl From<Point> for $theirs_f64 {
                fn from(point: Point) -> Self {
                    Self { x: point.x, y: point.y }
                }
            }
        };
    };
}

vectors_convert!("mint", mint::Vector2<f32>, mint::Vector2<f64>);
vectors_convert!("mint", mint::Point2<f32>, mint::Point2<f64>);
vectors_convert!("glam-027", glam_027::Vec2, glam_027::DVec2);
vectors_convert!("glam-029", glam_029::Vec2, glam_029::DVec2);
vectors_convert!("glam-030", glam_030::Vec2, glam_030::DVec2);
