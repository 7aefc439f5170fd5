"""Properties of the filter as keywords and options, read from properties.json.

>>> from active_implicit_surfaces import properties
>>> spacing = properties.find("particle_spacing")
>>> spacing.name, spacing.option, spacing.kind, spacing.default
('ParticleSpacing', '--particle-spacing', 'number', -1.0)
>>> properties.find("particle_model").choices
('sum', 'anisotropic')
"""

from __future__ import annotations

import difflib
import functools
import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

AUTOMATIC = -1.0  # the filter chooses the value; only for properties with this default
TABLE = Path(__file__).with_name("properties.json")


@dataclass(frozen=True)
class Property:
    """Property X of the filter, with SetX and GetX."""

    name: str
    kind: str  # "switch", "choice", "integer", "number", "numbers" or "object"
    group: str
    default: Any
    choices: tuple[str, ...]
    range: str  # "" if there is none
    unit: str
    sentence: str  # first sentence of the comment
    comment: str

    @property
    def keyword(self) -> str:
        """Returns the name in snake case."""
        return "_".join(_words(self.name))

    @property
    def option(self) -> str:
        """Returns the name as an option of the command line."""
        return "--" + "-".join(_words(self.name))

    @property
    def is_automatic(self) -> bool:
        """Returns True for a number whose default is -1, which means automatic."""
        return bool(self.kind == "number" and self.default == AUTOMATIC)

    @property
    def summary(self) -> str:
        """Returns the first sentence of the comment and, except for objects, the default."""
        if self.kind == "object":
            return self.sentence
        value = self.choices[self.default] if self.kind == "choice" else self.default
        return f"{self.sentence} (default: {_plain(self.kind, value)})"


def every() -> tuple[Property, ...]:
    """Returns all properties, ordered by group."""
    return tuple(_table().values())


def find(keyword: str) -> Property:
    """Returns the property of a keyword.

    Raises
    ------
    TypeError
        There is no such property; the text names a similar one, if any.
    """
    found = _table().get(keyword)
    if found is None:
        near = difflib.get_close_matches(keyword, _table(), 1, 0.5)
        hint = f"; did you mean {near[0]!r}?" if near else "."
        raise TypeError(f"vtkActiveImplicitSurface has no property {keyword!r}{hint}")
    return found


def given(options: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the options, but no automatic properties whose value is "automatic" or -1.

    Raises TypeError for an unknown keyword.
    """
    return {
        keyword: value
        for keyword, value in options.items()
        if not (find(keyword).is_automatic and _number_of(value) == AUTOMATIC)
    }


def put(surface: Any, values: Mapping[str, Any]) -> None:
    """Sets properties of a filter by their keywords.

    A choice is a word such as ``"anisotropic"``, or a number. For a number whose default is -1,
    ``"automatic"`` means -1.

    Raises
    ------
    TypeError
        There is no such property, or a value has a wrong type.
    ValueError
        A number is outside the range of its property, or a word or number is not among the choices.
    """
    for one in values:
        find(one)
    for keyword, value in values.items():
        _put_one(surface, find(keyword), value)


def values(surface: Any) -> dict[str, Any]:
    """Returns the values of all properties of a filter by their keywords, without objects."""
    return {
        own.keyword: getattr(surface, "Get" + own.name)() for own in every() if own.kind != "object"
    }


def _put_one(surface: Any, own: Property, value: Any) -> None:
    if own.kind == "choice" and isinstance(value, str):
        value = _number_of_choice(own, value)
    setter, kind = getattr(surface, "Set" + own.name), own.kind
    try:
        if kind == "numbers":
            wanted: Any = tuple(float(number) for number in value)
        elif kind == "number":
            wanted = float(_number_of(value) if own.is_automatic else value)
        elif kind in ("integer", "choice", "switch"):
            wanted = int(value)
            if wanted != value:
                raise TypeError(f"{value!r} is not a whole number")
        else:
            wanted = value
        setter(wanted)
    except OverflowError as error:
        limits = f"its range: {own.range}" if own.range else "its range"
        raise ValueError(f"{own.keyword} = {value!r} is out of {limits}.") from error
    except (TypeError, ValueError) as error:
        raise TypeError(f"{own.keyword} cannot be {value!r}: {error}.") from error
    got = getattr(surface, "Get" + own.name)()
    if kind == "choice" and got != wanted:
        words = ", ".join(f"{word!r} ({number})" for number, word in enumerate(own.choices))
        raise ValueError(f"{own.keyword} has to be one of {words}, not {value!r}.")
    if kind != "object" and got != wanted and wanted == wanted:
        limits = f"its range: {own.range}" if own.range else f"its range; the filter uses {got}"
        raise ValueError(f"{own.keyword} = {value!r} is out of {limits}.")


def _number_of(value: Any) -> Any:
    return AUTOMATIC if isinstance(value, str) and value == "automatic" else value


def _number_of_choice(own: Property, word: str) -> int:
    plain = word.lower().replace("-", "_")
    if plain not in own.choices:
        raise ValueError(f"{own.keyword} has to be one of {', '.join(own.choices)}, not {word!r}.")
    return own.choices.index(plain)


@functools.cache
def _table() -> dict[str, Property]:
    every_class = json.loads(TABLE.read_text(encoding="utf-8"))
    return {own.keyword: own for own in map(_read, every_class["vtkActiveImplicitSurface"])}


def _read(row: Mapping[str, Any]) -> Property:
    several = row["kind"] == "numbers"
    choices = tuple("_".join(_words(word)) for word in row["choices"])
    return Property(
        choices=choices,
        default=tuple(row["default"]) if several else row["default"],
        **{key: row[key] for key in "name kind group range unit sentence comment".split()},
    )


def _words(name: str) -> list[str]:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name).lower().split()


def _plain(kind: str, value: Any) -> str:
    if kind == "switch":
        return "on" if value else "off"
    if kind == "choice":
        return str(value).replace("_", "-")
    if kind == "numbers":
        return " ".join(f"{number:g}" for number in value)
    if kind == "number":
        return "automatic" if value == AUTOMATIC else f"{value:g}"
    return str(value)
