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
    return Spectrum(emission, power @ np.array(message.matrix, np.float64).reshape(excitation.size, -1))


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
