"""Writes the table of properties, which are read from the headers of classes.

    python3 Filters/property_table.py HEADER... --output properties.json

A property X is a method SetX(value) with its comment between ///@{ and ///@}; a line "// @name G"
begins the group G. The table has a list of properties for each class, in the order of the header,
each with

- name, group, comment;
- kind: switch, choice, integer, number, integers or numbers (vectors), text or object;
- type: the type in C++, without *; "text" for a string;
- choices: names of the values of a choice, from SetXToName(), by ascending value;
- default: the initial value of the member X; null for objects, and if there is no initial value;
- clamped: true if vtkSetClampMacro declares bounds;
- least, largest: bounds by vtkSetClampMacro, else by "Range: A to B" in the comment; null: none;
- range: text after "Range:" in the comment, without the text from ", automatic:" on;
- unit: text in the first [] of the comment;
- sentence: first sentence of the comment.

The keywords in Python, the options of the program, ParaView's panel and tests use the table.
"""

from __future__ import annotations

import argparse
import json
import re
from pathlib import Path
from typing import Any

LIMITS = {"VTK_DOUBLE_MAX": None, "VTK_INT_MAX": None, "VTK_ID_MAX": None}
NUMBER = r"-?[\d.]+(?:e[+-]?\d+)?"


def read_class(header: Path) -> tuple[str, list[dict[str, Any]]]:
    """Returns the name of a header's class, and its properties."""
    text = header.read_text(encoding="utf-8")
    name = re.search(r"^class \w+_EXPORT (\w+)", text, re.MULTILINE)
    if not name:
        raise ValueError(f"{header} declares no exported class.")
    constants = {word: int(number) for word, number in re.findall(r"\b([A-Z_]+) = (\d+),?\n", text)}
    members = dict(re.findall(r"^  [\w:<>*]+ (\w+)(?:\[\d\])? = ([^;]+);", text, re.MULTILINE))
    found, group = [], ""
    for part in re.finditer(r"// @name ?(\w*)\n|///@\{\n(.*?)///@\}", text, re.DOTALL):
        if part[2] is None:
            group = part[1]
        elif own := _read_property(part[2], constants, members):
            found.append({**own, "group": group})
    return name[1], found


def _read_property(
    block: str, constants: dict[str, int], members: dict[str, str]
) -> dict[str, Any] | None:
    """Returns the property that the code of a block sets; None if it sets none."""
    comment, code = re.match(r"\s*/\*\*(.*?)\*/(.*)", block, re.DOTALL).groups()  # type: ignore[union-attr]
    text = " ".join(comment.replace("\n   * ", " ").replace("\n   *", " ").split())
    declared = _find_setter(code)
    if declared is None:
        return None
    name, kind, sort, bounds = declared
    choices = dict(re.findall(rf"Set{name}To(\w+)\(\) {{ this->Set{name}\((\w+)\)", code))
    if choices:
        kind, words = "choice", sorted(choices, key=lambda word: constants[choices[word]])
    elif f"vtkBooleanMacro({name}" in code:
        kind = "switch"
    stated = re.search(r"Range: (.*?)\.(?= |$)(?! ?\d)", text)
    unit = re.search(r"\[([^\]]+)\]", text)
    sentence = re.match(r"(.*?[.:])(?= [A-Z]|$)", text)
    limits = [_value(word, constants) for word in bounds] or _stated_limits(text)
    return {
        "name": name,
        "kind": kind,
        "type": sort,
        "choices": words if choices else [],
        "default": None if kind == "object" else _value(members.get(name, "nullptr"), constants),
        "clamped": bool(bounds),
        "least": limits[0],
        "largest": limits[1],
        "range": stated[1].split(", automatic:")[0] if stated else "",
        "unit": unit[1] if unit else "",
        "sentence": (sentence[1] if sentence else text).rstrip(".:"),
        "comment": text,
    }


def _find_setter(code: str) -> tuple[str, str, str, list[str]] | None:
    """Returns name, kind, type and bounds of the property that a block's code sets.

    Returns None if there is no setter.
    """
    kinds = {"double": "number", "int": "integer", "vtkIdType": "integer"}
    if macro := re.search(r"vtkSet(Clamp|String|Vector(\d))?Macro\(([^)]*)\)", code):
        name, *more = (word.strip() for word in macro[3].split(","))
        if macro[1] == "String":
            return name, "text", "text", []
        kind = kinds.get(more[0], "switch")
        return name, kind + "s" * bool(macro[2]), more[0], more[1:]
    setter = re.search(r"^  (?:virtual )?void Set(\w+)\(([^)]*?) ?\w+\)", code, re.MULTILINE)
    if not setter:
        return None
    if setter[2] == "const char*":
        return setter[1], "text", "text", []
    return setter[1], "object", setter[2].rstrip("*"), []


def _stated_limits(text: str) -> list[Any]:
    limits = re.search(rf"Range: ({NUMBER}) to ({NUMBER})(?=[.;])", text)
    return [_plain(limits[1]), _plain(limits[2])] if limits else [None, None]


def _plain(word: str) -> int | float:
    return float(word) if re.search("[.e]", word) else int(word)


def _value(word: str, constants: dict[str, int]) -> Any:
    """Returns the value of C++ text: of an initial value or a bound; None for no bound."""
    words = {**constants, **LIMITS, "true": 1, "false": 0, "nullptr": None}
    if word.startswith("{"):
        return [_plain(number) for number in re.findall(NUMBER, word)]
    return words[word] if word in words else _plain(word)


def table(headers: list[Path]) -> dict[str, list[dict[str, Any]]]:
    """Returns the properties of the headers' classes, by class."""
    return dict(map(read_class, headers))


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes the table of properties.")
    parser.add_argument("headers", nargs="+", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    text = json.dumps(table(options.headers), indent=1) + "\n"
    options.output.parent.mkdir(parents=True, exist_ok=True)
    if not options.output.exists() or options.output.read_text(encoding="utf-8") != text:
        options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
