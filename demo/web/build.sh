#!/usr/bin/env bash
# Builds the demo as a page: demo/web/build.sh [folder, by default target/web]
#
# With a rustup toolchain it needs its target: rustup target add wasm32-unknown-unknown. Where that is not to be
# had, Debian's toolchain is used: rustc-web cargo-web rust-web-src lld-19.
set -euo pipefail
cd "$(dirname "$0")/../.."
out=${1:-target/web}
mkdir -p "$out"
target=wasm32-unknown-unknown
# All current browsers have SIMD; names of functions are for debuggers.
export RUSTFLAGS="-C target-feature=+simd128" CARGO_PROFILE_RELEASE_STRIP=symbols

if [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]; then
    cargo build --release --locked -p rustycs-demo --target "$target"
    built=target/$target/release/rustycs-demo.wasm
elif [ -x /usr/bin/cargo ] && [ -x /usr/bin/wasm-ld-19 ]; then
    # Debian has no standard library for this target: it is built along. Another compiler's work is kept apart.
    RUSTC=/usr/bin/rustc RUSTDOC=/usr/bin/rustdoc RUSTC_BOOTSTRAP=1 \
        CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=/usr/bin/wasm-ld-19 \
        /usr/bin/cargo build --release --locked -p rustycs-demo --target "$target" \
        -Zbuild-std=std,panic_abort --target-dir target/web-build
    built=target/web-build/$target/release/rustycs-demo.wasm
else
    echo "There is no compiler for $target. Either of these brings one:"
    echo "    rustup target add $target"
    echo "    apt-get install --no-install-recommends rustc-web cargo-web rust-web-src lld-19"
    exit 1
fi

# What connects the canvas and the program comes with the crate that the program was built with.
glue=$(cargo metadata --format-version 1 --locked |
    grep -o '"manifest_path":"[^"]*/miniquad-[^"]*/Cargo.toml"' | head -n 1 | cut -d '"' -f 4)
cp "$(dirname "$glue")/js/gl.js" "$built" demo/web/index.html "$out/"

# The page links to the source that it was built from.
git archive --format=tar.gz --prefix=rustycs/ -o "$out/rustycs.tar.gz" HEAD 2>/dev/null ||
    tar -czf "$out/rustycs.tar.gz" --exclude=./target --transform 's,^\.,rustycs,' .
echo "$out: $(du -k "$out/rustycs-demo.wasm" | cut -f 1) kB; look at it with"
echo "    python3 -m http.server --directory $out 8000"
