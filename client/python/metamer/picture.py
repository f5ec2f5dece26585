"""Pictures: X Y Z as numpy arrays, put together of tiles in any order; files of them."""
import os
import pathlib
import struct
import zlib
from dataclasses import dataclass

import numpy as np

from metamer.errors import ProtocolError
from metamer.events import Tile
from metamer.factors import Factors
from metamer.srgb import to_srgb
from metamer.v1 import plan_pb2

MAX_PIXELS = 256 << 20  # as proto/PROTOCOL.md, Limits


class Film:
    """A picture on its way."""

    def __init__(self, width: int, height: int) -> None:
        if not 0 < width * height <= MAX_PIXELS:
            raise ProtocolError(f"the server plans a picture of {width} x {height} pixels")
        self.xyz = np.zeros((height, width, 3), np.float32)
        self._there = np.zeros((height, width), bool)

    def put(self, tile: Tile) -> None:
        """ProtocolError: it lies outside."""
        height, width = tile.xyz.shape[:2]
        rows, columns = slice(tile.y, tile.y + height), slice(tile.x, tile.x + width)
        if rows.stop > self.xyz.shape[0] or columns.stop > self.xyz.shape[1]:
            raise ProtocolError("a tile lies outside the picture")
        self.xyz[rows, columns] = tile.xyz
        self._there[rows, columns] = True

    @property
    def missing(self) -> int:
        """Pixels of which no tile has come."""
        return int(self._there.size - self._there.sum())


@dataclass(frozen=True)
class Picture:
    """`xyz`: (height, width, 3) float32, Y = 1 is the luminance of a perfect white that faces a light of luminance 1.
    `accuracy`: of a job that promised or verified something, else None. `factors`: for relighting; None where they were
    not kept, not asked for, or more than the server keeps. `record`: what rendered it, and how long each phase took of the
    clock and of processors; None of a server that keeps none."""

    job_id: int
    xyz: np.ndarray
    plan: plan_pb2.Plan
    timing: plan_pb2.Timing
    accuracy: plan_pb2.Accuracy | None = None
    factors: Factors | None = None
    record: plan_pb2.RunRecord | None = None

    def srgb(self, exposure: float = 1.0) -> np.ndarray:
        """(height, width, 3) uint8; see metamer.srgb."""
        return to_srgb(self.xyz, exposure)

    def save(self, file: str | os.PathLike[str], exposure: float = 1.0) -> None:
        """A .png of sRGB, 8 bit; or a .npy of `xyz`. ValueError: another ending."""
        path = pathlib.Path(file)
        if path.suffix == ".png":
            save_png(self.srgb(exposure), path)
        elif path.suffix == ".npy":
            np.save(path, self.xyz)
        else:
            raise ValueError(f"{path}: the ending is neither .png nor .npy")


def save_png(rgb: np.ndarray, file: str | os.PathLike[str]) -> None:
    """(height, width, 3) uint8 -> a .png that says that it is sRGB (ISO/IEC 15948)."""
    height, width, channels = rgb.shape
    if channels != 3 or rgb.dtype != np.uint8:
        raise ValueError("a .png is made of (height, width, 3) uint8")

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = np.concatenate([np.zeros((height, 1), np.uint8), rgb.reshape(height, 3 * width)], axis=1)  # 0: no filter
    pathlib.Path(file).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"sRGB", b"\0") + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))
