"""A kept picture under another light is what the command line makes of it, and what a renderer would."""
import pathlib
import tempfile
import unittest

import numpy as np

import metamer
from metamer import errors, fresnel
from metamer.events import Tile
from metamer.factors import FactorsBuilder
from metamer.spectra import band_means
from metamer.v1 import factors_pb2, plan_pb2
from support import local, read_exr, run

# A paint, a metal and a glass ball on a floor that mirrors them: every kind of factor, and chains of them.
SCENE = """
camera { eye { y: 1.5 z: 4 } target { y: 0.4 } }
settings { width: 32 height: 24 spp: 4 depth: 3 tile_size: 16 method { exact {} } }
light { name: "key" position { x: -2 y: 4 z: 3 } luminance: 0.7 spectrum { standard: "D65" } }
light { name: "fill" direction { x: -1 y: -1 z: -1 } luminance: 0.2 spectrum { standard: "A" } }
material {
  name: "paint" specularness: 0.3 phong { shininess: 40 }
  diffuse { samples { wavelength: [400, 580, 620, 700] value: [0.05, 0.1, 0.7, 0.8] } }
  fluorescence {
    excitation { samples { wavelength: [300, 370, 420] value: [0.05, 0.2, 0.02] } }
    emission { samples { wavelength: [410, 440, 470, 560] value: [0, 1, 0.8, 0] } }
    quantum_yield: 0.8
  }
}
material {
  name: "gold" diffuseness: 0 specularness: 0.5 mirror: 0.6 cook_torrance {} fresnel { conductor { metal: "Au" } }
}
material {
  name: "silver" diffuseness: 0 specularness: 1 mirror: 1 he_torrance { rms_roughness: 0.07 correlation_length: 2 }
  fresnel { conductor { metal: "Ag" } }
}
material {
  name: "satin" diffuseness: 0 specularness: 1 he_torrance {} fresnel { schlick {} }
  specular { samples { wavelength: [400, 700] value: [0.3, 0.6] } }
}
material {
  name: "floor" mirror: 0.5 diffuse { samples { wavelength: [400, 700] value: [0.2, 0.6] } }
  specular { constant: 0.05 } specularness: 0.1 hall_greenberg {} fresnel { schlick {} }
}
material {
  name: "glass" fresnel { dielectric { medium: "N-BK7" } }
  transmission { transmittance { samples { wavelength: [400, 700] value: [0.9, 0.2] } } thickness: 0.5 }
}
object { name: "a" material: "paint" sphere { center { x: -0.6 y: 0.5 } radius: 0.5 } }
object { name: "b" material: "gold" sphere { center { x: 0.6 y: 0.5 } radius: 0.5 } }
object { name: "e" material: "silver" sphere { center { x: -0.3 y: 0.25 z: 1 } radius: 0.25 } }
object { name: "f" material: "satin" sphere { center { x: 0.4 y: 0.2 z: 1 } radius: 0.2 } }
object { name: "d" material: "glass" sphere { center { y: 0.3 z: 0.8 } radius: 0.3 } }
object { name: "c" material: "floor" quad { corner { x: -3 z: 3 } u { x: 6 } v { z: -6 } } }
"""
GREEN = metamer.Spectrum([400, 500, 540, 600, 700], [0.05, 0.3, 0.7, 0.2, 0.1])


def alike(one: np.ndarray, other: np.ndarray) -> None:
    """To the rounding of f32 sums (4e-6 on this scene)."""
    np.testing.assert_allclose(one, other, rtol=2e-5, atol=1e-6)


