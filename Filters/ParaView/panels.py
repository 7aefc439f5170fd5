"""Writes ParaView's XML from templates and the table of properties of ../property_table.py.

    python3 panels.py properties.json TEMPLATE.xml... --output FOLDER

Elements of a template:

- <Own name="X" />: property X of the proxy's class: command, type, default, choices, range and
  documentation follow from the table. The class is the proxy's attribute `of`, else its `class`.
  An Own may stand in a PropertyGroup. Attributes of an Own:
  - advanced="1": the gear shows the property;
  - if="Y=1", if="Y!=0": the panel shows the property if property Y has, or has not, this value;
  - if_input="T", unless_input="T": the panel shows, or hides, the property for inputs of type T;
  - choices="A,B": labels of the choices, in place of their names;
  - required="1": the user has to choose a function, so None is no choice.
  Other attributes and child elements are copied, and replace those that the table gives.
- <InUse name="X" />: property XInUse, advanced and read-only; the documentation of X names it.
- <Array name="X" number="N" />: point array that SetInputArrayToProcess(N, ...) chooses.
  Attributes: domain; input (default: "Input"); kind, "Scalars" (default) or "Vectors".
"""

from __future__ import annotations

import argparse
import json
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

FUNCTIONS = "Sphere Box Plane Cylinder Superquadric SkeletonPotential GridPotential".split()
KINDS = {"double": "Double", "vtkIdType": "IdType", "text": "String"}
Row = dict[str, Any]


