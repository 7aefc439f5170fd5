"""Options that commands share: properties of the filter, selections, pictures; parsers of texts."""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from .. import properties, vtkActiveImplicitSurface
from ..choice import conditions
from ..presets import PRESETS

WIDTH = 100
PICTURE_SIZE = (1280, 720)
# Properties that --help lists, because most users want to set them.
MAIN_PROPERTIES = {
    "particle_spacing": "distance between neighbouring particles (default: estimated)",
    "voxel_size": "resolution [length] (default: automatic)",
    "tension": "weight of smoothing by curvature [length^2/time] (default: automatic)",
    "attraction": "rate of approach to the target [1/time] (default: automatic)",
}


class Parser(argparse.ArgumentParser):
    """Parser whose help is at most 100 columns wide, and whose errors are one sentence."""

    def __init__(self, name: str, usage: str, description: str, epilog: str = "") -> None:
        super().__init__(
            prog=name,
            usage=f"{name} {usage}",
            description=description,
            epilog=epilog,
            formatter_class=lambda prog: argparse.RawDescriptionHelpFormatter(
                prog, max_help_position=30, width=WIDTH
            ),
            allow_abbrev=False,
            add_help=False,  # add_help() adds it in the right place
        )

    def error(self, message: str) -> NoReturn:
        text = message.rstrip(".")
        if text.endswith("expected one argument"):
            text += "; write OPTION=VALUE if the value begins with -"
        print(f"{self.prog}: {text}; run '{self.prog} --help' for help.", file=sys.stderr)
        raise SystemExit(2)

    def parse_args(self, args: Any = None, namespace: Any = None) -> Any:
        known, rest = self.parse_known_args(args, namespace)
        if rest:
            self.error(_about_unknown(rest[0], self))
        return known


def _about_unknown(word: str, parser: argparse.ArgumentParser) -> str:
    import difflib

    names = [name for action in parser._actions for name in action.option_strings]
    if not word.startswith("-"):
        has_series = any(action.nargs == "+" for action in parser._actions)
        hint = ", or, if it is a file, put it next to the other files" if has_series else ""
        return f"{word} is one argument too many; leave it out{hint}"
    name = word.partition("=")[0]
    # Short options resemble each other too much: -r is no typing error for -o.
    near = difflib.get_close_matches(name, names, 1, 0.5) if name.startswith("--") else []
    hint = f", did you mean {near[0]}?" if near else ""
    return f"there is no option {word}{hint}".rstrip("?")


class _HelpProperties(argparse.Action):
    def __call__(self, parser: Any, namespace: Any, values: Any, option: Any = None) -> None:
        print(properties_help())
        parser.exit()


def add_property_options(parser: Parser, shown: Sequence[str] = ()) -> None:
    """Adds an option for each property that is no object; --help lists only those in `shown`."""
    every = {own.keyword: own for own in properties.every() if own.kind != "object"}
    for keyword in dict.fromkeys([*shown, *every]):
        own = every[keyword]
        settings: dict[str, Any] = {"dest": "property_" + keyword, "help": argparse.SUPPRESS}
        if keyword in shown:
            settings |= {"help": MAIN_PROPERTIES[keyword], "metavar": "X"}
        if own.kind == "switch":
            settings["action"] = argparse.BooleanOptionalAction
        elif own.kind == "choice":
            settings["choices"] = [word.replace("_", "-") for word in own.choices]
        elif own.kind == "numbers":
            settings |= {"type": float, "nargs": len(own.default)}
        else:
            settings["type"] = int if own.kind == "integer" else _number(own)
        parser.add_argument(own.option, default=None, **settings)


def _number(own: properties.Property) -> Callable[[str], float]:
    def parse(text: str) -> float:
        return properties.AUTOMATIC if own.is_automatic and text == "automatic" else float(text)

    parse.__name__ = "number"  # in argparse's messages
    return parse


def add_help(group: Any, properties: bool = False) -> None:
    """Adds --help, and --help-properties if `properties` is true."""
    group.add_argument("-h", "--help", action="help", help="print this help")
    if properties:
        group.add_argument(
            "--help-properties", nargs=0, action=_HelpProperties, help=argparse.SUPPRESS
        )


def properties_of(options: argparse.Namespace, parser: Parser) -> dict[str, Any]:
    """Returns the given properties; ends the program if `properties.put` rejects a value."""
    start = "property_"
    given = {
        name[len(start) :]: value
        for name, value in vars(options).items()
        if name.startswith(start) and value is not None
    }
    try:
        properties.put(vtkActiveImplicitSurface(), given)
    except (TypeError, ValueError) as error:
        parser.error(str(error))
    return given


