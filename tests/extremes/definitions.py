"""The illumination models as the source defines them, with its errata (reference/errata.md), in numbers
of 120 digits: enough for 50 of them to survive any cancellation on the grid. Written from the printed
equations, not from shaders/, and without their rewritten forms: what is a removable special case or
0/0 there is a limit here, taken where its header comment names it.

Angles are the cosines of shaders/models/lobes.glsl, by the letters of Fig. 2-1: j = N·L, k = N·V,
h = N·H, i = V·H, l = R·V, C between the projections of L and V, m2 = (H′·T)², w the solid angle.
"""

from mpmath import mp, mpf

mp.dps = 120


# Fresnel's equations; u is the cosine of the angle of incidence.

def schlick_fresnel(u, f):  # E[2.2-12]
    return f + (1 - f) * (1 - u) ** 5


def index_from_reflectance(f):  # E[2.2-11]; f = 1 is an input error
    return (1 + mp.sqrt(f)) / (1 - mp.sqrt(f))


def dielectric_fresnel(u, n):  # E[2.2-9]
    below = n * n + u * u - 1
    if below < 0:
        return mpf(1)
    a = mp.sqrt(below)
    if n == 1:  # No boundary: 0, at u = 0 too.
        return mpf(0)
    return (a - u) ** 2 / (a + u) ** 2 / 2 * ((u * (a + u) - 1) ** 2 / (u * (a - u) + 1) ** 2 + 1)


def conductor_fresnel(u, n, k):  # E[2.2-8]
    if n == 1 and k == 0:
        return mpf(0)
    if u == 0:  # The limit.
        return mpf(1)
    t = n * n - k * k + u * u - 1
    s = mp.sqrt(t * t + 4 * n * n * k * k)
    a, b2 = mp.sqrt(max(s + t, mpf(0)) / 2), max(s - t, mpf(0)) / 2
    return (((a - u) ** 2 + b2) / ((a + u) ** 2 + b2) / 2 *
            (((a + u - 1 / u) ** 2 + b2) / ((a - u + 1 / u) ** 2 + b2) + 1))


# Slope distributions D(h, m²).

def gaussian(h, m2, sigma, c):  # E[2.2-15]
    return c * mp.exp(-(mp.acos(h) / sigma) ** 2)


def beckmann(h, m2, sigma):  # E[2.2-16]; 0 is the limit at h = 0
    return mpf(0) if h == 0 else mp.exp((h * h - 1) / (sigma * h) ** 2) / (sigma ** 2 * h ** 4)


def schlick_slope(h, m2, sigma):  # E[2.2-17]
    return h ** 2 / (sigma * h ** 4 - h ** 4 / (2 * sigma) + 1 / (2 * sigma)) ** 2


def trowbridge_reitz(h, m2, sigma):  # E[2.2-22]
    return (sigma ** 2 / (h ** 2 * (sigma ** 2 - 1) + 1)) ** 2


def ward(h, m2, a, b):  # E[2.2-31]; 0 is the limit at h = 0
    if h == 0:
        return mpf(0)
    return mp.exp((h * h - 1) / h ** 2 * (m2 / a ** 2 + (1 - m2) / b ** 2)) / (a * b * h ** 4)


def peak_of_slope(name, m2, p):
    """The largest D over h: at h = 1, or where the derivative by 1/h² vanishes."""
    if name == "gaussian":
        return p[1]
    if name == "trowbridge_reitz":
        return mpf(1)
    if name == "schlick":
        inside = 3 * p[0] ** 2 > 2
        return schlick_slope((3 * (2 * p[0] ** 2 - 1)) ** mpf(-0.25) if inside else mpf(1), m2, *p)
    form = SLOPES[name]
    steepness = 1 / p[0] ** 2 if name == "beckmann" else m2 / p[0] ** 2 + (1 - m2) / p[1] ** 2
    return form(mp.sqrt(min(mpf(1), steepness / 2)), m2, *p)


SLOPES = {"gaussian": gaussian, "beckmann": beckmann, "schlick": schlick_slope,
          "trowbridge_reitz": trowbridge_reitz, "ward": ward}


