"""A session with a server, for asyncio: handshake, requests, jobs. Names are those of the wire and the command line."""
import asyncio
import math
import os
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from contextlib import aclosing

from metamer.address import parse_address
from metamer.credentials import Credentials, kept_credentials
from metamer.assembly import Assembly, finished_of
from metamer.errors import Disconnected, InputError, NoServer, ProtocolError, VersionError
from metamer.events import Event, Tile, make_event
from metamer.exchange import Connection, Exchange
from metamer.handle import Job, job_handle, job_number
from metamer.picture import Picture
from metamer.reach import reach
from metamer.scene import Asset, Scene, Submission, as_scene, make_submission
from metamer.spectra import SceneSpectra, Spectrum
from metamer.sweep import Value, shortened, variants
from metamer.v1 import assets_pb2, factors_pb2, jobs_pb2, plan_pb2, session_pb2
from metamer.view import View, open_view

PROTOCOL_VERSION = 1
CLIENT = "metamer-python 0.1.0"
WELCOME_SECONDS = 15.0  # a server may wait 5 s for its first worker, on a loaded machine twice that
_DIGESTS_AT_ONCE = 4096
_JOBS_AT_ONCE = 8  # of a sweep: half the watches that a session may have
_ONE_LIGHT = """camera { eye { z: 1 } target {} } light { name: "light" direction { z: -1 } spectrum {} } material { name: "m" }
object { name: "o" material: "m" sphere { center {} radius: 0.1 } } settings { width: 8 height: 8 }"""
SceneLike = Scene | str | os.PathLike[str]


