"""From a scene to its picture, with a real metamerd."""
import asyncio
import itertools
import pathlib
import tempfile
import unittest
from unittest import mock

import numpy as np

import metamer
import metamer.aio
from metamer import errors
from metamer.private_server import private_server
from metamer.v1 import jobs_pb2, scene_pb2
from support import BIN, SCENES, local, read_exr, read_png, run, scene


class Rendered(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.server = cls.enterClassContext(local())

    def test_a_white_wall_has_the_luminance_of_its_light_times_its_reflectance(self) -> None:
        picture = self.server.render(scene())
        self.assertEqual(picture.xyz.shape, (16, 32, 3))
        # The light comes along the normal; D65's white is (0.9505, 1, 1.0888).
        np.testing.assert_allclose(picture.xyz[..., 1], 0.4, rtol=1e-6)
        np.testing.assert_allclose(picture.xyz / 0.4, np.broadcast_to(picture.plan.source_white, (16, 32, 3)), rtol=1e-5)

    def test_a_picture_knows_what_rendered_it(self) -> None:
        record = self.server.render(scene()).record
        self.assertTrue(record.build and record.server_build and record.machine[0].name)
        self.assertEqual(sum(machine.tiles for machine in record.machine), 8)
        self.assertIn("render", [phase.name for phase in record.phase])
        self.assertTrue(all(phase.seconds > 0 and phase.cpu_seconds > 0 for phase in record.phase))

    def test_tiles_make_the_picture_in_any_order(self) -> None:
        picture = self.server.render(scene())
        tiles = [event.body for event in self.server.watch(picture.job_id) if event.kind == "tile"]
        self.assertEqual(len(tiles), 8)
        for order in (tiles, tiles[::-1], tiles[1::2] + tiles[::2]):
            film = metamer.picture.Film(32, 16)
            for tile in order:
                self.assertGreater(film.missing, 0)
                film.put(tile)
            self.assertEqual(film.missing, 0)
            np.testing.assert_array_equal(film.xyz, picture.xyz)

    def test_events_go_on_from_any_number(self) -> None:
        job = self.server.render(scene()).job_id
        events = list(self.server.watch(job))
        self.assertTrue(events[-1].is_last)
        numbers = [event.sequence for event in events]
        self.assertEqual(numbers, sorted(set(numbers)))
        middle = numbers[len(numbers) // 2]
        self.assertEqual([event.sequence for event in self.server.watch(job, middle)], [n for n in numbers if n >= middle])

    def test_a_watch_that_is_left_leaves_its_place(self) -> None:
        job = self.server.submit(scene(width=2048, height=2048, spp=256))
        for _ in range(40):  # 16 are allowed at a time
            for event in self.server.watch(job, tiles=False):
                break
        self.assertEqual(self.server.cancel(job).job_id, job)
        with self.assertRaises(metamer.JobCancelled):
            self.server.picture(job)

    def test_the_same_key_is_the_same_job(self) -> None:
        key = bytes(range(16))
        job = self.server.submit(scene(), client_key=key)
        self.assertEqual(self.server.submit(scene(), client_key=key), job)
        with self.assertRaises(errors.StateError):
            self.server.submit(scene(spp=2), client_key=key)

    def test_a_bad_scene_fails_with_its_problems(self) -> None:
        wrong = scene()
        wrong.message.object[0].material = "gray"
        with self.assertRaises(metamer.JobFailed) as caught:
            self.server.render(wrong)
        self.assertEqual((caught.exception.kind, caught.exception.problems[0].field), ("BAD_INPUT", "object[0].material"))

    def test_errors_of_the_wire_are_exceptions_of_their_names(self) -> None:
        with self.assertRaises(errors.NotFound):
            self.server.picture(12345)
        with self.assertRaises(errors.LimitError):
            self.server.priority(self.server.submit(scene()), 101)
        self.server.info()  # the session goes on

    def test_a_server_of_another_version_says_so(self) -> None:
        with mock.patch("metamer.session.PROTOCOL_VERSION", 2), self.assertRaisesRegex(errors.VersionError, "1.*2|2.*1"):
            local()

    def test_the_blocking_face_has_every_call_of_the_session(self) -> None:
        calls = {name for name in vars(metamer.Session) if not name.startswith("_")} - {"connect"}
        self.assertLessEqual(calls, set(dir(metamer.Server)))
        self.assertEqual(metamer.Server.submit.__doc__, metamer.Session.submit.__doc__)


class Kept(unittest.TestCase):
    def test_a_watch_goes_on_with_the_next_server_of_the_state(self) -> None:
        with tempfile.TemporaryDirectory() as state:
            with metamer.local(BIN / "metamerd", ["--state", state]) as server:
                job = server.handle(server.submit(scene()))
                picture = server.picture(job)
                first = list(itertools.islice(server.watch(job), 7))
            with metamer.local(BIN / "metamerd", ["--state", state]) as server:
                rest = list(server.watch(job, first[-1].sequence + 1))
        tiles = [event.body for event in first + rest if event.kind == "tile"]
        self.assertTrue(rest[-1].is_last and 0 < len([event for event in rest if event.kind == "tile"]) < len(tiles))
        film = metamer.picture.Film(32, 16)
        for tile in tiles:
            film.put(tile)
        self.assertEqual((len(tiles), film.missing), (8, 0))
        np.testing.assert_array_equal(film.xyz, picture.xyz)


class GivenUp(unittest.TestCase):
    def test_a_render_that_is_cancelled_cancels_its_job(self) -> None:
        async def give_up() -> int:
            async with metamer.aio.local(BIN / "metamerd") as session:
                rendering = asyncio.create_task(session.render(scene(width=2048, height=2048, spp=256)))
                while not await session.jobs():
                    await asyncio.sleep(0.01)
                await asyncio.sleep(0)
                rendering.cancel()
                with self.assertRaises(asyncio.CancelledError):
                    await rendering
                return (await session.jobs())[0].state
        self.assertEqual(asyncio.run(give_up()), jobs_pb2.CANCELLED)


class WithTheCommandLine(unittest.TestCase):
    def test_a_picture_has_the_bits_and_colours_that_fetch_writes(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            address = f"unix:{folder}/socket"

            async def rendered_and_fetched() -> metamer.Picture:
                async with (private_server(BIN / "metamerd", ["--listen", address]),
                            metamer.aio.connect(address) as session):
                    example = metamer.Scene.read(SCENES / "example.txtpb")
                    example.message.settings.width, example.message.settings.height = 40, 30
                    picture = await session.render(example)
                    await asyncio.to_thread(run, "fetch", str(picture.job_id), "--server", address, "--exr", "xyz",
                                            "-o", f"{folder}/a.exr", "-o", f"{folder}/a.png")
                    return picture

            ours = asyncio.run(rendered_and_fetched())
            theirs = read_exr(pathlib.Path(folder, "a.exr"))
            np.testing.assert_array_equal(ours.xyz.view(np.uint32), theirs.view(np.uint32))
            self.assertGreater(ours.xyz[..., 1].max(), 0.1)

            colors = read_png(pathlib.Path(folder, "a.png")).astype(int)
            np.testing.assert_allclose(ours.srgb(), colors, atol=1)  # halves may be rounded either way
            self.assertGreater(np.mean(ours.srgb() == colors), 0.99)
            ours.save(f"{folder}/b.png")
            np.testing.assert_array_equal(read_png(pathlib.Path(folder, "b.png")), ours.srgb())


class Files(unittest.TestCase):
    def test_files_that_are_wrong_are_named_all_at_once(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            wrong = scene()
            wrong.folder = pathlib.Path(folder)
            wrong.message.material[0].diffuse.file = "no.sp"
            wrong.message.light[0].spectrum.file = "../up.sp"
            wrong.message.object.add(name="mesh").mesh.file = "/etc/passwd"
            with self.assertRaises(metamer.InputError) as caught:
                metamer.scene.make_submission(wrong)
        said = {problem.field: problem.message for problem in caught.exception.problems}
        self.assertEqual(said, {
            "light[0].spectrum.file": 'file "../up.sp" leads out of the scene\'s folder',
            "material[0].diffuse.file": 'file "no.sp" does not exist',
            "object[1].mesh.file": 'file "/etc/passwd" must be relative to the scene\'s folder'})

    def test_looks_stay_with_the_client(self) -> None:
        with_look = scene()
        with_look.message.look.add(name="night").light.add(name="*").spectrum.file = "not-there.sp"
        sent = metamer.scene.make_submission(with_look).scene.data
        self.assertFalse(scene_pb2.Scene.FromString(sent).look)

    def test_a_text_that_is_no_scene_is_located(self) -> None:
        with self.assertRaises(metamer.InputError) as caught:
            metamer.Scene.parse('camera {\n  eie { z: 4 }\n}', name="a.txtpb")
        problem = caught.exception.problems[0]
        self.assertEqual((problem.file, problem.line, problem.column), ("a.txtpb", 2, 3))


if __name__ == "__main__":
    unittest.main()
