"""The table of properties (Filters/property_table.py), and values that follow from it by rules.

A row has name, group, kind, type, choices, default, clamped, least, largest, range, unit, comment.
"""

import json
import math
from pathlib import Path
from types import SimpleNamespace

import active_implicit_surfaces
from active_implicit_surfaces import properties as keywords
from active_implicit_surfaces.commands import effects

AUTOMATIC = keywords.AUTOMATIC
TABLE = json.loads(
    Path(active_implicit_surfaces.__file__).with_name("properties.json").read_text(encoding="utf-8")
)
CLASSES = [getattr(active_implicit_surfaces, name) for name in TABLE]


def rows_of(kind):
    return {row["name"]: SimpleNamespace(**row) for row in TABLE[kind.__name__]}


def own_properties(kind):
    """Names X of the methods SetX(value) of a class, without those of VTK."""
    return sorted(rows_of(kind))


def comment_of(kind, name):
    return rows_of(kind)[name].comment


def restarts(row):
    return "restart the motion" not in row.comment


def other_values(row):
    """Valid values other than the default; none for boxes, texts and objects."""
    if row.kind == "switch":
        return [1 - row.default]
    if row.kind == "choice":
        return [value for value in range(len(row.choices)) if value != row.default]
    if row.kind not in ("integer", "number"):
        return []
    if row.default in (0, AUTOMATIC):
        return [1 if row.kind == "integer" else 0.05]
    doubled = 2 * row.default
    return [doubled if row.largest is None or doubled <= row.largest else row.default / 2]


def needed_values(row):
    """Values of other properties, by name, without which this property has no effect."""
    own, found = next(own for own in keywords.every() if own.name == row.name), {}
    for facts in effects.rows_of(own):
        keyword, _, word = facts.split()[0].partition("=")
        if word:
            other = keywords.find(keyword)
            found[other.name] = (other.choices or ("off", "on")).index(word)
    return found


def clamped_values(row):
    """(value, bound that it becomes) of a number that its macro clamps."""
    bounds = ((row.least, -1), (row.largest, 1)) if row.clamped else ()
    return [(bound + beyond, bound) for bound, beyond in bounds if bound is not None]


def refused_values(row):
    """Values with which an update fails."""
    if row.kind == "numbers":
        return [(0, 1, 0, math.inf, 0, 1), (math.nan, 1, 1, -1, 1, -1)]
    if row.kind != "number":
        return []
    found = [math.nan] if row.clamped else [math.nan, math.inf, -math.inf]
    if row.default == AUTOMATIC:
        found += [AUTOMATIC / 2, *([0.0] if row.range.startswith("1e") else [])]
    if row.range.startswith("> 0"):
        found += [0.0, -0.5]
    elif not row.clamped and row.least is not None:
        found += [row.least / 2, row.largest * 2]
    return found


def get(thing, name):
    return getattr(thing, "Get" + name)()


def put(thing, name, value):
    getattr(thing, "Set" + name)(value)
