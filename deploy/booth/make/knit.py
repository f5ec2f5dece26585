#!/usr/bin/env python3
"""Writes meshes/knit.ply: a knitted swatch that hangs over a rail; python3 alone.

Rows of yarn in stockinette stitch: each row is one tube along a curve of interlocking loops,
drawn flat in stitches and rows and then laid over the rail. Lengths in metres."""

from math import cos, pi, sin, sqrt
from pathlib import Path

from ply import write_ply

MESHES = Path(__file__).parent.parent / "meshes"

STITCHES, ROWS = 13, 17
SEGMENTS, SIDES = 16, 6     # of the tube: along one stitch, around it
WIDTH, LENGTH = 0.42, 0.60  # of the swatch
RAIL = 0.05                 # radius of the bend over the rail
BACK = 0.16                 # length that hangs down behind it
STITCH, ROW = WIDTH / STITCHES, LENGTH / ROWS
YARN = 0.0100               # radius of the yarn


def over_the_rail(u, v, out):
    """A point of the flat cloth (u across, v along it, `out` above its face) in space."""
    bend = pi * RAIL
    if v < BACK:
        y, z, normal_y, normal_z = v - BACK, -RAIL, 0.0, -1.0
    elif v < BACK + bend:
        angle = (v - BACK) / RAIL
        normal_y, normal_z = sin(angle), -cos(angle)
        y, z = RAIL * normal_y, RAIL * normal_z
    else:
        fall = v - BACK - bend
        y, z, normal_y, normal_z = -fall, RAIL + 0.22 * fall * fall, 0.0, 1.0
    ripple = 0.010 * sin(2 * pi * u / (0.62 * WIDTH)) * max(0.0, v - BACK) / LENGTH
    return (u, y + out * normal_y, z + (out + ripple) * normal_z)


def yarn_centre(row, t):
    """The yarn of a row at t, 2 pi a stitch: a loop that leans over its neighbours."""
    u = STITCH * (t / (2 * pi) + 0.27 * sin(2 * t)) - WIDTH / 2
    v = ROW * (row + 0.85 - 0.80 * cos(t))
    return over_the_rail(u, v, 0.0075 * -cos(2 * t))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def unit(a):
    length = sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def tube(points, vertices, triangles):
    """A tube around a curve; its frame is carried along without turning."""
    first = len(vertices)
    tangent = unit(minus(points[1], points[0]))
    side = unit(cross(tangent, (0.3, 0.9, 0.2)))
    for i, point in enumerate(points):
        ahead, behind = points[min(i + 1, len(points) - 1)], points[max(i - 1, 0)]
        tangent = unit(minus(ahead, behind))
        along = dot(side, tangent)
        side = unit(minus(side, tuple(along * x for x in tangent)))
        other = cross(tangent, side)
        for k in range(SIDES):
            c, s = cos(2 * pi * k / SIDES), sin(2 * pi * k / SIDES)
            normal = tuple(c * a + s * b for a, b in zip(side, other))
            vertices.append(tuple(p + YARN * n for p, n in zip(point, normal)) + normal)
    for i in range(len(points) - 1):
        for k in range(SIDES):
            a, b = first + i * SIDES + k, first + i * SIDES + (k + 1) % SIDES
            triangles += [(a, b, b + SIDES), (a, b + SIDES, a + SIDES)]


if __name__ == "__main__":
    vertices, triangles = [], []
    for row in range(ROWS):
        steps = STITCHES * SEGMENTS
        tube([yarn_centre(row, 2 * pi * i / SEGMENTS) for i in range(steps + 1)],
             vertices, triangles)
    write_ply(MESHES / "knit.ply", "a knitted swatch, by deploy/booth/make/knit.py",
              vertices, triangles)
    print(f"knit.ply: {len(triangles)} triangles, {len(vertices)} vertices")
