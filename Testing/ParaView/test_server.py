"""A server, of one rank or more, gives the same bytes as a single program, and nothing twice.

Each rank has a part of a skin: skins are compared as sets of triangles.

Run: pvpython test_server.py <pvserver> <number of ranks>
"""

import os
import socket
import subprocess
import sys
import unittest
from pathlib import Path

from paraview import servermanager
from paraview.simple import (
    ActiveImplicitSurface,
    ActiveImplicitSurfaceFunctions,
    Connect,
    CreateRenderView,
    Delete,
    Disconnect,
    OpenDataFile,
    OutputPort,
    PolyLineSource,
    RedistributeDataSet,
    ResetCamera,
    ResetSession,
    SaveData,
    SaveScreenshot,
    Show,
    Wavelet,
)
from scenes import COARSE, DATA, splash, triangles_at
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import (
    vtkXMLPImageDataReader,
    vtkXMLPolyDataReader,
    vtkXMLPolyDataWriter,
)

PVSERVER, RANKS = sys.argv.pop(1), int(sys.argv.pop(1))
FOLDER = Path(os.environ.get("ACTIVE_TEST_OUTPUT", ".")) / f"server_{RANKS}"
FILES = ("wavelet.vdb", "wavelet.exr")
# Settings for tests run by root, and for fewer processors than ranks.
MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
}


def write_files():
    FOLDER.mkdir(parents=True, exist_ok=True)
    wavelet = Wavelet(WholeExtent=[-9, 9, -9, 9, 0, 0])
    for name in FILES:
        SaveData(str(FOLDER / name), proxy=wavelet)


def write_partitioned():
    """Writes the splash at step 20 as a .pvtp of three pieces."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(DATA))
    reader.UpdateTimeStep(20)
    points = reader.GetOutput().GetPoints()
    count = points.GetNumberOfPoints()
    pieces = ""
    for piece in range(3):
        part, places, vertices = vtkPolyData(), vtkPoints(), vtkCellArray()
        for i in range(count * piece // 3, count * (piece + 1) // 3):
            vertices.InsertNextCell(1, [places.InsertNextPoint(points.GetPoint(i))])
        part.SetPoints(places)
        part.SetVerts(vertices)
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(part)
        writer.SetFileName(str(FOLDER / f"piece_{piece}.vtp"))
        writer.Write()
        pieces += f'<Piece Source="piece_{piece}.vtp"/>'
    array = '<PDataArray type="Float32" Name="Points" NumberOfComponents="3"/>'
    (FOLDER / "splash.pvtp").write_text(
        '<VTKFile type="PPolyData" version="0.1" byte_order="LittleEndian">'
        f'<PPolyData GhostLevel="0"><PPoints>{array}</PPoints>{pieces}</PPolyData></VTKFile>'
    )


def partitioned():
    particles = OpenDataFile(str(FOLDER / "splash.pvtp"))
    return particles, RedistributeDataSet(Input=particles)


def picture(surface, name):
    view = CreateRenderView(ViewSize=[300, 200], OrientationAxesVisibility=0)
    shown = Show(surface, view)
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = [0.36, 0.66, 0.86]
    view.CameraPosition = [0.4, 0.5, 1.0]
    view.CameraFocalPoint = [0, 0, 0]
    ResetCamera(view)
    file = str(FOLDER / name)
    SaveScreenshot(file, view)
    Delete(view)
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    assert (pixels != pixels[0]).any(axis=1).sum() > 1000, "there is next to nothing to see"
    return pixels.tobytes()


def results(name):
    write_partitioned()
    surface, _ = splash()
    found = [triangles_at(surface, time) for time in (3, 1, 3)]
    found.append(surface.GetDataInformation(0).GetNumberOfCells())
    found.append(servermanager.Fetch(surface, idx=2).GetNumberOfRows())
    tube = ActiveImplicitSurfaceFunctions(TargetFunction="Skeleton Potential", VoxelSize=0.1)
    tube.TargetFunction.Input = PolyLineSource(Points=[-0.5, 0, 0, 0.5, 0, 0])
    found.append(triangles_at(tube, 0.3))
    for particles in partitioned():
        skin = ActiveImplicitSurface(Input=particles, **COARSE)
        found.append(triangles_at(skin, 0.3))
        found.append(picture(skin, f"{name}_{len(found)}.png"))
    for file in FILES:
        reader = OpenDataFile(str(FOLDER / file))
        reader.UpdatePipeline()
        information = reader.GetDataInformation()
        values = information.GetPointDataInformation().GetArrayInformation("RTData")
        found += [information.GetNumberOfCells(), values.GetComponentRange(0)]
    image = FOLDER / "potential.pvti"
    SaveData(str(image), proxy=OutputPort(surface, 1), DataMode="Binary")
    reader = vtkXMLPImageDataReader()
    reader.SetFileName(str(image))
    reader.Update()
    values = reader.GetOutput().GetPointData().GetArray("Potential")
    return found + [reader.GetOutput().GetExtent(), bytes(memoryview(values))]


def start_server():
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = ["mpirun", "-np", str(RANKS)] if RANKS > 1 else []
    # This program is an MPI run of its own, whose variables the server must not inherit.
    server = subprocess.Popen(
        [*command, PVSERVER, f"--server-port={port}"],
        env={k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_"))} | MPI,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,  # messages at its termination
        text=True,
    )
    for line in server.stdout:
        if line.startswith("Accepting"):
            return server, port
    raise RuntimeError("pvserver does not start.")


class ClientAndServer(unittest.TestCase):
    def test_results_are_those_of_one_program(self):
        write_files()
        expected = results("one")
        ResetSession()
        server, port = start_server()
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.wait)
        self.addCleanup(server.terminate)
        Connect("127.0.0.1", port)
        self.assertTrue(servermanager.ActiveConnection.IsRemote())
        self.assertEqual(servermanager.ActiveConnection.GetNumberOfDataPartitions(), RANKS)
        found = results("server")
        self.assertEqual([a == b for a, b in zip(found, expected)], [True] * len(expected))
        Disconnect()


if __name__ == "__main__":
    unittest.main()
