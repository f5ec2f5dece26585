#!/usr/bin/env python3
"""Writes the still life of the source's pictures: scene.txtpb, its meshes and its spectra. A box with a red
and a green wall, and four things of test colours in it; lengths in metres, y up, the viewer at +z. The meshes are coarse, for
what is evaluated per vertex is to be seen."""

from math import cos, pi, sin
from pathlib import Path
import shutil
import sys

HERE = Path(__file__).parent.parent
BOOTH = HERE.parent / "booth"
sys.dont_write_bytecode = True
sys.path.insert(0, str(BOOTH / "make"))
from ply import write_ply  # noqa: E402
from scene import mesh, num, quad, sphere, vec  # noqa: E402

# In its place variants.py puts other models.
SHINE = "diffuseness: 0.8 specularness: 0.5 phong { shininess: 40 }"

PAINTS = {"ball": "TCS12", "vase": "TCS10", "ring": "TCS08", "pebble": "TCS13"}
WALLS = {"left": "TCS09", "right": "TCS11"}


def revolved(outline, around):
    """Vertices and triangles of a surface about the y axis: outline has (radius, y), from below to above."""
    vertices = []
    for i, (radius, y) in enumerate(outline):
        before, after = outline[max(i - 1, 0)], outline[min(i + 1, len(outline) - 1)]
        rise, spread = after[1] - before[1], after[0] - before[0]
        length = (rise * rise + spread * spread) ** 0.5
        for step in range(around + 1):
            turn = 2 * pi * step / around
            vertices.append((radius * cos(turn), y, -radius * sin(turn), rise / length * cos(turn),
                             -spread / length, -rise / length * sin(turn)))
    return vertices, woven(len(outline), around + 1)


def ring(large, small, along, around):
    vertices = []
    for i in range(along + 1):
        for k in range(around + 1):
            u, v = 2 * pi * i / along, 2 * pi * k / around
            out = large + small * cos(v)
            vertices.append((out * cos(u), out * sin(u), small * sin(v), cos(v) * cos(u), cos(v) * sin(u), sin(v)))
    return vertices, [(a, c, b) for a, b, c in woven(along + 1, around + 1)]


def woven(rows, columns):
    """Two triangles for each cell of a grid of vertices."""
    triangles = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            at = row * columns + column
            triangles += [(at, at + 1, at + columns + 1), (at, at + columns + 1, at + columns)]
    return triangles


def write_meshes():
    folder = HERE / "meshes"
    folder.mkdir(exist_ok=True)
    half = [(sin(pi * i / 12), -cos(pi * i / 12)) for i in range(13)]
    vase = [(0.34, 0), (0.47, 0.16), (0.53, 0.36), (0.5, 0.58), (0.38, 0.8), (0.25, 0.98), (0.2, 1.14),
            (0.22, 1.3), (0.31, 1.42)]
    for name, shape in {"ball": revolved(half, 24), "vase": revolved(vase, 24),
                        "ring": ring(0.36, 0.15, 24, 12)}.items():
        write_ply(folder / f"{name}.ply", "the still life of deploy/source", *shape)


def colour(entry):
    return f'diffuse {{ file: "spectra/tcs.sp" entry: "{entry}" }}'


def scene_text():
    lines = ["# proto-file: metamer/v1/scene.proto", "# proto-message: metamer.v1.Scene",
             "# A still life for the source's pictures E-1 to E-14. Written by make/still_life.py.", "",
             f"camera {{ eye {vec(0, 1.55, 6.6)} target {vec(0, 0.88, 0)} vertical_fov: 23 }}", ""]
    for name, x in (("left", -0.9), ("right", 1.1)):
        lines.append(f'light {{ name: "{name}" position {vec(x, 2.6, 2.2)} spectrum {{ standard: "D65" }} '
                     f'luminance: {num(0.5)} }}')
    lines += ["", 'material { name: "plaster" diffuse { constant: 0.7 } }',
              'material { name: "floor" diffuse { constant: 0.5 } mirror: 0.12 }']
    lines += [f'material {{ name: "{name} wall" {colour(entry)} }}' for name, entry in WALLS.items()]
    lines += [f'material {{ name: "{name}" {colour(entry)} {SHINE} }}' for name, entry in PAINTS.items()]
    lines += ['material { name: "mirror" diffuse { constant: 0.02 } mirror: 0.85 }', "",
              quad("floor", "floor", (-1.8, 0, 1.6), (3.6, 0, 0), (0, 0, -3.2)),
              quad("back", "plaster", (-1.8, 0, -1.6), (3.6, 0, 0), (0, 2.7, 0)),
              quad("left", "left wall", (-1.8, 0, 1.6), (0, 0, -3.2), (0, 2.7, 0)),
              quad("right", "right wall", (1.8, 0, -1.6), (0, 0, 3.2), (0, 2.7, 0)),
              mesh("vase", "vase", "meshes/vase.ply", f"translate {vec(-0.95, 0, -0.45)}"),
              mesh("ball", "ball", "meshes/ball.ply", "scale { x: 0.5 y: 0.5 z: 0.5 }",
                   f"translate {vec(0.05, 0.5, -0.1)}"),
              mesh("ring", "ring", "meshes/ring.ply", "rotate { axis { y: 1 } degrees: -28 }",
                   f"translate {vec(1.08, 0.51, 0.15)}"),
              mesh("pebble", "pebble", "meshes/ball.ply", "scale { x: 0.32 y: 0.2 z: 0.26 }",
                   f"translate {vec(-0.62, 0.2, 0.75)}"),
              sphere("mirror", "mirror", (0.42, 0.27, 0.85), 0.27),
              quad("room", "plaster", (5, -1, 8), (-10, 0, 0), (0, 6, 0)), "",
              "settings { width: 240 height: 180 spp: 16 depth: 3 method { exact {} } }"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    write_meshes()
    (HERE / "spectra").mkdir(exist_ok=True)
    shutil.copyfile(BOOTH / "spectra/tcs.sp", HERE / "spectra/tcs.sp")
    (HERE / "scene.txtpb").write_text(scene_text())
