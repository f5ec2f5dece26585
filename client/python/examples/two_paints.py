"""Two paints that match under D65 and part under F11: their spectra, their pictures, and ΔE00. Cells (# %%) run one by one in
an editor that knows them; as a program it takes the figure's file, and the metamerd to start if none is in PATH:

    /usr/bin/python3 client/python/examples/two_paints.py two_paints.png [build/release/bin/metamerd]
"""
# %% A scene: two matte balls that differ in nothing but their paint.
import sys

import matplotlib
import numpy as np

import metamer

FIGURE, PROGRAM = sys.argv[1], (sys.argv[2:] or [None])[0]
SCENE = """
camera { eye { y: 0.4 z: 4 } target {} vertical_fov: 32 }
light { name: "lamp" direction { x: -0.4 y: -0.6 z: -1 } luminance: 1 spectrum { standard: "D65" } }
material { name: "one" diffuse { constant: 0.5 } }
material { name: "other" diffuse { constant: 0.5 } }
material { name: "grey" diffuse { constant: 0.35 } }
object { name: "left" material: "one" sphere { center { x: -0.75 } radius: 0.7 } }
object { name: "right" material: "other" sphere { center { x: 0.75 } radius: 0.7 } }
object { name: "table" material: "grey" quad { corner { x: -9 y: -0.7 z: 9 } u { x: 18 } v { z: -18 } } }
settings { width: 240 height: 120 spp: 16 method { exact {} } }
"""
scene = metamer.Scene.parse(SCENE)
server = metamer.local(PROGRAM)
spectra = server.spectra(scene)
observer = spectra.observer
lights = {word: server.spectrum(word) for word in ("D65", "F11")}

# %% The paints: a smooth one, and one that differs from it by a metameric black, which D65 shows as nothing.
nm = np.arange(360.0, 831.0, 5.0)
paint = 0.45 + 0.2 * np.tanh((nm - 560) / 60)
waves = [np.cos(2 * np.pi * k * (nm - 360) / 470 + phase) for k in (2, 3) for phase in (0, np.pi / 2)]
seen = np.stack([metamer.xyz_of(lights["D65"], observer, metamer.Spectrum(nm, wave)) for wave in waves], 1)
black = np.linalg.svd(seen)[2][-1] @ np.stack(waves)  # 4 waves, 3 equations: one way is left
largest = np.min(np.where(black > 0, 1 - paint, paint) / np.abs(black))
paints = {"one": metamer.Spectrum(nm, paint), "other": metamer.Spectrum(nm, paint + 0.9 * largest * black)}

# %% One picture, whose factors are relit: with these paints, under both lights.
kept = server.render(scene, keep_factors=True)
pictures = {word: kept.factors.relight({"lamp": light}, paints) for word, light in lights.items()}
server.close()


def difference(light: metamer.Spectrum) -> float:
    """ΔE00 of the paints, each facing this light."""
    white = metamer.xyz_of(light, observer)
    one, other = (metamer.lab(metamer.xyz_of(light, observer, of), white) for of in paints.values())
    return float(metamer.delta_e_00(one, other))


# %% The figure.
matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

figure, (curves, *panels) = pyplot.subplots(1, 3, figsize=(12, 3), width_ratios=[1, 1.4, 1.4], layout="constrained")
for name, spectrum in paints.items():
    curves.plot(spectrum.nm, spectrum.values, label=name)
curves.set(xlabel="nm", ylabel="reflectance", ylim=(0, 1), xlim=(360, 830))
curves.legend()
for panel, (word, light) in zip(panels, lights.items()):
    panel.imshow(metamer.to_srgb(pictures[word]))
    panel.set_title(f"{word}: ΔE00 {difference(light):.1f}")
    panel.set_axis_off()
    print(f"{word}: {difference(light):.3f}")
figure.savefig(FIGURE, dpi=100)
