"""The source's tables, measured anew."""

from time import process_time

import numpy as np

import printed
from run import Times
from variants import STILL_LIFE, sampled_booth, with_model

ROUNDS = 3
QUICK = 12  # of what takes milliseconds
LARGE = ("--size", "480x360")
DIRECT, REFLECTED = ("--depth", 0, *LARGE), ("--depth", 3, *LARGE)
GL = ("--backend", "gl", "--spp", 1)
SMALL = ("--size", "80x60")  # software draws the passes of 301 samples, too


def point(count, *more):
    """Point sampling as the source does it: lights by their power at the samples."""
    return ("--method", "point", "--samples", f"400:700:{300 / (count - 1):g}", "--point-lights", "samples", *more)


def method_of(count):
    return ("--method", "rgb") if count == 3 else point(count)


def name_of(count):
    return "3, trichromatic" if count == 3 else str(count)


def table(number, title, columns, rows, command, why):
    return {"number": number, "title": title, "columns": columns, "rows": rows, "command": command, "why": why}


def milliseconds(seconds):
    return f"{1000 * seconds:.3g} ms"


def times(value):
    return f"{value:.2f}"


def table_4_2_1():
    printed_seconds = printed.TABLE_4_2_1
    taken = Times({count: (STILL_LIFE, (*method_of(count), *DIRECT)) for count in printed_seconds}, ROUNDS)
    rows = [[name_of(count), f"{seconds:g} s", times(seconds / printed_seconds[3]),
             milliseconds(taken.seconds[count]), times(taken.ratio(count, 3))]
            for count, seconds in printed_seconds.items()]
    return table("4.2-1", "Point sampling and trichromatic rendering by ray tracing, direct light alone",
                 ["samples", "the source", "over 3", "Metamer", "over 3"], rows,
                 "metamer render deploy/source/scene.txtpb --size 480x360 --depth 0 --method point --samples 400:700:1 "
                 "--point-lights samples -o picture.png --json",
                 "The source multiplies whole spectra for each ray, so that its time grows with them. Here no ray carries a "
                 "spectrum: a pixel's weights are gathered first, and wavelengths are gone over once a pixel: the time hardly grows. "
                 "The source's seconds are those of a managed program on a machine of 2004, and its scene is not known: only the ratios can be compared.")


