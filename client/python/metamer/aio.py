"""The face for asyncio:

    async with metamer.aio.local() as session:
        picture = await session.render("scene.txtpb")
"""
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from metamer.credentials import Credentials
from metamer.errors import InputError
from metamer.private_server import private_server
from metamer.session import Session


@asynccontextmanager
async def connect(server: str | None = None, credentials: Credentials | None = None) -> AsyncIterator[Session]:
    """A session with a server; None: the one that METAMER_SERVER names. Raises what Session.connect does."""
    server = server or os.environ.get("METAMER_SERVER", "")
    if not server:
        raise InputError("no server is named: connect(\"unix:…\"), METAMER_SERVER, or local()")
    session = await Session.connect(server, credentials)
    try:
        yield session
    finally:
        await session.close()


@asynccontextmanager
async def local(program: str | os.PathLike[str] | None = None, words: list[str] | None = None) -> AsyncIterator[Session]:
    """A session with a metamerd of our own, which ends with it. Raises NoServer; see private_server."""
    async with private_server(program, words) as address, connect(address, Credentials()) as session:
        yield session
