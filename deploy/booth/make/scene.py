#!/usr/bin/env python3
"""Writes booth.txtpb: the colour-matching booth. Lengths in metres, y up, the viewer at +z."""

from pathlib import Path

BOOTH = Path(__file__).parent.parent

HALF_WIDTH, HEIGHT = 1.50, 2.30     # of the box, inside
BACK, FRONT = -1.50, 1.30           # z of the back wall and of the opening
RISE, TREAD = 0.31, 0.42            # of the three steps
COLUMNS, SPACING = 5, 0.54
BALL = 0.125                        # radius


def num(x):
    return f"{round(x, 5) + 0.0:g}"


def vec(x, y, z):
    parts = [f"{name}: {num(value)}" for name, value in zip("xyz", (x, y, z)) if round(value, 5)]
    return "{ " + " ".join(parts) + " }" if parts else "{}"


def material(name, diffuse, finish):
    return f'material {{ name: "{name}" diffuse {{ {diffuse} }} {finish}'.rstrip() + " }"


def quad(name, paint, corner, u, v):
    return (f'object {{ name: "{name}" material: "{paint}" '
            f'quad {{ corner {vec(*corner)} u {vec(*u)} v {vec(*v)} }} }}')


def sphere(name, paint, center, radius):
    return (f'object {{ name: "{name}" material: "{paint}" '
            f'sphere {{ center {vec(*center)} radius: {num(radius)} }} }}')


def mesh(name, paint, file, *steps):
    return (f'object {{ name: "{name}" material: "{paint}" mesh {{ file: "{file}" }} '
            + " ".join(f"transform {{ {step} }}" for step in steps) + " }")


GLOSSY = "diffuseness: 0.8 specularness: 0.45 blinn_phong { shininess: 150 }"
SATIN = "diffuseness: 0.9 specularness: 0.12 blinn_phong { shininess: 30 }"


def materials():
    lines = [material("wall", "constant: 0.43", ""),
                          material("floor", "constant: 0.43", "diffuseness: 0.9 mirror: 0.06"),
             material("mirror", "constant: 0.02", "mirror: 0.88 specularness: 0.8 "
                      "blinn_phong { shininess: 1000 }")]
    for i in range(1, 16):
        source = f'file: "spectra/tcs.sp" entry: "TCS{i:02}"'
        lines.append(material(f"tcs{i:02}", source, GLOSSY))
        lines.append(material(f"card{i:02}", source, ""))
    for i in (1, 2):
        lines.append(material(f"paint-{i}", f'file: "spectra/paint-{i}.txt"', SATIN))
    return lines


def box():
    w, h, d = 2 * HALF_WIDTH, HEIGHT, FRONT - BACK
    return [quad("floor", "floor", (-HALF_WIDTH, 0, FRONT), (w, 0, 0), (0, 0, -d)),
            quad("ceiling", "wall", (-HALF_WIDTH, h, BACK), (w, 0, 0), (0, 0, d)),
            quad("back", "wall", (-HALF_WIDTH, 0, BACK), (w, 0, 0), (0, h, 0)),
            quad("left", "wall", (-HALF_WIDTH, 0, FRONT), (0, 0, -d), (0, h, 0)),
            quad("right", "wall", (HALF_WIDTH, 0, BACK), (0, 0, d), (0, h, 0)),
            quad("room", "wall", (6, -1, 6.5), (-12, 0, 0), (0, 6, 0))]


def step_back(row):
    return BACK + TREAD * (2 - row)


def bleacher():
    lines = []
    for row in range(3):
        y, back, w = RISE * (row + 1), step_back(row), 2 * HALF_WIDTH
        y -= 0.10
        low = y - (RISE if row else RISE - 0.10)
        lines += [quad(f"tread-{row + 1}", "wall", (-HALF_WIDTH, y, back + TREAD), (w, 0, 0),
                       (0, 0, -TREAD)),
                  quad(f"riser-{row + 1}", "wall", (-HALF_WIDTH, low, back + TREAD), (w, 0, 0),
                       (0, y - low, 0))]
        for column in range(COLUMNS):
            number = 5 * (2 - row) + column + 1
            x = SPACING * (column - (COLUMNS - 1) / 2)
            lines += [quad(f"card {number}", f"card{number:02}", (x - 0.21, y, back + 0.09),
                           (0.42, 0, 0), (0, 0.29, -0.07)),
                      sphere(f"ball {number}", f"tcs{number:02}", (x, y + BALL, back + 0.26),
                             BALL)]
    return lines