# Geometric attenuations, as G/(N·V).

def torrance_sparrow(j, k, h, i, sigma):  # E[2.2-18]
    if h == 0:  # No light is reflected by facets that nobody sees; L and V opposite.
        return mpf(0)
    if k == 0:  # The limit, where 2hk/i is the smallest; j = 0 is the terminator.
        return 2 * h / i
    return min(mpf(1), 2 * h * k / i, 2 * h * j / i) / k


def smith_over_cosine(x, sigma):  # E[2.2-19] by x
    if x == 0:  # The limit: g grows as √(π/2)x/σ.
        return mp.sqrt(mp.pi / 2) / sigma
    if x == 1:  # The limit: g grows without end.
        return mpf(1)
    q = x * x / (2 * sigma ** 2 * (1 - x * x))
    g = mp.sqrt(mp.pi * q) * mp.exp(q) * (2 - mp.erfc(mp.sqrt(q)))
    return g / (g + 1) / x


def smith(j, k, h, i, sigma):
    return j * smith_over_cosine(j, sigma) * smith_over_cosine(k, sigma)


def schlick_attenuation(j, k, h, i, sigma):  # E[2.2-20]
    c = mp.sqrt(2 * sigma ** 2 / mp.pi)
    return j / (j - c * j + c) / (k - c * k + c)


ATTENUATIONS = {"torrance_sparrow": torrance_sparrow, "smith": smith, "schlick": schlick_attenuation}


# Diffuse terms, N·L included.

def oren_nayar(a, sigma):  # E[2.2-29]
    if a.j == 0:
        return mpf(0)
    cos_alpha, cos_beta = min(a.j, a.k), max(a.j, a.k)  # α is the larger angle, β the smaller.
    sin_alpha, tan_beta = mp.sqrt(1 - cos_alpha ** 2), mp.sqrt(1 - cos_beta ** 2) / cos_beta
    big_a = 1 - mpf(sigma ** 2) / (sigma ** 2 + mpf(33) / 100) / 2
    big_b = mpf(45) / 100 * sigma ** 2 / (sigma ** 2 + mpf(9) / 100)
    return (big_a + big_b * max(mpf(0), a.C) * sin_alpha * tan_beta) * a.j


DIFFUSE = {"oren_nayar": oren_nayar}


# Models. `p` are their parameters, `t` the terms (diffuse, slope, attenuation). They return what weighs
# C_D, C_S, 1 and F, and the cosine that F takes. Highlights end at the terminator, j = 0.

def power(x, n):
    return x ** n if x > 0 else mpf(0)


def lit(a, value):
    return value if a.j > 0 else mpf(0)


def lambert(a, t, p):
    return p[0] * t.diffuse, 0, 0, 0, 0


def blinn_phong(a, t, p):  # E[2.2-5]
    return p[0] * t.diffuse, lit(a, p[1] * power(a.h, p[2])), 0, 0, 0


def phong(a, t, p):  # E[2.2-4]
    return p[0] * (t.diffuse * (1 - p[3]) + p[3]), 0, 0, lit(a, p[1] * power(a.l, p[2])), a.j


def schlick(a, t, p):  # E[2.2-6]
    return p[0] * t.diffuse, lit(a, p[1] * a.h / (a.h - a.h * p[2] + p[2])), 0, 0, 0


def hall_greenberg(a, t, p):  # E[2.2-7]
    return p[0] * t.diffuse, 0, 0, lit(a, p[1] * power(a.h, p[2])), a.i


def cook_torrance(a, t, p):  # E[2.2-13] N·L ω
    return (a.w * p[0] * t.diffuse / mp.pi, 0, 0,
            lit(a, a.w * p[1] * t.slope * t.attenuation / (4 * mp.pi)), a.i)


def blinn(a, t, p):  # E[2.2-21]
    return p[0] * t.diffuse, 0, 0, lit(a, p[1] * t.slope * t.attenuation), a.i


