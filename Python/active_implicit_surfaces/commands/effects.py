"""Rejects options that have no effect in a run; on one frame, warns of options for a series.

A run has facts: words such as "render", and the value of each choice and switch of the filter, such
as "particle_model=sum". An option has rows of facts, from _ACTING and from the group and the
comment of the option's property. The option acts if the run has at least one fact of each row.
"""

from __future__ import annotations

import re
import warnings
from argparse import Namespace
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from .. import properties, vtkActiveImplicitSurface
from ..file_names import suffix_of
from ..messages import ActiveSurfaceWarning
from .options import Parser, properties_of

_START = "property_"  # prefix of the properties' names among the options
_MOTION = "series evolution_mode=equilibrium volume_control=exact area_control=exact"
_ACTING = (  # rows, and their options and (after a colon) properties
    ("render", "size no_ground"),
    ("render glb usd", "up"),
    ("no_times render usd", "fps"),
    ("series render", "fps"),
    ("series", "ids output_fps :time_scale"),
    ("particles", "ids strengths velocities preset periodic :tangential_velocity"),
    ("particles atoms", "radii minimum_piece minimum_volume :pass_target_arrays"),
    ("atoms particles", "probe"),
    ("range", "preroll"),
    ("usd compute_velocity=on", "velocities"),
    ("usd tangential_velocity=on", "velocities"),
    ("files", "index :compute_curvature :compute_normals :pass_target_arrays"),
    ("files exr", ":compute_velocity"),
    (_MOTION, ":cfl :transport"),
    ("mesh_to_vdb", "voxel_size"),
    ("image_to_mesh", "level"),
    ("mesh", ":mesh_thickness"),
    ("no_radii", ":kernel_radius"),
    ("duration", ":arrival_time"),
    ("potential", ":output_potential"),
    ("particle_model=anisotropic", ":anisotropy"),
    ("particle_model=sum", ":particle_threshold"),
    ("normalize_target=on", ":target_noise"),
    ("compute_velocity=on", ":tangential_velocity :maximum_velocity"),
    ("evolution_mode=equilibrium", ":rest_tolerance :maximum_number_of_substeps"),
    ("volume_control=penalty volume_control=exact", ":target_volume"),
    ("volume_control=penalty", ":volume_stiffness"),
    ("area_control=penalty area_control=exact", ":target_area"),
    ("area_control=penalty", ":area_stiffness"),
)
_WHERE = {
    "atoms": "with --probe",
    "duration": "as --duration of active-surface morph",
    "exr": "on .exr pictures",
    "files": "on skins that are written (-o)",
    "glb": "on a .glb",
    "usd": "on a .usdc or .usda",
    "image_to_mesh": "from an image to a mesh",
    "mesh": "on meshes, with active-surface morph",
    "mesh_to_vdb": "from a mesh to a .vdb",
    "no_radii": "without --radii",
    "no_times": "without --times",
    "particles": "on particles, with active-surface skin (no --probe)",
    "pipeline": "in a pipeline of VTK; here set --times or --fps of skin, or --duration and "
    "--frames of morph",
    "potential": "in a pipeline of VTK; here -o NAME.vdb writes the distances to the skin",
    "range": "before the first of --frames FIRST:LAST",
    "render": "on pictures (--render of skin and morph)",
    "series": "from one frame to the next",
}


def check_effects(
    parser: Parser,
    options: Namespace,
    output: Path | None,
    facts: Iterable[str],
    surface: Any = None,
) -> None:
    """Ends the program if an option has no effect; only warns if the option needs a series.

    If `surface` is None, the properties are read from `options`.
    """
    given = vars(options)
    if surface is None:
        surface = vtkActiveImplicitSurface()
        properties.put(surface, properties_of(options, parser))
    known = {*facts, *_state_of(surface)}
    known |= {f"no_{name}" for name in ("times", "radii") if given.get(name) is None}
    known |= {"range"} if given.get("frames") else set()
    known |= {"files", suffix_of(output)[1:], suffix_of(output)[1:4]} if output else set()
    if picture := suffix_of(given.get("render") or ""):
        known |= {"render", picture[1:], *(["compute_velocity=on"] if picture == ".exr" else [])}
    idle = []
    for option, rows in _given(options):
        for row in rows:
            if known.isdisjoint(row.split()) and "series" in row:
                idle.append(option)
            elif known.isdisjoint(row.split()):
                where = " or ".join(map(_phrase, row.split()))
                parser.error(f"{option} has no effect here: it acts {where}")
    if idle:
        text = (
            f"No effect on one frame: {', '.join(idle)}; give a series, or leave the option(s) out."
        )
        warnings.warn(text, ActiveSurfaceWarning, stacklevel=2)


def _given(options: Namespace) -> Iterator[tuple[str, list[str]]]:
    """Yields each given option with its rows; leaves out switches that are set to their default."""
    for name, value in vars(options).items():
        if name.startswith(_START) and value is not None:
            own = properties.find(name[len(_START) :])
            if own.kind != "switch" or value != own.default:
                yield own.option if value is not False else f"--no-{own.option[2:]}", rows_of(own)
        elif value is not None and value is not False:
            yield "--" + name.replace("_", "-"), _rows(name)


def rows_of(own: properties.Property) -> list[str]:
    """Returns the rows of facts of a property: from _ACTING, its group and its comment."""
    groups = {
        "Motion": f"{_MOTION} particles",  # the first skin over particles is smoothed
        "Conservation": f"{_MOTION} particles",
        "Particles": "particles",
    }
    told = {
        "(No effect on|over) other targets": "particles",
        "PaperScheme": "paper_scheme=off",
        "if the input has at most one": "pipeline",
    }
    effect = own.comment.split(", automatic:")[0]  # without the rule for the automatic value
    found = [row for words, row in told.items() if re.search(words, effect)]
    found += filter(None, [groups.get(own.group)])
    return _rows(":" + own.keyword) + found


def _rows(name: str) -> list[str]:
    return [row for row, names in _ACTING if name in names.split()]


def _state_of(surface: Any) -> Iterator[str]:
    for own in properties.every():
        value = getattr(surface, "Get" + own.name)()
        if own.kind == "choice":
            yield f"{own.keyword}={own.choices[value]}"
        elif own.kind == "switch":
            yield f"{own.keyword}={'on' if value else 'off'}"


def _phrase(fact: str) -> str:
    keyword, _, value = fact.partition("=")
    if not value:
        return _WHERE[fact]
    option = properties.find(keyword).option
    if value in ("on", "off"):
        return f"with{'out' * (value == 'off')} {option}"
    return f"with {option} {value.replace('_', '-')}"
