#!/usr/bin/env python3
"""Writes tests/extremes/*.csv: what the models, their parts and Fresnel's equations are at the limits
of their inputs and one ulp inside them, from definitions.py. Needs Debian's python3-mpmath; run
/usr/bin/python3 tests/extremes/truth.py. Takes some seconds, and writes the same bytes every
time.

Ranges and defaults are those of common/models/models.def. A row's inputs are the very numbers in the
file (repr reads back exactly). Most are exact in f32 too, and are tested in f32 and GLSL; those one f64
ulp inside a limit are not. Values that f64 can't hold come out as 0 or inf."""

import math
import re
import struct
import sys
from itertools import product
from pathlib import Path
from types import SimpleNamespace

from mpmath import mp, mpf

sys.dont_write_bytecode = True  # The tree stays clean.
import definitions as truth

HERE = Path(__file__).parent
MODELS_DEF = HERE.parent.parent / "common" / "models" / "models.def"
LETTERS = ("j", "k", "h", "i", "l", "C", "m2", "w")  # The order of struct Angles.


def f32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def f32_next(x, towards):
    """The f32 number beside x, which is one itself."""
    bits = struct.unpack("i", struct.pack("f", x))[0]
    if x == 0:
        return math.copysign(2.0 ** -149, towards)
    return struct.unpack("f", struct.pack("i", bits + (1 if (towards > x) == (x > 0) else -1)))[0]


def f32_inside(x, low, high):
    """The f32 number nearest to x that lies in the range."""
    y = f32(x)
    return f32_next(y, high) if y < low else f32_next(y, low) if y > high else y


# Cosines: the limits, one ulp inside them, and near them. A label that starts with ~ is no extreme; such
# numbers are short in binary, to keep the files small.
COSINES = {"0": 0.0, "1e-30": f32(1e-30), "1e-7": f32(1e-7), "~0.001": 2.0 ** -10, "~0.1": 0.125,
           "~0.5": 0.5, "~0.8": 0.8125, "~0.98": 0.984375, "1−1e-7": f32(1 - 1e-7),
           "1−ulp": 1 - 2.0 ** -24, "1": 1.0}
ULPS = {"0+ulp": 2.0 ** -149, "1−ulp (f64)": 1 - 2.0 ** -53, "0+ulp (f64)": 2.0 ** -1074}
FINE = COSINES | ULPS | {"~0.04": 0.0390625, "~0.9": 0.90625, "~0.999": 1 - 2.0 ** -10,
                         "~1−1e-5": f32(1 - 1e-5),
                         "~1−1e-6": f32(1 - 1e-6)}


def tag(name, label):
    """[f"{name}={label}"], or nothing for what is no extreme."""
    return [] if label.startswith("~") else [f"{name}={label}"]


def read_models_def():
    """{(kind, name): [(parameter, default, min, max)]}"""
    result = {}
    for line in MODELS_DEF.read_text(encoding="utf-8").splitlines():
        head = re.match(r"METAMER_(MODEL|DIFFUSE|SLOPE|ATTENUATION)\(\d+, (\w+),", line)
        if head:
            found = re.findall(r"METAMER_PARAMETER\((\w+), ([^,]+), ([^,]+), ([^,]+),", line)
            result[head[1].lower(), head[2]] = [(p[0], *map(float, p[1:])) for p in found]
    return result


TABLE = read_models_def()


def defaults(kind, name):
    return [f32_inside(p[1], p[2], p[3]) for p in TABLE[kind, name]]


def parameter_sets(kind, name):
    """(tags, values): the defaults; each parameter at its ends, one ulp inside and between; all at an
    end."""
    usual = defaults(kind, name)
    yield [], usual
    for at, (label, _, low, high) in enumerate(TABLE[kind, name]):
        low32, high32 = f32_inside(low, low, high), f32_inside(high, low, high)
        middle = ({f"{label} 1e{e}": 10.0 ** e for e in range(1, 6)} if high / max(low, 1) >= 1e6
                  else {f"{label} middle": f32(0.5 * (low + high))})
        ends = {f"{label} min": low32, f"{label} min+ulp": f32_next(low32, high32),
                f"{label} max−ulp": f32_next(high32, low32), f"{label} max": high32,
                f"{label} min (f64)": low, f"{label} max−ulp (f64)": math.nextafter(high, low)}
        if label.startswith("roughness"):
            root = math.sqrt(0.5)
            middle |= {"σ=1/√2": f32(root), "σ=1/√2 (f64)": root,
                       "σ=1/√2+ulp (f64)": math.nextafter(root, 1)}
        for tag, value in (ends | middle).items():
            if value not in (usual[at], low32) or tag == f"{label} min":
                yield [tag], usual[:at] + [value] + usual[at + 1:]
    if len(usual) > 1:
        yield ["all min"], [f32_inside(p[2], p[2], p[3]) for p in TABLE[kind, name]]
        yield ["all max"], [f32_inside(p[3], p[2], p[3]) for p in TABLE[kind, name]]