def label_of(name: str) -> str:
    """Returns ParaView's label for a name: the name's words, separated by spaces."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name)


def number(value: Any) -> str:
    """Returns a number as text for XML; a whole float is without .0."""
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)


class Panels:
    """Replaces the elements Own, InUse and Array of one template."""

    def __init__(self, table: dict[str, list[Row]], root: Element) -> None:
        self.table, self.root = table, root
        self.classes = {proxy.get("name"): proxy.get("class") for proxy in root.iter()}
        self.in_use = {element.get("name") for element in root.iter("InUse")}

    def write(self, file: Path) -> None:
        """Replaces all Own, InUse and Array elements; writes the file if its text changes."""
        for group in self.root.iter("ProxyGroup"):
            for proxy in group:
                self._expand(proxy)
        ElementTree.indent(self.root)
        text = ElementTree.tostring(self.root, encoding="unicode") + "\n"
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")

    def _expand(self, proxy: Element) -> None:
        rows = self._rows_of(proxy)
        made: list[Element] = []
        for child in list(proxy):
            if child.tag == "PropertyGroup":
                for i, member in enumerate(list(child)):
                    if member.tag != "Property":
                        made.append(self._make(member, rows))
                        child[i] = Element("Property", name=made[-1].attrib["name"])
            made.append(self._make(child, rows))
        proxy[:] = made

    def _rows_of(self, proxy: Element) -> dict[str, Row]:
        kind = proxy.get("of") or proxy.get("class") or ""
        proxy.attrib.pop("of", None)
        return {row["name"]: row for row in self.table.get(kind, [])}

    def _make(self, element: Element, rows: dict[str, Row]) -> Element:
        if element.tag == "Own":
            return self._make_own(element, rows)
        if element.tag == "InUse":
            return self._make_in_use(rows[element.attrib["name"]])
        return _make_array(element) if element.tag == "Array" else element

    def _make_own(self, element: Element, rows: dict[str, Row]) -> Element:
        given = dict(element.attrib)
        row = rows[given["name"]]
        if row["kind"] == "object":
            made = _make_function(row, "required" not in given)
        else:
            made = _make_plain(row, element, given.pop("choices", ""))
        hints = _make_hints(given, element.find("Hints"))
        if given.pop("advanced", None):
            given["panel_visibility"] = "advanced"
        given.pop("required", None)
        made.attrib.update(given)
        made.extend(child for child in element if child.tag != "Hints")
        if element.find("Documentation") is None:
            SubElement(made, "Documentation").text = self._text_of(row, rows)
        if len(hints):
            made.append(hints)
        return made

    def _text_of(self, row: Row, rows: dict[str, Row]) -> str:
        """Returns a property's comment, in which names of properties are ParaView's labels.

        If the template has an InUse of the property, a sentence names it.
        """
        names = "|".join(sorted(rows, key=len, reverse=True))
        text = re.sub(rf"\b({names})\b", lambda found: label_of(found[1]), row["comment"])
        used = f" {label_of(row['name'])} In Use shows the value." * (row["name"] in self.in_use)
        return text + used

    @staticmethod
    def _make_in_use(row: Row) -> Element:
        name = row["name"] + "InUse"
        made = Element(
            "DoubleVectorProperty",
            name=name,
            command="Get" + name,
            information_only="1",
            number_of_elements="1",
            default_values="0",
            panel_visibility="advanced",
        )
        SubElement(made, "SimpleDoubleInformationHelper")
        SubElement(made, "Documentation").text = (
            f"{label_of(row['name'])} [{row['unit']}] used by the last update: set or automatic. "
            "0: none, or no skin yet."
        )
        return made


def _make_plain(row: Row, element: Element, choices: str) -> Element:
    values = row["default"] if isinstance(row["default"], list) else [row["default"]]
    made = Element(
        KINDS.get(row["type"], "Int") + "VectorProperty",
        name=row["name"],
        command="Set" + row["name"],
        number_of_elements=str(len(values)),
        default_values="" if row["kind"] == "text" else " ".join(map(number, values)),
    )
    words = choices.split(",") if choices else map(label_of, row["choices"])
    if any(child.tag.endswith("Domain") for child in element):
        return made
    if row["kind"] == "switch":
        SubElement(made, "BooleanDomain", name="bool")
    elif row["kind"] == "choice":
        domain = SubElement(made, "EnumerationDomain", name="enum")
        for value, word in enumerate(words):
            SubElement(domain, "Entry", text=word, value=str(value))
    elif row["least"] is not None and row["type"] in ("int", "double"):
        domain = SubElement(made, made.tag[: -len("VectorProperty")] + "RangeDomain", name="range")
        limits = {"min": row["least"], "max": row["largest"]}
        domain.attrib.update({k: number(v) for k, v in limits.items() if v is not None})
    return made


def _make_function(row: Row, may_be_none: bool) -> Element:
    made = Element("ProxyProperty", name=row["name"], command="Set" + row["name"])
    made.set("label", label_of(row["name"]))
    groups = SubElement(made, "ProxyGroupDomain", name="groups")
    SubElement(groups, "Group", name="implicit_functions")
    proxies = SubElement(made, "ProxyListDomain", name="proxy_list")
    for name in ["None"] * may_be_none + FUNCTIONS:
        SubElement(proxies, "Proxy", group="implicit_functions", name=name)
    return made


def _make_hints(given: dict[str, str], more: Element | None) -> Element:
    """Returns the Hints of `more`, with a hint for the attribute if, if_input or unless_input.

    These attributes are removed from `given`.
    """
    hints = Element("Hints")
    hints.extend(more if more is not None else [])
    found: dict[str, str] = {}
    if condition := given.pop("if", ""):
        name, value = condition.replace("!=", "=").split("=")
        found = {"type": "GenericDecorator", "property": name, "value": value}
        found |= {"inverse": "1"} if "!=" in condition else {}
    for key, more_words in (("if_input", {}), ("unless_input", {"exclude": "1"})):
        if kind := given.pop(key, ""):
            found = {"type": "InputDataTypeDecorator", "name": kind, **more_words}
    if found:
        SubElement(hints, "PropertyWidgetDecorator", {"mode": "visibility", **found})
    return hints


def _make_array(element: Element) -> Element:
    given = dict(element.attrib)
    made = Element("StringVectorProperty", name=given["name"], label=label_of(given.pop("name")))
    made.attrib |= {
        "command": "SetInputArrayToProcess",
        "number_of_elements": "5",
        "element_types": "0 0 0 0 2",
        "default_values_delimiter": ";",
        "default_values": f"{given.pop('number')};0;0;0;",
    }
    domain = SubElement(made, "ArrayListDomain", name="array_list")
    domain.set("attribute_type", given.pop("kind", "Scalars"))
    domain.attrib |= {"input_domain_name": given.pop("domain"), "none_string": ""}
    needed = SubElement(domain, "RequiredProperties")
    SubElement(needed, "Property", name=given.pop("input", "Input"), function="Input")
    hints = _make_hints(given, None)
    hints.insert(0, Element("NoDefault"))
    if given.pop("advanced", None):
        given["panel_visibility"] = "advanced"
    made.attrib |= given
    SubElement(made, "Documentation").text = element.text
    made.append(hints)
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes ParaView's XML.")
    parser.add_argument("table", type=Path)
    parser.add_argument("templates", nargs="+", type=Path)
    parser.add_argument("--output", type=Path, required=True)
    options = parser.parse_args()
    table = json.loads(options.table.read_text(encoding="utf-8"))
    options.output.mkdir(parents=True, exist_ok=True)
    for template in options.templates:
        Panels(table, ElementTree.parse(template).getroot()).write(options.output / template.name)


if __name__ == "__main__":
    main()
