"""A picture before any spectrum, and what another light, paint or observer makes of it: no ray is traced.

What reaches a pixel is Σ weight · light · factor · factor … (proto/metamer/v1/factors.proto). A signature is a light and the
factors that it meets; its X Y Z is found once, and a pixel is a sum over its signatures:

    X Y Z (pixel) = Σ weight · luminance / Y(light) · ∫ x̄ȳz̄(λ) light(λ) Π factor(λ) dλ

Spectra are straight lines between samples, so that the integrals are exact, but for Fresnel terms. f64 throughout: the
answer of the method `exact`, to the rounding of the weights, f32."""
import hashlib
import os
import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from google.protobuf.message import DecodeError

from metamer import absorption, rough
from metamer.errors import InputError, ProtocolError
from metamer.events import Tile
from metamer.fluorescence import reradiated
from metamer.fresnel import fresnel_at_node
from metamer.spectra import (SEEN, Observer, Quadrature, SceneSpectra, Spectrum, band_means, luminance_of, observer_of,
                             quadrature)
from metamer.v1 import factors_pb2, plan_pb2

_HEAD = struct.Struct("<8s4I4Q32s")  # client/relight/factors_file.cpp
_WHITE, _DIFFUSE, _SPECULAR, _FRESNEL = (factors_pb2.FACTOR_WHITE, factors_pb2.FACTOR_DIFFUSE,
                                         factors_pb2.FACTOR_SPECULAR, factors_pb2.FACTOR_FRESNEL)
_REFLECT, _TRANSMIT, _ABSORB = factors_pb2.FACTOR_REFLECT, factors_pb2.FACTOR_TRANSMIT, factors_pb2.FACTOR_ABSORB
_WINDOW = factors_pb2.FACTOR_WINDOW
_RERADIATE = factors_pb2.FACTOR_RERADIATE
_LOBE, _COHERENT = factors_pb2.FACTOR_LOBE, factors_pb2.FACTOR_COHERENT
_NODES = {_FRESNEL: 512, _REFLECT: 512, _TRANSMIT: 512, _ABSORB: absorption.NODES, _LOBE: rough.LOBE_NODES,
          _COHERENT: rough.MIRROR_NODES}  # else 1
Node = tuple[int, int, int]  # term, material, node


@dataclass(frozen=True)
class Factors:
    """`products[i]` is a product (of those before it; 0 is 1) and the term more that product i + 1 has. `signatures`:
    product, light, term. `pixel`, `signature`, `weight`, (pairs,) each: what every pair adds to which pixel."""

    width: int
    height: int
    scene: factors_pb2.SceneFactors
    products: list[tuple[int, Node]]
    signatures: list[tuple[int, int, Node]]
    pixel: np.ndarray
    signature: np.ndarray
    weight: np.ndarray

    @property
    def spectra(self) -> SceneSpectra:
        """The spectra that the picture was rendered with."""
        return SceneSpectra.from_message(self.scene)

    def relight(self, lights: Mapping[str, Spectrum] | None = None, materials: Mapping[str, Spectrum] | None = None,
                observer: Observer | None = None) -> np.ndarray:
        """(height, width, 3) float32 X Y Z with other spectra, by the names of lights ("*": all that are not named) and
        of materials ("NAME", its diffuse, or "NAME.specular"). Luminances stay. InputError: no such name."""
        scene = _with_spectra(self.scene, lights or {}, materials or {})
        return self._pixels(_signature_colors(self, scene, observer or observer_of(scene.observer)))

    def spectral(self, nm: Sequence[float]) -> np.ndarray:
        """(height, width, bands) float32: what reaches each pixel, per nm, in bands at `nm` (rising, 360 to 830): the
        means of the lights over each band, up to its neighbours, times the factors in its middle. InputError."""
        middles = Spectrum(np.array(nm), np.zeros(len(nm)))
        if middles.nm[0] < SEEN[0] or middles.nm[-1] > SEEN[1]:
            raise InputError(f"bands lie between {SEEN[0]:g} and {SEEN[1]:g} nm")
        at = Quadrature(middles.nm, np.ones(len(nm)))
        lights = _Lights(self, self.scene, observer_of(self.scene.observer))
        rows = [band_means(power, middles.nm) for power in lights.powers]
        spectra = [rows[light] * met for light, met in _met(self, self.scene, at, lights)]
        return self._pixels(np.array(spectra).reshape(-1, len(nm)))

    def _pixels(self, values: np.ndarray) -> np.ndarray:
        """Sums of (signatures, channels) values over each pixel's pairs."""
        pairs, pixels = self.weight.astype(np.float64), self.width * self.height
        sums = [np.bincount(self.pixel, pairs * channel[self.signature], pixels) for channel in values.T]
        return np.stack(sums, -1).reshape(self.height, self.width, -1).astype(np.float32)