def angles(**given):
    """Of a plain direction, but for what is given."""
    usual = {"j": 0.8125, "k": 0.625, "h": 0.90625, "i": 0.75, "l": 0.90625, "C": 0.5, "m2": 0.25,
             "w": 3.125}
    return [float(x) for x in (usual | given).values()]


def between(cos_l, cos_v, azimuth, rounded=f32):
    """The angles of L and V at these cosines; `azimuth` degrees apart, L 30° from the tangent."""
    def direction(cosine, phi):
        sine = mp.sqrt(1 - mpf(cosine) ** 2)
        return [sine * mp.cos(phi), sine * mp.sin(phi), mpf(cosine)]

    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    turn = mp.pi / 6
    light, viewer = direction(cos_l, turn), direction(cos_v, turn + mp.pi * azimuth / 180)
    sum_ = [x + y for x, y in zip(light, viewer)]
    length = mp.sqrt(dot(sum_, sum_))
    opposite = length < mpf(10) ** -100
    half = [mpf(0)] * 3 if opposite else [x / length for x in sum_]
    flat = half[0] ** 2 + half[1] ** 2
    mirrored = 2 * light[2] * viewer[2] - dot(light, viewer)
    across = mp.cos(mp.pi * azimuth / 180) if 0 < max(cos_l, cos_v) < 1 else mpf(0)
    m2 = half[0] ** 2 / flat if flat > 0 else mpf(1)
    within = lambda x, low: rounded(float(min(max(x, mpf(low)), mpf(1))))
    return [float(cos_l), float(cos_v), within(half[2], 0), within(dot(viewer, half), 0),
            within(mirrored, 0), within(across, -1), within(m2, 0), 3.125]


def directions(cosines):
    """(tags, angles) of pairs of directions, the coinciding ones among them."""
    for (a, x), (b, y) in product(cosines.items(), repeat=2):
        for azimuth in (0, 90, 180) if a in ("0", "1e-7", "~0.5", "1") and a != b or x == y else (140,):
            tags = tag("N·L", a) + tag("N·V", b)
            if azimuth in (0, 180):
                tags.append("coplanar")
            if x == y and azimuth in (0, 180):
                tags.append("L=V" if azimuth == 0 else "L=−V" if x == 0 else "H=N")
            yield tags, between(x, y, azimuth)
    for a, b in ((ULPS["1−ulp (f64)"], 0.5), (0.5, ULPS["1−ulp (f64)"])):
        yield ["one ulp inside (f64)"], between(a, b, 180, float)


def some(*labels):
    return {label: COSINES[label] for label in labels}


def highlights():
    """(tags, angles) along a highlight, whatever model has it."""
    for label, value in FINE.items():
        yield tag("N·H=R·V", label), angles(h=value, l=value)


def number(x, digits=None):
    """As short as reads back, or to so many digits; an f32 number by the nine that say which."""
    x = float(x)
    if x == int(x) and abs(x) < 1e6:
        return repr(int(x))
    return repr(x) if digits is None else f"{x:.{digits}g}"


def text(values, digits=None):
    return " ".join(number(x, digits) for x in values)


def rounded(value):
    """To f64; below its normal numbers the digits say nothing."""
    value = mpf(value)
    if value and abs(value) < mpf(2) ** -1074:
        return 0.0
    return float(value)


def exact(values):
    return [mpf(x) for x in values]


def slopes():
    for name, form in truth.SLOPES.items():
        for parameter_tags, values in parameter_sets("slope", name):
            p = exact(values)
            tangents = (0, f32(1e-7), 0.5, 1 - 2.0 ** -24, 1) if name == "ward" else (0.25,)
            # Where the lobe falls off, whatever its width.
            sigma = min(values[:1] if name != "ward" else values)
            flank = {f"~flank {x}": f32(math.cos(min(x * sigma, 1.5))) for x in (0.3, 1, 2)}
            for (label, h), m2 in product((FINE | flank).items(), tangents):
                if name == "ward" and parameter_tags and m2 not in (0, 0.5, 1):
                    continue
                tags = parameter_tags + tag("h", label)
                if name == "ward" and m2 != 0.5:
                    tags.append(f"m²={number(m2)}")
                yield (name, tags, angles(h=h, m2=m2), values, "", "", "",
                       [form(mpf(h), mpf(m2), *p)], [truth.peak_of_slope(name, mpf(m2), p)])


