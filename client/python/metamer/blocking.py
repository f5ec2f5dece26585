"""The face for scripts and notebooks: the calls of metamer.session.Session, each of which waits until it is done.

    with metamer.local() as server:
        picture = server.render("scene.txtpb")

An event loop runs on a thread of its own; calls may come from any other thread.
"""
import asyncio
import functools
import inspect
import os
import threading
from collections.abc import AsyncIterator, Callable, Coroutine, Iterator
from contextlib import AbstractAsyncContextManager
from typing import Any, TypeVar

from metamer import aio
from metamer.credentials import Credentials
from metamer.session import Session
from metamer.v1 import plan_pb2
from metamer.view import View

T = TypeVar("T")


class Waiting:
    """Calls on something that lives on an event loop of another thread."""

    def __init__(self, loop: asyncio.AbstractEventLoop, target: Any = None) -> None:
        self._loop = loop
        self._target = target

    def _wait(self, coroutine: Coroutine[Any, Any, T]) -> T:
        """Its result; a Ctrl-C cancels it."""
        future = asyncio.run_coroutine_threadsafe(coroutine, self._loop)
        try:
            return future.result()
        except BaseException:
            future.cancel()
            raise

    def _iterate(self, events: AsyncIterator[T]) -> Iterator[T]:
        try:
            while True:
                try:
                    yield self._wait(events.__anext__())
                except StopAsyncIteration:
                    return
        finally:
            self._wait(events.aclose())


def _calls_of(target: type) -> Callable[[type], type]:
    """Gives a Waiting the public calls and properties of `target`, with their names, signatures and docstrings."""

    def call(name: str, function: Callable) -> Callable:
        step = Waiting._iterate if inspect.isasyncgenfunction(function) else Waiting._wait

        @functools.wraps(function)
        def waits(self: Waiting, *arguments: Any, **named: Any) -> Any:
            result = step(self, getattr(self._target, name)(*arguments, **named))
            return WaitingView(self._loop, result) if isinstance(result, View) else result

        return waits

    def add(to: type) -> type:
        for name, value in vars(target).items():
            if name.startswith("_") or name in vars(to):
                continue
            if inspect.iscoroutinefunction(value) or inspect.isasyncgenfunction(value):
                setattr(to, name, call(name, value))
            elif isinstance(value, property):
                setattr(to, name, property(lambda self, of=value: of.fget(self._target), doc=value.__doc__))
        return to

    return add


@_calls_of(View)
class WaitingView(Waiting):
    """A view that waits: all calls of View, under the same names and with the same arguments."""

    def __enter__(self) -> "WaitingView":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def plan(self) -> plan_pb2.Plan:
        return self._target.plan


@_calls_of(Session)
class Server(Waiting):
    """A session that waits: all calls of Session, under the same names and with the same arguments."""

    def __init__(self, opening: AbstractAsyncContextManager[Session]) -> None:
        super().__init__(asyncio.new_event_loop())
        self._thread = threading.Thread(target=self._loop.run_forever, name="metamer", daemon=True)
        self._thread.start()
        self._opening = opening
        try:
            self._target = self._wait(opening.__aenter__())
        except BaseException:
            self._stop()
            raise
        self.welcome = self._target.welcome

    def handle(self, job_id: int) -> str:
        """As Session.handle."""
        return self._target.handle(job_id)

    def __enter__(self) -> "Server":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the session, and a private server with it. A second time does nothing."""
        if self._thread.is_alive():
            try:
                self._wait(self._opening.__aexit__(None, None, None))
            finally:
                self._stop()

    def _stop(self) -> None:
        self._wait(self._loop.shutdown_asyncgens())
        self._wait(self._loop.shutdown_default_executor())
        self._loop.call_soon_threadsafe(self._loop.stop)
        self._thread.join()
        self._loop.close()


def connect(server: str | None = None, credentials: Credentials | None = None) -> Server:
    """As aio.connect."""
    return Server(aio.connect(server, credentials))


def local(program: str | os.PathLike[str] | None = None, words: list[str] | None = None) -> Server:
    """As aio.local."""
    return Server(aio.local(program, words))