class Session:
    """A connection after its handshake, of one event loop; several calls may be under way at once. `welcome` is what
    the server said of itself. Every call may raise Disconnected, ProtocolError and a ServerError."""

    def __init__(self, connection: Connection, welcome: session_pb2.Welcome) -> None:
        self._connection = connection
        self.welcome = welcome

    @classmethod
    async def connect(cls, server: str, credentials: Credentials | None = None) -> "Session":
        """`server`: unix:PATH, HOST:PORT or tls:HOST:PORT; `credentials`: None, those that `metamer login` has kept.
        Raises InputError, NoServer, VersionError, Unauthenticated, LimitError."""
        address = parse_address(server)
        if credentials is None:
            credentials = kept_credentials(str(address))
        connection = Connection(*await reach(address, credentials), str(address))
        try:
            hello = session_pb2.Hello(protocol_version=PROTOCOL_VERSION, client=CLIENT, token=credentials.token)
            async with asyncio.timeout(WELCOME_SECONDS):
                with Exchange(connection) as exchange:
                    await exchange.send(hello, "hello")
                    welcome = await exchange.receive("welcome")
            if welcome.protocol_version != PROTOCOL_VERSION:
                raise VersionError(session_pb2.Error(code=session_pb2.Error.VERSION, message=(
                    f"{address} speaks version {welcome.protocol_version} of the protocol, this program {PROTOCOL_VERSION}")))
        except BaseException as error:
            await connection.close()
            if isinstance(error, TimeoutError):
                raise NoServer(f"{address} did not answer the handshake within {WELCOME_SECONDS:g} s") from error
            raise
        connection.control_frame = welcome.limits.control_frame or connection.control_frame
        return cls(connection, welcome)

    @property
    def address(self) -> str:
        """Where the server is, for further sessions and for `metamer --server`."""
        return self._connection.server

    def handle(self, job_id: int) -> str:
        """What names the job elsewhere, too: "7@3f9c2a1b". All calls take it in place of the number, and raise InputError
        where it is of another server."""
        return job_handle(job_id, self.welcome.server_id)

    def _number(self, job: Job) -> int:
        return job_number(job, self.welcome.server_id)

    async def close(self) -> None:
        await self._connection.close()

    async def _ask(self, body, name: str, answer: str):
        with Exchange(self._connection) as exchange:
            await exchange.send(body, name)
            return await exchange.receive(answer)

    async def info(self) -> session_pb2.Info:
        """What the server can do, and how it is."""
        return await self._ask(session_pb2.GetInfo(), "get_info", "info")

    async def jobs(self, mine: bool = False) -> list[jobs_pb2.JobSummary]:
        """All that the server shows, oldest first; `mine`: an admin's own alone."""
        found: list[jobs_pb2.JobSummary] = []
        while True:
            last = found[-1].job_id if found else 0
            page = await self._ask(jobs_pb2.ListJobs(mine=mine, after=last), "list_jobs", "job_list")
            found += page.job
            if not page.more or not page.job or page.job[-1].job_id <= last:  # numbers rise, or it would have no end
                return found

    async def cancel(self, job: Job) -> jobs_pb2.JobSummary:
        """Ends a job and drops what it rendered. NotFound; StateError: it has ended."""
        return await self._ask(jobs_pb2.Cancel(job_id=self._number(job)), "cancel", "job_summary")

    async def pause(self, job: Job) -> jobs_pb2.JobSummary:
        """Stops a job and keeps its tiles. NotFound, StateError, LimitError."""
        return await self._ask(jobs_pb2.Pause(job_id=self._number(job)), "pause", "job_summary")

    async def resume(self, job: Job) -> jobs_pb2.JobSummary:
        """Goes on with a paused job. NotFound, StateError."""
        return await self._ask(jobs_pb2.Resume(job_id=self._number(job)), "resume", "job_summary")

    async def priority(self, job: Job, priority: int) -> jobs_pb2.JobSummary:
        """-100 to 100: higher first among the user's own jobs. NotFound, StateError, LimitError."""
        return await self._ask(jobs_pb2.Prioritize(job_id=self._number(job), priority=priority), "prioritize", "job_summary")

    async def submit(self, scene: SceneLike, *, name: str = "", check_only: bool = False, explain: bool = False,
                     keep_factors: bool = False, prepare: bool = False, priority: int = 0,
                     client_key: bytes | None = None, series: jobs_pb2.Series | None = None) -> int:
        """Sends what the server lacks, then the job; gives its number. The options are those of jobs.proto's Submit. The
        same scene under the same `client_key` (16 to 32 bytes; None: random) is one job, however often it is sent:
        after Disconnected it can be sent again. InputError has all files that are wrong."""
        submission = await asyncio.to_thread(lambda: make_submission(as_scene(scene)))
        await self._send_missing(submission)
        request = jobs_pb2.Submit(
            name=name or submission.name, scene_sha256=submission.scene.sha256, asset=submission.names(),
            check_only=check_only, explain=explain, keep_factors=keep_factors, backend=submission.backend,
            prepare=prepare, priority=priority, client_key=os.urandom(16) if client_key is None else client_key,
            series=series)
        return (await self._ask(request, "submit", "submitted")).job_id

    async def watch(self, job: Job, from_sequence: int = 0, *, tiles: bool = True, previews: bool = False,
                    factors: bool = False) -> AsyncIterator[Event]:
        """A job's events from that number on (0: all), until its last. It can be left early: contextlib.aclosing tells
        the server at once. NotFound; LimitError: too many watches; Closing."""
        ended = False
        request = jobs_pb2.Watch(job_id=self._number(job), from_sequence=from_sequence, tiles=tiles, previews=previews,
                                 factors=factors)
        with Exchange(self._connection) as exchange:
            await exchange.send(request, "watch")
            try:
                while not ended:
                    event = make_event(await exchange.receive("job_event"))
                    ended = event is not None and event.is_last
                    if event is not None:
                        yield event
            except (Disconnected, ProtocolError):
                ended = True
                raise
            finally:
                if not ended and not self._connection.lost:
                    # Nobody waits for the answer: the next request is read after this one.
                    with Exchange(self._connection) as leaving:
                        await leaving.send(jobs_pb2.Unwatch(watch=exchange.id), "unwatch")

    async def picture(self, job: Job, *, factors: bool = False) -> Picture:
        """Waits for a job and gives its picture; with its `factors`, where it keeps them. JobFailed, JobCancelled,
        NotFound; InputError: a check_only job."""
        assembly: Assembly | None = None
        async with aclosing(self.watch(job, factors=factors)) as events:
            async for event in events:
                if event.kind == "planned":
                    assembly = Assembly(event.body)
                elif isinstance(event.body, Tile):
                    if assembly is None:
                        raise ProtocolError("a tile came before the plan")
                    assembly.put(event.body)
                elif event.is_last:
                    finished = finished_of(event)
        if assembly is None or assembly.film.missing:
            raise InputError(f"job {job} has no picture")
        return assembly.picture(self._number(job), finished)

    async def render(self, scene: SceneLike, *, keep_factors: bool = False, **options) -> Picture:
        """submit() and picture(); a job that nobody waits for any more is cancelled."""
        job_id = await self.submit(scene, keep_factors=keep_factors, **options)
        try:
            return await self.picture(job_id, factors=keep_factors)
        except asyncio.CancelledError:
            await asyncio.shield(self.cancel(job_id))
            raise

    async def _planned(self, scene: SceneLike, **options) -> jobs_pb2.Planned:
        """What a job that is only checked says."""
        job_id = await self.submit(scene, check_only=True, **options)
        async with aclosing(self.watch(job_id, tiles=False, factors=True)) as events:
            async for event in events:
                if event.kind == "planned":
                    planned = event.body
                elif event.is_last:
                    finished_of(event)
        return planned

    async def check(self, scene: SceneLike) -> plan_pb2.Plan:
        """What would be rendered, with the plan's notices. JobFailed has all problems of the scene."""
        return (await self._planned(scene)).plan

    async def explain(self, scene: SceneLike) -> plan_pb2.Plan:
        """The same, and what each method would cost and miss: plan.prediction, plan.need, plan.unneeded."""
        return (await self._planned(scene, explain=True)).plan

    async def spectra(self, scene: SceneLike) -> SceneSpectra:
        """A scene's spectra and observer as the renderer has them; nothing is rendered. JobFailed as by check()."""
        planned = await self._planned(scene, keep_factors=True)
        return SceneSpectra.from_message(factors_pb2.SceneFactors.FromString(planned.factors))

    async def spectrum(self, word: str) -> Spectrum:
        """A light by the schema's word: "D65", "F11", "D:6504K", "2856K". JobFailed: no such word."""
        scene = Scene.parse(_ONE_LIGHT, name=word)
        scene.message.light[0].spectrum.standard = word
        return (await self.spectra(scene)).lights["light"]

    async def open_view(self, scene: SceneLike) -> View:
        """A scene to look at and change: async with await session.open_view(…) as view. InputError has the problems of a
        scene that is wrong; LimitError: too many views."""
        submission = await asyncio.to_thread(lambda: make_submission(as_scene(scene)))
        await self._send_missing(submission)
        return await open_view(self._connection, submission.scene.sha256, submission.names(), submission.backend)

    async def sweep(self, scene: SceneLike, parameters: Mapping[str, Sequence[Value]],
                    measure: Callable[[Picture], Mapping[str, object]] | None = None, **options) -> list[dict[str, object]]:
        """Renders a scene with all combinations of values, by the paths of fields (see metamer.sweep). A row for each: the
        values, `job_id`, `seconds` of rendering, and what `measure` says of the picture. `options`: those of render().
        The first that fails ends all. To `metamer jobs` they are one series."""
        places = asyncio.Semaphore(_JOBS_AT_ONCE)
        made = as_scene(scene)
        count = math.prod(len(values) for values in parameters.values())
        name, key = shortened(f"{options.get('name') or made.name}, sweep"), os.urandom(16)

        async def row(index: int, values: dict[str, Value], variant: Scene) -> dict[str, object]:
            label = shortened(" ".join(f"{path}={value}" for path, value in values.items()))
            series = jobs_pb2.Series(id=key, name=name, index=index, count=count, label=label)
            async with places:
                picture = await self.render(variant, series=series, **options)
            measured = measure(picture) if measure else {}
            return {**values, "job_id": picture.job_id, "seconds": picture.timing.render, **measured}

        try:
            async with asyncio.TaskGroup() as group:
                rows = [group.create_task(row(index, *one)) for index, one in enumerate(variants(made, parameters))]
        except ExceptionGroup as failed:
            raise failed.exceptions[0] from None
        return [task.result() for task in rows]

    async def _send_missing(self, submission: Submission) -> None:
        assets = {asset.sha256: asset for asset in (submission.scene, *submission.files)}
        limits = self.welcome.limits
        if len(assets) > limits.assets_per_job:
            raise InputError(f"the scene and its files are {len(assets)} assets; the server takes {limits.assets_per_job}")
        digests, missing = list(assets), []
        for at in range(0, len(digests), _DIGESTS_AT_ONCE):
            offer = assets_pb2.OfferAssets(sha256=digests[at : at + _DIGESTS_AT_ONCE])
            missing += (await self._ask(offer, "offer_assets", "missing_assets")).sha256
        for digest in missing:
            if digest not in assets:
                raise ProtocolError("the server misses an asset that was not offered")
            await self._send(assets[digest])

    async def _send(self, asset: Asset) -> None:
        limits = self.welcome.limits
        if asset.size > limits.asset:
            raise InputError(f"{asset.name} has {asset.size} bytes; the server takes {limits.asset}")
        offset = 0
        with Exchange(self._connection) as exchange:
            for piece in asset.pieces(min(max(limits.chunk, 1), 4 << 20)):
                if exchange.has_answer:  # so early it can only be a refusal
                    break
                chunk = assets_pb2.AssetChunk(sha256=asset.sha256, size=asset.size, offset=offset, data=piece)
                await exchange.send(chunk, "asset_chunk")
                offset += len(piece)
            await exchange.receive("asset_stored")
