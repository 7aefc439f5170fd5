"""Makes sph_drop.vtp: a liquid drop falls into a basin, 992 SPH particles, 41 frames at 25 fps.

Run: python3 make_sph_drop.py sph_drop.npz [sph_drop.vtp]

The .npz contains `positions` (41, 992, 3), y up, g = 9.81, and `fps`. Row k of every frame is the
same particle: it becomes point k, with id k. Particles have radius 0.05 and start 0.1 apart.
Positions are rounded to multiples of 2^-16, which compresses better: the file is within 2^-17 =
7.6e-6 of the simulation on each axis, 1/6500 of a radius.

VTK's reader publishes the steps as 0, 1, 2 ..., whatever their times. There are no vertex cells,
because the reader (VTK 9.1) appends a temporal file's cells to those of the previous step. To
display the particles, use a glyph mapper or vtkVertexGlyphFilter.
"""

import re
import sys
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import VTK_INT, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

ROUNDING = 2.0**-16


def make_particles(count):
    ids = numpy_to_vtk(np.arange(count, dtype=np.int32), deep=True, array_type=VTK_INT)
    ids.SetName("id")
    particles = vtkPolyData()
    particles.SetPoints(vtkPoints())
    particles.GetPointData().AddArray(ids)
    return particles


def move_particles(particles, positions):
    rounded = (np.round(positions / ROUNDING) * ROUNDING).astype(np.float32)
    particles.GetPoints().SetData(numpy_to_vtk(rounded, deep=True))
    particles.Modified()


def write_frames(path, particles, frames, fps):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(path)
    writer.SetInputData(particles)
    writer.SetCompressionLevel(9)
    writer.SetNumberOfTimeSteps(len(frames))
    move_particles(particles, frames[0])  # Start() writes the number of points
    writer.Start()
    for index, positions in enumerate(frames):
        move_particles(particles, positions)
        writer.WriteNextTime(index / fps)
    writer.Stop()
    say_encoding_by_default(path)
    say_ids_once(path)


def say_encoding_by_default(path):
    """Omits the encoding, base64 by default. VTK 9.1 passes the tag in pieces to libexpat, which
    defers such pieces of a long tag since 2.6 and in Debian's 2.5.0-1+deb12u2."""
    text = Path(path).read_text()
    Path(path).write_text(text.replace('<AppendedData encoding="base64">', "<AppendedData>"))


def say_ids_once(path):
    """Keeps one of the ids' tags, which are equal: VTK 9.6 warns of each except the first."""
    text = Path(path).read_text()
    tag = re.compile(r'[ \t]*<DataArray[^>]*Name="id"[^>]*/>\n')
    once = re.sub(r' TimeStep="\d+"', "", tag.search(text)[0])
    head, *rest = tag.split(text)
    Path(path).write_text(head + once + "".join(rest))


def main():
    path = sys.argv[2] if len(sys.argv) > 2 else "sph_drop.vtp"
    with np.load(sys.argv[1]) as simulation:
        frames = simulation["positions"].astype(float)
        write_frames(path, make_particles(frames.shape[1]), frames, float(simulation["fps"]))


if __name__ == "__main__":
    main()
