"""A scene that is looked at and changed, for asyncio. It belongs to its session and ends with it."""
import asyncio
from collections.abc import AsyncIterator, Iterable
from dataclasses import dataclass

import numpy as np
from google.protobuf.message import Message

from metamer.errors import InputError, ProtocolError, ViewClosed
from metamer.events import pixels
from metamer.exchange import Connection, Exchange
from metamer.v1 import jobs_pb2, material_pb2, plan_pb2, scene_pb2, views_pb2

_MAX_PIXELS = 4 << 20  # as proto/PROTOCOL.md, Limits


@dataclass(frozen=True)
class Frame:
    """`rgb`: (height, width, 3) uint8, as the settings' Development says; a fourth of the size for a first coarse look.
    `xyz`: (height, width, 3) float32 of a complete frame that was asked for with it, else None. `facts`: views.proto's
    Frame: revision, samples, complete, out_of_gamut, render and develop in seconds."""

    rgb: np.ndarray
    xyz: np.ndarray | None
    facts: views_pb2.Frame


class View:
    """`plan`: what is shown and how. One call is carried out at a time. Every call may raise ViewClosed, after which the
    view is gone, and what Session's calls raise."""

    def __init__(self, connection: Connection) -> None:
        self._exchange = Exchange(connection)
        self._lock = asyncio.Lock()
        self._view_id = 0
        self._revision = 0  # of the newest change
        self._asked = 0
        self._bands: list[views_pb2.FrameBand] = []
        self._newest: Frame | None = None
        self._probes = 0
        self.plan = plan_pb2.Plan()

    async def __aenter__(self) -> "View":
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.close()

    async def _open(self, request: views_pb2.OpenView) -> None:
        """InputError has the problems of a scene that is wrong."""
        self._exchange.__enter__()
        try:
            await self._exchange.send(request, "open_view")
            await self._updated(0)
        except BaseException as error:
            self._exchange.__exit__(None, None, None)
            if isinstance(error, ViewClosed) and error.kind == "BAD_INPUT":
                raise InputError("", error.problems) from None
            raise

    async def update(self, *, camera: scene_pb2.Camera | None = None, light: Iterable[scene_pb2.Light] = (),
                     material: Iterable[material_pb2.Material] = (), settings: scene_pb2.Settings | None = None
                     ) -> views_pb2.ViewUpdated:
        """Changes what is seen: whole lights and materials by their names, all settings; what is left out stays.
        InputError has the problems of a change that is wrong: the view stays as it was."""
        return await self._change(views_pb2.UpdateView(camera=camera, light=light, material=material, settings=settings))

    async def _change(self, change: views_pb2.UpdateView) -> views_pb2.ViewUpdated:
        async with self._lock:
            self._revision += 1
            change.view_id, change.revision = self._view_id, self._revision
            await self._exchange.send(change, "update_view")
            return await self._updated(self._revision)

    async def frame(self, xyz: bool = False) -> Frame:
        """The next frame: of the newest revision, with more samples than the one before. A complete one stays the same
        until something changes; with `xyz` it has these, too."""
        async with self._lock:
            newest = self._newest
            if newest and newest.facts.complete and (newest.xyz is not None or not xyz):
                return newest
            while True:
                if self._asked == 0:
                    self._asked = 1
                    await self._exchange.send(views_pb2.NextFrame(view_id=self._view_id, xyz=xyz), "next_frame")
                frame = await self._read("frame")
                # One that a call without asked for, and gave up, comes again with them.
                if not (xyz and frame.facts.complete and frame.xyz is None):
                    return frame

    async def frames(self, xyz: bool = False) -> AsyncIterator[Frame]:
        """One after the other, up to the complete one."""
        while True:
            frame = await self.frame(xyz)
            yield frame
            if frame.facts.complete:
                return

    async def probe(self, x: int, y: int, side: int = 1) -> views_pb2.Probed:
        """What is at a pixel of a complete frame, from the upper left; its `xyz` is the mean over a square of `side`
        pixels (1 to 64). LimitError: a place outside."""
        async with self._lock:
            self._probes += 1
            number = self._probes
            await self._exchange.send(views_pb2.Probe(view_id=self._view_id, number=number, x=x, y=y, side=side), "probe")
            while (probed := await self._read("probed")).number != number:
                pass
            return probed

    async def close(self) -> None:
        """Returns when the server has forgotten it. A second time does nothing."""
        async with self._lock:
            if self._view_id == 0:
                return
            try:
                await self._exchange.send(views_pb2.CloseView(view_id=self._view_id), "close_view")
                while True:
                    await self._read("closed")
            except ViewClosed:
                pass
            finally:
                self._view_id = 0
                self._exchange.__exit__(None, None, None)

    async def _updated(self, revision: int) -> views_pb2.ViewUpdated:
        while True:
            said = await self._read("updated", "refused")
            if said.revision != revision:
                continue  # of a call that was given up
            if isinstance(said, views_pb2.ViewRefused):
                raise InputError("the view stays as it was", said.problem)
            self._newest = None
            if said.HasField("plan"):
                self.plan = said.plan
            return said

    async def _read(self, *wanted: str) -> Message | Frame:
        """The next event of these kinds; keeps frames that come in between."""
        while True:
            message = await self._exchange.receive("view_event")
            self._view_id = message.view_id
            kind = message.WhichOneof("event")
            if kind == "closed":
                raise ViewClosed(message.closed.reason)
            if kind == "band":
                self._take_band(message.band)
                if not message.band.HasField("frame"):
                    continue
                kind, body = "frame", self._finish_frame(message.band.frame)
            elif kind is None:
                continue  # of a newer server
            else:
                body = getattr(message, kind)
            if kind in wanted:
                return body

    def _take_band(self, band: views_pb2.FrameBand) -> None:
        if not 0 < band.width * band.height <= _MAX_PIXELS:
            raise ProtocolError(f"the server sends a frame of {band.width} x {band.height} pixels")
        rows = sum(len(known.rgb) // (3 * known.width) for known in self._bands)
        if band.first_row != rows or any((known.width, known.height) != (band.width, band.height) for known in self._bands):
            raise ProtocolError("the bands of a frame do not fit each other")
        self._bands.append(band)

    def _finish_frame(self, facts: views_pb2.Frame) -> Frame:
        bands, self._bands = self._bands, []
        self._asked = max(0, self._asked - 1)
        width, height = bands[0].width, bands[0].height
        rgb = pixels(b"".join(band.rgb for band in bands), width, height, "u1")
        xyz = b"".join(band.xyz for band in bands)
        self._newest = Frame(rgb, pixels(xyz, width, height, "<f4") if xyz else None, facts)
        return self._newest


async def open_view(connection: Connection, scene_sha256: bytes, files: list[jobs_pb2.AssetName], backend: int) -> View:
    view = View(connection)
    await view._open(views_pb2.OpenView(scene_sha256=scene_sha256, asset=files, backend=backend))
    return view
