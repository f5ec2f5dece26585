"""Scenes that differ in a few fields, all combinations of their values.

A field is named by its path, as problems have it: "settings.spp", "light[0].luminance"; an element of a list also by its
name: "light[key].spectrum". A value is a number, a word of an enumeration, a string, a message, or a message's text:

    server.sweep(scene, {"settings.method": ["exact {}", "point { fitted: 8 }"], "settings.spp": [1, 4]})
"""
import itertools
import re
from collections.abc import Iterator, Mapping, Sequence

from google.protobuf import text_format
from google.protobuf.message import Message

from metamer.errors import InputError
from metamer.scene import Scene

Value = bool | int | float | str | Message
_STEP = re.compile(r"([a-z0-9_]+)(?:\[([^\]]+)\])?\Z")


def variants(scene: Scene, parameters: Mapping[str, Sequence[Value]]) -> Iterator[tuple[dict[str, Value], Scene]]:
    """Each combination, the last parameter fastest, and a scene that has it. InputError: see set_field."""
    for values in itertools.product(*parameters.values()):
        chosen, made = dict(zip(parameters, values)), scene.copy()
        for path, value in chosen.items():
            set_field(made.message, path, value)
        yield chosen, made


def shortened(text: str, most: int = 256) -> str:
    """At most so many bytes of UTF-8, as a Series takes them."""
    return text.encode()[:most].decode(errors="ignore")


def set_field(message: Message, path: str, value: Value) -> None:
    """InputError: there is no such field or element, or it can't have the value."""
    *way, last = path.split(".")
    try:
        for step in way:
            message = _get(message, step)
        _set(message, last, value)
    except (KeyError, IndexError, AttributeError, TypeError, ValueError, text_format.ParseError) as error:
        raise InputError(f"{path} can't become {value}: {error}") from error


def _get(message: Message, step: str) -> Message:
    name, element = _STEP.match(step).groups()
    if element is None:
        return getattr(message, name)
    elements = getattr(message, name)
    if element.isdigit():
        return elements[int(element)]
    for found in elements:
        if found.name == element:
            return found
    raise KeyError(f'there is no {name} "{element}"')


def _set(message: Message, step: str, value: Value) -> None:
    name, element = _STEP.match(step).groups()
    field = message.DESCRIPTOR.fields_by_name[name]
    if element is None and field.message_type is None:
        is_word = field.enum_type is not None and isinstance(value, str)
        setattr(message, name, field.enum_type.values_by_name[value].number if is_word else value)
        return
    target = _get(message, step)
    target.Clear()
    if isinstance(value, str):
        text_format.Parse(value, target)
    else:
        target.CopyFrom(value)
    target.SetInParent()
