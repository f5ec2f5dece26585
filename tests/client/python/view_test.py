"""Views: frames up to the complete one, changes, what is under a place."""
import asyncio
import unittest

import numpy as np

import metamer
import metamer.aio
from metamer import errors
from metamer.v1 import scene_pb2
from support import BIN, local, scene


class Viewed(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.server = cls.enterClassContext(local())

    def test_a_complete_frame_is_the_picture(self) -> None:
        picture = self.server.render(scene(spp=4))
        with self.server.open_view(scene(spp=4)) as view:
            self.assertEqual((view.plan.width, view.plan.height), (32, 16))
            frames = list(view.frames(xyz=True))
            self.assertEqual([frame.facts.complete for frame in frames], [False] * (len(frames) - 1) + [True])
            np.testing.assert_allclose(frames[-1].xyz, picture.xyz, rtol=1e-5)
            self.assertLessEqual(np.abs(frames[-1].rgb.astype(int) - picture.srgb()).max(), 1)
            self.assertIs(view.frame(), view.frame())  # nothing has changed
            self.assertEqual(view.frame(xyz=True).xyz.shape, (16, 32, 3))

    def test_a_complete_frame_comes_again_with_its_xyz(self) -> None:
        with self.server.open_view(scene()) as view:
            last = list(view.frames())[-1]
            self.assertIsNone(last.xyz)
            np.testing.assert_allclose(view.frame(xyz=True).xyz[..., 1], 0.4, rtol=1e-5)

    def test_a_change_is_seen(self) -> None:
        with self.server.open_view(scene()) as view:
            light = scene_pb2.Light()
            light.CopyFrom(scene().message.light[0])
            light.luminance = 0.2
            for luminance in (0.2, 0.6):
                light.luminance = luminance
                view.update(light=[light])
                last = list(view.frames(xyz=True))[-1]
                np.testing.assert_allclose(last.xyz[..., 1], luminance / 2, rtol=1e-5)

    def test_a_change_that_is_wrong_leaves_the_view_as_it_was(self) -> None:
        with self.server.open_view(scene()) as view:
            with self.assertRaises(metamer.InputError) as caught:
                view.update(camera=scene_pb2.Camera(vertical_fov=200))
            self.assertIn("vertical_fov", caught.exception.problems[0].field)
            np.testing.assert_allclose(list(view.frames(xyz=True))[-1].xyz[..., 1], 0.4, rtol=1e-5)

    def test_what_is_under_a_place(self) -> None:
        with self.server.open_view(scene()) as view:
            list(view.frames())
            probed = view.probe(16, 8)
            self.assertEqual((probed.object, probed.material), ("wall", "grey"))
            np.testing.assert_allclose(probed.surface, 0.5)
            with self.assertRaises(errors.LimitError):
                view.probe(32, 0)
            self.assertEqual(view.probe(0, 0).object, "wall")

    def test_a_scene_that_is_wrong_opens_no_view(self) -> None:
        wrong = scene()
        wrong.message.object[0].material = "gray"
        for _ in range(5):  # a session has four
            with self.assertRaises(metamer.InputError) as caught:
                self.server.open_view(wrong)
        self.assertEqual(caught.exception.problems[0].field, "object[0].material")
        with self.server.open_view(scene()) as view:
            view.frame()

    def test_a_frame_that_is_given_up_costs_nothing(self) -> None:
        async def look() -> None:
            async with metamer.aio.local(BIN / "metamerd") as session:
                async with await session.open_view(scene()) as view:
                    await view.frame()  # not complete yet
                    for _ in range(3):
                        asking = asyncio.create_task(view.frame())
                        await asyncio.sleep(0)  # it has asked, without X Y Z
                        asking.cancel()
                    async for frame in view.frames(xyz=True):
                        pass
                    np.testing.assert_allclose(frame.xyz[..., 1], 0.4, rtol=1e-5)
        asyncio.run(look())


class Swept(unittest.TestCase):
    def test_a_table_of_all_combinations(self) -> None:
        with local() as server:
            table = server.sweep(scene(), {"light[key].luminance": [0.2, 0.8], "settings.method": ["exact {}", "rgb {}"]},
                                 lambda picture: {"y": float(picture.xyz[..., 1].mean())})
            self.assertEqual([row["settings.method"] for row in table], ["exact {}", "rgb {}"] * 2)
            np.testing.assert_allclose([row["y"] for row in table], [0.1, 0.1, 0.4, 0.4], rtol=1e-3)
            series = sorted((job.series.index, job.series.count, job.series.label) for job in server.jobs())
            self.assertEqual([one[:2] for one in series], [(0, 4), (1, 4), (2, 4), (3, 4)])
            self.assertEqual(series[0][2], "light[key].luminance=0.2 settings.method=exact {}")
            self.assertEqual(len({job.series.id for job in server.jobs()}), 1)
            with self.assertRaises(metamer.JobFailed):
                server.sweep(scene(), {"settings.spp": [1, 0]})

    def test_fields_by_their_paths(self) -> None:
        message = scene().message
        metamer.set_field(message, "settings.observer", "CIE_1964_10DEG")
        metamer.set_field(message, "light[0].spectrum", "standard: 'F11'")
        metamer.set_field(message, "material[grey].diffuse", metamer.Spectrum([400, 700], [0.2, 0.4]).message())
        self.assertEqual((message.settings.observer, message.light[0].spectrum.standard), (1, "F11"))
        self.assertEqual(list(message.material[0].diffuse.samples.value), [0.2, 0.4])
        for path, value in (("settings.sp", 1), ("light[1].luminance", 1), ("light[kei].luminance", 1), ("settings.spp", "a"),
                            ("settings.method", "exakt {}"), ("settings", 3), ("", 1)):
            with self.assertRaises(errors.InputError, msg=path):
                metamer.set_field(message, path, value)

    def test_a_look_changes_what_it_says(self) -> None:
        made = scene()
        look = made.message.look.add(name="night", observer=1)
        look.light.add(name="*", luminance=0.1).spectrum.standard = "A"
        look.material.add(name="grey").diffuse.constant = 0.9
        night = made.with_look("night").message
        self.assertEqual((night.light[0].luminance, night.light[0].spectrum.standard), (0.1, "A"))
        self.assertEqual((night.material[0].diffuse.constant, night.settings.observer), (0.9, 1))
        self.assertEqual(made.message.light[0].luminance, 0.8)
        with self.assertRaises(metamer.InputError):
            made.with_look("day")


if __name__ == "__main__":
    unittest.main()
