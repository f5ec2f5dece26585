#!/usr/bin/env python3
"""Writes the gallery: gallery.txtpb, its spectra and its mesh, and labels.txt, the words on the
contact sheet. A ball for everything that decides how a surface reflects. Lengths in metres, y up,
the viewer at +z, the balls at z = 0."""

from math import atan, cos, degrees, pi, sin
from pathlib import Path
import sys

GALLERY = Path(__file__).parent.parent
BOOTH_MAKE = GALLERY.parent / "booth" / "make"
sys.dont_write_bytecode = True
sys.path.insert(0, str(BOOTH_MAKE))
from ply import write_ply  # noqa: E402
from scene import mesh, num, quad, sphere, vec  # noqa: E402

RADIUS = 0.125
COLUMN, ROW = 0.36, 0.5             # from ball to ball
WIDTH, HEIGHT = 1600, 912           # pixels
METRE = 420                         # pixels, at z = 0
DISTANCE = 10                       # of the eye

BLUE = 'diffuse { file: "spectra/blue.txt" }'
SATIN = "diffuseness: 0.7 specularness: 0.4"
GLOSS = "diffuse { constant: 0.02 } mirror: 1 specularness: 0.9 hall_greenberg { shininess: 400 }"
BRIGHT = "diffuseness: 0 mirror: 0.33 specularness: 0.9 hall_greenberg { shininess: 400 }"


def conductor(metal):
    return f'fresnel {{ conductor {{ metal: "{metal}" }} }}'


def medium(name):
    return f'fresnel {{ dielectric {{ medium: "{name}" }} }}'


SCHLICK = "specular { constant: 0.04 } fresnel { schlick {} }"
SHINY = "diffuseness: 0.6 specularness: 0.7 specular { constant: 0.32 } fresnel { schlick {} }"

# Headings with their balls: label, second line, material.
MODELS = [
    ("lambert", "", f"{BLUE} lambert {{}}"),
    ("oren_nayar", "diffuse term, 0.6", f"{BLUE} lambert {{}} oren_nayar {{ roughness: 0.6 }}"),
    ("phong", "n 60", f"{BLUE} {SATIN} phong {{ shininess: 60 }}"),
    ("blinn_phong", "n 60", f"{BLUE} {SATIN} blinn_phong {{ shininess: 60 }}"),
    ("schlick", "p 60", f"{BLUE} {SATIN} schlick {{ falloff: 60 }}"),
    ("hall_greenberg", "n 60, f 0.32", f"{BLUE} {SHINY} hall_greenberg {{ shininess: 60 }}"),
    ("cook_torrance", "beckmann 0.3, f 0.32", f"{BLUE} {SHINY} "
     "slope { beckmann { roughness: 0.3 } } cook_torrance {}"),
    ("blinn", "trowbridge_reitz 0.2", f"{BLUE} {SHINY} "
     "slope { trowbridge_reitz { roughness: 0.2 } } blinn {}"),
    ("strauss", "o 0.75, p 0.7", f"{BLUE} strauss {{ smoothness: 0.75 metalness: 0.7 }}"),
    ("ward_phong", "a 10, b 200", f"{BLUE} {SATIN} ward_phong {{ shininess_u: 10 shininess_v: 200 }}"),
]


SLOPES = [
    ("gaussian", "roughness: 0.3", 1),
    ("beckmann", "roughness: 0.3", 1 / 0.09),
    ("schlick", "roughness: 0.3", 1 / 0.09),
    ("trowbridge_reitz", "roughness: 0.3", 1),
    ("ward", "roughness_u: 0.1 roughness_v: 0.4", 1 / 0.04),
]


def slopes(metal, model, weight):
    """Alike bright in the mirror direction, where D is `peak`, as far as a specularness of 1 allows."""
    cells = []
    for name, values, peak in SLOPES:
        if (name, model) == ("gaussian", "cook_torrance"):  # its scale is for such a model
            values, peak = values + " scale: 11.1", 11.1
        strength = num(min(1, weight / peak))
        cells.append((name, f"{model}, {metal}",
                      f"diffuseness: 0 specularness: {strength} {conductor(metal)} "
                      f"slope {{ {name} {{ {values} }} }} {model} {{}}"))
    return cells