def _with_spectra(scene: factors_pb2.SceneFactors, lights: Mapping[str, Spectrum], materials: Mapping[str, Spectrum]
                  ) -> factors_pb2.SceneFactors:
    changed = factors_pb2.SceneFactors()
    changed.CopyFrom(scene)
    fields = {light.name: light.power for light in changed.light}
    for name, spectrum in sorted(lights.items(), key=lambda item: item[0] != "*"):
        if name != "*" and name not in fields:
            raise InputError(f'there is no light "{name}"; there are {", ".join(fields)}')
        for power in fields.values() if name == "*" else [fields[name]]:
            power.CopyFrom(_sampled(spectrum))
    fields = {material.name: material.diffuse for material in changed.material}
    fields |= {f"{material.name}.specular": material.specular for material in changed.material}
    for name, spectrum in materials.items():
        if name not in fields:
            raise InputError(f'there is no material "{name}"; there are {", ".join(fields)}')
        fields[name].CopyFrom(_sampled(spectrum))
    return changed


def _sampled(spectrum: Spectrum) -> factors_pb2.SampledSpectrum:
    return factors_pb2.SampledSpectrum(nm=spectrum.nm, values=spectrum.values)


def _signature_colors(factors: Factors, scene: factors_pb2.SceneFactors, observer: Observer) -> np.ndarray:
    """(signatures, 3) X Y Z of each at weight 1."""
    lights = _Lights(factors, scene, observer)
    length = [0]
    for parent, _ in factors.products:
        length.append(length[parent] + 1)
    spectra = [Spectrum.from_message(s) for m in scene.material
               for s in (m.diffuse, m.specular, m.constants.n, m.constants.k, m.transmittance) if s.nm]
    spectra += [Spectrum.from_message(message) for message in (*(i.n for i in scene.interface), *scene.window)]
    if any(material.rough for material in scene.material):
        spectra.append(rough.GRID)
    at = quadrature([*lights.powers, *observer, *spectra], 3 + max(length))

    # What an observer sees of each light: (lights, 3, points).
    functions = np.stack([f.emission_at(at.nm) for f in observer]) * at.widths
    seen = np.stack([functions * power.emission_at(at.nm) for power in lights.powers])
    return np.array([seen[light] @ met for light, met in _met(factors, scene, at, lights)]).reshape(-1, 3)


class _Lights:
    """The scene's lights with their luminance, and behind them those that its fluorescences make of them."""

    def __init__(self, factors: Factors, scene: factors_pb2.SceneFactors, observer: Observer) -> None:
        self.powers: list[Spectrum] = []
        self._reradiated: dict[tuple[int, int], int] = {}  # by light and material
        for light in scene.light:
            power = Spectrum.from_message(light.power).as_emission()
            y = luminance_of(power, observer)
            self.powers.append(Spectrum(power.nm, power.values * (light.luminance / y if y > 0 else 0)))
        for _, light, (term, material, _) in factors.signatures:
            if term == _RERADIATE and (light, material) not in self._reradiated:
                self._reradiated[light, material] = len(self.powers)
                of = scene.fluorescence[scene.material[material].fluorescence]
                self.powers.append(reradiated(of, self.powers[light]))

    def of(self, light: int, node: Node) -> int:
        """Which one comes from a signature's last surface."""
        return self._reradiated[light, node[1]] if node[0] == _RERADIATE else light


