"""Differences of colours as people see them."""
import numpy as np


def lab(xyz: np.ndarray, white: np.ndarray) -> np.ndarray:
    """(…, 3) X Y Z -> (…, 3) CIE L*a*b* against the X Y Z of what looks white (CIE 15:2004, 8.2.1)."""
    t = np.asarray(xyz, np.float64) / np.asarray(white, np.float64)
    x, y, z = np.moveaxis(np.where(t > 216 / 24389, np.cbrt(t), 841 / 108 * t + 4 / 29), -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], -1)


def delta_e_ab(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """(…, 3) L*a*b* each -> (…) ΔE*ab, CIE 1976."""
    return np.linalg.norm(np.asarray(one) - np.asarray(other), axis=-1)


def delta_e_00(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """(…, 3) L*a*b* each -> (…) ΔE00: CIEDE2000 as Sharma, Wu and Dalal write it (Color Research and Application 30, 21,
    2005); k_L = k_C = k_H = 1."""
    (l1, a1, b1), (l2, a2, b2) = (np.moveaxis(np.asarray(given, np.float64), -1, 0) for given in (one, other))
    c7 = ((np.hypot(a1, b1) + np.hypot(a2, b2)) / 2) ** 7
    g = 1.5 - 0.5 * np.sqrt(c7 / (c7 + 25.0**7))
    c1, c2 = np.hypot(g * a1, b1), np.hypot(g * a2, b2)
    h1, h2 = (np.degrees(np.arctan2(b, g * a)) % 360 for a, b in ((a1, b1), (a2, b2)))
    grey = c1 * c2 == 0
    turn = np.where(grey, 0, (h2 - h1 + 180) % 360 - 180)
    turn = np.where(h2 - h1 == 180, 180, turn)
    mean_h = np.where(grey, h1 + h2, np.where(np.abs(h1 - h2) <= 180, (h1 + h2) / 2,
                                              np.where(h1 + h2 < 360, (h1 + h2) / 2 + 180, (h1 + h2) / 2 - 180)))
    mean_l, mean_c = (l1 + l2) / 2, (c1 + c2) / 2

    def cosine(degrees: np.ndarray) -> np.ndarray:
        return np.cos(np.radians(degrees))

    t = (1 - 0.17 * cosine(mean_h - 30) + 0.24 * cosine(2 * mean_h) + 0.32 * cosine(3 * mean_h + 6)
         - 0.20 * cosine(4 * mean_h - 63))
    rotation = -2 * np.sqrt(mean_c**7 / (mean_c**7 + 25.0**7)) * np.sin(
        np.radians(60 * np.exp(-(((mean_h - 275) / 25) ** 2))))
    dl = (l2 - l1) / (1 + 0.015 * (mean_l - 50) ** 2 / np.sqrt(20 + (mean_l - 50) ** 2))
    dc = (c2 - c1) / (1 + 0.045 * mean_c)
    dh = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * mean_c * t)
    return np.sqrt(dl**2 + dc**2 + dh**2 + rotation * dc * dh)
