"""What a server may say wrongly, or never: a false server on a Unix socket says it."""
import asyncio
import contextlib
import os
import pathlib
import struct
import tempfile
import unittest
from collections.abc import Awaitable, Callable
from unittest import mock

import metamer
from metamer import credentials, errors, frames, handle, server_owner
from metamer.address import parse_address
from metamer.events import make_event
from metamer.session import Session
from metamer.v1 import jobs_pb2, session_pb2

Envelope = frames.Envelope
WELCOME = session_pb2.Welcome(protocol_version=1, limits=session_pb2.Limits(control_frame=256 << 10, chunk=4 << 20))


async def read(reader: asyncio.StreamReader) -> Envelope:
    """What a client sends."""
    (size,) = struct.unpack(">I", await reader.readexactly(4))
    return Envelope.FromString(await reader.readexactly(size))


async def with_false_server(speak: Callable[..., Awaitable[None]], use: Callable[[Session], Awaitable[None]]) -> None:
    """A server that says Welcome and then what `speak(reader, writer)` says, and a session with it."""
    async def serve(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            hello = await read(reader)
            writer.write(frames.encode(Envelope(request_id=hello.request_id, welcome=WELCOME)))
            await speak(reader, writer)
        except (asyncio.IncompleteReadError, ConnectionError):
            pass
        finally:
            writer.close()

    with tempfile.TemporaryDirectory() as folder:
        async with await asyncio.start_unix_server(serve, f"{folder}/s"):
            session = await Session.connect(f"unix:{folder}/s", credentials.Credentials())
            try:
                await asyncio.wait_for(use(session), 20)
            finally:
                await session.close()


def answering(data: Callable[[int], bytes]) -> Callable[..., Awaitable[None]]:
    """Answers the first request with these bytes, and stays."""
    async def speak(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writer.write(data((await read(reader)).request_id))
        await reader.read()
    return speak


class Wire(unittest.TestCase):
    def refused(self, data: Callable[[int], bytes], kind: type[BaseException]) -> None:
        async def use(session: Session) -> None:
            with self.assertRaises(kind):
                await session.info()
        asyncio.run(with_false_server(answering(data), use))

    def test_each_code_of_the_wire_has_an_exception(self) -> None:
        for name, code in session_pb2.Error.Code.items():
            error = errors.server_error(session_pb2.Error(code=code, message="why"))
            self.assertEqual((error.code, str(error)), (name, "why"))
            self.assertEqual(type(error) is errors.ServerError, name == "UNSPECIFIED")
            if code:
                self.refused(lambda i, c=code: frames.encode(Envelope(request_id=i, error=session_pb2.Error(code=c))),
                             type(error))
        self.assertEqual(errors.server_error(session_pb2.Error(code=99)).code, "99")

    def test_a_frame_over_the_limit_is_not_read(self) -> None:
        self.refused(lambda i: struct.pack(">I", frames.MAX_FRAME + 1), errors.ProtocolError)
        self.refused(lambda i: struct.pack(">I", 0), errors.ProtocolError)

    def test_bytes_that_are_no_message(self) -> None:
        self.refused(lambda i: struct.pack(">I", 3) + b"\xff\xff\xff", errors.ProtocolError)

    def test_another_answer_than_the_one_asked_for(self) -> None:
        self.refused(lambda i: frames.encode(Envelope(request_id=i, pong=session_pb2.Pong())), errors.ProtocolError)

    def test_a_large_frame_has_to_be_plain_bytes(self) -> None:
        many = Envelope(request_id=1, job_list=jobs_pb2.JobList(job=[jobs_pb2.JobSummary()] * 200_000))
        self.refused(lambda i: frames.encode(many), errors.ProtocolError)
        tile = jobs_pb2.Tile(width=256, height=256, xyz=bytes(256 * 256 * 12))
        large = Envelope(request_id=1, job_event=jobs_pb2.JobEvent(job_id=1, sequence=1, tile=tile)).SerializeToString()
        self.assertTrue(frames.is_bulk(large))
        self.assertFalse(frames.is_bulk(large[:-1]))

    def test_a_connection_that_ends_says_so_to_all_that_wait(self) -> None:
        async def speak(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            await read(reader)
            await read(reader)

        async def use(session: Session) -> None:
            first, second = await asyncio.gather(session.info(), session.cancel(1), return_exceptions=True)
            self.assertIsInstance(first, errors.Disconnected)
            self.assertIsInstance(second, errors.Disconnected)
            with self.assertRaises(errors.Disconnected):
                await session.info()
        asyncio.run(with_false_server(speak, use))

    def test_another_version_is_refused(self) -> None:
        async def use(session: Session) -> None:
            self.fail("it should not get so far")
        with mock.patch("metamer.session.PROTOCOL_VERSION", 2), self.assertRaises(errors.VersionError):
            asyncio.run(with_false_server(answering(lambda i: b""), use))

    def test_pixels_of_another_number_than_the_tile_has(self) -> None:
        for tile in (jobs_pb2.Tile(width=4, height=4, xyz=bytes(4 * 4 * 12 - 1)), jobs_pb2.Tile(),
                     jobs_pb2.Tile(width=1 << 31, height=1 << 31, xyz=bytes(12))):
            with self.assertRaises(errors.ProtocolError):
                make_event(jobs_pb2.JobEvent(tile=tile))
        film = metamer.picture.Film(8, 8)
        with self.assertRaises(errors.ProtocolError):
            film.put(make_event(jobs_pb2.JobEvent(tile=jobs_pb2.Tile(x=5, y=0, width=4, height=1, xyz=bytes(48)))).body)
        with self.assertRaises(errors.ProtocolError):
            metamer.picture.Film(1 << 20, 1 << 20)

    def test_an_answer_comes_through_though_nobody_takes_the_tiles(self) -> None:
        """A watcher that does not look may not keep an answer from who asks: more tiles wait than are held."""
        async def speak(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            watch = await read(reader)
            tile = jobs_pb2.Tile(width=512, height=512, xyz=bytes(512 * 512 * 12))
            for i in range(8):
                writer.write(frames.encode(Envelope(request_id=watch.request_id, job_event=jobs_pb2.JobEvent(
                    sequence=i + 1, tile=tile))))
                await writer.drain()
            info = await read(reader)
            writer.write(frames.encode(Envelope(request_id=info.request_id, info=session_pb2.Info(uptime=7))))
            await reader.read()

        async def use(session: Session) -> None:
            events = session.watch(1)
            await anext(events)
            self.assertEqual((await session.info()).uptime, 7)
            self.assertEqual([(await anext(events)).sequence for _ in range(7)], list(range(2, 9)))
            await events.aclose()
        with mock.patch("metamer.exchange.MAX_WAITING", 4 << 20):
            asyncio.run(with_false_server(speak, use))


class Handles(unittest.TestCase):
    def test_a_job_is_its_number_at_its_server(self) -> None:
        here = bytes.fromhex("3f9c2a1b" + "00" * 12)
        for job in (7, "7", "7@3f9c2a1b", "7@3F9C2A", handle.job_handle(7, here)):
            self.assertEqual(handle.job_number(job, here), 7)
        self.assertEqual((handle.job_handle(7, here), handle.job_handle(7, b"")), ("7@3f9c2a1b", "7"))
        for job in ("", "0", "7@", "7@3f9", "7@3f9c2a1c", "-7", "7@3f9c2a1b ", "٧", "7@" + "0" * 33):
            with self.assertRaises(errors.InputError, msg=job):
                handle.job_number(job, here)
        with self.assertRaises(errors.InputError):
            handle.job_number("7@3f9c2a1b", b"")


class TheWay(unittest.TestCase):
    def test_addresses_are_those_of_the_command_line(self) -> None:
        for text, same in (("unix:/a/b", "unix:/a/b"), ("7777", "127.0.0.1:7777"), ("a.example:1", "a.example:1"),
                           ("tls:[::1]:7777", "tls:[::1]:7777")):
            self.assertEqual(str(parse_address(text)), same)
        for text in ("", "unix:", "a", "::1:7777", "a:70000", "tls:", "unix:" + "x" * 108):
            with self.assertRaises(errors.InputError):
                parse_address(text)

    def test_nobody_there(self) -> None:
        with tempfile.TemporaryDirectory() as folder, self.assertRaises(errors.NoServer):
            metamer.connect(f"unix:{folder}/nobody")
        with self.assertRaises(errors.NoServer):
            metamer.local("/nowhere/metamerd")
        with self.assertRaises(errors.NoServer):
            metamer.local("/bin/true")

    def test_a_stranger_who_listens_is_told_nothing(self) -> None:
        server_owner.check_server_owner(os.geteuid(), "/tmp/x")
        server_owner.check_server_owner(0, "/tmp/x")
        with self.assertRaises(errors.NoServer):
            server_owner.check_server_owner(12345, "/tmp/x")  # anybody may have made it
        with tempfile.TemporaryDirectory(dir="/var/tmp") as folder, self.assertRaises(errors.NoServer):
            server_owner.check_server_owner(12345, f"{folder}/s")

    def test_a_socket_is_where_those_have_let_its_user_whom_one_trusts(self) -> None:
        me, they, other = os.geteuid(), 12345, 12346
        for folder, file, is_well in (((me, 0o755), (they, 0o700), True), ((they, 0o700), (they, 0o700), True),
                                      ((other, 0o755), (they, 0o700), False), ((me, 0o775), (they, 0o700), False),
                                      ((me, 0o757), (they, 0o700), False), ((me, 0o755), (other, 0o700), False)):
            owners = {"/": (0, 0o755), "/etc": folder, "/etc/s": file}

            def status(path: pathlib.Path, owners: dict = owners) -> os.stat_result:
                user, mode = owners[str(path)]
                return os.stat_result((mode, 0, 0, 1, user, 0, 0, 0, 0, 0))
            with self.subTest(folder=folder, file=file), mock.patch("metamer.server_owner.os.lstat", status), \
                    contextlib.nullcontext() if is_well else self.assertRaises(errors.NoServer):
                server_owner.check_server_owner(they, "/etc/s")

    def test_kept_credentials_are_for_their_user_alone(self) -> None:
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ, {"XDG_CONFIG_HOME": folder}):
            self.assertEqual(credentials.kept_credentials("a:1"), credentials.Credentials())
            file = pathlib.Path(folder, "metamer", "servers.toml")
            file.parent.mkdir()
            file.write_text('["tls:a:1"]\ntoken = "secret"\nca = "/ca.pem"\n')
            file.chmod(0o600)
            kept = credentials.kept_credentials("tls:a:1")
            self.assertEqual((kept.token, kept.authorities), ("secret", "/ca.pem"))
            self.assertNotIn("secret", repr(kept))
            file.chmod(0o644)
            with self.assertRaises(errors.InputError):
                credentials.kept_credentials("tls:a:1")


if __name__ == "__main__":
    unittest.main()