def _met(factors: Factors, scene: factors_pb2.SceneFactors, at: Quadrature, lights: _Lights
         ) -> Iterator[tuple[int, np.ndarray]]:
    """Each signature's light, one of `lights`, and the product of all factors that it meets, (points,)."""
    values = _NodeValues(scene, at)
    products = [np.ones_like(at.nm)]
    for parent, node in factors.products:
        products.append(products[parent] * values(node))
    for product, light, node in factors.signatures:
        yield lights.of(light, node), products[product] * values(node)


class _NodeValues:
    """A factor at the wavelengths of a quadrature; each is made once."""

    def __init__(self, scene: factors_pb2.SceneFactors, at: Quadrature) -> None:
        self._scene, self._at = scene, at
        self._known: dict[Node, np.ndarray] = {}

    def __call__(self, node: Node) -> np.ndarray:
        if node not in self._known:
            self._known[node] = self._make(*node)
        return self._known[node]

    def _make(self, term: int, material: int, node: int) -> np.ndarray:
        nm = self._at.nm
        if term in (_WHITE, _RERADIATE):
            return np.ones_like(nm)
        if term == _WINDOW:
            return Spectrum.from_message(self._scene.window[material]).property_at(nm)
        if term in (_REFLECT, _TRANSMIT):
            reflected = fresnel_at_node(Spectrum.from_message(self._scene.interface[material].n).property_at(nm) + 0j, node)
            return reflected if term == _REFLECT else 1 - reflected
        of = self._scene.material[material]
        if term == _ABSORB:
            return absorption.at_node(Spectrum.from_message(of.transmittance), nm, node)
        if term == _COHERENT:
            return rough.mirror_at_node(nm, node)
        if term == _LOBE and not of.HasField("constants"):
            return rough.schlick_lobe_at_node(Spectrum.from_message(of.specular).property_at(nm), nm, node)
        if term in (_FRESNEL, _LOBE):
            n = Spectrum.from_message(of.constants.n).property_at(nm)
            k = Spectrum.from_message(of.constants.k).property_at(nm) if of.constants.HasField("k") else np.zeros_like(nm)
            return fresnel_at_node(n + 1j * k, node) if term == _FRESNEL else rough.lobe_at_node(n + 1j * k, nm, node)
        return Spectrum.from_message(of.diffuse if term == _DIFFUSE else of.specular).property_at(nm)


