"""Properties of the filter as keywords and options, found by inspection of the class.

>>> from active_implicit_surfaces import properties
>>> spacing = properties.find("particle_spacing")
>>> spacing.name, spacing.option, spacing.kind, spacing.default
('ParticleSpacing', '--particle-spacing', 'number', 0.0)
>>> properties.find("particle_model").choices
('sum', 'anisotropic')
"""

from __future__ import annotations

import difflib
import functools
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from . import vtkActiveImplicitSurface

PACKAGE = __package__


@dataclass(frozen=True)
class Property:
    """Property X of the filter, with SetX and GetX."""

    name: str
    kind: str  # "switch", "choice", "integer", "number", "numbers" or "function"
    default: Any
    choices: tuple[str, ...]
    comment: str
    owner: str  # class that declares it

    @property
    def keyword(self) -> str:
        """Returns the name in snake case."""
        return "_".join(_words(self.name))

    @property
    def option(self) -> str:
        """Returns the name as an option of the command line."""
        return "--" + "-".join(_words(self.name))

    @property
    def range(self) -> str:
        """Returns the range from the comment; "" if the comment has none."""
        found = re.search(r"Range: (.*?)\.(?= |$)(?! ?\d)", self.comment)
        return found[1] if found else ""

    @property
    def summary(self) -> str:
        """Returns the first sentence of the comment, with the default."""
        first = re.match(r"(.*?[.:])(?= [A-Z]|$)", self.comment)
        text = first[1].rstrip(".:") if first else self.comment
        value = self.choices[self.default] if self.kind == "choice" else self.default
        return text if self.kind == "function" else f"{text} (default: {_plain(self.kind, value)})"


def every() -> tuple[Property, ...]:
    """Returns all properties, sorted by name."""
    return tuple(_table().values())


def find(keyword: str) -> Property:
    """Returns the property of a keyword.

    Raises
    ------
    TypeError
        There is no such property; the text names the closest one.
    """
    found = _table().get(keyword)
    if found is None:
        near = difflib.get_close_matches(keyword, _table(), 1, 0.5)
        hint = f"; did you mean {near[0]!r}?" if near else "."
        raise TypeError(f"vtkActiveImplicitSurface has no property {keyword!r}{hint}")
    return found


def put(surface: Any, values: Mapping[str, Any]) -> None:
    """Sets properties of a filter by their keywords.

    Choices are words such as ``"anisotropic"``, or numbers.

    Raises
    ------
    TypeError
        There is no such property, or a value has a wrong type.
    ValueError
        A value is out of the property's range, or a word is unknown.
    """
    for one in values:
        find(one)
    for keyword, value in values.items():
        _put_one(surface, find(keyword), value)


def _put_one(surface: Any, own: Property, value: Any) -> None:
    if own.kind == "choice" and isinstance(value, str):
        value = _number_of_choice(own, value)
    setter, kind = getattr(surface, "Set" + own.name), own.kind
    try:
        if kind == "numbers":
            wanted: Any = tuple(float(number) for number in value)
        elif kind == "number":
            wanted = float(value)
        elif kind in ("integer", "choice", "switch"):
            wanted = int(value)
            if wanted != value:
                raise TypeError(f"{value!r} is not a whole number")
        else:
            wanted = value
        setter(wanted)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{own.keyword} cannot be {value!r}: {error}.") from error
    got = getattr(surface, "Get" + own.name)()
    if kind == "choice" and got != wanted:
        words = ", ".join(f"{word!r} ({number})" for number, word in enumerate(own.choices))
        raise ValueError(f"{own.keyword} is one of {words}, not {value!r}.")
    if kind != "function" and got != wanted and wanted == wanted:
        limits = f"its range: {own.range}" if own.range else f"its range; it became {got}"
        raise ValueError(f"{own.keyword} = {value!r} is out of {limits}.")


def _number_of_choice(own: Property, word: str) -> int:
    plain = word.lower().replace("-", "_")
    if plain not in own.choices:
        raise ValueError(f"{own.keyword} is one of {', '.join(own.choices)}, not {word!r}.")
    return own.choices.index(plain)


@functools.cache
def _table() -> dict[str, Property]:
    surface, found = vtkActiveImplicitSurface(), {}
    for name in _names(type(surface)):
        own = _describe(surface, name)
        found[own.keyword] = own
    return found


def _names(kind: type) -> list[str]:
    ours = [base for base in kind.__mro__ if base.__module__.startswith(PACKAGE)]
    setters = {name for base in ours for name in vars(base) if name.startswith("Set")}
    taking = (name for name in setters if not re.match(r"\w+\(self\)", _text(kind, name)))
    return sorted(name[3:] for name in taking)


def _text(kind: type, name: str) -> str:
    return getattr(kind, name).__doc__ or ""


def _describe(surface: Any, name: str) -> Property:
    kind = type(surface)
    signatures, _, rest = _text(kind, "Set" + name).rpartition("\nC++: ")
    comment = " ".join((rest.partition("\n\n")[2] if signatures else rest).split())
    default, choices = getattr(surface, "Get" + name)(), _choices(surface, name)
    if choices:
        sort = "choice"
    elif hasattr(kind, name + "On"):
        sort = "switch"
    elif isinstance(default, tuple):
        sort = "numbers"
    elif isinstance(default, float):
        sort = "number"
    elif isinstance(default, int):
        sort = "integer"
    else:
        sort = "function"
    owner = next(base.__name__ for base in kind.__mro__ if "Set" + name in vars(base))
    return Property(name, sort, default, choices, comment, owner)


def _choices(surface: Any, name: str) -> tuple[str, ...]:
    """Returns the words of SetXToWord(), in the order of their values."""
    before = getattr(surface, "Get" + name)()
    start, numbered = f"Set{name}To", {}
    for method in dir(type(surface)):
        if method.startswith(start):
            getattr(surface, method)()
            word = "_".join(_words(method[len(start) :]))
            numbered[getattr(surface, "Get" + name)()] = word
    if numbered:
        getattr(surface, "Set" + name)(before)
    return tuple(word for _, word in sorted(numbered.items()))


def _words(name: str) -> list[str]:
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name).lower().split()


def _plain(kind: str, value: Any) -> str:
    if kind == "switch":
        return "on" if value else "off"
    if kind == "choice":
        return str(value).replace("_", "-")
    if kind == "numbers":
        return " ".join(f"{number:g}" for number in value)
    return f"{value:g}" if kind == "number" else str(value)
