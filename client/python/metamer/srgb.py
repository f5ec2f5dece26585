"""X Y Z as the colours of a screen: sRGB, IEC 61966-2-1."""
import numpy as np

# Linear sRGB -> X Y Z by the primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and the white (0.3127, 0.3290) at Y = 1,
# after SMPTE RP 177 (1993), 3.3.
_CHROMATICITIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06], [0.3127, 0.3290]])
_COLUMNS = np.stack([_CHROMATICITIES[:, 0], _CHROMATICITIES[:, 1], 1 - _CHROMATICITIES.sum(1)]) / _CHROMATICITIES[:, 1]
TO_XYZ = _COLUMNS[:, :3] * np.linalg.solve(_COLUMNS[:, :3], _COLUMNS[:, 3])
FROM_XYZ = np.linalg.inv(TO_XYZ)


def linear_srgb(xyz: np.ndarray) -> np.ndarray:
    """(…, 3) X Y Z -> linear R G B, f64; below 0 or above 1 where sRGB has no such colour."""
    return np.asarray(xyz, np.float64) @ FROM_XYZ.T


def encode(linear: np.ndarray) -> np.ndarray:
    """Linear 0..1 -> the standard's codes 0..1; what lies outside is clipped."""
    inside = np.clip(linear, 0, 1)
    return np.where(inside <= 0.0031308, 12.92 * inside, 1.055 * inside ** (1 / 2.4) - 0.055)


def to_srgb(xyz: np.ndarray, exposure: float = 1.0) -> np.ndarray:
    """(…, 3) X Y Z -> uint8 sRGB. `exposure` multiplies X Y Z. No adaptation: a light's tint stays, as in what
    `metamer fetch` writes of a scene without Development."""
    return np.rint(255 * encode(linear_srgb(xyz) * exposure)).astype(np.uint8)
