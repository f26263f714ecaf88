//! A small test binary: the same inputs give the same bits, in every build, on every machine, with any lanes and threads; and fast
//! paths come to what their slow twins do. It is built and run in each of these ways, where one for all tests would take long.

mod determinism;
mod golden;
mod lanes;
mod threads;
mod twins;

use rustycs_tests::support;