class Relit(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.server = cls.enterClassContext(local())
        cls.scene = metamer.Scene.parse(SCENE)
        cls.kept = cls.server.render(cls.scene, keep_factors=True)
        cls.f11 = cls.server.spectrum("F11")

    def test_its_own_spectra_give_the_picture(self) -> None:
        self.assertGreater(self.kept.xyz[..., 1].max(), 0.1)
        alike(self.kept.factors.relight(), self.kept.xyz)

    def test_another_light_and_paint_give_what_is_rendered_with_them(self) -> None:
        scene = self.scene.copy()
        scene.message.light[0].spectrum.standard = "F11"
        scene.message.material[0].diffuse.CopyFrom(GREEN.message())
        alike(self.kept.factors.relight({"key": self.f11}, {"paint": GREEN}), self.server.render(scene).xyz)
        for light in scene.message.light:
            light.spectrum.standard = "F11"
        alike(self.kept.factors.relight({"*": self.f11}, {"paint": GREEN}), self.server.render(scene).xyz)

    def test_another_observer(self) -> None:
        scene = self.scene.copy()
        scene.message.settings.observer = 1  # CIE_1964_10DEG
        alike(self.kept.factors.relight(observer=self.server.spectra(scene).observer), self.server.render(scene).xyz)

    def test_bands_have_the_light_of_the_picture(self) -> None:
        """Sums over 1 nm with the observer are X Y Z, but for what lights and paints do within a nanometre."""
        nm = np.arange(360.0, 831.0)
        bands = self.kept.factors.spectral(nm)
        self.assertEqual(bands.shape, (24, 32, 471))
        observer = np.stack([f.emission_at(nm) for f in self.kept.factors.spectra.observer], 1)
        np.testing.assert_allclose(bands @ observer, self.kept.xyz, rtol=2e-3, atol=1e-5)

    def test_the_mean_of_a_line_is_its_light_over_a_band(self) -> None:
        line = metamer.Spectrum([545.999, 546, 546.001], [0, 1000, 0])  # all in all 1
        np.testing.assert_allclose(band_means(line, np.array([540.0, 546.0, 550.0])), [0, 1 / 5, 0], atol=1e-4)
        np.testing.assert_allclose(band_means(line, np.array([536.0, 556.0])), [0.05, 0.05], rtol=1e-6)

    def test_names_that_are_not_there(self) -> None:
        for lights, materials in (({"kei": self.f11}, {}), ({}, {"gold.diffuse": GREEN})):
            with self.assertRaises(errors.InputError):
                self.kept.factors.relight(lights, materials)

    def test_the_command_line_agrees(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "scene.txtpb").write_text(SCENE)
            (folder / "green.csv").write_text("".join(f"{nm},{value}\n" for nm, value in zip(GREEN.nm, GREEN.values)))
            run("render", f"{folder}/scene.txtpb", "--keep-factors", f"{folder}/a.factors", "--exr", "xyz", "-o",
                f"{folder}/a.exr")
            run("relight", f"{folder}/a.factors", "--light", "*=F11", "--exr", "xyz", "-o", f"{folder}/b.exr")
            factors = metamer.read_factors(folder / "a.factors")
            alike(factors.relight(), read_exr(folder / "a.exr"))
            alike(factors.relight({"*": self.f11}), read_exr(folder / "b.exr"))
            damaged = bytearray((folder / "a.factors").read_bytes())
            damaged[-1] ^= 1
            (folder / "a.factors").write_bytes(damaged)
            with self.assertRaises(errors.InputError):
                metamer.read_factors(folder / "a.factors")

    def test_a_white_has_the_luminance_of_its_light(self) -> None:
        spectra = self.server.spectra(self.scene)
        white = metamer.xyz_of(spectra.lights["key"], spectra.observer, luminance=0.7)
        self.assertAlmostEqual(white[1], 0.7)
        np.testing.assert_allclose(white / 0.7, self.kept.plan.source_white, rtol=1e-6)
        np.testing.assert_allclose(metamer.xyz_of(self.f11, spectra.observer, metamer.Spectrum.constant(0.5)) * 2,
                                   metamer.xyz_of(self.f11, spectra.observer), rtol=1e-12)
        with self.assertRaises(metamer.JobFailed):
            self.server.spectrum("D66")


class Closed(unittest.TestCase):
    def test_fresnel_at_normal_and_grazing_incidence(self) -> None:
        index = np.array([1.5 + 0j, 0.2 + 3.5j])
        np.testing.assert_allclose(fresnel.fresnel(index, 1.0), np.abs((index - 1) / (index + 1)) ** 2, rtol=1e-12)
        np.testing.assert_allclose(fresnel.fresnel(index, 0.0), 1.0)

    def test_the_published_differences(self) -> None:
        """Of Sharma, Wu and Dalal's table 1: rows 1, 7, 9, 13, 16, 19, 25, 34."""
        table = np.array([[50, 2.6772, -79.7751, 50, 0, -82.7485, 2.0425], [50, 0, 0, 50, -1, 2, 2.3669],
                          [50, 2.49, -0.001, 50, -2.49, 0.0009, 7.1792], [50, -0.001, 2.49, 50, 0.0009, -2.49, 4.8045],
                          [50, 2.5, 0, 50, 0, -2.5, 4.3065], [50, 2.5, 0, 56, -27, -3, 31.9030],
                          [60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644],
                          [2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082]])
        np.testing.assert_allclose(metamer.delta_e_00(table[:, :3], table[:, 3:6]), table[:, 6], atol=1e-4)

    def test_a_product_of_straight_lines_is_integrated_exactly(self) -> None:
        flat = metamer.Spectrum.constant(1)
        ramp = metamer.Spectrum([360, 830], [0, 1])
        for power in range(1, 6):  # ∫ t^n dt = 1 / (n + 1)
            np.testing.assert_allclose(metamer.xyz_of(flat, (flat, flat, flat), *[ramp] * power), 1 / (power + 1))

    def test_factors_that_do_not_fit_are_refused(self) -> None:
        scene = factors_pb2.SceneFactors(light=[factors_pb2.SceneFactors.Light(name="l")])
        sound = {"signature_product": [0], "signature_light": [0], "signature_material": [0], "signature_term": [0],
                 "signature_node": [0], "count": [1], "signature": [0], "weight": [1.0]}
        xyz = np.zeros((1, 1, 3), np.float32)
        FactorsBuilder(plan_pb2.Plan(width=1, height=1), scene.SerializeToString()).add(
            Tile(0, 0, xyz, factors_pb2.TileFactors(**sound).SerializeToString()))
        for wrong in ({"signature_light": [1]}, {"signature_product": [1]}, {"signature_term": [1]}, {"signature": [1]},
                      {"count": [2]}, {"weight": [float("nan")]}, {"signature_node": []}, {"signature_node": [1]}):
            with self.assertRaises(errors.ProtocolError, msg=str(wrong)):
                FactorsBuilder(plan_pb2.Plan(width=1, height=1), scene.SerializeToString()).add(
                    Tile(0, 0, xyz, factors_pb2.TileFactors(**sound | wrong).SerializeToString()))


if __name__ == "__main__":
    unittest.main()
