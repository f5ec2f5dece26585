#!/usr/bin/env python3
"""Writes ../meshes/tumbler.ply and wine.ply: solids of revolution for ../glass.txtpb, in metres, with their normals. The liquid
reaches half into the glass, which has the higher priority."""
import math
import pathlib
import struct

AROUND = 96  # vertices of a circle


def arc(center, radius, first, last, steps=8):
    """Points of a circle in the (r, y) plane, by degrees from the r axis."""
    for i in range(steps + 1):
        angle = math.radians(first + (last - first) * i / steps)
        yield center[0] + radius * math.cos(angle), center[1] + radius * math.sin(angle)


def solid(profile):
    """A profile from the axis below, outside up, to the axis above: points and faces, outwards counter-clockwise."""
    points, faces = [], []
    for k, (r, y) in enumerate(profile):
        before, after = profile[max(k - 1, 0)], profile[min(k + 1, len(profile) - 1)]
        slope = math.atan2(after[1] - before[1], after[0] - before[0]) - math.pi / 2  # of the normal
        ends = k in (0, len(profile) - 1)
        for j in range(AROUND):
            angle = 2 * math.pi * j / AROUND
            c, s = math.cos(angle), math.sin(angle)
            normal = (0, -1 if k == 0 else 1, 0) if ends else (math.cos(slope) * c, math.sin(slope), -math.cos(slope) * s)
            points.append(((r * c, y, -r * s), normal))
    for k in range(len(profile) - 1):
        for j in range(AROUND):
            a, b = k * AROUND + j, k * AROUND + (j + 1) % AROUND
            if profile[k][0] > 0:
                faces.append((a, b, b + AROUND))
            if profile[k + 1][0] > 0:
                faces.append((a, b + AROUND, a + AROUND))
    return points, faces


def write(name, profile):
    points, faces = solid(profile)
    head = "ply\nformat binary_little_endian 1.0\n" + f"element vertex {len(points)}\n"
    head += "".join(f"property float {p}\n" for p in ("x", "y", "z", "nx", "ny", "nz"))
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    file = pathlib.Path(__file__).parent.parent / "meshes" / name
    with file.open("wb") as out:
        out.write(head.encode())
        for place, normal in points:
            out.write(struct.pack("<6f", *place, *normal))
        for face in faces:
            out.write(struct.pack("<B3i", 3, *face))


def main():
    rim = (0.039, 0.0985)
    tumbler = [(0, 0), (0.015, 0), (0.027, 0), *arc((0.029, 0.003), 0.003, -90, 5), (0.0345, 0.045), (0.0385, 0.080),
               *arc(rim, 0.0015, 0, 180), (0.0355, 0.080), (0.0315, 0.045), *arc((0.0265, 0.017), 0.004, 5, -90), (0.012, 0.013),
               (0, 0.013)]
    wine = [(0, 0.010), (0.012, 0.010), (0.024, 0.010), *arc((0.026, 0.014), 0.004, -90, 5), (0.033, 0.045), (0.0352, 0.0620),
            (0.0353, 0.0630), (0.0345, 0.0632), (0.02, 0.0632), (0, 0.0632)]
    write("tumbler.ply", tumbler)
    write("wine.ply", wine)


main()
