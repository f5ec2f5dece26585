#!/usr/bin/env python3
"""Writes tests/extremes/vectors/*.csv: what the models and their parts are at and around their peaks, at
every sharpness that models.def allows, from the vectors that a renderer has and not from cosines. Needs
Debian's python3-mpmath; run /usr/bin/python3 tests/extremes/vectors.py. Writes the same bytes every time.

A row's inputs are N, T, L and V, three f32 numbers each, and the solid angle. Each is the rounding of a
unit vector, so that its length misses 1 by up to 1e-7, as a renderer's do. The truth is of their
directions: it makes them unit again, and T orthogonal to N, in 120 digits.

H is placed by multiples of the lobe's width from N, along an ellipse where the lobe has two widths."""

import math
import random
import sys
from itertools import product
from types import SimpleNamespace

from mpmath import mp, mpf

sys.dont_write_bytecode = True  # The tree stays clean.
import definitions
from truth import LETTERS, TABLE, defaults, exact, f32, f32_inside, text, write

INCIDENCES = (0, 30, 60, 85, 89.9)  # Degrees of L from N.
WIDTHS = (0, 0.1, 0.3, 1, 2, 3.5)
LOWEST = 5e-4  # The smallest N·V: below it f32 vectors themselves don't say N·V to 1e-4.
SOLID_ANGLE = 3.125


def is_exponent(low, high):
    return low > 0 and high / low >= 1000


def steps(label, low, high):
    """Sharpnesses that a parameter may have, from its one end to the other."""
    if label == "smoothness":
        return [low, 0.9, 0.99, 0.999, 0.9999, 0.99999, high]
    if label.startswith("roughness") and low > 0:
        return [low, 0.005, 0.01, 0.03, 0.1, high]
    if is_exponent(low, high):
        return [low, *(10.0 ** e for e in range(1, 6) if 10.0 ** e < high), high]
    return [low, high]


def sharpnesses(kind, name):
    """(tags, values): the defaults, each parameter by itself, all at an end."""
    usual, table = defaults(kind, name), TABLE[kind, name]
    yield [], usual
    for at, (label, _, low, high) in enumerate(table):
        for value in steps(label, low, high):
            yield [f"{label}={value:g}"], usual[:at] + [f32_inside(value, low, high)] + usual[at + 1:]
    ends = [[f32_inside(p[2], p[2], p[3]), f32_inside(p[3], p[2], p[3])] for p in table]
    both = product(*ends) if len(table) == 2 else zip(*ends) if len(table) > 2 else ()
    for values in both:
        yield ["ends"], list(values)


def widths(kind, name, values):
    """Of the lobe, as slopes of H along T and across it."""
    if name == "he_torrance":  # From where the rough surface's slopes, or diffraction, make it that wide.
        sigma, tau = values
        width = min(max(2 * sigma / tau, 0.09 / tau), 1)
        return width, width
    result = []
    for (label, _, low, high), value in zip(TABLE[kind, name], values):
        if label.startswith("roughness"):
            result.append(value)
        elif label == "smoothness":
            result.append(math.sqrt((1 - value) / 3))
        elif label == "falloff":
            result.append(math.sqrt(2 / value))
        elif is_exponent(low, high):
            result.append(1 / math.sqrt(value))
    result = [min(x, 1) for x in result] or [0.3]
    return result[0], result[-1]


def turned(vector, turn):
    """By a unit quaternion."""
    w, x, y, z = turn
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return [dot(row, vector) for row in rows]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = mp.sqrt(dot(a, a))
    return [x / length for x in a]


def less(a, b, share):
    """a − share b"""
    return [x - share * y for x, y in zip(a, b)]


def placed(dice, incidence, multiple, along, across):
    """N, T, L, V of f32 numbers, or None where V would be at the horizon. Every fourth N is the z axis."""
    turn = [dice.gauss(0, 1) for _ in range(4)] if dice.randrange(4) else [1, 0, 0, 0]
    turn = [x / math.sqrt(dot(turn, turn)) for x in turn]
    for _ in range(8):
        phi, psi = (dice.uniform(0, 2 * math.pi) for _ in range(2))
        sine = math.sin(math.radians(incidence))
        light = [sine * math.cos(phi), sine * math.sin(phi), math.cos(math.radians(incidence))]
        half = [multiple * along * math.cos(psi), multiple * across * math.sin(psi), 1]
        half = [x / math.sqrt(dot(half, half)) for x in half]
        viewer = less([2 * dot(light, half) * x for x in half], light, 1)
        if dot(light, half) > 0 and viewer[2] >= LOWEST:
            vectors = [[0, 0, 1], [1, 0, 0], light, viewer]
            return [[f32(x) for x in turned(v, turn)] for v in vectors]
    return None


