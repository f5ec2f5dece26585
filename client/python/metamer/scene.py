"""A scene as a client holds it: the message, and the folder where the files lie that it names."""
import hashlib
import json
import os
import pathlib
import urllib.parse
from collections.abc import Iterator
from dataclasses import dataclass, field

from google.protobuf import text_format
from google.protobuf.message import Message

from metamer.errors import InputError
from metamer.v1 import jobs_pb2, problem_pb2, scene_pb2

MAX_SCENE_TEXT = 16 << 20  # bytes, as common/scene/scene_file.h
_FILE_FIELDS = {"metamer.v1.Spectrum.file", "metamer.v1.Mesh.file", "metamer.v1.Settings.observer_file",
                "metamer.v1.Light.Environment.file", "metamer.v1.Texture.file", "metamer.v1.Map.file"}


@dataclass
class Scene:
    """`message` is the scene.proto's Scene and may be changed: scene.message.settings.spp = 64. Names of files in it
    are relative to `folder` and may not leave it."""

    message: scene_pb2.Scene = field(default_factory=scene_pb2.Scene)
    folder: pathlib.Path = pathlib.Path(".")
    name: str = "scene"

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> "Scene":
        """A .txtpb file. InputError: it can't be read, or is no scene; with line and column."""
        path = pathlib.Path(file)
        try:
            if path.stat().st_size > MAX_SCENE_TEXT:
                raise InputError(f"{path}: over {MAX_SCENE_TEXT} bytes are no scene")
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"cannot read {path}: {error}") from error
        return cls.parse(text, path.parent, path.name)

    @classmethod
    def parse(cls, text: str, folder: str | os.PathLike[str] = ".", name: str = "scene") -> "Scene":
        """Protobuf text format. InputError, with line and column."""
        message = scene_pb2.Scene()
        try:
            text_format.Parse(text, message)
        except text_format.ParseError as error:
            line, column = error.GetLine() or 0, error.GetColumn() or 0
            what = str(error).removeprefix(f"{line}:{column} : ")
            problem = problem_pb2.Problem(file=name, line=line, column=column, message=what)
            raise InputError("", [problem]) from error
        return cls(message, pathlib.Path(folder), name)

    def copy(self) -> "Scene":
        """One that can be changed by itself."""
        message = scene_pb2.Scene()
        message.CopyFrom(self.message)
        return Scene(message, self.folder, self.name)

    def with_look(self, name: str) -> "Scene":
        """A copy with one of its looks applied. InputError: it has none of that name, or the look names what is not
        there."""
        made = self.copy()
        for look in self.message.look:
            if look.name == name:
                apply_look(made.message, look)
                return made
        raise InputError(f'{self.name} has no look "{name}"; it has {", ".join(look.name for look in self.message.look)}')


def apply_look(scene: scene_pb2.Scene, look: scene_pb2.Look) -> None:
    """What a look leaves out stays as it is."""
    for change in look.light:
        named = [light for light in scene.light if change.name in ("*", light.name)]
        if not named:
            raise InputError(f'look "{look.name}" names the light "{change.name}", which is not there')
        for light in named:
            if change.HasField("spectrum"):
                light.spectrum.CopyFrom(change.spectrum)
            if change.HasField("luminance"):
                light.luminance = change.luminance
    for change in look.material:
        named = [material for material in scene.material if material.name == change.name]
        if not named:
            raise InputError(f'look "{look.name}" names the material "{change.name}", which is not there')
        for part in ("diffuse", "specular"):
            if change.HasField(part):
                getattr(named[0], part).CopyFrom(getattr(change, part))
    if look.HasField("observer") or look.observer_file:
        scene.settings.observer, scene.settings.observer_file = look.observer, look.observer_file
    if look.development.WhichOneof("space"):
        scene.settings.development.ClearField(scene.settings.development.WhichOneof("space") or "rgb_space")
    scene.settings.development.MergeFrom(look.development)
    if look.HasField("camera"):
        scene.camera.CopyFrom(look.camera)


def as_scene(scene: "Scene | str | os.PathLike[str]") -> Scene:
    return scene if isinstance(scene, Scene) else Scene.read(scene)


