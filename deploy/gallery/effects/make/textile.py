"""Writes the cloth of ../textile.txtpb: its print, its mesh, its ink and both paints. Python 3 alone.

The print has two inks on dyed cloth. The ornament's ink is a metamer of the cloth under D65
(deploy/booth/spectra/paint-2.txt on paint-1.txt): by daylight it can't be seen. The stripes are indigo,
made by Kubelka and Munk's formula from a Gaussian band of absorption at 650 nm.
"""
import math
import struct
import zlib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent
SIZE = 768


def ornament(u, v):
    """1 within a lattice of eight-petalled flowers and the rings around them."""
    x, y = (u * 4.5 + 0.25) % 1 - 0.5, ((v - 1 / 6) * 3) % 1 - 0.5
    r, angle = math.hypot(x, y), math.atan2(y, x)
    petal = r < 0.20 + 0.13 * math.cos(8 * angle)
    ring = 0.38 < r < 0.43
    return float((petal and r > 0.06) or ring)


def stripes(u, v):
    """1 within the borders above and below, and their row of lozenges."""
    edge = min(v, 1 - v)
    lozenge = abs((u * 12) % 1 - 0.5) / 0.5 + abs(edge - 0.105) / 0.025 < 1
    return float(0.05 < edge < 0.07 or 0.14 < edge < 0.15 or lozenge)


def shares(i, j):
    """Two bytes, the means over a pixel's 3 x 3 parts, row j from the top; the third is not used."""
    ink = [0.0, 0.0]
    for a in range(3):
        for b in range(3):
            u, v = (i + (a + 0.5) / 3) / SIZE, 1 - (j + (b + 0.5) / 3) / SIZE
            band = stripes(u, v)
            ink[1] += band / 9
            ink[0] += (1 - band) * ornament(u, v) / 9 if 1 / 6 < v < 5 / 6 else 0
    return bytes([round(255 * ink[0]), round(255 * ink[1]), 0])


def png(path, rows):
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    path.write_bytes(b"\x89PNG\r\n\x1a\n"
                     + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + row for row in rows), 9))
                     + chunk(b"IEND", b""))


def cloth(path, columns=96, rows=24):
    """A curtain of 2.4 x 1.6 m in folds that grow downwards."""
    lines = ["# a curtain, by deploy/gallery/effects/make/textile.py"]
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            depth = 0.07 * (1.3 - v)
            z = depth * math.sin(2 * math.pi * 4.5 * u + 0.6 * math.sin(3 * v))
            lines.append(f"v {2.4 * (u - 0.5):.5f} {1.6 * v:.5f} {z:.5f}")
            lines.append(f"vt {u:.5f} {v:.5f}")
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i + 1
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            lines.append(f"f {a}/{a} {b}/{b} {c}/{c} {d}/{d}")
    path.write_text("\n".join(lines) + "\n")


def indigo(path):
    lines = ["# indigo on cotton: reflectance; wavelength in nm, value. K/S = 0.5 + 9 exp(-((nm - 650) / 90)^2),",
             "# R = 1 + K/S - sqrt((K/S)^2 + 2 K/S) (Kubelka and Munk, 1931); by deploy/gallery/effects/make/textile.py"]
    for nm in range(380, 781, 10):
        ks = 0.5 + 9 * math.exp(-(((nm - 650) / 90) ** 2))
        lines.append(f"{nm} {1 + ks - math.sqrt(ks * ks + 2 * ks):.6f}")
    path.write_text("\n".join(lines) + "\n")


png(FOLDER / "pictures/print.png", [b"".join(shares(i, j) for i in range(SIZE)) for j in range(SIZE)])
cloth(FOLDER / "meshes/cloth.obj")
indigo(FOLDER / "spectra/indigo.txt")
for paint in ("paint-1.txt", "paint-2.txt"):  # a scene's files lie in its folder
    source = FOLDER.parent.parent / "booth/spectra" / paint
    (FOLDER / "spectra" / paint).write_bytes(source.read_bytes())
