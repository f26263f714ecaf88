//! Sets `unoptimized` where the library is built without optimization. There each number of a function has a place of its own on the
//! stack, and what is inlined into one function for the sake of speed would take more than a thread has.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level == "0") {
        println!("cargo::rustc-cfg=unoptimized");
    }
}
