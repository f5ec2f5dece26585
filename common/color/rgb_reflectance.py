#!/usr/bin/env python3
"""Prints the table of rgb_reflectance.cpp: the three reflectances of which a colour is mixed.

They are not negative, sum to 1 at every wavelength, and under D65 the 2 degree observer sees them as the primaries
of sRGB, each channel's weights scaled so that white is 1. Of all such reflectances they are the smoothest: the sum of
their squared differences is the smallest, but for a barrier of 1e-6 log b that keeps them off 0. It is the idea of
I. Mallett and C. Yuksel, "Spectral Primary Decomposition for Rendering with sRGB Reflectance", Eurographics Symposium on Rendering 2019; the numbers
are ours. Between the nodes they are straight lines, outside they keep their end values. Needs Debian's colord-data."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "deploy/booth/make"))
from cie import solve, weights  # noqa: E402

NODES = [380 + 10 * i for i in range(36)]  # nm, to 730
FINE = [360 + i for i in range(471)]       # nm: what the observer sees
FROM_XYZ = [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560],
            [0.0556434, -0.2040259, 1.0572252]]
N = len(NODES)


def channels():
    """Weights at NODES of linear R, G and B of a reflectance; those of each sum to 1."""
    xyz = []
    for row in weights("D65", FINE):
        folded = [0.0] * N
        for nm, weight in zip(FINE, row):
            place = min(max((nm - NODES[0]) / 10, 0), N - 1)
            i = min(int(place), N - 2)
            folded[i] += weight * (i + 1 - place)
            folded[i + 1] += weight * (place - i)
        xyz.append(folded)
    rgb = [[sum(m * xyz[k][i] for k, m in enumerate(row)) for i in range(N)] for row in FROM_XYZ]
    return [[w / sum(row) for w in row] for row in rgb]


def derivatives(b, barrier):
    """Gradient and Hessian by red's and green's values; blue is 1 less both."""
    gradient, hessian = [0.0] * (2 * N), [[0.0] * (2 * N) for _ in range(2 * N)]
    curves = [[(i, 1.0)] for i in range(N)], [[(N + i, 1.0)] for i in range(N)], \
        [[(i, -1.0), (N + i, -1.0)] for i in range(N)]
    for values, terms in zip(b, curves):
        for i in range(N):
            for j, s in terms[i]:
                gradient[j] -= s * barrier / values[i]
                for k, t in terms[i]:
                    hessian[j][k] += s * t * barrier / values[i] ** 2
        for i in range(N - 1):
            slope = values[i + 1] - values[i]
            both = [(j, -s) for j, s in terms[i]] + terms[i + 1]
            for j, s in both:
                gradient[j] += 2 * slope * s
                for k, t in both:
                    hessian[j][k] += 2 * s * t
    return gradient, hessian


def newton_step(b, barrier, rows):
    """Towards the minimum where red is (1 0 0) and green (0 1 0)."""
    gradient, hessian = derivatives(b, barrier)
    constraints = [row + [0.0] * N for row in rows] + [[0.0] * N + row for row in rows]
    wanted = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    x = b[0] + b[1]
    missing = [w - sum(c * v for c, v in zip(row, x)) for w, row in zip(wanted, constraints)]
    system = [hessian[i] + [row[i] for row in constraints] for i in range(2 * N)]
    system += [row + [0.0] * 6 for row in constraints]
    return solve(system, [-g for g in gradient] + missing)[:2 * N]


def reflectances():
    rows = channels()
    b = [[1 / 3] * N for _ in range(3)]
    for barrier in [10.0 ** -e for e in range(0, 7)]:
        for _ in range(30):
            step = newton_step(b, barrier, rows)
            ends = [step[:N], step[N:], [-s - t for s, t in zip(step[:N], step[N:])]]
            length = min([1.0] + [0.9 * v / -d for values, steps in zip(b, ends)
                                  for v, d in zip(values, steps) if d < 0])
            b = [[v + length * d for v, d in zip(values, steps)] for values, steps in zip(b, ends)]
            if max(abs(d) for d in step) < 1e-9:
                break
    return b


if __name__ == "__main__":
    red, green, _ = reflectances()
    for nm, r, g in zip(NODES, red, green):
        print(f"    {{{r:.6f}, {g:.6f}, {1 - round(r, 6) - round(g, 6):.6f}}},  // {nm} nm")
