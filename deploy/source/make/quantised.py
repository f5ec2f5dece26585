"""The sum over 301 samples in numbers of few bits, as a graphics card of the source's day would have kept them: from the spectral
picture, by numpy."""

import struct
import sys
import zlib

import numpy as np
from PIL import Image

from run import OUT, ROOT, render

sys.path.insert(0, str(ROOT / "deploy/booth/make"))
from cie import observer  # noqa: E402

SRGB = np.array([[3.2406255, -1.5372080, -0.4986286], [-0.9689307, 1.8757561, 0.0415175],
                 [0.0557101, -0.2040211, 1.0569959]])  # of X Y Z, IEC 61966-2-1
SAMPLES = ("--method", "point", "--samples", "400:700:1", "--point-lights", "samples", "--depth", 0)


def attributes(data):
    """The head of an OpenEXR file: attributes, and where its table of offsets begins."""
    found, at = {}, 8
    while data[at] != 0:
        name, kind, rest = data[at:at + 512].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        found[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    return found, at + 1


def channels(block):
    names, at = [], 0
    while block[at] != 0:
        end = block.index(b"\0", at)
        if struct.unpack_from("<i", block, end + 1)[0] != 2:
            raise ValueError("not a channel of 32-bit floats")
        names.append(block[at:end].decode())
        at = end + 17
    return names


def unzipped(block, size):
    """Bytes by their differences, those of even places before those of odd ones."""
    if len(block) >= size:
        return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    steps[1:] -= 128
    plain = (np.cumsum(steps) & 255).astype(np.uint8)
    joined = np.empty(size, np.uint8)
    joined[0::2], joined[1::2] = plain[:(size + 1) // 2], plain[(size + 1) // 2:]
    return joined.tobytes()


def read_exr(file):
    """Names, and an array (channel, row, column), of a file by scan lines with ZIP, ZIPS or no compression."""
    data = file.read_bytes()
    head, at = attributes(data)
    names, lines = channels(head["channels"]), {0: 1, 2: 1, 3: 16}[head["compression"][0]]
    left, top, right, bottom = struct.unpack("<4i", head["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    values = np.empty((height, len(names), width), np.float32)
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, packed = struct.unpack_from("<ii", data, offset)
        rows = min(lines, bottom + 1 - y)
        plain = unzipped(data[offset + 8:offset + 8 + packed], rows * len(names) * width * 4)
        values[y - top:y - top + rows] = np.frombuffer(plain, "<f4").reshape(rows, len(names), width)
    return names, values.transpose(1, 0, 2)


def encoded(xyz):
    linear = np.clip(np.tensordot(SRGB, xyz, 1), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def pictures(scene):
    """The picture of the sum of 301 samples, and words → pictures of the sum of rounded ones."""
    file = OUT / "samples.exr"
    render(scene, file, *SAMPLES, "--exr", "spectral:400:700:1")
    names, values = read_exr(file)
    spectral = [name for name in names if name.startswith("S0.")]
    nm = np.array([float(name[3:-2].replace(",", ".")) for name in spectral])
    light = values[[names.index(name) for name in spectral]].astype(np.float64)
    curves = np.array(observer(nm.tolist()))
    top = light.max()

    def summed(rounded, kind=np.float64):
        xyz = np.zeros((3, *light.shape[1:]), kind)
        for curve, plane in zip(curves.T, rounded):
            xyz += (curve[:, None, None] * plane).astype(kind)
        return xyz.astype(np.float64)

    scale = summed_luminance(file.with_suffix(".xyz.exr"), scene) / summed(light)[1].mean()
    kept = {"plain": summed(light),
            "16-bit floats": summed(light.astype(np.float16), np.float16),
            "8 bits, stretched": summed(np.round(light / top * 255) / 255 * top),
            "8 bits": summed(np.round(light * scale * 255) / 255 / scale)}
    files = {}
    for name, xyz in kept.items():
        files[name] = OUT / f"quantised-{len(files)}.png"
        rgb = encoded(xyz * scale).transpose(1, 2, 0)
        Image.fromarray(np.round(rgb * 255).astype(np.uint8)).save(files[name])
    return files.pop("plain"), files


def summed_luminance(file, scene):
    """The mean Y of the same picture."""
    render(scene, file, *SAMPLES, "--exr", "xyz")
    names, values = read_exr(file)
    return values[names.index("Y")].mean()