@dataclass(frozen=True)
class Asset:
    """Bytes that a server knows by their SHA-256: of the scene itself, or a file."""

    name: str
    sha256: bytes
    size: int
    data: bytes | pathlib.Path

    def pieces(self, size: int) -> Iterator[bytes]:
        """Its bytes in pieces of `size`; an empty asset has one. InputError: the file has changed meanwhile."""
        if isinstance(self.data, bytes):
            yield from (self.data[at : at + size] for at in range(0, max(self.size, 1), size))
            return
        with open(self.data, "rb") as stream:
            for at in range(0, max(self.size, 1), size):
                wanted = min(size, self.size - at)
                piece = stream.read(wanted)
                if len(piece) != wanted:
                    raise InputError(f"{self.data} changed while it was being sent")
                yield piece


@dataclass(frozen=True)
class Submission:
    """What a job, or a view, is made of: the scene without its looks, which clients apply, and its files."""

    name: str
    scene: Asset
    files: tuple[Asset, ...]
    backend: int  # scene_pb2.Backend

    def names(self) -> list[jobs_pb2.AssetName]:
        return [jobs_pb2.AssetName(name=file.name, sha256=file.sha256) for file in self.files]


def make_submission(scene: Scene) -> Submission:
    """InputError has all the files that are wrong."""
    sent = scene_pb2.Scene()
    sent.CopyFrom(scene.message)
    sent.ClearField("look")
    data = sent.SerializeToString(deterministic=True)  # the same scene always is the same asset
    asset = Asset(scene.name, hashlib.sha256(data).digest(), len(data), data)
    return Submission(scene.name, asset, tuple(_collect(sent, scene.folder)), sent.settings.backend)


def _named_files(message: Message, path: str = "") -> Iterator[tuple[str, str]]:
    """Each file that a message names, and the field that does: "object[2].mesh.file"."""
    for described, value in message.ListFields():
        at = f"{path}.{described.name}" if path else described.name
        if described.full_name in _FILE_FIELDS:
            yield value, at
        elif described.type == described.TYPE_MESSAGE:
            if described.label == described.LABEL_REPEATED:
                for i, item in enumerate(value):
                    yield from _named_files(item, f"{at}[{i}]")
            else:
                yield from _named_files(value, at)


def _collect(scene: scene_pb2.Scene, folder: pathlib.Path) -> Iterator[Asset]:
    problems: list[problem_pb2.Problem] = []
    seen: dict[str, Asset] = {}
    waiting = list(_named_files(scene))
    for name, at in waiting:
        if not name or name in seen:
            continue
        try:
            path = _find(name, folder)
            with open(path, "rb") as stream:
                digest = hashlib.file_digest(stream, "sha256").digest()
            seen[name] = Asset(name, digest, path.stat().st_size, path)
            if seen[name].size == 0:
                raise InputError("is empty")
            if name.lower().endswith(".gltf"):
                waiting += [(buffer, at) for buffer in _gltf_buffers(path, name)]
        except OSError as error:
            problems.append(problem_pb2.Problem(field=at, message=f'file "{name}" can\'t be read: {error.strerror}'))
        except InputError as error:
            problems.append(problem_pb2.Problem(field=at, message=f'file "{name}" {error}'))
    if problems:
        raise InputError("", problems)
    yield from seen.values()


def _find(name: str, folder: pathlib.Path) -> pathlib.Path:
    """The file, links followed. InputError is the end of a sentence about it."""
    if "\0" in name:
        raise InputError("has a NUL in its name")
    if os.path.isabs(name):
        raise InputError("must be relative to the scene's folder")
    base = folder.resolve()
    path = (base / name).resolve()
    if base not in path.parents:
        raise InputError("leads out of the scene's folder")
    if not path.exists():
        raise InputError("does not exist")
    if not path.is_file():
        raise InputError("is not a regular file")
    return path


def _gltf_buffers(path: pathlib.Path, name: str) -> list[str]:
    """The files that a .gltf names in turn, as the scene would."""
    try:
        buffers = json.loads(path.read_bytes()).get("buffers", [])
        uris = [buffer["uri"] for buffer in buffers]
        return [os.path.normpath(os.path.join(os.path.dirname(name), urllib.parse.unquote(uri)))
                for uri in uris if not uri.startswith("data:")]
    except (ValueError, AttributeError, KeyError, TypeError) as error:
        raise InputError("is not glTF 2.0") from error
