"""Requests under way on one connection: answers find who asked by their request id. One event loop."""
import asyncio
from collections import deque
from types import TracebackType

from google.protobuf.message import Message

from metamer.errors import Disconnected, InputError, MetamerError, ProtocolError, server_error
from metamer.frames import MAX_CONTROL_FRAME, Envelope, encode, read_envelope

# What may wait for watchers that do not look, before no more is read: a few tiles' worth.
MAX_WAITING = 64 << 20


class Connection:
    """Sends messages and hands out what comes. Once it is lost every call raises why."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter, server: str) -> None:
        self.server = server
        self.lost: MetamerError | None = None
        self.control_frame = MAX_CONTROL_FRAME  # the server's limit, once it is known
        self._reader, self._writer = reader, writer
        self._exchanges: dict[int, Exchange] = {}
        self._last_id = 0
        self._may_read = asyncio.Event()
        self._may_read.set()
        self._reading = asyncio.create_task(self._read_all())

    async def send(self, request_id: int, body: Message, name: str) -> None:
        """Writes an Envelope whose body `name` is `body`."""
        if self.lost:
            raise self.lost
        envelope = Envelope(request_id=request_id, **{name: body})
        if name != "asset_chunk" and envelope.ByteSize() > self.control_frame:
            raise InputError(f"a request of {envelope.ByteSize()} bytes is over the server's limit of {self.control_frame}")
        try:
            self._writer.write(encode(envelope))
            await self._writer.drain()
        except OSError as error:
            self._lose(Disconnected(f"the connection to {self.server} is lost: {error.strerror or error}"))
            raise self.lost from error

    async def close(self) -> None:
        self._lose(Disconnected(f"the session with {self.server} was closed"))
        self._reading.cancel()
        self._writer.close()
        await asyncio.gather(self._reading, self._writer.wait_closed(), return_exceptions=True)

    def open(self, exchange: "Exchange") -> int:
        self._last_id += 1
        self._exchanges[self._last_id] = exchange
        self.balance()
        return self._last_id

    def close_exchange(self, request_id: int) -> None:
        self._exchanges.pop(request_id, None)
        self.balance()

    def balance(self) -> None:
        """Reads on while there is room, or while somebody waits for an answer that may come behind all that."""
        waiting = sum(exchange.bytes for exchange in self._exchanges.values())
        if waiting < MAX_WAITING or any(exchange.is_awaited for exchange in self._exchanges.values()):
            self._may_read.set()
        else:
            self._may_read.clear()

    async def _read_all(self) -> None:
        try:
            while True:
                await self._may_read.wait()
                envelope = await read_envelope(self._reader)
                exchange = self._exchanges.get(envelope.request_id)
                if exchange is not None:
                    exchange.put(envelope)
                    self.balance()
                elif envelope.request_id == 0 and envelope.WhichOneof("body") == "error":
                    self._lose(server_error(envelope.error))
                    return
        except (asyncio.IncompleteReadError, OSError):
            self._lose(Disconnected(f"the connection to {self.server} is lost"))
        except ProtocolError as error:
            self._lose(error)
        finally:
            self._writer.close()

    def _lose(self, why: MetamerError) -> None:
        if self.lost:
            return
        self.lost = why
        for exchange in self._exchanges.values():
            exchange.wake()


class Exchange:
    """One request and what comes under its id; `with` forgets it at the end, and what still comes is skipped."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._envelopes: deque[Envelope] = deque()
        self._came = asyncio.Event()
        self.bytes = 0
        self.is_awaited = False
        self.id = 0

    def __enter__(self) -> "Exchange":
        self.id = self._connection.open(self)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._connection.close_exchange(self.id)

    def put(self, envelope: Envelope) -> None:
        self._envelopes.append(envelope)
        self.bytes += envelope.ByteSize()
        self._came.set()

    def wake(self) -> None:
        self._came.set()

    @property
    def has_answer(self) -> bool:
        return bool(self._envelopes)

    async def send(self, body: Message, name: str) -> None:
        await self._connection.send(self.id, body, name)

    async def receive(self, *names: str) -> Message:
        """The next body, one of `names`. What had come before the connection was lost still comes. Raises the server's
        Error; why the connection is lost; ProtocolError for another body."""
        self.is_awaited = True
        self._connection.balance()
        try:
            while not self._envelopes:
                if self._connection.lost:
                    raise self._connection.lost
                self._came.clear()
                await self._came.wait()
        finally:
            self.is_awaited = False
        envelope = self._envelopes.popleft()
        self.bytes -= envelope.ByteSize()
        self._connection.balance()
        name = envelope.WhichOneof("body")
        if name == "error":
            raise server_error(envelope.error)
        if name not in names:
            raise ProtocolError(f"the server answers {name} where {' or '.join(names)} was to come")
        return getattr(envelope, name)
