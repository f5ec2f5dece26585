"""What a surface re-radiates of light: E(λ) = ∫ M(λ, μ) light(μ) dμ, from 300 to 830 nm (common/spectral/fluorescence.h)."""
import numpy as np

from metamer.spectra import Quadrature, Spectrum, cells
from metamer.v1 import factors_pb2

_EXCITED = (300.0, 830.0)  # nm


def reradiated(message: factors_pb2.SampledFluorescence, light: Spectrum) -> Spectrum:
    """E of a light, in its unit. The message is the server's."""
    light = light.as_emission()
    if message.HasField("emission"):
        return _by_molecules(message, light)
    excitation, emission = np.array(message.excitation_nm), np.array(message.emission_nm)
    at = _between([excitation, light.nm], excitation)
    hats = np.stack([np.interp(at.nm, excitation, hat, left=0.0, right=0.0) for hat in np.eye(excitation.size)])
    power = hats @ (light.emission_at(at.nm) * at.widths)
    table = np.array(message.matrix, np.float64).reshape(excitation.size, -1)
    lines = Spectrum(emission, power @ table)
    before, after = np.concatenate([emission[:1], emission[:-1]]), np.concatenate([excitation[1:], excitation[-1:]])
    if not np.any((table > 0) & (before[None, :] < after[:, None])):
        return lines
    return _turned_up(table, excitation, lines, light)


def _turned_up(table: np.ndarray, excitation: np.ndarray, lines: Spectrum, light: Spectrum) -> Spectrum:
    """What the table's lines have below the diagonal, as far above it."""
    emission = lines.nm
    reach = np.max(np.diff(excitation)) + 2 * np.max(np.diff(emission))
    low, high = np.clip([excitation[0], excitation[-1]], *_EXCITED)
    if high <= low:
        return lines
    first, last = min(low - reach, emission[0]), max(min(high, emission[-1]) + reach, emission[-1])
    nm = np.unique(np.concatenate([[first, last], np.arange(_EXCITED[0], _EXCITED[1] + 1), excitation, light.nm, emission]))
    nm = nm[(nm >= first) & (nm <= last)]
    near = (nm >= low - reach) & (nm <= high + reach) & (nm >= emission[0])
    nm = nm[near | np.isin(nm, emission)]
    at = _between([excitation, light.nm, nm], excitation)
    power = light.emission_at(at.nm) * at.widths
    values = np.interp(nm, emission, lines.values, left=0.0, right=0.0)
    for i, one in enumerate(nm):
        part = slice(*np.searchsorted(at.nm, [one - reach, one + reach]))
        excited = at.nm[part]
        below = one < excited
        moved = _table_at(table, excitation, emission, np.where(below, one, 2 * excited - one), excited)
        values[i] = max(values[i] + np.sum(np.where(below, -moved, moved) * power[part]), 0.0)
    return Spectrum(nm, values)


def _table_at(table: np.ndarray, excitation: np.ndarray, emission: np.ndarray, emitted: np.ndarray,
              excited: np.ndarray) -> np.ndarray:
    """Linear between its values in both; 0 outside."""
    i = np.clip(np.searchsorted(excitation, excited, side='right') - 1, 0, excitation.size - 2)
    j = np.clip(np.searchsorted(emission, emitted, side='right') - 1, 0, emission.size - 2)
    s = (excited - excitation[i]) / (excitation[i + 1] - excitation[i])
    t = (emitted - emission[j]) / (emission[j + 1] - emission[j])
    inside = (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    rows = [table[i + k, j] + t * (table[i + k, j + 1] - table[i + k, j]) for k in (0, 1)]
    return np.where(inside, rows[0] + s * (rows[1] - rows[0]), 0.0)


def _by_molecules(message: factors_pb2.SampledFluorescence, light: Spectrum) -> Spectrum:
    """Each wavelength has what is absorbed below it."""
    excitation, emission = map(Spectrum.from_message, (message.excitation, message.emission))
    inside = np.concatenate([np.arange(_EXCITED[0], _EXCITED[1] + 1), excitation.nm, light.nm])
    inside = inside[(inside >= excitation.nm[0]) & (inside <= excitation.nm[-1])]
    inside = inside[(inside > emission.nm[0]) & (inside < emission.nm[-1])]
    nm = np.unique(np.concatenate([emission.nm, inside]))
    at = _between([excitation.nm, light.nm, nm], excitation.nm)
    absorbed = excitation.emission_at(at.nm) * light.emission_at(at.nm) * at.nm * at.widths
    up_to = np.concatenate([[0.0], np.cumsum(absorbed)])[np.searchsorted(at.nm, nm)]
    photons = cells(emission.nm, 2)
    every = np.sum(emission.emission_at(photons.nm) * photons.nm * photons.widths)
    return Spectrum(nm, message.quantum_yield / every * emission.emission_at(nm) * up_to)


def _between(lists: list[np.ndarray], excitation: np.ndarray) -> Quadrature:
    """Over what excites, in cells between all samples."""
    ends = np.clip([excitation[0], excitation[-1]], *_EXCITED)
    inner = [nm[(nm > ends[0]) & (nm < ends[1])] for nm in lists]
    return cells(np.unique(np.concatenate([ends, *inner])), 3)
