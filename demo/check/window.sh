#!/usr/bin/env bash
# Drives the demo's window with real keys and a real mouse, on a display in memory, and checks what it says of
# its state: demo/check/window.sh [path of rustycs-demo]
#
# Needs xvfb, xauth, xdotool and a software OpenGL (libgl1-mesa-dri).
set -euo pipefail
cd "$(dirname "$0")/../.."
demo=$(realpath "${1:-target/release/rustycs-demo}")

# Again, on a display of its own.
if [ -z "${WINDOW_CHECK:-}" ]; then
    exec env WINDOW_CHECK=1 xvfb-run -a -s "-screen 0 1600x900x24 +extension GLX" "$0" "$demo"
fi

out=$(mktemp -d)
log=$out/log
app=
trap '[ -z "$app" ] || kill "$app" 2>/dev/null || true; rm -rf "$out"' EXIT

fail() {
    echo "FAILED: $*"
    tail -n 5 "$log"
    exit 1
}

# The value of a word in the last line of the log: value bodies
value() { tail -n 1 "$log" | tr ' ' '\n' | sed -n "s/^$1=//p"; }

# Waits until a word has a value: until_is paused yes
until_is() {
    for _ in $(seq 100); do
        [ "$(value "$1")" = "$2" ] && { echo "    $1=$2"; return; }
        sleep 0.1
    done
    fail "$1 is $(value "$1"), not $2"
}

# Waits until a word has another value than before: until_not bodies 5
until_not() {
    for _ in $(seq 100); do
        [ "$(value "$1")" != "$2" ] && { echo "    $1=$(value "$1")"; return; }
        sleep 0.1
    done
    fail "$1 is still $2"
}

# Waits for a line that is written from now on, one of which comes every second.
next_line() {
    local before
    before=$(wc -l <"$log")
    for _ in $(seq 100); do
        [ "$(wc -l <"$log")" -gt "$before" ] && return
        sleep 0.1
    done
    fail "nothing more is said"
}

