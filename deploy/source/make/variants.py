"""Scenes that differ in one thing from the still life or the booth, in build/source."""

import shutil

from run import OUT, ROOT, metamer
from still_life import SHINE

STILL_LIFE = ROOT / "deploy/source/scene.txtpb"
BOOTH = ROOT / "deploy/booth"
LIGHTS = ["A", "B", "C", "D50", "D55", "D65", "D75", "D93", "E"] + [f"F{i}" for i in range(1, 13)]

SATIN = "diffuseness: 0.8 specularness: 0.5"
FRESNEL = "diffuseness: 0.8 specularness: 0.8 specular { constant: 0.6 } fresnel { schlick {} }"
WEAKER = FRESNEL.replace("specularness: 0.8", "specularness: 0.15")  # of lobes whose height is that of all facets in one direction
# Parameters for highlights that can be compared, though they are not alike; a model that is not here is shown with its defaults.
LOOKS = {
    "lambert": "diffuseness: 0.8 lambert {}",
    "blinn_phong": f"{SATIN} blinn_phong {{ shininess: 120 }}",
    "phong": SHINE,
    "schlick": f"{SATIN} schlick {{ falloff: 120 }}",
    "hall_greenberg": f"{FRESNEL} hall_greenberg {{ shininess: 120 }}",
    "cook_torrance": f"{WEAKER} slope {{ beckmann {{ roughness: 0.2 }} }} cook_torrance {{}}",
    "blinn": f"{FRESNEL} slope {{ trowbridge_reitz {{ roughness: 0.2 }} }} blinn {{}}",
    "strauss": "strauss { smoothness: 0.7 metalness: 0.3 }",
    "ward_phong": f"{SATIN} ward_phong {{ shininess_u: 20 shininess_v: 300 }}",
    "he_torrance": f"{WEAKER} he_torrance {{ rms_roughness: 0.2 correlation_length: 2.5 }}",
}


def prepare():
    """The files that the variants name."""
    OUT.mkdir(parents=True, exist_ok=True)
    for folder in ("meshes", "spectra"):
        shutil.copytree(STILL_LIFE.parent / folder, OUT / folder, dirs_exist_ok=True)


def models():
    """The registry's names."""
    return [item["name"] for item in metamer("models")["models"] if item["kind"] == "model"]


def with_model(name):
    """The still life with all its things of this model."""
    text = STILL_LIFE.read_text()
    assert SHINE in text
    file = OUT / f"{name}.txtpb"
    file.write_text(text.replace(SHINE, LOOKS.get(name, f"{name} {{}}")))
    return file


def sampled_booth(count):
    """The booth, whose lights and paints are given at so many wavelengths from 400 to 700 nm, and its lamp's file."""
    folder, samples = OUT / f"booth-{count}", f"400:700:{300 / (count - 1):g}"
    shutil.copytree(BOOTH / "meshes", folder / "meshes", dirs_exist_ok=True)
    (folder / "spectra").mkdir(exist_ok=True)
    shutil.copyfile(BOOTH / "booth.txtpb", folder / "booth.txtpb")
    for file in sorted((BOOTH / "spectra").iterdir()):
        metamer("spectra", "resample", file, "--samples", samples, "-o", folder / "spectra" / file.name)
    lamp = folder / "spectra/lamp.txt"
    metamer("spectra", "resample", "D65", "--samples", samples, "-o", lamp)
    return folder / "booth.txtpb", lamp


def variant(name, old, new):
    """The still life with these words in the place of those."""
    text = STILL_LIFE.read_text()
    assert old in text
    file = OUT / f"{name}.txtpb"
    file.write_text(text.replace(old, new))
    return file
