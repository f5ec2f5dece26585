"""The exact Fresnel term, as a table over the cosine has it (common/scene/fresnel_table.h)."""
import numpy as np

NODES = 512


def fresnel(index: np.ndarray, cosine: float) -> np.ndarray:
    """F of unpolarised light at the cosine of incidence, 0..1; `index`: n + i k of the surface in air, complex."""
    inside = np.sqrt(1 - (1 - cosine * cosine) / index**2)
    s = (cosine - index * inside) / (cosine + index * inside)
    p = (index * cosine - inside) / (index * cosine + inside)
    return (np.abs(s) ** 2 + np.abs(p) ** 2) / 2


def fresnel_at_node(index: np.ndarray, node: int) -> np.ndarray:
    """At a node of the table, u = (i / (n − 1))²."""
    return fresnel(index, (node / (NODES - 1)) ** 2)