# A frame of the software renderer takes up to 30 ms; what is shorter may fall between two.
hold=0.12
key() { echo "  key $1"; for part in ${1//+/ }; do xdotool keydown "$part"; done; sleep $hold
        for part in $(tr '+' '\n' <<<"$1" | tac); do xdotool keyup "$part"; done; sleep $hold; }
move() { xdotool mousemove "$1" "$2"; sleep $hold; }
click() { echo "  click $1 $2"; move "$1" "$2"; xdotool mousedown "${3:-1}"; sleep $hold; xdotool mouseup "${3:-1}"; sleep $hold; }

say() { printf '%s\n' "- $*"; }

open() {
    : >"$log"
    "$demo" --report --samples 1 "$@" >"$log" 2>"$out/errors" &
    app=$!
    for _ in $(seq 100); do
        grep -q '^state' "$log" && break
        kill -0 "$app" 2>/dev/null || fail "the window did not open: $(cat "$out/errors")"
        sleep 0.1
    done
    window=$(xdotool search --sync --onlyvisible --class rustycs | head -n 1)
    xdotool windowmove --sync "$window" 0 0 2>/dev/null || true
    xdotool windowfocus "$window" 2>/dev/null || true
    sleep 0.5
}

close() {
    kill -0 "$app" 2>/dev/null || fail "the window is gone: $(cat "$out/errors")"
    kill "$app"; wait "$app" 2>/dev/null || true
    app=
    if grep -i -E 'panic|error' "$out/errors"; then fail "it complained"; fi
}

open --scene tower --size 1280x720

say "pause and single ticks"
key space; until_is paused yes
next_line; tick=$(value tick)
key s; until_is tick $((tick + 1))
key space; until_is paused no

say "speed, seed, restart"
key minus; until_is speed 0.5
key equal; until_is speed 1
key k; until_is seed 2
key shift+k; until_is seed 1
key r; until_is scene tower

say "every overlay by its key, on and off again"
for pair in b:boxes t:tree c:contacts d:penetration v:velocity m:centres i:islands o:colours z:sleeping \
            l:names g:grid j:trails e:sums; do
    key "${pair%%:*}"; until_is overlays "${pair##*:}"
    key "${pair%%:*}"; until_is overlays -
done

say "the sandbox: make, throw, take back, delete"
key space; until_is paused yes
bodies=$(value bodies)
key 2; until_is tool circle
click 200 200; until_is bodies $((bodies + 1))
key u; until_is bodies "$bodies"
key 5; until_is tool polygon
move 250 250; xdotool mousedown 1; sleep $hold; move 320 180; xdotool mouseup 1
until_is bodies $((bodies + 1))
key w; key 4; until_is tool box
# Two of ten would lie on the polygon, and are left out.
click 300 300; until_is bodies $((bodies + 9))
key ctrl+z; until_is bodies $((bodies + 1))
key w; key shift+w; key shift+w
key 6; until_is tool attractor
click 600 120; until_is attractors 1
key 8; until_is tool delete
click 600 120; until_is attractors 0
key 2; click 700 200; until_is bodies $((bodies + 2))
move 700 200; key Delete; until_is bodies $((bodies + 1))
key bracketright; key a; key y; click 750 250; until_is bodies $((bodies + 2))

say "drag a body with the spring"
key 1; until_is tool drag
key r; until_is bodies "$bodies"
key space; until_is paused no
# The highest box of the tower, in the middle of the scene.
click 499 205
move 499 205; xdotool mousedown 1; sleep $hold
until_not held -
for x in 520 560 600 640 680 720; do move $x 160; done
sleep 1; next_line
at=$(value at); echo "    at=$at"
xdotool mouseup 1; until_is held -
awk -v at="$at" 'BEGIN { split(at, place, ","); exit !(place[1] > 1.5) }' || fail "the body did not follow: $at"

say "rewind"
key space; until_is paused yes; next_line
tick=$(value tick)
key BackSpace; next_line; until_not tick "$tick"
[ "$(value tick)" -lt "$tick" ] || fail "rewind went forward"

say "camera: zoom at the mouse, move, follow, whole scene"
zoom=$(value zoom)
move 400 300; xdotool click 4; next_line; until_not zoom "$zoom"
move 300 100; xdotool mousedown 3; move 360 140; xdotool mouseup 3
key f; until_not follows -
key f; until_is follows -
key Home; next_line; until_is zoom "$zoom"
key 1
move 499 520; xdotool mousedown 1; sleep $hold; xdotool mouseup 1
until_not selected -

say "panel by mouse: pause, pages, a tick box, a knob"
click 1160 98; until_is paused no
click 1079 180; until_is tab Scenes
click 1186 180; until_is tab View
click 1020 240; until_is overlays boxes
click 1020 240; until_is overlays -
click 1240 180; until_is tab Solver
substeps=$(value substeps)
click 1255 309; until_not substeps "$substeps"

say "panel by keys"
key Tab; until_is tab Run
key Down; key Return; until_not scene tower
key Escape
key x; until_is copies 2
key x; until_is copies 1
key h; until_is help yes
key Escape; until_is help no

say "the panel hides"
key F2; until_is folded yes
key F2; until_is folded no
click 1254 22; until_is folded yes
click 1258 22; until_is folded no

say "two copies begin with the scene; a restart restarts both"
until_is paused no; sleep 1.5; next_line
before=$(value tick)
key x; until_is copies 2; key space; until_is paused yes; next_line
[ "$(value tick)" -lt "$before" ] || fail "two copies begin at tick $(value tick)"
until_is other "$(value tick)"
key r; next_line; until_is tick 0; until_is other 0
key x; until_is copies 1

say "next and previous scene"
scene=$(value scene)
key n; until_not scene "$scene"
key p; until_is scene "$scene"

say "another size of the window"
for size in "800 600" "1500 850" "640 480"; do
    # shellcheck disable=SC2086
    xdotool windowsize "$window" $size
    until_is size "${size/ /x}"
done
close

say "a scene brings its own overlays, and takes them along"
open --scene bounce --size 640x480
until_is overlays names
key n; until_is overlays -
key p; until_is overlays names
close

say "pinball is played with the arrow keys, which change no scene"
open --scene pinball --size 640x480
key Right; key Left; next_line; until_is scene pinball
close

say "every scene for 120 frames"
for scene in $("$demo" --list | awk '{ print $1 }'); do
    "$demo" --scene "$scene" --frames 120 --samples 1 --report >"$log" 2>"$out/errors" || fail "$scene: $(cat "$out/errors")"
    if grep -i -E 'panic|error' "$out/errors"; then fail "$scene complained"; fi
    echo "    $scene: tick=$(value tick) bodies=$(value bodies) draw_ms=$(value draw_ms)"
done

say "CPU time to draw 5,000 bodies, without the rasterizer"
"$demo" --scene sandbox --crowd 5000 --frames 150 --samples 1 --report >"$log" 2>"$out/errors" || fail "crowd"
echo "    bodies=$(value bodies) draw_ms=$(value draw_ms)"

say "all of it holds"
