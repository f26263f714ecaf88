//! Error against run time, for any scene: which settings are worth their time, and which are the cheapest that
//! are good enough. Feature `report`; nothing of it runs in a step.
//!
//! A [`Study`] runs a scene over a range of settings and measures, for each, how wrong it is and how long it
//! takes. The scene is a function of [`Settings`](crate::Settings); what is right comes from a closed form, or
//! from the scene itself at much finer settings.
//!
//! ```
//! use rustycs::prelude::*;
//! use rustycs::report::Study;
//!
//! let report = Study::new(|settings| {
//!     let mut world = World::new(settings);
//!     world.add_force(Force::EARTH_GRAVITY);
//!     world.add(Body::fixed(Shape::aabb(20.0, 1.0)).at([0.0, -0.5])).unwrap();
//!     for level in 0..3 {
//!         world.add(Body::dynamic(Shape::obb(1.0, 1.0)).at([0.0, 0.5 + f64::from(level)])).unwrap();
//!     }
//!     world
//! })
//! .name("three boxes")
//! .duration(1.0)
//! .tick_rates([30.0, 60.0, 120.0])
//! .substeps([1, 2, 4])
//! .run()?;
//!
//! println!("{}", report.to_markdown());
//! let cheapest = report.recommend(2e-3).expect("some settings are good to two millimetres");
//! assert!(cheapest.error <= 2e-3);
//! # Ok::<(), rustycs::report::StudyError>(())
//! ```
//!
//! For run times, hand it a clock; for a picture, [`Report::to_svg`]:
//!
//! ```
//! # use rustycs::prelude::*;
//! # use rustycs::report::{Exact, Study};
//! let start = std::time::Instant::now();
//! let report = Study::new(|settings| {
//!     let mut world = World::new(settings);
//!     world.add_force(Force::EARTH_GRAVITY);
//!     world.add(Body::dynamic(Shape::circle(0.5)).velocity([3.0, 4.0])).unwrap();
//!     world
//! })
//! .exact(|t| vec![Exact::at([3.0 * t, 4.0 * t - 0.5 * 9.81 * t * t])])
//! .also("classic", [30.0, 60.0, 120.0].map(|tick_rate| Settings { tick_rate, ..Settings::classic() }))
//! .clock(|| start.elapsed().as_secs_f64())
//! .run()?;
//! let order = report.order_of("classic").expect("its errors are well above rounding");
//! assert!((0.9..1.1).contains(&order));
//! assert!(report.to_svg().starts_with("<svg"));
//! # Ok::<(), rustycs::report::StudyError>(())
//! ```
//!
//! # What it will not say
//!
//! - A reference has an error of its own, which is estimated. Rows within twice of it are marked as good as
//!   the reference and are not ranked among each other.
//! - Where a tiny change of the start comes to another outcome (chaos), trajectories are not compared: the
//!   report says so, and ranks by what should be kept, the energy or the overlap.
//!
//! # Source
//!
//! Work-precision diagrams: Hairer, Nørsett, Wanner, "Solving Ordinary Differential Equations I" (1993),
//! section II.10.

mod chart;
mod error;
mod front;
mod measure;
mod order;
mod plot;
mod quantity;
mod reference;
mod result;
mod run;
mod study;
mod sweep;
mod text;
mod track;
mod watch;
mod work;

pub use chart::{Axis, Chart, Mark, Point, Series};
pub use error::StudyError;
pub use front::front;
pub use measure::{Custom, Invariants, Measure};
pub use order::order;
pub use quantity::Unit;
pub use result::{Reference, Report, Row, RunTime};
pub use study::{Progress, Study};
pub use track::Exact;
pub use work::Work;
