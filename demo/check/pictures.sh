#!/usr/bin/env bash
# Makes the pictures of the README, and a sheet of all scenes: demo/check/pictures.sh [path of rustycs-demo] [folder]
#
# Needs xvfb, xauth, imagemagick and a software OpenGL (libgl1-mesa-dri).
set -euo pipefail
cd "$(dirname "$0")/../.."
demo=$(realpath "${1:-target/release/rustycs-demo}")
to=$(realpath "${2:-demo/assets}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture NAME FRAMES OPTIONS...
picture() {
    local name=$1 frames=$2
    shift 2
    xvfb-run -a -s "-screen 0 1280x720x24 +extension GLX" \
        "$demo" --samples 4 --size 1280x720 --frames "$frames" --screenshot "$work/$name.png" "$@"
}

# Few colours and no blur: such a picture is small as it is.
small() { convert "$work/$1.png" -resize 960x -colors 128 -strip -define png:compression-level=9 "$to/$1.png"; }

picture pile 260 --scene pile --overlays contacts
picture islands 150 --scene smash --overlays islands,sums
picture card_house 90 --scene card_house --overlays contacts,colours,centres
picture solar_system 900 --scene solar_system --overlays names,trails,velocity
picture compare 200 --scene card_house --compare --page solver
picture tree 200 --scene pyramid --overlays tree,boxes,grid --page view
for name in pile islands card_house solar_system compare tree; do small "$name"; done

tiles=()
for scene in $("$demo" --list | awk '{ print $1 }'); do
    picture "sheet_$scene" 200 --scene "$scene"
    # The picture without the panel, with its name below.
    convert "$work/sheet_$scene.png" -crop 992x720+0+0 +repage -resize 200x "$work/sheet_$scene.png"
    tiles+=(-label "${scene//_/ }" "$work/sheet_$scene.png")
done
montage "${tiles[@]}" -tile 6x -geometry +4+4 -background '#11141b' -fill '#99a3b3' -pointsize 12 \
    -font demo/assets/Inter-Regular.otf "$work/sheet.png"
convert "$work/sheet.png" +dither -colors 64 -strip -define png:compression-level=9 "$to/scenes.png"
ls -l "$to"/*.png
