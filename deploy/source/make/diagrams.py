"""The source's diagrams: those of chapter 2 by `metamer models plot`, those of chapters 3 and 4 from the CIE's tables."""

import sys

import matplotlib
import numpy as np

import sheet
from run import OUT, ROOT, metamer
from variants import LIGHTS

sys.path.insert(0, str(ROOT / "deploy/booth/make"))
from cie import COLORD, read_cgats  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import NullFormatter  # noqa: E402

CURVES = {"2": "CIE1931-2deg-XYZ.cmf", "10": "CIE1964-10deg-XYZ.cmf"}
SRGB_CORNERS = [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06), (0.64, 0.33)]  # IEC 61966-2-1
SPRAGUE = np.array([[0, 0, 24, 0, 0, 0], [2, -16, 0, 16, -2, 0], [-1, 16, -30, 16, -1, 0], [-9, 39, -70, 66, -33, 7],
                    [13, -64, 126, -124, 61, -12], [-5, 25, -50, 50, -25, 5]]) / 24  # powers of t by the six samples around
MATRICES = [(7, 75), (31, 75), (301, 75), (7, 300), (31, 300), (301, 300)]  # of Fig. 4-3: rows, columns


def keep(figure, name):
    file = OUT / f"{name}.png"
    figure.savefig(file, dpi=100)
    plt.close(figure)
    sheet.write_diagram(name, file, 1200)


def chapter_2():
    """Those that `metamer models plot` has, by their names."""
    folder = OUT / "diagrams"
    metamer("models", "plot", "--figures", "-o", folder)
    names = sorted((file.stem for file in folder.glob("fig-*.png")), key=lambda name: int(name.split("-")[2]))
    for name in names:
        sheet.write_diagram(name, folder / f"{name}.png", 1200)
    return names


def by_nanometres(values):
    """Sprague's interpolation (CIE 167:2005, equations 1 and 2) of samples by 5 nm at every nm, from the third
    sample to the third last; never below 0."""
    t = np.arange(5) / 5
    six = np.lib.stride_tricks.sliding_window_view(values, 6)
    pieces = sum(np.outer(six @ row, t ** power) for power, row in enumerate(SPRAGUE))
    return np.maximum(np.append(pieces.ravel(), values[-3]), 0)


def observer(degrees):
    """By 1 nm, 370 to 820."""
    nm, _, rows = read_cgats(COLORD / "cmf" / CURVES[degrees])
    return np.arange(nm[2], nm[-3] + 1), np.array([by_nanometres(np.array(row)) for row in rows])


def fig_3_3():
    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    for degrees, style in (("2", "-"), ("10", "--")):
        nm, rows = observer(degrees)
        for row, letter, colour in zip(rows, "xyz", ("tab:red", "tab:green", "tab:blue")):
            axes.plot(nm, row, style, color=colour, label=rf"$\bar{{{letter}}}$, {degrees}°")
    axes.set(xlim=(380, 780), ylim=(0, None), xlabel="wavelength, nm", ylabel="matching functions")
    axes.legend(ncols=2)
    axes.grid(alpha=0.3)
    keep(figure, "fig-3-3")


def fig_3_4():
    nm, rows = observer("2")
    seen = (nm >= 380) & (nm <= 700)
    x, y = rows[0, seen] / rows[:, seen].sum(0), rows[1, seen] / rows[:, seen].sum(0)
    figure, axes = plt.subplots(figsize=(5.6, 6), layout="constrained")
    axes.plot(np.append(x, x[0]), np.append(y, y[0]), "k-")
    for at in (460, 480, 500, 520, 540, 560, 580, 600, 620, 700):
        i = int(np.argmin(abs(nm[seen] - at)))
        axes.plot(x[i], y[i], "k.")
        axes.annotate(str(at), (x[i], y[i]), xytext=(4, 4), textcoords="offset points", fontsize=8)
    axes.plot(*zip(*SRGB_CORNERS), "-", color="tab:gray", label="sRGB")
    spectra = metamer("spectra", "info", "A", "D65", "F11")["spectra"]
    for spectrum in spectra:
        place = spectrum["cie-1931-2deg"]
        axes.plot(place["x"], place["y"], "o", label=spectrum["name"])
    axes.set(xlim=(0, 0.8), ylim=(0, 0.9), xlabel="$x$", ylabel="$y$", aspect="equal")
    axes.legend()
    axes.grid(alpha=0.3)
    keep(figure, "fig-3-4")


def stimuli(rows):
    """Columns: the CIE's lights, and each of its test colours under each of them, by so many samples from 400 to 700 nm."""
    file = OUT / f"stimuli-{rows}.sp"
    colours = [f"TCS{i:02}" for i in range(1, 16)]
    values = {}
    for kind, names in (("emission", LIGHTS), ("reflectance", colours)):
        metamer("spectra", "resample", *names, "--as", kind, "--samples", f"400:700:{300 / (rows - 1):g}", "-o", file)
        data = file.read_text().split("\nBEGIN_DATA\n")[1].split("\nEND_DATA")[0]
        values[kind] = np.array([line.split()[-rows:] for line in data.splitlines()], float)
    lights = values["emission"] / values["emission"].mean(1, keepdims=True)
    lit = (lights[:, None, :] * values["reflectance"][None]).reshape(-1, rows)
    return np.concatenate([lights, lit]).T


def fig_4_3():
    """E[3.3-10] relative to the sum of all squares, as a root: what the basis leaves out is what the smaller singular values hold."""
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for rows, columns in MATRICES:
        whole = stimuli(rows)
        picked = np.linspace(0, whole.shape[1] - 1, columns).round().astype(int)
        squares = np.linalg.svd(whole[:, picked], compute_uv=False) ** 2
        left = np.sqrt(np.maximum(1 - np.cumsum(squares) / squares.sum(), 0))[:10]
        shown = np.flatnonzero(left > 1e-6)
        axes.semilogy(shown + 1, 100 * left[shown], "o-" if columns == 75 else "s--", label=f"{rows}×{columns}")
    axes.set(xlabel="basis functions", ylabel="error, % of the spectra's root mean square")
    axes.set_yticks([5, 10, 20, 50], ["5", "10", "20", "50"])
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.legend(title="rows × columns", ncols=2)
    axes.grid(alpha=0.3, which="both")
    keep(figure, "fig-4-3")


def all_diagrams():
    """The names of the pictures."""
    names = chapter_2()
    fig_3_3()
    fig_3_4()
    fig_4_3()
    return names + ["fig-3-3", "fig-3-4", "fig-4-3"]
