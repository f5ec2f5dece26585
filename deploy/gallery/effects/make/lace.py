"""Writes the pictures of ../lace.txtpb: lace (alpha), linen (heights) and a tile (normals). Python 3 alone."""
import math
import struct
import zlib
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent / "pictures"


def png(name, width, height, color_type, pixel):
    """`pixel`: of a column and a row from the top, to the bytes of its channels; 8 bits, 0 grey or 2 RGB."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = b"".join(b"\0" + b"".join(bytes(pixel(i, j)) for i in range(width)) for j in range(height))
    (FOLDER / name).write_bytes(b"\x89PNG\r\n\x1a\n"
                                + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0))
                                + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def thread(u, v):
    """1 on a thread of the lace: 6 x 5 flowers in a net, between a hem above and scallops below."""
    if v > 0.94:
        return 1
    scallop = 0.09 - 0.06 * abs(math.cos(math.pi * 6 * u))
    if v < scallop:
        return 0
    if v < scallop + 0.025:
        return 1
    x, y = (u * 6) % 1 - 0.5, (v * 5) % 1 - 0.5
    r, angle = math.hypot(x, y), math.atan2(y, x)
    petal = 0.07 < r < 0.22 + 0.13 * math.cos(6 * angle)
    ring = 0.40 < r < 0.44
    net = abs((u * 48 + v * 40) % 1 - 0.5) < 0.09 or abs((u * 48 - v * 40) % 1 - 0.5) < 0.09
    return petal or ring or (net and r > 0.44) or (r < 0.4 and abs((angle * 12 / math.pi) % 1 - 0.5) < 0.1)


def lace(size):
    def share(i, j):  # the mean over a pixel's 3 x 3 parts
        parts = [thread((i + (a + 0.5) / 3) / size, 1 - (j + (b + 0.5) / 3) / size) for a in range(3) for b in range(3)]
        return [round(255 * sum(map(float, parts)) / 9)]
    png("lace.png", size, size, 0, share)


def linen(size):
    """Two threads by two of a plain weave."""
    def height(i, j):
        x, y = 2 * (i + 0.5) / size, 2 * (j + 0.5) / size

        def over(across, along, number):
            return math.sin(math.pi * (across % 1)) * (0.6 + 0.4 * math.cos(math.pi * (along - 0.5 + number)))
        return [round(255 * max(over(x, y, int(x)), over(y, x, int(y) + 1)))]
    png("linen.png", size, size, 0, height)


def relief(x, y):
    """The height of a tile at -1 to 1, in half tiles: a rosette in a frame."""
    r, angle = math.hypot(x, y), math.atan2(y, x)
    petals = 0.10 * max(0.0, 1 - (r / (0.62 + 0.16 * math.cos(8 * angle))) ** 4)
    boss = 0.10 * math.sqrt(max(0.0, 1 - (r / 0.22) ** 2))
    edge = max(abs(x), abs(y))
    frame = 0.05 * math.exp(-(((edge - 0.88) / 0.035) ** 2)) - 0.12 * max(0.0, (edge - 0.95) / 0.05)
    return petals + boss + frame


def tile(size):
    def normal(i, j):
        x, y, step = 2 * (i + 0.5) / size - 1, 1 - 2 * (j + 0.5) / size, 1 / size
        n = [-(relief(x + step, y) - relief(x - step, y)) / (2 * step),
             -(relief(x, y + step) - relief(x, y - step)) / (2 * step), 1]
        length = math.sqrt(sum(c * c for c in n))
        return [round(128 + 127 * c / length) for c in n]
    png("tile.png", size, size, 2, normal)


lace(768)
linen(64)
tile(256)
