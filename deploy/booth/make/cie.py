"""CIE tables from Debian's colord-data, tristimulus values and CIEDE2000; python3 alone."""

from math import atan2, cos, degrees, exp, hypot, radians, sin, sqrt
from pathlib import Path

COLORD = Path("/usr/share/colord")


def read_cgats(file):
    """The spectra of a CGATS file: (wavelengths in nm, names, rows of values)."""
    head, rows, names, inside = {}, [], [], False
    for line in file.read_text().splitlines():
        words = line.split()
        if words[:1] == ["BEGIN_DATA"]:
            inside = True
        elif words[:1] == ["END_DATA"]:
            inside = False
        elif inside and words:
            named = words[0][0].isalpha()
            names.append(words.pop(0) if named else "")
            rows.append([float(word) for word in words])
        elif len(words) == 2:
            head[words[0]] = words[1]
    start, end = float(head["SPECTRAL_START_NM"]), float(head["SPECTRAL_END_NM"])
    count = int(head["SPECTRAL_BANDS"])
    step = (end - start) / (count - 1)
    return [start + step * i for i in range(count)], names, rows


def at(positions, nm, values):
    """Linear interpolation; 0 outside."""
    result = []
    for x in positions:
        if not nm[0] <= x <= nm[-1]:
            result.append(0.0)
            continue
        i = min(int((x - nm[0]) / (nm[1] - nm[0])), len(nm) - 2)
        t = (x - nm[i]) / (nm[i + 1] - nm[i])
        result.append(values[i] * (1 - t) + values[i + 1] * t)
    return result


def observer(positions):
    """x̄, ȳ, z̄ of the 2° observer of 1931."""
    nm, _, rows = read_cgats(COLORD / "cmf/CIE1931-2deg-XYZ.cmf")
    return [at(positions, nm, row) for row in rows]


def illuminant(name, positions):
    nm, _, rows = read_cgats(COLORD / f"illuminant/CIE-{name}.sp")
    return at(positions, nm, rows[0])


def weights(name, positions):
    """Rows w with X = Σ w R and so on, for a light of luminance 1 sampled at these positions, all
    the same distance apart (their widths cancel)."""
    power = illuminant(name, positions)
    rows = [[c * p for c, p in zip(row, power)] for row in observer(positions)]
    y = sum(rows[1])
    return [[value / y for value in row] for row in rows]


def to_xyz(rows, reflectance):
    return [sum(w * r for w, r in zip(row, reflectance)) for row in rows]


def to_lab(xyz, white):
    def f(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29

    x, y, z = (f(v / w) for v, w in zip(xyz, white))
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)]


def delta_e_2000(lab1, lab2):
    """CIEDE2000, ISO/CIE 11664-6:2014."""
    l1, a1, b1 = lab1
    l2, a2, b2 = lab2
    c_mean = (hypot(a1, b1) + hypot(a2, b2)) / 2
    g = 0.5 * (1 - sqrt(c_mean**7 / (c_mean**7 + 25**7)))
    a1, a2 = (1 + g) * a1, (1 + g) * a2
    c1, c2 = hypot(a1, b1), hypot(a2, b2)
    h1, h2 = degrees(atan2(b1, a1)) % 360, degrees(atan2(b2, a2)) % 360
    dh = 0.0 if c1 * c2 == 0 else (h2 - h1 + 180) % 360 - 180
    dl, dc, dhh = l2 - l1, c2 - c1, 2 * sqrt(c1 * c2) * sin(radians(dh / 2))
    h = h1 + h2 if c1 * c2 == 0 else (h1 + dh / 2) % 360
    l, c = (l1 + l2) / 2, (c1 + c2) / 2
    t = (1 - 0.17 * cos(radians(h - 30)) + 0.24 * cos(radians(2 * h))
         + 0.32 * cos(radians(3 * h + 6)) - 0.20 * cos(radians(4 * h - 63)))
    sl = 1 + 0.015 * (l - 50) ** 2 / sqrt(20 + (l - 50) ** 2)
    sc, sh = 1 + 0.045 * c, 1 + 0.015 * c * t
    rt = (-2 * sqrt(c**7 / (c**7 + 25**7))
          * sin(radians(60 * exp(-(((h - 275) / 25) ** 2)))))
    return sqrt((dl / sl) ** 2 + (dc / sc) ** 2 + (dhh / sh) ** 2
                + rt * (dc / sc) * (dhh / sh))


def solve(matrix, right):
    """Gaussian elimination with pivoting."""
    n = len(matrix)
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            if factor:
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    result = [0.0] * n
    for i in reversed(range(n)):
        known = sum(rows[i][k] * result[k] for k in range(i + 1, n))
        result[i] = (rows[i][n] - known) / rows[i][i]
    return result