def attenuations():
    sigmas = {"σ min": f32(0.001), "~0.25": 0.25, "σ=1/√2": f32(math.sqrt(0.5)),
              "σ max−ulp": 1 - 2.0 ** -24, "σ max": 1.0, "σ min (f64)": 0.001}
    low, high = TABLE["slope", "beckmann"][0][2:]
    assert (low, high) == (0.001, 1), "the range of roughness has changed: see sigmas"
    for name, form in truth.ATTENUATIONS.items():
        for label, sigma in sigmas.items() if name != "torrance_sparrow" else [("~", 0.25)]:
            seen = set()
            for tags, a in directions(COSINES):
                if name != "torrance_sparrow" and tuple(a[:2]) in seen:
                    continue  # The azimuth is nothing to them.
                seen.add(tuple(a[:2]))
                value = form(*exact(a[:4]), mpf(sigma))
                own = [] if label.startswith("~") else [label]
                yield name, tags + own, a, [sigma], "", "", "", [value], [value]


def diffuse():
    for name, form in truth.DIFFUSE.items():
        for parameter_tags, values in parameter_sets("diffuse", name):
            cosines = COSINES | ULPS if not parameter_tags else some("0", "1e-7", "~0.5", "1−ulp", "1")
            for (a, j), (b, k) in product(cosines.items(), repeat=2):
                for c in (-1, 0.5, 1) if not parameter_tags else (1,):
                    given = angles(j=j, k=k, C=c)
                    value = form(SimpleNamespace(**dict(zip(LETTERS, exact(given)))), *exact(values))
                    tags = parameter_tags + tag("N·L", a) + tag("N·V", b) + [f"C={c}"] * (c != 0.5)
                    yield name, tags, given, values, "", "", "", [value], [1]


def critical_cosines(n):
    """Where n² + u² = 1, and one ulp on each side."""
    if n >= 1:
        return {}
    at = math.sqrt((1 - n) * (1 + n))
    single = f32(at)
    return {"critical−ulp": f32_next(single, 0), "critical": single, "critical+ulp": f32_next(single, 1),
            "critical−ulp (f64)": math.nextafter(at, 0), "critical (f64)": at,
            "critical+ulp (f64)": math.nextafter(at, 1)}


def fresnel():
    cosines = COSINES | ULPS
    f = {"0": 0.0, "1e-30": f32(1e-30), "1e-7": f32(1e-7), "~0.04": f32(0.04), "~0.5": 0.5,
         "1−1e-7": f32(1 - 1e-7), "1−ulp": 1 - 2.0 ** -24, "1−ulp (f64)": 1 - 2.0 ** -53}
    n = {"1": 1.0, "1−ulp": 1 - 2.0 ** -24, "1+ulp": 1 + 2.0 ** -23, "1−ulp (f64)": 1 - 2.0 ** -53,
         "1+ulp (f64)": 1 + 2.0 ** -52, "~0.1": f32(0.1), "~0.5": 0.5, "~1/1.5": f32(1 / 1.5),
         "~0.9": f32(0.9), "~1.001": f32(1.001), "~1.5": 1.5, "~2.5": 2.5, "20": 20.0}
    k = {"0": 0.0, "1e-30": f32(1e-30), "1e-7": f32(1e-7), "~0.01": f32(0.01), "~1": 1.0, "~3.9": f32(3.9),
         "20−ulp": f32_next(20.0, 0), "20": 20.0}

    def row(name, tags, inputs, parameters):
        value = truth.FRESNEL[name](*exact(inputs + parameters))
        return name, tags, inputs, parameters, "", "", "", [value], [max(value, mpf(1))]

    for label, reflectance in (f | {"1": 1.0}).items():
        for place, u in cosines.items():
            yield row("schlick_fresnel", tag("u", place) + tag("f", label), [u], [reflectance])
    for label, reflectance in f.items():
        yield row("index_from_reflectance", tag("f", label), [reflectance], [])
    for name, extinctions in ("dielectric_fresnel", {"": None}), ("conductor_fresnel", k):
        for label, index in n.items():
            for place, u in (cosines | critical_cosines(index)).items():
                tags = tag("u", place) + tag("n", label) + ["n<1 past the critical angle"] * (
                    index < 1 and u * u < (1 - index) * (1 + index))
                for extinction, value in extinctions.items():
                    if value is None:
                        yield row(name, tags, [u], [index])
                    else:
                        yield row(name, tags + tag("k", extinction), [u], [index, value])


