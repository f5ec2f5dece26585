#!/usr/bin/env python3
"""Writes ../pictures/studio.exr: a photographer's studio as a latitude-longitude picture of R G B, half floats without
compression (openexr.com, "OpenEXR File Layout"). Needs nothing but Python.

A floor, walls that fade upwards, and lamps: a large neutral one to the left, a narrow warm one to the right, a bluish
window behind the eye, a round one above."""
import math
import struct
import sys
from pathlib import Path

WIDTH, HEIGHT = 160, 80


def direction(x, y):
    polar, turn = math.pi * (y + 0.5) / HEIGHT, 2 * math.pi * ((x + 0.5) / WIDTH - 0.5)
    return math.sin(polar) * math.sin(turn), math.cos(polar), -math.sin(polar) * math.cos(turn)


def soft(value, low, high):
    """1 between the two, falling to 0 over 3 degrees outside."""
    out = max(low - value, value - high, 0) / 3
    return max(0.0, 1 - out) ** 2


def radiance(x, y):
    dx, dy, dz = direction(x, y)
    height = math.degrees(math.asin(dy))
    turn = math.degrees(math.atan2(dx, -dz))  # 0: -z, -90: -x
    if height < 0:
        walls = 0.10 + 0.05 * math.exp(height / 12)
        base = (walls, walls * 0.97, walls * 0.93)
    else:
        walls = 0.16 + 0.22 * math.exp(-height / 25)
        base = (walls, walls, walls * 1.03)
    lamps = [
        ((9, 9, 9), soft(turn, -95, -45) * soft(height, 5, 60)),            # the key
        ((7, 4.2, 2.1), soft(turn, 70, 82) * soft(height, -5, 65)),         # a warm strip
        ((1.3, 1.9, 2.8), soft(abs(turn), 140, 180) * soft(height, 12, 45)),  # the window
        ((14, 14, 14), soft(90 - height, 0, 14)),                           # above
    ]
    return [b + sum(lamp[i] * share for lamp, share in lamps) for i, b in enumerate(base)]


def attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def exr(pixels):
    channels = b"".join(c + b"\0" + struct.pack("<iiii", 1, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<iiii", 0, 0, WIDTH - 1, HEIGHT - 1)
    head = b"\x76\x2f\x31\x01\x02\0\0\0" + b"".join([
        attribute("channels", "chlist", channels),
        attribute("compression", "compression", b"\0"),
        attribute("dataWindow", "box2i", window),
        attribute("displayWindow", "box2i", window),
        attribute("lineOrder", "lineOrder", b"\0"),
        attribute("pixelAspectRatio", "float", struct.pack("<f", 1)),
        attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0)),
        attribute("screenWindowWidth", "float", struct.pack("<f", 1)),
    ]) + b"\0"
    row = 6 * WIDTH
    first = len(head) + 8 * HEIGHT
    places = b"".join(struct.pack("<Q", first + y * (8 + row)) for y in range(HEIGHT))
    rows = b"".join(struct.pack("<ii", y, row) + b"".join(
        struct.pack(f"<{WIDTH}e", *(pixels[y][x][c] for x in range(WIDTH))) for c in (2, 1, 0))
        for y in range(HEIGHT))
    return head + places + rows


def main():
    target = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[1] / "pictures/studio.exr")
    target.write_bytes(exr([[radiance(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]))


main()
