"""What the tests of client/python share: the programs of this build, small scenes, and readers of the .exr and .png
that `metamer` writes."""
import os
import pathlib
import struct
import subprocess
import zlib

import numpy as np

import metamer

BIN = pathlib.Path(os.environ["METAMER_BIN"])
SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"

# A white quad that faces the camera and a light at the eye: Y is the light's luminance times 0.5 in the middle.
SCENE = """
camera { eye { z: 4 } target {} vertical_fov: 20 }
light { name: "key" direction { z: -1 } luminance: 0.8 spectrum { standard: "D65" } }
material { name: "grey" diffuse { constant: 0.5 } }
object { name: "wall" material: "grey" quad { corner { x: -4 y: -4 } u { x: 8 } v { y: 8 } } }
settings { width: 32 height: 16 spp: 1 tile_size: 8 method { exact {} } }
"""


def local() -> metamer.Server:
    return metamer.local(BIN / "metamerd")


def scene(**settings) -> metamer.Scene:
    made = metamer.Scene.parse(SCENE)
    for name, value in settings.items():
        setattr(made.message.settings, name, value)
    return made


def run(*words: str) -> None:
    """`metamer` with these words, which has to succeed."""
    ended = subprocess.run([BIN / "metamer", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert ended.returncode == 0, ended.stdout


def read_exr(file: pathlib.Path) -> np.ndarray:
    """(height, width, 3) float32 of an .exr of X, Y and Z by `metamer`: scan lines, zip (the OpenEXR file layout)."""
    data = file.read_bytes()
    at, attributes = 8, {}
    while data[at]:
        name, kind = (word.decode() for word in data[at : at + 80].split(b"\0", 2)[:2])
        at += len(name) + len(kind) + 2
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    assert attributes["compression"] == b"\3" and attributes["channels"].count(struct.pack("<i", 2)) >= 3
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    picture = np.empty((height, width, 3), np.float32)
    for (place,) in struct.iter_unpack("<Q", data[at + 1 : at + 1 + 8 * -(-height // 16)]):
        row, size = struct.unpack_from("<ii", data, place)
        rows = min(16, height - row)
        bytes_ = np.frombuffer(data, np.uint8, size, place + 8)
        if size < rows * width * 12:  # else stored as it is
            steps = np.frombuffer(zlib.decompress(bytes_), np.uint8).astype(np.int64)
            steps[1:] -= 128
            halves = np.cumsum(steps).astype(np.uint8)
            bytes_ = np.empty_like(halves)
            bytes_[0::2], bytes_[1::2] = np.split(halves, [(halves.size + 1) // 2])
        picture[row : row + rows] = bytes_.view("<f4").reshape(rows, 3, width).transpose(0, 2, 1)
    return picture


def read_png(file: pathlib.Path) -> np.ndarray:
    """(height, width, 3) uint8 of a .png of 8 bit R G B (ISO/IEC 15948, 9)."""
    data, at, packed = file.read_bytes(), 8, b""
    while at < len(data):
        size, name = struct.unpack_from(">I4s", data, at)
        if name == b"IHDR":
            width, height, depth, kind = struct.unpack_from(">IIBB", data, at + 8)
            assert (depth, kind) == (8, 2)
        packed += data[at + 8 : at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 3 * width)
    picture = np.zeros((height + 1, width + 1, 3), np.int64)  # with a row and a column of 0 before
    for y, row in enumerate(rows, 1):
        for x, pixel in enumerate(row[1:].reshape(width, 3), 1):
            left, up, corner = picture[y, x - 1], picture[y - 1, x], picture[y - 1, x - 1]
            far = abs(left + up - corner - np.stack([left, up, corner]))
            nearest = np.choose(far.argmin(0), [left, up, corner])
            picture[y, x] = (pixel + (0, left, up, (left + up) // 2, nearest)[row[0]]) % 256
    return picture[1:, 1:].astype(np.uint8)
