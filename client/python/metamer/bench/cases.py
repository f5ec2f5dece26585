"""What is measured."""
import itertools
import os
import pathlib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from metamer.scene import Scene
from metamer.sweep import set_field


@dataclass(frozen=True)
class Case:
    """`name` tells it from all others, in records of other days too."""

    name: str
    scene: Scene


def method_text(word: str) -> str:
    """"exact" or "point { fitted: 8 }" as the schema's text."""
    return word if "{" in word else f"{word} {{}}"


def make_cases(scenes: Iterable[str | os.PathLike[str]], methods: Iterable[str], samples: Iterable[int],
               backends: Iterable[str], size: tuple[int, int] | None) -> Iterator[Case]:
    """All combinations; without methods, samples or backends, the scene's own. InputError: as Scene.read, set_field."""
    for file, method, spp, backend in itertools.product(scenes, methods or [""], samples or [0], backends or [""]):
        scene = Scene.read(file)
        name = pathlib.Path(file).stem
        if size:
            scene.message.settings.width, scene.message.settings.height = size
            name += f" {size[0]}x{size[1]}"
        if method:
            scene.message.settings.ClearField("goal")
            set_field(scene.message, "settings.method", method_text(method))
            name += f" {method}"
        if spp:
            scene.message.settings.spp = spp
            name += f" spp {spp}"
        if backend:
            set_field(scene.message, "settings.backend", backend.upper())
            name += f" {backend}"
        yield Case(name, scene)