def strauss(a, t, p):  # E[2.2-23] to E[2.2-28]
    o, metal, k_f, k_g, k_s = p[2:7]

    def fresnel(x):
        return ((1 / (x - k_f) ** 2 - 1 / k_f ** 2) / (1 / (1 - k_f) ** 2 - 1 / k_f ** 2))

    def shown(x):
        return ((1 / (1 - k_g) ** 2 - 1 / (x - k_g) ** 2) / (1 / (1 - k_g) ** 2 - 1 / k_g ** 2))

    x_l, x_v = mp.acos(a.j) / (mp.pi / 2), mp.acos(a.k) / (mp.pi / 2)
    d = (1 - o ** 3) * (1 - metal * o)
    s = min(mpf(1), o ** 3 + (o ** 3 + k_s) * fresnel(x_l) * shown(x_l) * shown(x_v))
    highlight = lit(a, s * power(a.l, 3 / (1 - o)))
    # C_S = 1 + p (1 − F)(C_D − 1), split into C_D and 1.
    coloured = metal * (1 - fresnel(x_l))
    return d * t.diffuse + highlight * coloured, 0, highlight * (1 - coloured), 0, 0


def ward_phong(a, t, p):  # E[2.2-32] in E[2.2-5]
    n = p[2] * p[3] / (p[2] - p[2] * a.m2 + p[3] * a.m2)
    return p[0] * t.diffuse, lit(a, p[1] * power(a.h, n)), 0, 0, 0


# X. D. He et al., 1991 (SIGGRAPH '91, eqs. 4 to 11): ρ = d a/π + s F G S D/(π j k), times j ω. What depends on
# wavelength, but F, is told apart: D G = (4 i²/(j + k))² · σ² (j + k)² τ²/16 · ripples, so that the weight of F has
# the rest, and `ripples` has g and v_xy²τ²/4 of a wave number of 1.

def he_torrance(a, t, p):
    sigma0, tau = p[2:4]

    def hidden(x):  # K of a cosine
        if x == 1:
            return mpf(0)
        sine = mp.sqrt(1 - x * x)
        return sine / max(x, mpf(1e-12)) * mp.erfc(tau / (2 * sigma0) * x / sine)  # 0 has no value: 1e-12

    root = (hidden(a.j) + hidden(a.k)) / 4 / mp.sqrt(mp.pi / 2)  # z exp(z²/2)
    lit_height = sigma0 ** 2 / (1 + mp.lambertw(root * root).real)
    slopes = mp.sqrt(2) * sigma0 / tau
    shown = a.j * smith_over_cosine(a.j, slopes) * smith_over_cosine(a.k, slopes)
    weight = p[1] * a.w / mp.pi * shown * lit_height * tau ** 2 * a.i ** 4
    return (a.w * p[0] * t.diffuse / mp.pi, 0, 0, lit(a, weight), a.i, lit_height * (a.j + a.k) ** 2,
            tau ** 2 * a.i ** 2 * (1 - a.h ** 2))


def ripples(height, spread, nm):
    """The series, as it stands, to 50 digits; of thousands of terms without the first, which are below 1e-80 of the rest."""
    q = (2000 * mp.pi / nm) ** 2
    g, s = height * q, spread * q
    with mp.workdps(60):
        m = max(1, int(g - 20 * mp.sqrt(g)))
        term = mp.exp(-g + ((m - 1) * mp.log(g) if m > 1 else 0) - mp.loggamma(m + 1))  # g^(m−1) e^(−g)/m!
        total = most = mpf(0)
        while True:
            value = term * mp.exp(-s / m) / m
            total += value
            most = max(most, value)
            if m > g and value < most * mpf(10) ** -55 and m * m > s:
                return q * q * total
            m += 1
            term *= g / m


MODELS = {form.__name__: form for form in (
    lambert, blinn_phong, phong, schlick, hall_greenberg, cook_torrance, blinn, strauss, ward_phong,
    he_torrance)}
FRESNEL = {form.__name__: form for form in (
    schlick_fresnel, index_from_reflectance, dielectric_fresnel, conductor_fresnel)}