def pair():
    """The board: a chequer of paint 1 and paint 2 on a backing that leans away from the viewer. It
    leans by 3:4, so that the corners are exact and no seam opens between the cells."""
    columns, rows, cell = 6, 3, 0.13
    left, y, z, rim, thick = -1.17, 0.0165, 0.56, 0.02, 0.0005
    up, out = (0, 0.8, -0.6), (0, 0.6, 0.8)
    across, tall = cell * columns + 2 * rim, cell * rows + 2 * rim
    corner = (left - rim, y - rim * up[1] - thick * out[1], z - rim * up[2] - thick * out[2])
    lines = [quad("board", "wall", corner, (across, 0, 0), [tall * x for x in up])]
    for r in range(rows):
        for c in range(columns):
            corner = (left + cell * c, y + cell * r * up[1], z + cell * r * up[2])
            lines.append(quad(f"board {r + 1}.{c + 1}", f"paint-{1 + (r + c) % 2}", corner,
                              (cell, 0, 0), [cell * x for x in up]))
    return lines


def swatches():
    """One knitted mesh placed twice, in paint 1 and in paint 2."""
    return [mesh(f"swatch {i}", f"paint-{i}", "meshes/knit.ply",
                 "rotate { axis { x: 1 } degrees: -36 }", f"translate {vec(x, 0.25, 0.26)}")
            for i, x in ((1, 0.55), (2, 0.99))]


PAIR = """\
# The pair: a chequer and two swatches of one knitted mesh, in two paints that look alike under
# D65 and part under A and F11. Paint 2 is paint 1 plus a metameric black: a function that the
# eye does not see under D65 (make/spectra.py computes it)."""


LOOKS = """\
# Looks: `metamer render booth.txtpb --look A -o a.png`. The window has them on its keys 1 to 4.
look { name: "D65" light { name: "*" spectrum { standard: "D65" } } }
look { name: "A" light { name: "*" spectrum { standard: "A" } } }
look { name: "F11" light { name: "*" spectrum { standard: "F11" } } }
# As in a shop: a fluorescent tube on one side, a filament lamp on the other.
look { name: "shop" light { name: "lamp left" spectrum { standard: "F11" } } light { name: "lamp right" spectrum { standard: "A" } } }"""


def scene():
    lamp = 'spectrum { standard: "D65" } luminance: 0.72 reference_distance: 1.9 }'
    parts = [
        ["# proto-file: metamer/v1/scene.proto", "# proto-message: metamer.v1.Scene",
         "# A colour-matching light booth; lengths in metres. Written by make/scene.py."],
        ["camera { eye { y: 1.5 z: 5.8 } target { y: 0.575 } vertical_fov: 17.6 }"],
        ["# Each lamp gives a white that faces it from 1.9 m a Y of 0.72.",
         f'light {{ name: "lamp left" position {vec(-0.75, 2.15, 0.85)} {lamp}',
         f'light {{ name: "lamp right" position {vec(0.75, 2.15, 0.85)} {lamp}'],
        ["# The 15 test colours are each a glossy ball and a matt card."] + materials(),
        ["# The box, and the room behind the viewer that the mirror ball sees."] + box(),
        ["# Three steps with five cards and five balls each."] + bleacher(),
        [PAIR] + pair() + swatches(),
        [sphere("mirror ball", "mirror", (0.0, 0.19, 0.42), 0.19)],
        [LOOKS],
        ["settings { width: 960 height: 640 spp: 16 method { point { from: 400 to: 700 step: 5 } } }"]]
    return "\n\n".join("\n".join(part) for part in parts) + "\n"


if __name__ == "__main__":
    (BOOTH / "booth.txtpb").write_text(scene())
