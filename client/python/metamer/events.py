"""What happens to a job, as objects; pixels are numpy arrays. Arrays of the wire are held to their sizes before use."""
from dataclasses import dataclass

import numpy as np
from google.protobuf.message import Message

from metamer.errors import ProtocolError
from metamer.v1 import jobs_pb2

LAST = {"finished", "failed", "cancelled"}  # of a job's events


@dataclass(frozen=True)
class Tile:
    """A finished rectangle of a picture. `xyz`: (height, width, 3) float32, Y = 1 is a light's luminance.
    `factors`: a TileFactors, serialised, if the job keeps them and the watch asks for them; else empty."""

    x: int
    y: int
    xyz: np.ndarray
    factors: bytes


@dataclass(frozen=True)
class Preview:
    """The whole picture so far, reduced. `rgb`: (height, width, 3) uint8, sRGB."""

    rgb: np.ndarray


@dataclass(frozen=True)
class Event:
    """`sequence` rises; to go on after a lost connection, watch from one more. `time`: seconds since the job was
    submitted. `kind`: as jobs.proto names it: "queued" "started" "planned" "progress" "tile" "preview" "paused"
    "retrying" "preparing" "prepared", and last "finished", "failed" or "cancelled". `body`: a Tile, a Preview, else
    the message of that name."""

    job_id: int
    sequence: int
    time: float
    kind: str
    body: Tile | Preview | Message

    @property
    def is_last(self) -> bool:
        return self.kind in LAST


def pixels(data: bytes, width: int, height: int, dtype: str) -> np.ndarray:
    """(height, width, 3) of what the wire has row by row. ProtocolError: bytes of another number."""
    kind = np.dtype(dtype)
    if width == 0 or height == 0 or len(data) != width * height * 3 * kind.itemsize:
        raise ProtocolError(f"the server sends {len(data)} bytes for {width} x {height} pixels")
    return np.frombuffer(data, kind).reshape(height, width, 3)


def make_event(message: jobs_pb2.JobEvent) -> Event | None:
    """None: an event that this client does not know, of a newer server."""
    kind = message.WhichOneof("event")
    if kind is None:
        return None
    body = getattr(message, kind)
    if kind == "tile":
        body = Tile(body.x, body.y, pixels(body.xyz, body.width, body.height, "<f4"), body.factors)
    elif kind == "preview":
        body = Preview(pixels(body.rgb, body.width, body.height, "u1"))
    return Event(message.job_id, message.sequence, message.time, kind, body)