FRESNEL = [
    ("none", "C_S 0.04", f"specular {{ constant: 0.04 }} {GLOSS}"),
    ("schlick", "f 0.04", f"{SCHLICK} {GLOSS}"),
    ("water", "dielectric", f"{medium('water')} {GLOSS}"),
    ("N-BK7", "dielectric", f"{medium('N-BK7')} {GLOSS}"),
    ("N-SF11", "dielectric", f"{medium('N-SF11')} {GLOSS}"),
    ("diamond", "dielectric", f"{medium('diamond')} {GLOSS}"),
]
REFLECTANCE = ("reflectance", "of copper", "fresnel { dielectric { reflectance { "
               f'file: "spectra/copper-reflectance.txt" }} }} }} {BRIGHT}')
METALS = [(metal, "conductor", f"{conductor(metal)} {BRIGHT}") for metal in ("Cu", "Au", "Ag")]
ROUGH = ("he_torrance", "Al, 150 nm", f"diffuseness: 0 specularness: 1 {conductor('Al')} "
         "he_torrance { rms_roughness: 0.15 correlation_length: 2 }")
ATTENUATIONS = [
    (name, "roughness 0.8", f"diffuseness: 0 specularness: 1 {conductor('Ag')} "
     f"slope {{ beckmann {{ roughness: 0.8 }} }} "
     f"attenuation: {name.upper()} cook_torrance {{}}")
    for name in ("torrance_sparrow", "smith", "schlick")]
WARD = [
    (f"ward {u:g} x {v:g}", "Al", f"diffuseness: 0 specularness: 0.2 {conductor('Al')} "
     f"slope {{ ward {{ roughness_u: {u} roughness_v: {v} }} }} cook_torrance {{}}")
    for u, v in ((0.1, 0.5), (0.5, 0.1))]
COARSE = f"{BLUE} {SATIN} blinn_phong {{ shininess: 40 }}"
SHADINGS = [(word, "120 triangles", COARSE) for word in ("constant", "gouraud", "quadratic", "phong")]

ROWS = [
    [("Models, and Oren's and Nayar's diffuse term", MODELS)],
    [("Slope distributions, roughness 0.3", slopes("Cu", "cook_torrance", 4)),
     ("", slopes("Au", "blinn", 0.9))],
    [("Fresnel term", FRESNEL), ("", [REFLECTANCE]), ("Attenuation, silver", ATTENUATIONS)],
    [("Metals", METALS + [ROUGH]), ("Anisotropic", WARD), ("Shading of a coarse mesh", SHADINGS)],
]

# Where the shipped table of P. B. Johnson and R. W. Christy, Phys. Rev. B 6, 4370 (1972) has copper:
# nm, n, k.
COPPER = [(381.5, 1.33, 2.045), (397.4, 1.32, 2.116), (413.3, 1.28, 2.207), (430.5, 1.25, 2.305),
          (450.9, 1.24, 2.397), (471.4, 1.25, 2.483), (495.9, 1.22, 2.564), (520.9, 1.18, 2.608),
          (548.6, 1.02, 2.577), (582.1, 0.70, 2.704), (616.8, 0.30, 3.205), (659.5, 0.22, 3.747),
          (704.5, 0.21, 4.205)]


def write_spectra():
    lines = ["# Reflectance of copper at normal incidence, ((n − 1)² + k²)/((n + 1)² + k²), from n and k of",
             "# P. B. Johnson and R. W. Christy, Optical constants of the noble metals, Phys. Rev. B 6,",
             "# 4370 (1972). Wavelength in nm, value. Made by deploy/gallery/make/scene.py."]
    for nm, n, k in COPPER:
        lines.append(f"{nm:g} {((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k):.6f}")
    (GALLERY / "spectra" / "copper-reflectance.txt").write_text("\n".join(lines) + "\n")

    # One of the booth's test colours.
    rows = (BOOTH_MAKE.parent / "spectra" / "tcs.sp").read_text().splitlines()
    values = next(row.split()[1:] for row in rows if row.startswith("TCS12 "))
    lines = ["# Strong blue: CIE 13.3-1995, test colour sample 12, from the table in Debian's colord-data.",
             "# Reflectance; wavelength in nm, value. Made by deploy/gallery/make/scene.py."]
    lines += [f"{360 + 5 * i} {value}" for i, value in enumerate(values)]
    (GALLERY / "spectra" / "blue.txt").write_text("\n".join(lines) + "\n")


def write_coarse_ball():
    """A ball of 12 × 6 patches, 120 triangles, with the normals of the true ball."""
    points = [(sin(v) * sin(u), cos(v), sin(v) * cos(u))
              for v in (pi * j / 6 for j in range(7)) for u in (2 * pi * i / 12 for i in range(12))]
    triangles = []
    for j in range(6):
        for i in range(12):
            a, b = 12 * j + i, 12 * j + (i + 1) % 12
            if j > 0:
                triangles.append((a, a + 12, b))
            if j < 5:
                triangles.append((a + 12, b + 12, b))
    write_ply(GALLERY / "meshes" / "coarse-ball.ply", "made by deploy/gallery/make/scene.py",
              [p + p for p in points], triangles)


