"""Frames: a length of four bytes, big-endian, and as many bytes of an Envelope. Nothing is read whose length is over a
limit, and nothing large is parsed that is not plain bytes (proto/PROTOCOL.md, Frames)."""
import asyncio
import struct

from google.protobuf.message import DecodeError

from metamer.errors import ProtocolError
from metamer.v1 import envelope_pb2, jobs_pb2

MAX_CONTROL_FRAME = 256 << 10
MAX_FRAME = (4 << 20) + 1024
_HEADER = struct.Struct(">I")
_TLS_RECORDS = (0x1503, 0x1603)  # an alert, a handshake: no frame is so long
_FEW = 8  # fields of a message whose frame may be large

Envelope = envelope_pb2.Envelope


def encode(envelope: Envelope) -> bytes:
    payload = envelope.SerializeToString()
    return _HEADER.pack(len(payload)) + payload


async def read_envelope(reader: asyncio.StreamReader) -> Envelope:
    """The next message. Raises ProtocolError, and asyncio.IncompleteReadError or OSError where the connection ends."""
    (size,) = _HEADER.unpack(await reader.readexactly(_HEADER.size))
    if size >> 16 in _TLS_RECORDS:
        raise ProtocolError("the server speaks TLS there: put tls: before its address")
    if not 0 < size <= MAX_FRAME:
        raise ProtocolError(f"the server sends a frame of {size} bytes; at most {MAX_FRAME} are allowed")
    payload = await reader.readexactly(size)
    if size > MAX_CONTROL_FRAME and not is_bulk(payload):
        raise ProtocolError(f"the server sends a control message of {size} bytes; at most {MAX_CONTROL_FRAME} are allowed")
    try:
        return Envelope.FromString(payload)
    except DecodeError as error:
        raise ProtocolError("the server sends bytes that are no message") from error


def is_bulk(payload: bytes) -> bool:
    """Whether a large frame is what may be large: a Tile, a Preview, or a Planned with factors, each of few fields. It
    is looked at before it is parsed, as parsed messages can be 128 times as large as their bytes."""
    event = _only_submessage(payload, {Envelope.JOB_EVENT_FIELD_NUMBER})
    if event is None:
        return False
    planned = _only_submessage(event, {jobs_pb2.JobEvent.PLANNED_FIELD_NUMBER})
    if planned is not None:
        fields = _few_fields(planned)
        return fields is not None and all(number == jobs_pb2.Planned.FACTORS_FIELD_NUMBER or len(held) <= MAX_CONTROL_FRAME
                                          for number, held in fields)
    picture = _only_submessage(event, {jobs_pb2.JobEvent.TILE_FIELD_NUMBER, jobs_pb2.JobEvent.PREVIEW_FIELD_NUMBER})
    return picture is not None and _few_fields(picture) is not None


def _only_submessage(message: bytes | memoryview, numbers: set[int]) -> memoryview | None:
    """The one large field of a message of few fields, if its number is one of these."""
    large = [(number, held) for number, held in _few_fields(message) or () if len(held) > MAX_CONTROL_FRAME // 2]
    return large[0][1] if len(large) == 1 and large[0][0] in numbers else None


def _few_fields(message: bytes | memoryview) -> list[tuple[int, memoryview]] | None:
    """Numbers and bytes (of numbers: none) of at most eight fields; None where it has more, or groups."""
    view, at, fields = memoryview(message), 0, []
    try:
        while at < len(view):
            key, at = _varint(view, at)
            kind, begin = key & 7, at
            if kind == 0:
                begin = at = _varint(view, at)[1]
            elif kind == 2:
                size, begin = _varint(view, at)
                at = begin + size
            elif kind in (1, 5):
                begin = at = at + (8 if kind == 1 else 4)
            else:
                return None
            if at > len(view) or len(fields) == _FEW:
                return None
            fields.append((key >> 3, view[begin:at]))
    except IndexError:
        return None
    return fields


def _varint(view: memoryview, at: int) -> tuple[int, int]:
    value = 0
    for i in range(10):
        value |= (view[at + i] & 0x7F) << 7 * i
        if view[at + i] < 0x80:
            return value, at + i + 1
    raise IndexError
