"""Lobes and mirrors of rough surfaces (X. D. He et al., 1991), as their tables have them (common/scene/rough_lobe_table.h,
rough_mirror_table.h)."""
import numpy as np

from metamer.fresnel import fresnel
from metamer.spectra import Spectrum

WAVELENGTHS, COSINES = 8, 128
LOBE_NODES = WAVELENGTHS * COSINES
MIRROR_NODES = 512
FIRST, LAST = 390.0, 730.0  # nm; end values hold outside
GRID = Spectrum(np.arange(FIRST, LAST + 1, 5), np.ones(69))  # between whose samples a window is nearly a line
_DEEPEST = 330.0  # nm


def window(nm: np.ndarray, wavelength: int) -> np.ndarray:
    """The polynomial that is 1 at this one of Chebyshev's nodes and 0 at the others."""
    at = -np.cos(np.pi * (np.arange(WAVELENGTHS) + 0.5) / WAVELENGTHS)
    x = (np.clip(nm, FIRST, LAST) - (FIRST + LAST) / 2) / ((LAST - FIRST) / 2)
    others = np.delete(at, wavelength)
    return np.prod((x[..., None] - others) / (at[wavelength] - others), axis=-1)


def _cosine(node: int) -> float:
    return (node // WAVELENGTHS / (COSINES - 1)) ** 2


def lobe_at_node(index: np.ndarray, nm: np.ndarray, node: int) -> np.ndarray:
    """`index`: n + i k at `nm`."""
    return fresnel(index, _cosine(node)) * window(nm, node % WAVELENGTHS)


def schlick_lobe_at_node(normal: np.ndarray, nm: np.ndarray, node: int) -> np.ndarray:
    """`normal`: the reflectance at normal incidence at `nm`."""
    return (normal + (1 - normal) * (1 - _cosine(node)) ** 5) * window(nm, node % WAVELENGTHS)


def mirror_at_node(nm: np.ndarray, node: int) -> np.ndarray:
    """What the roughness leaves at a node's depth."""
    return np.exp(-((4 * np.pi * _DEEPEST * node / (MIRROR_NODES - 1) / nm) ** 2))