def model_sets(name):
    """(tags, parameters, diffuse, slope, attenuation), each part as (name, parameters…) or None."""
    half = [0.5, 0.5]
    facets = name in ("cook_torrance", "blinn")
    beckmann, smith = ("beckmann", *defaults("slope", "beckmann")), ("smith", f32(0.3))
    parts = (None, beckmann, smith) if facets else (None, None, None)
    for tags, values in parameter_sets("model", name):
        yield tags, half + values, *parts
    usual = defaults("model", name)
    for pair in [1, 0], [0, 1], [0, 1 - 2.0 ** -24]:
        yield [], pair + usual, *parts
    rough = ("oren_nayar", 1.0)
    yield ["oren_nayar"], half + usual, rough, *parts[1:]
    if facets:
        for slope, attenuation in product(truth.SLOPES, truth.ATTENUATIONS):
            own = defaults("slope", slope)
            yield ([f"D {slope}", f"G {attenuation}"], half + usual, None, (slope, *own),
                   (attenuation, own[0]))
        for slope in truth.SLOPES:
            for tags, own in parameter_sets("slope", slope):
                if tags and tags[0] in ("roughness min", "roughness max", "all min", "all max"):
                    yield ([f"D {slope}"] + tags, half + usual, None, (slope, *own), ("smith", own[0]))


def models():
    for name, form in truth.MODELS.items():
        for parameter_tags, values, diffuse_part, slope, attenuation in model_sets(name):
            plain = not parameter_tags and values[:2] == [0.5, 0.5]
            few = some("0", "1e-30", "1e-7", "~0.5", "1−ulp", "1") if plain else some("0", "1e-7")
            for tags, given in [*directions(few), *highlights()]:
                a = SimpleNamespace(**dict(zip(LETTERS, exact(given))))
                t = SimpleNamespace(diffuse=a.j, slope=mpf(0), attenuation=mpf(0))
                slope_peak = mpf(0)
                if diffuse_part:
                    t.diffuse = truth.DIFFUSE[diffuse_part[0]](a, *exact(diffuse_part[1:]))
                if slope:
                    p = exact(slope[1:])
                    t.slope = truth.SLOPES[slope[0]](a.h, a.m2, *p)
                    slope_peak = truth.peak_of_slope(slope[0], a.m2, p)
                    t.attenuation = truth.ATTENUATIONS[attenuation[0]](
                        a.j, a.k, a.h, a.i, mpf(attenuation[1]))
                p = exact(values)
                lobes = form(a, t, p)
                # The peak of the highlight at these L and V: (N·H)^n and its kin are 1 there.
                peak = max(form(SimpleNamespace(**vars(a) | {"h": mpf(1), "l": mpf(1)}),
                                SimpleNamespace(**vars(t) | {"slope": slope_peak}), p)[:4])
                yield (name, parameter_tags + tags, given, values,
                       *(f"{part[0]} {text(part[1:])}".strip() if part else ""
                         for part in (diffuse_part, slope, attenuation)), lobes, [peak])


def ripples():
    """Heights and spreads at a wavelength, in µm²: g from 1e-7 to 1e5, few terms and many; and far beside the peak."""
    nm = 550.0
    for height in (0.0, f32(1e-30), f32(1e-9), 2.0 ** -12, 2.0 ** -9, 2.0 ** -7, 0.015625, 0.03125, 0.0625, 0.09375,
                   0.125, 0.25, 0.3125, 0.375, 0.5, 1.0, 8.0, 64.0, 400.0):
        for spread in (0.0, f32(1e-6), 2.0 ** -12, 2.0 ** -8, 0.03125, 0.125, 0.5, 2.0, 16.0, 1000.0):
            g, s = height * (2 * math.pi / 0.55) ** 2, spread * (2 * math.pi / 0.55) ** 2
            tags = ["height 0"] * (height == 0) + ["spread 0"] * (spread == 0)
            yield ("ripples", tags, [height, spread], [nm], "", "", "", [truth.ripples(mpf(height), mpf(spread), mpf(nm))],
                   [truth.ripples(mpf(height), mpf(0), mpf(nm))])


def write(name, rows, digits=None):
    """Rows as above; with `digits` the inputs are f32 numbers and the values have so many digits."""
    header = "form,extremes,inputs,parameters,diffuse,slope,attenuation,values,peak"
    lines = [header]
    for form, tags, inputs, parameters, *parts, values, peaks in rows:
        lines.append(",".join([form, "|".join(tags).replace(",", ";"), text(inputs, digits and 9),
                               text(parameters), *parts, text(map(rounded, values), digits),
                               text(map(rounded, peaks), digits)]))
    (HERE / f"{name}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{name}.csv: {len(lines) - 1} rows")


if __name__ == "__main__":
    for each in (slopes, attenuations, diffuse, fresnel, models, ripples):
        write(each.__name__, each())
