"""A metamerd of our own, on a Unix socket that nobody else knows. It ends with us, however that happens: it reads the
end of file of a socket pair whose other end we alone hold."""
import asyncio
import os
import pathlib
import shutil
import socket
import subprocess
import tempfile
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from metamer.errors import NoServer

START_SECONDS = 20.0
STOP_SECONDS = 5.0


def _folder_for_sockets() -> str:
    """A Unix socket's path is limited to 107 bytes."""
    base = os.environ.get("XDG_RUNTIME_DIR", "")
    return base if base and os.access(base, os.W_OK | os.X_OK) and len(base) <= 60 else "/tmp"


@asynccontextmanager
async def private_server(program: str | os.PathLike[str] | None = None, words: list[str] | None = None
                         ) -> AsyncIterator[str]:
    """Starts `program` (the metamerd in PATH, if None) with further `words` of its command line, waits until it
    listens, and gives its address. Raises NoServer, with its last words, where it does not start."""
    daemon = os.fspath(program) if program is not None else shutil.which("metamerd")
    if daemon is None:
        raise NoServer("no metamerd is in PATH; name one: local(program=…)")
    ours, theirs = socket.socketpair()
    with ours, tempfile.TemporaryDirectory(prefix="metamer-", dir=_folder_for_sockets()) as folder:
        address = f"unix:{folder}/socket"
        log = pathlib.Path(folder, "log")
        with theirs, open(log, "wb") as output:
            try:
                process = subprocess.Popen(
                    [daemon, "--listen", address, "--parent-fd", str(theirs.fileno()), "--log-level", "warn",
                     "--unconfined", *(words or [])],
                    stdin=subprocess.DEVNULL, stdout=output, stderr=output, pass_fds=[theirs.fileno()],
                    process_group=0)  # a Ctrl-C at the terminal is ours alone
            except OSError as error:
                raise NoServer(f"cannot start {daemon}: {error.strerror}") from error
        try:
            if not await _is_ready(ours):
                lines = log.read_text(errors="replace").strip().splitlines()
                raise NoServer(": ".join([f"the private {daemon} did not start", *lines[-1:]]))
            yield address
        finally:
            ours.close()
            await asyncio.to_thread(_wait_for_end, process)


async def _is_ready(pair: socket.socket) -> bool:
    """Waits for the line `ready`."""
    pair.setblocking(False)
    line = b""
    try:
        async with asyncio.timeout(START_SECONDS):
            while not line.endswith(b"\n") and len(line) < 64:
                piece = await asyncio.get_running_loop().sock_recv(pair, 64)
                if not piece:
                    return False
                line += piece
    except (TimeoutError, OSError):
        return False
    return line == b"ready\n"


def _wait_for_end(process: subprocess.Popen[bytes]) -> None:
    try:
        process.wait(STOP_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
