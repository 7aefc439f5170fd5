"""One skin over particles that lie on the ranks of a parallel program, and pass from rank to rank.

Run: python3 ranks.py [--output FOLDER], on ranks by mpiexec -n 3. Needs mpi4py, VTK with MPI.
"""

import numpy as np
from active_implicit_surfaces import LiveSurface
from film_strip import CLAY, WATER, output_folder, skin_actor, write_film_strip
from fluid_scenes import ball
from mpi4py import MPI  # it starts MPI
from vtkmodules.vtkIOParallelXML import vtkXMLPPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController

RATE, SPACING, PICTURED = 25, 0.09, (0, 9, 17, 25)
COLORS = (WATER, CLAY, (0.6, 0.8, 0.5), (0.8, 0.7, 0.9))


def particles_at(time):
    """Returns the particles, at a time, of two lumps that move around each other."""
    angles = 3 * time + np.array([0, np.pi])
    places = np.stack([0.62 * np.cos(angles), 0.1 * np.sin(2 * angles), 0.3 * np.sin(angles)], 1)
    return np.concatenate([ball(0.42, SPACING) + place for place in places])


controller = vtkMPIController()  # VTK does not hold the global one: keep it
controller.Initialize()
vtkMultiProcessController.SetGlobalController(controller)
ranks, folder, moments = MPI.COMM_WORLD, output_folder(__doc__), []
# With a given spacing, no rank has to receive whole frames to estimate the spacing.
live = LiveSurface(particle_spacing=SPACING, number_of_threads=1)
for frame in range(PICTURED[-1] + 1):
    places = particles_at(frame / RATE)
    owners = np.clip((places[:, 0] + 1.05) / 2.1 * ranks.size, 0, ranks.size - 1).astype(int)
    own = np.flatnonzero(owners == ranks.rank)
    part = live.advance(places[own], 1 / RATE, ids=own)  # ids match particles across ranks
    if frame in PICTURED:
        writer = vtkXMLPPolyDataWriter()  # a .pvtp, and a .vtp of each rank
        writer.SetFileName(str(folder / f"ranks_{frame}.pvtp"))
        writer.SetNumberOfPieces(ranks.size)
        writer.SetStartPiece(ranks.rank)
        writer.SetEndPiece(ranks.rank)
        writer.SetInputData(part)
        writer.Write()
        print(f"frame {frame}, rank {ranks.rank}: {part.GetNumberOfPolys()} triangles")
ranks.Barrier()
for frame in PICTURED if ranks.rank == 0 else ():
    moments.append([])
    for rank, color in zip(range(ranks.size), COLORS):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(folder / f"ranks_{frame}_{rank}.vtp"))
        reader.Update()
        moments[-1].append(skin_actor(reader.GetOutput(), color))
if moments:
    write_film_strip(folder / "ranks.png", moments, view=(0.1, 0.5, 1), width=2000)
