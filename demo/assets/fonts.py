#!/usr/bin/env python3
"""Makes the fonts of the demo: demo/assets/fonts.py FOLDER

The folder holds Inter-Regular.otf and Inter-SemiBold.otf of Inter 3.19 (github.com/rsms/inter) and
JetBrainsMono-Regular.ttf of JetBrains Mono 2.242 (github.com/JetBrains/JetBrainsMono). What the demo never shows is left
out, and the zero loses its dot: at 12 px it reads as an eight. Needs python3-fonttools.
"""

import pathlib
import sys

from fontTools import subset
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.pens.ttGlyphPen import TTGlyphPen
from fontTools.ttLib import TTFont

FONTS = ["Inter-Regular.otf", "Inter-SemiBold.otf", "JetBrainsMono-Regular.ttf"]
# Latin, Greek, dashes and quotes, exponents, arrows, signs of mathematics.
CHARACTERS = [*range(0x20, 0x7F), *range(0xA0, 0x100), *range(0x370, 0x400), *range(0x2010, 0x203B),
              *range(0x2070, 0x209D), *range(0x2190, 0x219A), 0x2212, 0x221A, 0x221E, 0x2248, 0x2264, 0x2265]


def remove_dot(font):
    """Leaves the two outer contours of the zero."""
    recording = DecomposingRecordingPen(font.getGlyphSet())
    font.getGlyphSet()["zero"].draw(recording)
    pen = TTGlyphPen(None)
    contours = 0
    for name, points in recording.value:
        contours += name == "moveTo"
        if contours <= 2:
            getattr(pen, name)(*points)
    assert contours == 3, f"the zero has {contours} contours, not an outer one, an inner one and a dot"
    font["glyf"]["zero"] = pen.glyph()


if len(sys.argv) != 2:
    sys.exit(__doc__)
for name in FONTS:
    font = TTFont(pathlib.Path(sys.argv[1]) / name)
    if name.startswith("JetBrains"):
        remove_dot(font)
    options = subset.Options(layout_features=[], hinting=False, notdef_outline=True, name_IDs=["*"])
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=CHARACTERS)
    subsetter.subset(font)
    font.save(pathlib.Path(__file__).parent / name)
