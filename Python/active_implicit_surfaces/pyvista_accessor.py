"""Gives PyVista's data sets methods that make skins.

cloud.active_surface.skin(...)               the skin over the points
mesh.active_surface.morph_to(other, 2.0)     the mesh becomes another mesh

PyVista 0.48 or later finds the methods in an installed wheel. Without a wheel,
`import active_implicit_surfaces.pyvista_accessor` registers the methods.
"""

from __future__ import annotations

from typing import Any

import pyvista

from .api import skin
from .morphing import morph

if not hasattr(pyvista, "register_dataset_accessor"):
    raise ImportError(
        "active_implicit_surfaces.pyvista_accessor needs PyVista 0.48 or later, and this is "
        f"{pyvista.__version__}; install a newer one, or call active_implicit_surfaces.skin(cloud)."
    )


@pyvista.register_dataset_accessor("active_surface", pyvista.DataSet)
class ActiveSurfaceAccessor:
    """Functions of active_implicit_surfaces for one data set."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset

    def skin(self, **options: Any) -> Any:
        """Returns the skin over the points of this data set, used as particles; cells are ignored.

        Parameters
        ----------
        **options
            ``radii``, ``strengths``, ``probe``, ``preset``, ``arrays`` and the properties of
            vtkActiveImplicitSurface; see active_implicit_surfaces.skin.

        Returns
        -------
        pyvista.PolyData
            Closed surface of triangles, by default with normals.

        Raises
        ------
        ValueError
            A value or an array does not fit, or the filter reports an error.
        TypeError
            Unknown keyword (the text names a similar one, if any), a value of a wrong type, or the
            data set is an ImageData or a RectilinearGrid.

        Examples
        --------
        >>> import numpy, pyvista
        >>> grid = numpy.stack(numpy.meshgrid(*3 * [numpy.arange(8.0)]), -1).reshape(-1, 3)
        >>> ball = pyvista.PolyData(grid).active_surface.skin(particle_spacing=1)
        >>> ball.is_manifold
        True
        """
        return skin(self._dataset, **options)

    def morph_to(self, other: Any, duration: float = 1.0, **options: Any) -> morph:
        """Returns an iterator over the skins from this closed mesh or image to another shape.

        Parameters
        ----------
        other : pyvista.PolyData, pyvista.ImageData, or another shape that `morph` accepts
        duration : float
            Time of the last skin [time]. The last skin is `other`, unless properties such as
            ``attraction`` or ``tension`` prevent this. Default: 1.
        **options
            ``frames``, ``fit``, ``progress`` and the properties of vtkActiveImplicitSurface; see
            active_implicit_surfaces.morph.

        Returns
        -------
        morph
            Yields for each frame a named tuple Frame(`time`, `skin`); `skin` is a pyvista.PolyData.

        Examples
        --------
        >>> import pyvista
        >>> way = pyvista.Cube().active_surface.morph_to(pyvista.Sphere(radius=1), 2, frames=3)
        >>> for time, skin in way:
        ...     print(f"at {time}: {skin.bounds.x_max:.2f}")
        at 0.0: 0.50
        at 1.0: 0.74
        at 2.0: 1.00
        """
        return morph(self._dataset, other, duration, **options)
