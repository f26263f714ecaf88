//! Sets `unoptimized` where this package is built without optimization. There each local variable has a place of its own on the stack, and
//! the kernels of `src/resolution/kernel.rs`, inlined into one function for the sake of speed, would take more than a thread has.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimized");
    }
}
