#!/usr/bin/env python3
"""Writes the numbers of lamps_test.cpp: X Y Z of lamps of every kind, summed over 0.005 nm.

Independent of our code: numpy, colord-data's tables, Sprague's polynomial as Hermite's quintic.
"""
import numpy as np

COLORD = "/usr/share/colord/"
FINE = np.arange(360, 830, 0.005) + 0.0025


def read(file):
    """The positions and values of a CGATS file's spectra."""
    text = open(COLORD + file).read()
    start, end = (float(text.split(word)[1].split()[0].strip('"'))
                  for word in ("SPECTRAL_START_NM", "SPECTRAL_END_NM"))
    rows = [[float(x) for x in line.split() if x[:3] != "TCS"]
            for line in text.split("BEGIN_DATA\n")[1].split("END_DATA")[0].strip().split("\n")]
    return np.linspace(start, end, len(rows[0])), np.array(rows)


def sprague(y):
    second = np.array([884, -1960, 3033, -2648, 1080, -180]) / 209
    first = np.array([508, -540, 488, -367, 144, -24]) / 209
    v = np.r_[second @ y[:6], first @ y[:6], y, first @ y[:-7:-1], second @ y[:-7:-1]]
    d1 = (v[:-4] - 8 * v[1:-3] + 8 * v[3:-1] - v[4:]) / 12
    d2 = (-v[:-4] + 16 * v[1:-3] - 30 * v[2:-2] + 16 * v[3:-1] - v[4:]) / 12
    t = np.arange(5) / 5
    fine = []
    for k in range(len(y) - 1):
        low = [y[k], d1[k], d2[k] / 2]
        high = np.linalg.solve([[1, 1, 1], [3, 4, 5], [6, 12, 20]],
                               [y[k + 1] - sum(low), d1[k + 1] - low[1] - 2 * low[2],
                                d2[k + 1] - 2 * low[2]])
        fine.extend(np.polyval(np.r_[low, high][::-1], t))
    return np.maximum(np.r_[fine, y[-1]], 0)


def observer(file):
    return np.array([np.interp(FINE, np.arange(360, 831), sprague(y)) for y in read(file)[1]])


# Components of a lamp: nm, full width at half height, height. Samples: from, to, step; or uneven.
def even(low, high, step):
    return np.array([low + i * step for i in range(int(round((high - low) / step)) + 1)])


LAMPS = {
    "led": ([(450, 20, 1), (550, 120, .6)], even(380, 780, 5)),
    "laser phosphor": ([(445.5, .3, 100), (560, 110, 1)], even(380, 780, .1)),
    "mercury": ([(404.66, .3, .4), (435.83, .3, 1), (546.07, .3, 1), (576.96, .3, .3),
                 (579.07, .3, .3), (520, 300, .01)], even(380, 780, .05)),
    "sodium": ([(589, .1, 1), (589.6, .1, .5)], even(585, 595, .05)),
    "hid": ([(420.2, .4, 1), (535.1, .4, 2), (589.3, 6, .8), (671, .4, .5), (550, 250, .05)],
            even(380, 780, .2)),
    "lasers": ([(457, .1, 1), (532, .1, 1), (638, .1, 1.2)], even(450, 645, .02)),
    "20 nm": ([(600, 200, 1)], even(380, 780, 20)),
    "uneven": ([(450, 20, 1), (550, 120, .6)], np.array([380 + 400 * (i / 60) ** 1.5
                                                       for i in range(61)])),
}


def lamp(parts, nm):
    return sum(h * np.exp(-4 * np.log(2) * ((nm - c) / w) ** 2) for c, w, h in parts)


def power(nm, values):
    return np.interp(FINE, nm, values, 0, 0)


def xyz(eye, *factors):
    return eye @ np.prod(factors, 0) * 0.005


def uv(v):
    return np.array([4 * v[0], 6 * v[1]]) / (v @ [1, 15, 3])


def planck(kelvin):
    return (FINE / 560) ** -5 / np.expm1(1.4388e7 / (FINE * kelvin)) * 1e9


def daylight(kelvin):
    r = 1000 / kelvin
    x = (((-4.6070 * r + 2.9678) * r + .09911) * r + .244063 if kelvin <= 7000 else
         ((-2.0064 * r + 1.9018) * r + .24748) * r + .237040)
    y = -3 * x * x + 2.87 * x - .275
    share = .0241 + .2562 * x - .7341 * y
    nm, s = read("ref/CIE-1986-daylight-SPD.cmf")
    return power(nm, s[0] + (-1.3515 - 1.7703 * x + 5.9114 * y) / share * s[1]
                 + (.03 - 31.4424 * x + 30.0717 * y) / share * s[2])


def ra(eye, light):
    """CIE 13.3 of the first eight test colours; nan where nothing is like the light."""
    own = uv(xyz(eye, light))
    low, high = 1, 1000  # mired
    grid = np.linspace(low, high, 400)
    best = grid[np.argmin([np.hypot(*(uv(xyz(eye, planck(1e6 / m))) - own)) for m in grid])]
    low, high = max(1, best - 3), best + 3
    for _ in range(40):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        da, db = (np.hypot(*(uv(xyz(eye, planck(1e6 / m))) - own)) for m in (a, b))
        low, high = (low, b) if da < db else (a, high)
    kelvin = 2e6 / (low + high)
    if np.hypot(*(uv(xyz(eye, planck(kelvin))) - own)) > .05:
        return float("nan")
    reference = planck(kelvin) if kelvin < 5000 else daylight(kelvin)
    c = lambda q: (4 - q[0] - 10 * q[1]) / q[1]
    d = lambda q: (1.708 * q[1] + .404 - 1.481 * q[0]) / q[1]
    there = uv(xyz(eye, reference))

    def uvw(light, white, paint):
        v = xyz(eye, light, paint)
        q = uv(v)
        cc, dd = c(there) / c(white) * c(q), d(there) / d(white) * d(q)
        share = 16.518 + 1.481 * cc - dd
        q = np.array([10.872 + .404 * cc - 4 * dd, 5.52]) / share
        w = 25 * np.cbrt(100 * v[1] / xyz(eye, light)[1]) - 17
        return np.r_[13 * w * (q - there), w]

    nm, paints = read("ref/CIE-TCS.sp")
    paints = [np.interp(FINE, nm, p) for p in paints[:8]]
    return np.mean([100 - 4.6 * np.linalg.norm(uvw(light, own, p) - uvw(reference, there, p))
                    for p in paints])


if __name__ == "__main__":
    two, ten = (observer(f"cmf/CIE{name}-XYZ.cmf") for name in ("1931-2deg", "1964-10deg"))
    tcs_nm, tcs = read("ref/CIE-TCS.sp")
    red = np.interp(FINE, tcs_nm, tcs[8])
    for name, (parts, nm) in LAMPS.items():
        light = power(nm, lamp(parts, nm))
        rows = [xyz(two, light), xyz(ten, light), xyz(two, light, red) / xyz(two, light)[1]]
        text = ", ".join("{" + ", ".join(f"{x:.8g}" for x in row) + "}" for row in rows)
        print(f'{{"{name}", {text}, {ra(two, light):.2f}}},')
