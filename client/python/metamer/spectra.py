"""Spectra as numpy arrays, and the integrals of their products that make X Y Z."""
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from metamer.errors import InputError
from metamer.v1 import factors_pb2, spectrum_pb2

SEEN = (360.0, 830.0)  # nm: where observers are
_LINE_HALF_WIDTH = 1e-3  # nm, as common/spectral/lines.h


@dataclass(frozen=True)
class Spectrum:
    """A function of wavelength: straight lines between samples. `nm`: rising, (n,) float64; `values`: (n,) float64. An
    emission is 0 outside its samples, a reflectance or transmittance keeps its end values. InputError: none of these."""

    nm: np.ndarray
    values: np.ndarray

    def __post_init__(self) -> None:
        nm, values = (np.array(given, np.float64) for given in (self.nm, self.values))
        if nm.ndim != 1 or nm.shape != values.shape or nm.size == 0:
            raise InputError("a spectrum has as many values as wavelengths, one at least")
        if not (np.isfinite(nm).all() and np.isfinite(values).all() and (np.diff(nm) > 0).all()):
            raise InputError("a spectrum's wavelengths rise, and its numbers are finite")
        object.__setattr__(self, "nm", nm)
        object.__setattr__(self, "values", values)

    @classmethod
    def constant(cls, value: float) -> "Spectrum":
        return cls(np.array([SEEN[0], SEEN[1]]), np.array([value, value]))

    @classmethod
    def from_message(cls, message: factors_pb2.SampledSpectrum) -> "Spectrum":
        return cls(np.array(message.nm), np.array(message.values))

    def message(self) -> spectrum_pb2.Spectrum:
        """As a scene has it: scene.message.material[0].diffuse.CopyFrom(spectrum.message())."""
        return spectrum_pb2.Spectrum(samples=spectrum_pb2.Samples(wavelength=self.nm, value=self.values),
                                     interpolation=spectrum_pb2.Spectrum.LINEAR)

    def emission_at(self, nm: np.ndarray) -> np.ndarray:
        return np.interp(nm, self.nm, self.values, left=0.0, right=0.0)

    def property_at(self, nm: np.ndarray) -> np.ndarray:
        return np.interp(nm, self.nm, self.values)

    def as_emission(self) -> "Spectrum":
        """One sample of an emission is a line, a narrow triangle, since it has no width."""
        if self.nm.size > 1:
            return self
        return Spectrum(self.nm[0] + _LINE_HALF_WIDTH * np.array([-1, 0, 1]), self.values[0] * np.array([0, 1, 0]))


Observer = tuple[Spectrum, Spectrum, Spectrum]  # x̄, ȳ, z̄


@dataclass(frozen=True)
class Quadrature:
    """Σ f(nm) widths is the integral of f over what is seen."""

    nm: np.ndarray
    widths: np.ndarray


def quadrature(spectra: Iterable[Spectrum], degree: int) -> Quadrature:
    """Gauss and Legendre's in every cell between the samples of all spectra: exact for a product of straight lines that
    is a polynomial of at most this degree in each cell."""
    inner = [spectrum.nm[(spectrum.nm > SEEN[0]) & (spectrum.nm < SEEN[1])] for spectrum in spectra]
    return cells(np.unique(np.concatenate([np.array(SEEN), *inner])), degree)


def cells(edges: np.ndarray, degree: int) -> Quadrature:
    """Gauss and Legendre's in every cell between `edges` (rising)."""
    points, weights = np.polynomial.legendre.leggauss(degree // 2 + 1)
    half = np.diff(edges)[:, None] / 2
    return Quadrature((edges[:-1, None] + half * (1 + points)).ravel(), (half * weights).ravel())


def xyz_of(light: Spectrum, observer: Observer, *factors: Spectrum, luminance: float = 1.0) -> np.ndarray:
    """(3,) X Y Z of a light after `factors`, reflectances or transmittances; without any its Y is `luminance`."""
    light = light.as_emission()
    at = quadrature([light, *observer, *factors], 2 + len(factors))
    seen = np.stack([f.emission_at(at.nm) for f in observer]) * light.emission_at(at.nm) * at.widths
    met = np.prod([f.property_at(at.nm) for f in factors], axis=0) if factors else 1.0
    y = seen[1].sum()
    return luminance / y * (seen * met).sum(1) if y > 0 else np.zeros(3)


def luminance_of(light: Spectrum, observer: Observer) -> float:
    """∫ light ȳ dλ, in the light's own unit."""
    light = light.as_emission()
    at = quadrature([light, observer[1]], 2)
    return float(np.sum(light.emission_at(at.nm) * observer[1].emission_at(at.nm) * at.widths))


def band_means(light: Spectrum, nm: np.ndarray) -> np.ndarray:
    """The mean of a light over the hat function of each of `nm` (rising), which is 1 there and 0 at its neighbours; of a
    single one its value there. As common/spectral/cells.h has it."""
    light = light.as_emission()
    if nm.size == 1:
        return light.emission_at(nm)
    at = quadrature([light, Spectrum(nm, np.zeros(nm.size))], 2)
    hats = np.stack([np.interp(at.nm, nm, hat, left=0.0, right=0.0) for hat in np.eye(nm.size)]) * at.widths
    return hats @ light.emission_at(at.nm) / hats.sum(1)


@dataclass(frozen=True)
class SceneSpectra:
    """A scene's spectra as the renderer has them: files read, words looked up, interpolated. By the names of lights and
    materials."""

    lights: dict[str, Spectrum]
    luminances: dict[str, float]
    diffuse: dict[str, Spectrum]
    specular: dict[str, Spectrum]
    observer: Observer

    @classmethod
    def from_message(cls, scene: factors_pb2.SceneFactors) -> "SceneSpectra":
        of = Spectrum.from_message
        return cls({light.name: of(light.power) for light in scene.light},
                   {light.name: light.luminance for light in scene.light},
                   {material.name: of(material.diffuse) for material in scene.material},
                   {material.name: of(material.specular) for material in scene.material},
                   observer_of(scene.observer))


def observer_of(functions: Sequence[factors_pb2.SampledSpectrum]) -> Observer:
    """InputError: a server that does not say by whom its pictures are seen."""
    if len(functions) != 3:
        raise InputError("the factors do not say their observer: the server is too old")
    x, y, z = map(Spectrum.from_message, functions)
    return x, y, z