def cosines(normal, tangent, light, viewer):
    """What definitions.py takes, of the directions of these vectors."""
    normal, light, viewer = (unit([mpf(x) for x in v]) for v in (normal, light, viewer))
    tiny = mpf(10) ** -100  # 0 but for 120 digits.
    within = lambda x: mpf(1) if x > 1 - tiny else max(x, mpf(0))
    j, k = dot(normal, light), dot(normal, viewer)
    half = unit([x + y for x, y in zip(light, viewer)])
    h = dot(normal, half)
    flat_light, flat_viewer = less(light, normal, j), less(viewer, normal, k)
    flat_half = less(half, normal, h)
    flat_tangent = less(tangent, normal, dot(normal, tangent))
    size = dot(flat_half, flat_half) * dot(flat_tangent, flat_tangent)
    across = mp.sqrt(dot(flat_light, flat_light) * dot(flat_viewer, flat_viewer))
    values = (within(j), within(k), within(h), within(dot(viewer, half)),
              within(2 * j * k - dot(light, viewer)),
              dot(flat_light, flat_viewer) / across if across > tiny else mpf(0),
              dot(flat_half, flat_tangent) ** 2 / size if size > tiny else mpf(1), mpf(SOLID_ANGLE))
    return SimpleNamespace(**dict(zip(LETTERS, values)))


def around(kind, name, values, multiples=WIDTHS):
    """(tags, inputs, angles) at every incidence, along and beside the peak of a lobe."""
    dice = random.Random(f"{kind} {name} {values}")
    for incidence, multiple in product(INCIDENCES, multiples):
        vectors = placed(dice, incidence, multiple, *widths(kind, name, values))
        if vectors:
            tags = [f"incidence {incidence}°", f"{multiple} widths" if multiple else "peak"]
            yield tags, [x for v in vectors for x in v] + [SOLID_ANGLE], cosines(*vectors)


def slopes():
    for name, form in definitions.SLOPES.items():
        for parameter_tags, values in sharpnesses("slope", name):
            p = exact(values)
            for tags, inputs, a in around("slope", name, values):
                yield (name, parameter_tags + tags, inputs, values, "", "", "",
                       [form(a.h, a.m2, *p)], [definitions.peak_of_slope(name, a.m2, p)])


def attenuations():
    for name, form in definitions.ATTENUATIONS.items():
        for sigma in (0.001, 0.01, 0.1, 0.3, 1):
            values = [f32_inside(sigma, 0.001, 1)]
            for tags, inputs, a in around("slope", "beckmann", values):
                value = form(a.j, a.k, a.h, a.i, mpf(values[0]))
                yield name, [f"σ={sigma:g}"] + tags, inputs, values, "", "", "", [value], [value]


def diffuse():
    for name, form in definitions.DIFFUSE.items():
        for parameter_tags, values in sharpnesses("diffuse", name):
            for tags, inputs, a in around("slope", "beckmann", [0.3]):
                yield (name, parameter_tags + tags, inputs, values, "", "", "",
                       [form(a, *exact(values))], [1])


def model_sets(name):
    """(tags, parameters, slope, attenuation), each part as (name, parameters…) or None."""
    half = [0.5, 0.5]
    if name not in ("cook_torrance", "blinn"):
        for tags, values in sharpnesses("model", name):
            yield tags, half + values, None, None
        return
    for slope in definitions.SLOPES:
        for tags, own in sharpnesses("slope", slope):
            for attenuation in definitions.ATTENUATIONS if not tags else ["smith"]:
                yield ([f"D {slope}", f"G {attenuation}"], half, (slope, *own), (attenuation, own[0]))


def at_wavelength(lobes):
    """With the geometry of a lobe that depends on wavelength, at 550 nm, and nothing more of it."""
    if len(lobes) == 5:
        return lobes
    diffuse, specular, white, fresnel, cosine, height, spread = lobes
    return diffuse, specular, white, fresnel * definitions.ripples(height, spread, mpf(550)), cosine


def models():
    for name, form in definitions.MODELS.items():
        for parameter_tags, values, slope, attenuation in model_sets(name):
            p = exact(values)
            lobe = ("slope", slope[0], slope[1:], (0, 1)) if slope else ("model", name, values[2:])
            for tags, inputs, a in around(*lobe):
                t = SimpleNamespace(diffuse=a.j, slope=mpf(0), attenuation=mpf(0))
                slope_peak = mpf(0)
                if slope:
                    own = exact(slope[1:])
                    t.slope = definitions.SLOPES[slope[0]](a.h, a.m2, *own)
                    slope_peak = definitions.peak_of_slope(slope[0], a.m2, own)
                    t.attenuation = definitions.ATTENUATIONS[attenuation[0]](
                        a.j, a.k, a.h, a.i, mpf(attenuation[1]))
                peak = at_wavelength(form(SimpleNamespace(**vars(a) | {"h": mpf(1), "l": mpf(1)}),
                                          SimpleNamespace(**vars(t) | {"slope": slope_peak}), p))
                yield (name, parameter_tags + tags, inputs, values, "",
                       *(f"{part[0]} {text(part[1:])}" if part else "" for part in (slope, attenuation)),
                       at_wavelength(form(a, t, p)), [max(peak[1:4])])


if __name__ == "__main__":
    for each in (slopes, attenuations, diffuse, models):
        write(f"vectors/{each.__name__}", each(), digits=12)
