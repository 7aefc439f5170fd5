"""Options that have no effect where they are given: an error, which says where they act.

A run has facts, as "render", or "particle_model=sum" for each choice and switch of its filter. An
option acts if the run has at least one fact of each of the option's rows. Rows are in the tables
below, or follow from the filter's classes and their documentation.
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

_START = "property_"  # of the properties' names among the options
_OPTIONS = {
    "size": ["render"],
    "no_ground": ["render"],
    "up": ["render glb"],
    "index": ["files"],
    "fps": ["no_times render", "series render"],
    "ids": ["series"],
    "velocities": ["render glb compute_velocity=on", "render glb tangential_velocity=on"],
    "voxel_size": ["mesh_to_vdb"],
    "level": ["image_to_mesh"],
}
_PROPERTIES = {
    "anisotropy": ["particle_model=anisotropic"],
    "area_stiffness": ["area_control=penalty"],
    "arrival_time": ["duration"],
    "compute_curvature": ["files"],
    "compute_normals": ["files"],
    "compute_velocity": ["files exr"],
    "maximum_number_of_substeps": ["evolution_mode=equilibrium"],
    "maximum_velocity": ["compute_velocity=on"],
    "mesh_thickness": ["mesh"],
    "output_potential": ["potential"],
    "particle_radius": ["no_radii"],
    "particle_threshold": ["particle_model=sum"],
    "pass_target_arrays": ["files"],
    "rest_tolerance": ["evolution_mode=equilibrium"],
    "tangential_velocity": ["compute_velocity=on"],
    "target_area": ["area_control=penalty area_control=exact"],
    "target_noise": ["normalize_target=on"],
    "target_volume": ["volume_control=penalty volume_control=exact"],
    "time_scale": ["series"],
    "volume_stiffness": ["volume_control=penalty"],
}
_WHERE = {
    "duration": "as --duration of active-surface morph",
    "exr": "on pictures .exr",
    "files": "on skins that are written, with -o",
    "glb": "on a .glb",
    "image_to_mesh": "from an image to a mesh",
    "mesh": "on meshes, with active-surface morph",
    "mesh_to_vdb": "from a mesh to a .vdb",
    "no_radii": "without --radii",
    "no_times": "without --times",
    "particles": "on particles, with active-surface skin",
    "pipeline": "in a pipeline of VTK; the times here are those of --times, --fps or --duration",
    "potential": "in a pipeline of VTK; -o NAME.vdb writes the potential here",
    "render": "on pictures, with --render",
    "series": "from one frame to the next",
}


def check_effects(
    parser: Parser,
    options: Namespace,
    output: Path | None,
    facts: Iterable[str],
    surface: Any = None,
) -> None:
    """Ends the program if an option has no effect; where more frames would help, warns of it.

    Without a surface the properties are those of the options.
    """
    given = vars(options)
    if surface is None:
        surface = vtkActiveImplicitSurface()
        properties.put(surface, properties_of(options, parser))
    known = {*facts, *_state_of(surface)}
    known |= {f"no_{name}" for name in ("times", "radii") if given.get(name) is None}
    known |= {"files", suffix_of(output)[1:]} if output else set()
    known |= {"render", suffix_of(given["render"])[1:]} if given.get("render") else set()
    idle = []
    for option, rows in _given(options):
        for row in rows:
            if known.isdisjoint(row.split()) and "series" in row:
                idle.append(option)
            elif known.isdisjoint(row.split()):
                where = " or ".join(map(_phrase, row.split()))
                parser.error(f"{option} has no effect here: it acts {where}")
    if idle:
        text = f"Of no effect on one frame: {', '.join(idle)}; give a series, or leave it out."
        warnings.warn(text, ActiveSurfaceWarning, stacklevel=2)


def _given(options: Namespace) -> Iterator[tuple[str, list[str]]]:
    """The options of a command line, and their rows."""
    for name, value in vars(options).items():
        keyword = name[len(_START) :]
        if value is None or (value is False and not name.startswith(_START)):
            continue
        if not name.startswith(_START):
            yield "--" + name.replace("_", "-"), _OPTIONS.get(name, [])
        elif (own := properties.find(keyword)).kind != "switch" or value != own.default:
            option = own.option if value is not False else f"--no-{own.option[2:]}"
            yield option, [*_PROPERTIES.get(keyword, []), *_rows_of(own)]


def _rows_of(own: properties.Property) -> Iterator[str]:
    """What the class of a property, and its documentation, say of where it acts."""
    if own.owner == "vtkActiveMotionAlgorithm":
        yield "series evolution_mode=equilibrium"
    elif own.owner == "vtkActiveParticleAlgorithm":
        yield "particles"
    if re.search("(Of no use to|over) other targets", own.comment):
        yield "particles"
    if "PaperScheme" in own.comment:
        yield "paper_scheme=off"
    if "published where the input has" in own.comment:
        yield "pipeline"


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