def table_4_2_2():
    cases = {}
    for count in printed.TABLE_4_2_2:
        cases[count] = (STILL_LIFE, (*method_of(count), *GL, *SMALL, *(("--multi-pass",) if count > 3 else ())))
        cases["one", count] = (STILL_LIFE, (*method_of(count), *GL, *SMALL))
    taken = Times(cases, 1)
    rows = []
    for count, (passes, rate) in sorted(printed.TABLE_4_2_2.items(), reverse=True):
        fastest = printed.TABLE_4_2_2[3][1]
        rows.append([name_of(count), str(passes), f"{rate:g}", times(fastest / rate),
                     str(2 * -(-count // 4) if count > 3 else 1), f"{1 / taken.seconds[count]:.3g}", times(taken.ratio(count, 3)),
                     times(taken.ratio(("one", count), 3))])
    return table("4.2-2", "Frames per second of the real-time version by the number of samples, four a pass",
                 ["samples", "passes, the source", "frames a second", "time over 3", "passes, Metamer",
                  "frames a CPU second", "time over 3", "in one pass, over 3"], rows,
                 "metamer render deploy/source/scene.txtpb --backend gl --spp 1 --size 80x60 --method point --samples 400:700:1 "
                 "--point-lights samples --multi-pass -o picture.png --json",
                 "One round alone. Metamer's passes are counted, not printed: `--multi-pass` draws four wavelengths of one of the two lights a pass, "
                 "so 301 take 152. "
                 "The source counts the passes that add three textures up among its own; here each pass adds what it draws. "
                 "Both grow with the passes, since the scene is drawn anew for each. A pass here costs more than the source's beside a trichromatic "
                 "frame: it shades all that triangles cover, hidden or not, with shadows, and software does so in blocks of 4×4 "
                 "pixels, which small triangles fill badly. In one pass, Metamer's default, each pixel is shaded once and wavelengths are "
                 "summed up in a second shader.")


def preparation(number, title, printed_seconds, method, columns, command, why):
    cases = {}
    for count in printed_seconds:
        scene, lamp = sampled_booth(count)
        cases[count] = (scene, (*method, "--light", f"*={lamp}", "--size", "32x24", "--spp", 1))
    taken = Times(cases, QUICK, "prepare")
    rows = [[str(count) if method[1] == "prefilter" else f"{count}×75", milliseconds(seconds),
             times(seconds / printed_seconds[31]), milliseconds(taken.seconds[count]), times(taken.ratio(count, 31))]
            for count, seconds in sorted(printed_seconds.items(), reverse=True)]
    return table(number, title, columns, rows, command, why)


def table_4_3_1():
    return preparation(
        "4.3-1", "What colour pre-filtering prepares, by the samples of the data: two lights, 35 materials",
        printed.TABLE_4_3_1, ("--method", "prefilter"),
        ["samples", "the source", "over 31", "Metamer", "over 31"],
        "metamer render build/source/booth-301/booth.txtpb --light '*=build/source/booth-301/spectra/lamp.txt' "
        "--method prefilter --size 32x24 --spp 1 -o picture.png --json",
        "The source adds up the samples of its data. Here the products of spectra are integrated between all samples, and data by "
        "more than 1 nm are first read as curves at every nm from 360 to 830: fewer samples save nothing, and do not cost "
        "accuracy. The scene is the booth, which has as many lights and materials.")


def table_4_4_1():
    generator = np.random.default_rng(1)
    matrices = {size: generator.random(size) for size in printed.TABLE_4_4_1}
    seconds = {size: float("inf") for size in matrices}
    for _ in range(ROUNDS):
        for size, matrix in matrices.items():
            start = process_time()
            np.linalg.svd(matrix, full_matrices=False)
            seconds[size] = min(seconds[size], process_time() - start)
    smallest = (100, 100)
    rows = [[f"{m}×{n}", f"{value:g} s", times(value / printed.TABLE_4_4_1[smallest]),
             milliseconds(seconds[m, n]), times(seconds[m, n] / seconds[smallest])]
            for (m, n), value in printed.TABLE_4_4_1.items()]
    return table("4.4-1", "Singular value decomposition by the dimensions of the matrix",
                 ["rows × columns", "the source", "over 100×100", "LAPACK", "over 100×100"], rows,
                 "numpy.linalg.svd(numpy.random.default_rng(1).random((100, 100)), full_matrices=False)",
                 "The source adapted a textbook's routine, which finds full bases by loops over single numbers; LAPACK, by "
                 "numpy, finds the thin ones by blocks that fit a cache, by divide and conquer. Metamer itself takes Eigen's, "
                 "which works alike. The source's time grows faster than the cube of the size, LAPACK's more slowly.")


def table_4_4_2():
    return preparation(
        "4.4-2", "What the linear representation prepares for four basis functions, by the samples of the data: "
        "two lights, 35 materials", printed.TABLE_4_4_2, ("--method", "linear", "--bases", 4),
        ["dimension", "the source", "over 31×75", "Metamer", "over 31×75"],
        "metamer render build/source/booth-301/booth.txtpb --light '*=build/source/booth-301/spectra/lamp.txt' "
        "--method linear --bases 4 --size 32x24 --spp 1 -o picture.png --json",
        "The source decomposes a matrix with a row for each sample. Here the matrix has a row for each nm from 360 to 830 "
        "whatever the data are, so that fewer samples save nothing; and a column for each light and each distinct "
        "paint under it, where the source has one for each material.")


def table_4_4_3():
    cases = {}
    for count in printed.TABLE_4_4_3:
        method = point(count) if count > 5 else ("--method", "linear", "--bases", count)
        cases[count, 0] = (STILL_LIFE, (*method, *DIRECT))
        cases[count, 1] = (STILL_LIFE, (*method, *REFLECTED))
    taken = Times(cases, ROUNDS)
    rows = [[f"{count} samples" if count > 5 else str(count), light, f"{seconds[k]} s",
             times(seconds[k] / printed.TABLE_4_4_3[301][k]), milliseconds(taken.seconds[count, k]),
             times(taken.ratio((count, k), (301, k)))]
            for k, light in enumerate(("direct", "with reflections")) for count, seconds in printed.TABLE_4_4_3.items()]
    return table("4.4-3", "The linear representation by its basis functions, and 301 samples",
                 ["basis functions", "light", "the source", "over 301 samples", "Metamer", "over 301 samples"], rows,
                 "metamer render deploy/source/scene.txtpb --method linear --bases 4 --size 480x360 --depth 3 -o picture.png --json",
                 "The source saves what its rays no longer carry. Here rays carry nothing in either case, so that "
                 "less is there to save: what differs is done once a pixel. What accuracy costs is seen in Figs. E-3 and E-4.")


def table_4_5_1():
    cases = {name: (with_model(name), (*point(301), *REFLECTED)) for name in printed.TABLE_4_5_1}
    taken = Times(cases, ROUNDS)
    rows = [[name, f"{seconds} s", times(seconds / printed.TABLE_4_5_1["phong"]), milliseconds(taken.seconds[name]),
             times(taken.ratio(name, "phong"))] for name, seconds in printed.TABLE_4_5_1.items()]
    return table("4.5-1", "Illumination models by ray tracing, 301 samples, reflections traced",
                 ["model", "the source", "over phong", "Metamer", "over phong"], rows,
                 "metamer render build/source/blinn.txtpb --method point --samples 400:700:1 --point-lights samples "
                 "--size 480x360 --depth 3 -o picture.png --json",
                 "The source evaluates Blinn's Fresnel term at each of the 301 wavelengths of each hit. Here such a term is "
                 "a weight on two spectra, and models are computed for several rays at once: tracing the rays takes most of the time.")


def table_4_5_2():
    shadings = {"vertex": "gouraud", "pixel": "phong"}
    cases = {(name, per): (with_model(name), ("--method", "rgb", "--shading", shading, *GL))
             for name in printed.TABLE_4_5_2 for per, shading in shadings.items()}
    taken = Times(cases, QUICK)
    first = printed.TABLE_4_5_2["phong"][0]
    rows = []
    for k, per in enumerate(shadings):
        for name, rates in printed.TABLE_4_5_2.items():
            rate, one_light = rates[k], "*" if (name, per) == ("blinn", "pixel") else ""
            rows.append([name, per, f"{rate:g}{one_light}" if rate else "n/a", times(first / rate) if rate else "",
                         f"{1 / taken.seconds[name, per]:.3g}", times(taken.ratio((name, per), ("phong", "vertex")))])
    return table("4.5-2", "Frames per second of the models' real-time version, per vertex and per pixel",
                 ["model", "per", "the source", "time over phong per vertex", "Metamer, a CPU second", "time over phong per vertex"], rows,
                 "metamer render build/source/blinn.txtpb --backend gl --spp 1 --method rgb --shading gouraud -o picture.png --json",
                 "The source's pixel shaders had room for 64 instructions: Blinn's model had to do with one light (*) and Strauss's "
                 "did not fit. Here all fit. A frame's time is that of drawing pixels and shadows by software, next to which "
                 "a model costs little; what is evaluated per vertex is another pass, which costs as much as it saves.")


def all_tables():
    return [make() for make in (table_4_2_1, table_4_2_2, table_4_3_1, table_4_4_1, table_4_4_2, table_4_4_3, table_4_5_1,
                                table_4_5_2)]