class FactorsBuilder:
    """Puts the factors of a picture's tiles together: their tables become one. ProtocolError: numbers that do not fit."""

    def __init__(self, plan: plan_pb2.Plan, scene: bytes) -> None:
        try:
            self._scene = factors_pb2.SceneFactors.FromString(scene)
        except DecodeError as error:
            raise ProtocolError("the scene's factors are no message") from error
        self._width, self._height = plan.width, plan.height
        self._products: dict[tuple[int, Node], int] = {}
        self._signatures: dict[tuple[int, int, Node], int] = {}
        self._pieces: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []

    def add(self, tile: Tile) -> None:
        try:
            own = factors_pb2.TileFactors.FromString(tile.factors)
        except DecodeError as error:
            raise ProtocolError("a tile's factors are no message") from error
        try:
            numbers = self._add_tables(own)
        except ValueError as error:  # zip's
            raise ProtocolError("the lists of a tile's factors differ in length") from error
        height, width = tile.xyz.shape[:2]
        count, signature = np.array(own.count, np.int64), np.array(own.signature, np.int64)
        weight = np.array(own.weight, np.float32)
        if count.size != width * height or not count.sum() == signature.size == weight.size:
            raise ProtocolError("a tile's factors do not fit its pixels")
        if not np.isfinite(weight).all() or signature.size and signature.max() >= numbers.size:
            raise ProtocolError("a tile's factors name what does not exist")
        rows, columns = np.divmod(np.arange(width * height), width)
        pixel = (tile.y + rows) * self._width + tile.x + columns
        self._pieces.append((np.repeat(pixel, count), numbers[signature], weight))

    def _add_tables(self, tile: factors_pb2.TileFactors) -> np.ndarray:
        """The picture's numbers of a tile's signatures."""
        products = [0]
        for parent, *node in zip(tile.product_parent, tile.product_term, tile.product_material, tile.product_node,
                                 strict=True):
            if parent >= len(products):
                raise ProtocolError("a product comes before its parent")
            if node[0] == _RERADIATE:
                raise ProtocolError("a product re-radiates")
            key = (products[parent], self._sound(*node))
            products.append(self._products.setdefault(key, len(self._products) + 1))
        numbers = []
        for product, light, *node in zip(tile.signature_product, tile.signature_light, tile.signature_term,
                                         tile.signature_material, tile.signature_node, strict=True):
            if product >= len(products) or light >= len(self._scene.light):
                raise ProtocolError("a signature names what does not exist")
            key = (products[product], light, self._sound(*node))
            numbers.append(self._signatures.setdefault(key, len(self._signatures)))
        return np.array(numbers, np.int64)

    def _sound(self, term: int, material: int, node: int) -> Node:
        if term not in (_WHITE, _DIFFUSE, _SPECULAR, _WINDOW, _RERADIATE, *_NODES):
            raise ProtocolError(f"a factor is of a kind that this client does not know ({term})")
        members = {_REFLECT: self._scene.interface, _TRANSMIT: self._scene.interface,
                   _WINDOW: self._scene.window}.get(term, self._scene.material)
        if term != _WHITE and material >= len(members) or node >= _NODES.get(term, 1):
            raise ProtocolError("a factor names what does not exist")
        if term in (_LOBE, _COHERENT) and not self._scene.material[material].rough:
            raise ProtocolError("a factor names a roughness that does not exist")
        if term == _RERADIATE and not self._scene.material[material].HasField("fluorescence"):
            raise ProtocolError("a factor names a fluorescence that does not exist")
        return term, material, node

    def finish(self) -> Factors:
        pieces = [np.concatenate(parts) for parts in zip(*self._pieces)] or [np.zeros(0, np.int64)] * 3
        return Factors(self._width, self._height, self._scene, list(self._products), list(self._signatures), *pieces)


def read_factors(file: str | os.PathLike[str]) -> Factors:
    """What `metamer render --keep-factors` wrote. InputError: it is no such file, or damaged."""
    with open(file, "rb") as stream:
        data = stream.read()
    wrong = InputError(f"{os.fspath(file)} is no file of factors, of another version, or damaged")
    if len(data) < _HEAD.size:
        raise wrong
    magic, version, width, height, _, plan_bytes, scene_bytes, tables_bytes, pairs, digest = _HEAD.unpack_from(data)
    size = _HEAD.size + plan_bytes + scene_bytes + tables_bytes + 4 * width * height + 8 * pairs
    if magic != b"MTMRFACT" or version != 1 or size != len(data):
        raise wrong
    if hashlib.sha256(data[: _HEAD.size - 32] + bytes(32) + data[_HEAD.size :]).digest() != digest:
        raise wrong
    plan, scene, tables, numbers = (data[at:to] for at, to in _ranges(_HEAD.size, plan_bytes, scene_bytes, tables_bytes))
    end = np.frombuffer(numbers, "<u4", width * height).astype(np.int64)
    signature = np.frombuffer(numbers, "<u4", pairs, end.size * 4)
    message = factors_pb2.TileFactors.FromString(tables)
    message.count.extend(np.diff(end, prepend=0))
    message.signature.extend(signature)
    message.weight.extend(np.frombuffer(numbers, "<f4", pairs, (end.size + pairs) * 4))
    builder = FactorsBuilder(plan_pb2.Plan.FromString(plan), scene)
    builder.add(Tile(0, 0, np.empty((height, width, 3), np.float32), message.SerializeToString()))
    return builder.finish()


def _ranges(begin: int, *sizes: int) -> list[tuple[int, int | None]]:
    """Where so many bytes lie one after the other, and the rest."""
    ends = list(np.cumsum([begin, *sizes]))
    return [*zip(ends[:-1], ends[1:]), (ends[-1], None)]