def properties_help() -> str:
    """Returns the help of all properties that are options, under their groups."""
    lines, group = ["properties of the filter (details: help(vtkActiveImplicitSurface))"], ""
    for own in properties.every():
        if own.kind == "object":
            continue
        if own.group != group:
            group = own.group
            lines += ["", group]
        lines.append(f"  {_form(own)}")
        text = own.summary + (f"; range: {own.range}" if own.range else "")
        lines += textwrap.wrap(text, WIDTH - 8, initial_indent=8 * " ", subsequent_indent=8 * " ")
    return "\n".join(lines)


def _form(own: properties.Property) -> str:
    if own.kind == "switch":
        return f"{own.option}, --no-{own.option[2:]}"
    if own.kind == "choice":
        return f"{own.option} {{{','.join(word.replace('_', '-') for word in own.choices)}}}"
    if own.kind == "numbers":
        return f"{own.option} {' '.join(['X'] * len(own.default))}"
    return f"{own.option} {'N' if own.kind == 'integer' else 'X'}"


def wrapped(text: str) -> str:
    """Wraps a text to the width of the help."""
    return "\n".join(textwrap.wrap(text, WIDTH - 1))


def preset_help() -> str:
    """Returns a text with a line for each preset and its purpose."""
    return "\n".join(f"  {name:<10}{text}" for name, text in PRESETS.items())


def add_choice_options(group: Any, searched: str = "the first frame") -> None:
    """Adds --where and --label; `searched` says in the help where --label all finds labels."""
    group.add_argument(
        "--where",
        action="append",
        type=condition,
        metavar="COND",
        help="select data that meet each COND: Type=1, element=Na,Cl, id!=3, 'T>300'",
    )
    for option, told in (
        ("--label", f"select labels, or all of {searched}; one output each"),
        ("--labels", None),
    ):
        text = told or argparse.SUPPRESS
        group.add_argument(option, dest="labels", type=label_list, metavar="N,N...", help=text)


def add_picture_options(parser: Parser, up: str) -> None:
    """Adds the options of pictures; the help states `up` as the default of --up."""
    pictures = parser.add_argument_group("pictures")
    pictures.add_argument(
        "--size",
        type=picture_size,
        metavar="WxH",
        help="size of pictures in pixels (default: {}x{})".format(*PICTURE_SIZE),
    )
    pictures.add_argument("--no-ground", action="store_true", help="draw no ground below the skin")
    add_up_option(pictures, up, "of pictures, .glb, USD")


def add_up_option(group: Any, default: str, where: str) -> None:
    """Adds --up."""
    group.add_argument(
        "--up",
        choices=("x", "y", "z", "-x", "-y", "-z"),
        metavar="[-]x|y|z",
        help=f"up axis {where}; negative: --up=-y (default: {default})",
    )


def picture_size(text: str) -> tuple[int, int]:
    """Parses a size [pixels] such as 640x360."""
    parts = text.lower().split("x")
    if len(parts) != 2 or not all(part.isdigit() and 16 <= int(part) <= 16384 for part in parts):
        raise argparse.ArgumentTypeError(
            f"{text} is no size from 16x16 to 16384x16384 pixels; write WIDTHxHEIGHT, such as "
            "1280x720"
        )
    return int(parts[0]), int(parts[1])


def times_list(text: str) -> list[float]:
    """Parses 0,0.1,0.2 or FIRST:LAST:COUNT."""
    try:
        if text.count(":") == 2:
            first, last, count = text.split(":")
            start, way, steps = float(first), float(last) - float(first), range(int(count))
            if not steps:
                raise ValueError
            return [start + way * i / max(1, len(steps) - 1) for i in steps]
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text} are no times; write 0,0.1,0.2 or FIRST:LAST:COUNT"
        ) from None


def condition(text: str) -> str:
    """Returns the text of a condition after a check of its form."""
    try:
        conditions(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r} is no condition; write NAME=1, NAME=Na,Cl, NAME!=1, NAME<1 or NAME>=1, and "
            "give each condition its own --where"
        ) from None
    return text


def label_list(text: str) -> list[int] | str:
    """Parses labels: 3, or 3,5, or all."""
    try:
        return "all" if text == "all" else [int(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is no label; write 3, or 3,5, or all") from None


def frame_range(text: str) -> tuple[int | None, int | None, int]:
    """Parses FIRST:LAST or FIRST:LAST:STEP; FIRST and LAST may be omitted."""
    first, last, step = [*text.split(":"), "", ""][:3]
    try:
        found = int(first) if first else None, int(last) if last else None, int(step or 1)
    except ValueError:
        found = None, None, 0
    if found[2] < 1 or text.count(":") not in (1, 2):
        raise argparse.ArgumentTypeError(
            f"{text} are no frames; write FIRST:LAST or FIRST:LAST:STEP with a STEP of 1 or more"
        )
    return found


def whole(text: str) -> int:
    """Parses a whole number of 0 or more."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text} is no whole number of 0 or more")
    return int(text)


def positive(text: str) -> float:
    """Parses a finite number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text} is not a finite number above 0")
    return value
