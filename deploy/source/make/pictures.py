"""Figs. E-1 to E-14: the still life as the source shows its scene."""

import quantised
import sheet
from run import OUT, metamer, render
from tables import point
from variants import STILL_LIFE, models, variant, with_model

BRADFORD = ("--adapt", "bradford")
REFERENCE = point(301)
GL_PREFILTER = ("--backend", "gl", "--method", "prefilter", *BRADFORD)


def short(value):
    """Two digits, zeros as well: 1.0 beside 0.98."""
    return f"{value:#.2g}" if value < 9.95 else f"{value:.0f}"


def light(name):
    return ("--light", f"*={name}")


def picture(name, *words, scene=STILL_LIFE):
    """The .png of that name; beside it is an .exr for `difference`."""
    file = OUT / f"{name}.png"
    render(scene, file, "-o", file.with_suffix(".exr"), *words)
    return file


def difference(a, b, scale, title):
    """A cell: a map of ΔE*uv up to `scale` with its legend, and how large it is."""
    file = OUT / f"{a}-{b}.png"
    far = metamer("compare", OUT / f"{a}.exr", OUT / f"{b}.exr", "--metric", "deuv", "--scale", scale, "-o", file)["difference"]
    return file, f"{title}: ΔE*uv {short(far['mean'])} on average, at most {short(far['maximum'])}"


def references():
    for lamp in ("A", "D65"):
        picture(f"{lamp}-301", *REFERENCE, *light(lamp), *BRADFORD)


def fig_e_1():
    sheet.write("fig-e-1", [[(picture(f"{lamp}-{count}", *point(count), *light(lamp), *BRADFORD), f"{lamp}, {count} samples")
                             for count in (301, 61, 16, 7)] for lamp in ("A", "D65", "F11")])


def fig_e_2():
    whole, rounded = quantised.pictures(STILL_LIFE)
    cells = [(picture("gl-301", *REFERENCE, *light("D65"), "--backend", "gl"), "the GL backend, 32-bit floats")]
    for name, file in rounded.items():
        far = metamer("compare", whole, file, "--metric", "deuv")["difference"]
        cells.append((file, f"{name}: ΔE*uv ≤ {short(far['maximum'])}"))
    sheet.write("fig-e-2", [cells[:2], cells[2:]])


def fig_e_3():
    sheet.write("fig-e-3", [[(picture(f"{lamp}-linear-{bases}", "--method", "linear", "--bases", bases, *light(lamp), *BRADFORD),
                              f"{lamp}, {bases} basis function" + "s" * (bases > 1)) for bases in (1, 2, 3, 4)]
                            for lamp in ("A", "D65")])


def fig_e_4():
    sheet.write("fig-e-4", [[difference(f"{lamp}-linear-4", f"{lamp}-301", 25, f"{lamp}, 4 basis functions") for lamp in ("A", "D65")]])


def with_difference(name, method, title, scale):
    """A row for each light: the picture, and how far it is from 301 samples."""
    rows = []
    for lamp in ("D65", "A"):
        shown = picture(f"{lamp}-{method}", "--method", method, *light(lamp), *BRADFORD)
        rows.append([(shown, f"{lamp}, {title}"), difference(f"{lamp}-{method}", f"{lamp}-301", scale, f"{lamp}, {title}")])
    sheet.write(name, rows)


def fig_e_5():
    with_difference("fig-e-5", "prefilter", "pre-filtered", 1)


ADAPTATIONS = {"none": "none", "von-kries": "CAT1, von Kries", "bradford": "CAT2, Bradford", "sharp": "CAT3, Sharp",
               "cmccat2000": "CAT4, CMCCAT2000"}


def fig_e_6():
    sheet.write("fig-e-6", [[(picture(f"A-{word}", *light("A"), "--adapt", word), f"A, {title}")
                             for word, title in ADAPTATIONS.items()]])


def fig_e_7():
    pairs = {"CAT2, CAT3": ("bradford", "sharp"), "CAT2, CAT4": ("bradford", "cmccat2000"), "CAT3, CAT4": ("sharp", "cmccat2000")}
    sheet.write("fig-e-7", [[difference(f"A-{a}", f"A-{b}", 10, title) for title, (a, b) in pairs.items()]])


def fig_e_8():
    sheet.write("fig-e-8", [[(picture(f"{lamp}-{degrees}deg", *light(lamp), *BRADFORD, "--observer", observer), f"{lamp}, {degrees}°")
                             for lamp in ("A", "D65")
                             for degrees, observer in ((2, "cie-1931-2deg"), (10, "cie-1964-10deg"))]])


def fig_e_9():
    sheet.write("fig-e-9", [[difference(f"{lamp}-2deg", f"{lamp}-10deg", 10, f"{lamp}, 2° and 10°") for lamp in ("A", "D65")]])


def fig_e_10():
    with_difference("fig-e-10", "rgb", "RGB", 25)


def fig_e_11():
    methods = {"RGB": ("--method", "rgb"), "301 samples": REFERENCE, "5 basis functions": ("--method", "linear", "--bases", 5),
               "pre-filtered": ("--method", "prefilter")}
    scenes = {"mirrors": variant("mirrors", "mirror: 0.12", "mirror: 0.6"),
              "bounces": variant("bounces", "depth: 3", "depth: 3 bounces: 2")}
    sheet.write("fig-e-11", [[(picture(f"{what}-{i}", *method, *light("D65"), *BRADFORD, scene=scene), f"{what}, {name}")
                              for i, (name, method) in enumerate(methods.items())] for what, scene in scenes.items()])


def by_model(name, *words):
    """A cell for each model of the registry, five a row."""
    cells = [(picture(f"{name}-{model}", *words, scene=with_model(model)), model) for model in models()]
    sheet.write(name, [cells[i:i + 5] for i in range(0, len(cells), 5)])


def fig_e_12():
    by_model("fig-e-12", *REFERENCE, *BRADFORD)


def fig_e_13():
    by_model("fig-e-13", *GL_PREFILTER, "--shading", "gouraud")


def fig_e_14():
    by_model("fig-e-14", *GL_PREFILTER, "--shading", "phong")


def section_2_3():
    sheet.write("section-2-3", [[(picture(f"shading-{word}", *BRADFORD, "--shading", word), word)
                                 for word in ("constant", "gouraud", "quadratic", "phong")]])


def all_pictures():
    references()
    for draw in (fig_e_1, fig_e_2, fig_e_3, fig_e_4, fig_e_5, fig_e_6, fig_e_7, fig_e_8, fig_e_9, fig_e_10, fig_e_11, fig_e_12,
                 fig_e_13, fig_e_14, section_2_3):
        draw()