def panel(name, corner, u, v):
    return quad(name, "panel", corner, u, v)


def studio():
    """A grey board behind the balls, and panels for them to mirror. A panel's light comes from
    nowhere (ambient), so no lamp stands before it; none is in the key light's way. The light behind
    the board reaches no ball: it only makes the panels brighter."""
    return [
        'light { name: "key" direction { x: 0.45 y: -0.5 z: -0.75 } '
        'spectrum { standard: "D65" } luminance: 0.9 }',
        'light { name: "behind the board" direction { z: 1 } '
        'spectrum { standard: "D65" } luminance: 2.5 }',
        "",
        'material { name: "board" diffuse { constant: 0.065 } phong { ambient: 0.35 } }',
        'material { name: "panel" diffuse { constant: 0.95 } phong { ambient: 1 } }',
        'material { name: "room" diffuse { constant: 0.2 } phong { ambient: 1 } }',
        quad("board", "board", (-9, -9, -0.14), (18, 0, 0), (0, 18, 0)),
        panel("panel above", (-3.5, 4, 0.5), (7, 0, 0), (0, 0, 2.6)),
        panel("panel left", (-4, -1.6, 0.6), (0, 0, 2.8), (0, 2.8, 0)),
        panel("panel right", (4, -1.2, 0.6), (0, 2.4, 0), (0, 0, 1.6)),
        quad("room front", "room", (8, -5, 12), (-16, 0, 0), (0, 9, 0)),
        quad("room left", "room", (-8, -5, 12), (0, 0, -12), (0, 9, 0)),
        quad("room right", "room", (8, -5, 0), (0, 0, 12), (0, 9, 0)),
        quad("room below", "room", (-8, -5, 12), (16, 0, 0), (0, 0, -12)),
    ]


def balls():
    lines, labels = [], []
    names = set()
    for r, row in enumerate(ROWS):
        column = 0
        y = ROW * (len(ROWS) / 2 - 0.5 - r) - 0.065
        for heading, cells in row:
            if heading:
                x = WIDTH / 2 + METRE * (COLUMN * (column - 5) + 0.03)
                labels.append(f"heading {x:.0f} {HEIGHT / 2 - METRE * (y + 0.25):.0f} {heading}")
            for label, second, material in cells:
                x = COLUMN * (column - 4.5)
                name = f"{r + 1}.{column + 1} {label}"
                lines.append(f'material {{ name: "{name}" {material} }}')
                if label in ("constant", "gouraud", "quadratic") or second.endswith("triangles"):
                    made = mesh(name, name, "meshes/coarse-ball.ply",
                                f"scale {{ x: {RADIUS} y: {RADIUS} z: {RADIUS} }}",
                                f"rotate {{ axis {{ x: 1 z: 0.3 }} degrees: 25 }}",
                                f"translate {vec(x, y, 0)}")
                    lines.append(made[:-1] + f"shading: {label.upper()} }}")
                else:
                    lines.append(sphere(name, name, (x, y, 0), RADIUS))
                px, py = WIDTH / 2 + METRE * x, HEIGHT / 2 - METRE * (y + 0.18)
                labels.append(f"name {px:.0f} {py:.0f} {label}")
                if second:
                    labels.append(f"note {px:.0f} {py + 16:.0f} {second}")
                assert name not in names
                names.add(name)
                column += 1
    return lines, labels


def main():
    write_spectra()
    write_coarse_ball()
    lines, labels = balls()
    fov = degrees(2 * atan(HEIGHT / METRE / 2 / DISTANCE))
    text = ["# proto-file: metamer/v1/scene.proto", "# proto-message: metamer.v1.Scene",
            "# Every model, slope distribution, attenuation, Fresnel term and shading, a ball each.",
            "# Written by make/scene.py.", "",
            f"camera {{ eye {vec(0, 0, DISTANCE)} target {{}} vertical_fov: {num(fov)} }}", "",
            *studio(), "", *lines, "",
            f"settings {{ width: {WIDTH} height: {HEIGHT} spp: 16 depth: 2 "
            f"method {{ point {{ from: 400 to: 700 step: 5 }} }} }}"]
    (GALLERY / "gallery.txtpb").write_text("\n".join(text) + "\n")
    (GALLERY / "make" / "labels.txt").write_text("\n".join(labels) + "\n")


main()
