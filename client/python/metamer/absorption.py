"""Absorption along a way, as a table over its optical length has it (common/scene/absorption_table.h)."""
import math

import numpy as np

from metamer.spectra import Spectrum

NODES = 1024
_STEP = 0.0125


def node_length(node: int) -> float:
    """Evenly in 1 − exp(−s/2) up to s = 2, then evenly in ln s."""
    turn = (1 - math.exp(-1)) * 2 / _STEP
    if node <= turn:
        return -2 * math.log1p(-node * _STEP / 2)
    return 2 * math.exp((node - turn) * _STEP * math.e / 2)


def at_node(transmittance: Spectrum, nm: np.ndarray, node: int) -> np.ndarray:
    """What goes through, where the wavelength that is absorbed most has the node's optical depth."""
    strongest = -math.log(max(transmittance.values.min(), 1e-30))
    depth = -np.log(np.clip(transmittance.property_at(nm), 1e-30, 1))
    return np.exp(-depth / strongest * node_length(node))
