#!/usr/bin/env python3
"""Writes the booth's spectra: the CRI test colours, and two paints that match under D65.

Run from anywhere; needs Debian's colord-data. Prints how far the paints differ, by light."""

from pathlib import Path

from cie import COLORD, delta_e_2000, read_cgats, solve, to_lab, to_xyz, weights

SPECTRA = Path(__file__).parent.parent / "spectra"

NODES = [400 + 5 * i for i in range(61)]  # nm: where the metameric black has its samples
FINE = [400 + i for i in range(301)]      # nm: the reference, 1 nm, interpolated linearly
COARSE = [400 + 10 * i for i in range(31)]
AMPLITUDE = 0.50                          # of the black, at its largest


def on_nodes(positions, rows):
    """Weights at `positions` of a function that is linear between NODES, as weights at NODES."""
    result = []
    for row in rows:
        folded = [0.0] * len(NODES)
        for x, weight in zip(positions, row):
            i = min(int(x - 400) // 5, len(NODES) - 2)
            t = (x - NODES[i]) / 5
            folded[i] += weight * (1 - t)
            folded[i + 1] += weight * t
        result.append(folded)
    return result


def unit(i):
    return [1.0 if k == i else 0.0 for k in range(len(NODES))]


def redness_under_a():
    """X/X_w - Y/Y_w under illuminant A: to first order how red a surface looks there."""
    x, y, _ = on_nodes(FINE, weights("A", FINE))
    return [a / sum(x) - b / sum(y) for a, b in zip(x, y)]


def metameric_black():
    """The smoothest function (least squared second differences) that no sampling of 1, 5 or 10 nm
    sees under D65, that fades out at 400 and 700 nm, and that is red under A."""
    invisible = [row for positions in (FINE, NODES, COARSE)
                 for row in on_nodes(positions, weights("D65", positions))]
    ends = [unit(0), unit(1), unit(len(NODES) - 2), unit(len(NODES) - 1)]
    constraints = invisible + ends + [redness_under_a()]
    wanted = [0.0] * (len(constraints) - 1) + [1.0]

    # Minimise f'Hf under the constraints: one linear system with a multiplier for each of them.
    n = len(NODES)
    h = [[0.0] * n for _ in range(n)]
    for i in range(n - 2):
        second = ((i, 1.0), (i + 1, -2.0), (i + 2, 1.0))
        for j, a in second:
            for k, b in second:
                h[j][k] += a * b
    system = [h[i] + [row[i] for row in constraints] for i in range(n)]
    system += [row + [0.0] * len(constraints) for row in constraints]
    black = solve(system, [0.0] * n + wanted)[:n]
    largest = max(abs(value) for value in black)
    return [AMPLITUDE * value / largest for value in black]


def paints():
    """Both paints at NODES: a warm grey less half the black, and that plus the black."""
    grey = [0.38 + 0.08 * (nm - 400) / 300 for nm in NODES]
    black = metameric_black()
    first = [round(g - b / 2, 6) for g, b in zip(grey, black)]
    return first, [round(f + b, 6) for f, b in zip(first, black)]


def write_paint(name, what, values):
    lines = [f"# {name}: {what}",
             "# Reflectance; wavelength in nm, value. Level outside 400 to 700 nm.",
             "# Made by deploy/booth/make/spectra.py, which says how the black is computed. The paints",
             "# match for the CIE 1931 2-degree observer under D65, sampled by 1, 5 or 10 nm."]
    rows = [(360, values[0])] + list(zip(NODES, values)) + [(830, values[-1])]
    lines += [f"{nm} {value:.6f}" for nm, value in rows]
    (SPECTRA / f"{name}.txt").write_text("\n".join(lines) + "\n")


def hold_ends(values):
    """The table has 0 where a colour was not measured; hold its first and last value there."""
    measured = [i for i, value in enumerate(values) if value > 0]
    first, last = measured[0], measured[-1]
    return [values[min(max(i, first), last)] for i in range(len(values))]


def write_test_colours():
    nm, names, rows = read_cgats(COLORD / "ref/CIE-TCS.sp")
    lines = ['SPECT', '',
             'DESCRIPTOR "CIE 13.3-1995, test colour samples 1 to 14, and the Asian skin of JIS Z 8726"',
             'ORIGINATOR "deploy/booth/make/spectra.py, from the table in Debian\'s colord-data"',
             f'SPECTRAL_START_NM {nm[0]:g}', f'SPECTRAL_END_NM {nm[-1]:g}',
             f'SPECTRAL_BANDS {len(nm)}', f'NUMBER_OF_FIELDS {len(nm) + 1}',
             f'NUMBER_OF_SETS {len(names)}', '', 'BEGIN_DATA_FORMAT',
             'SAMPLE_ID ' + ' '.join(f'SPEC_{x:g}' for x in nm), 'END_DATA_FORMAT', '',
             'BEGIN_DATA']
    for name, row in zip(names, rows):
        lines.append(name + ' ' + ' '.join(f'{value:g}' for value in hold_ends(row)))
    (SPECTRA / "tcs.sp").write_text("\n".join(lines + ["END_DATA"]) + "\n")


def report(first, second):
    print(f"paint-1 {min(first):.3f} to {max(first):.3f}, paint-2 {min(second):.3f} to {max(second):.3f}")
    for name in ("D65", "D50", "A", "F2", "F11"):
        texts = []
        for positions in (FINE, NODES, COARSE):
            rows = weights(name, positions)
            white = [sum(row) for row in rows]
            folded = on_nodes(positions, rows)
            lab = [to_lab(to_xyz(folded, paint), white) for paint in (first, second)]
            texts.append(f"{delta_e_2000(*lab):.3f}")
        print(f"{name:4} ΔE00 at 1, 5, 10 nm: {', '.join(texts)}")


if __name__ == "__main__":
    first, second = paints()
    write_paint("paint-1", "a warm grey less half a metameric black", first)
    write_paint("paint-2", "paint-1 plus that metameric black", second)
    write_test_colours()
    report(first, second)
