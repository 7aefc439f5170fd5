"""Sphinx's settings for the pages of the Python package; run by the target `documentation`.

PYTHONPATH has to include the built package. This file also writes a page (.rst), next to itself,
for each class in CLASSES.
"""

import re
import sys
from pathlib import Path
from types import ModuleType

import active_implicit_surfaces as active

project = "active_implicit_surfaces"
version = release = active.__version__
extensions = ["sphinx.ext.autodoc", "numpydoc"]
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say more
numpydoc_show_class_members = False
html_theme = "alabaster"
html_theme_options = {"page_width": "1100px", "font_family": "sans-serif"}
html_sidebars = {"**": ["globaltoc.html", "searchbox.html"]}
html_show_sourcelink = html_copy_source = False

# A substitute for PyVista, so that the accessor's page does not need PyVista.
sys.modules["pyvista"] = pyvista = ModuleType("pyvista")
pyvista.DataSet = object
pyvista.register_dataset_accessor = lambda name, kind: lambda accessor: accessor

CLASSES = (
    active.vtkActiveImplicitSurface,
    active.vtkSkeletonPotential,
    active.vtkGridPotential,
    active.vtkActiveVDBReader,
    active.vtkActiveVDBWriter,
    active.vtkActiveEXRReader,
    active.vtkActiveEXRWriter,
)


def properties_of(kind):
    """Yields X and the comment for each method SetX(value) that this package adds to a class."""
    ours = [base for base in kind.__mro__ if base.__module__.startswith(active.__name__)]
    for name in sorted({name for base in ours for name in vars(base) if name.startswith("Set")}):
        text = getattr(kind, name).__doc__
        if not re.match(r"Set\w+\(self\)", text):
            signatures, _, comment = text.rpartition("\nC++: ")
            yield name[3:], " ".join((comment.partition("\n\n")[2] if signatures else text).split())


def escaped(text):
    """Escapes Sphinx markup in a text."""
    return re.sub(r"([\\*_`|<>])", r"\\\1", text)


def keyword(name):
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def page_of(kind):
    """Returns the page of a class: its comment and its properties."""
    name, indented = kind.__name__, re.sub(r"^", "    ", kind.__doc__.strip(), flags=re.MULTILINE)
    lines = [name, "=" * len(name), "", ".. code-block:: none", "", indented, ""]
    for own, comment in properties_of(kind):
        lines += [f".. py:attribute:: {name}.{own}", ""]
        if kind is active.vtkActiveImplicitSurface:
            lines += [f"   Keyword ``{keyword(own)}``.", ""]
        lines += [f"   {escaped(comment)}", ""]
    return "\n".join(lines)


for kind in CLASSES:
    page = Path(__file__).with_name(f"{kind.__name__}.rst")
    page.write_text(page_of(kind), encoding="utf-8")
