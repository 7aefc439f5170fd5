"""Runs: arrays of the skin, images, functions, states and files."""

import numpy
from active_implicit_surfaces import (
    vtkActiveEXRWriter,
    vtkActiveVDBWriter,
    vtkGridPotential,
    vtkSkeletonPotential,
)
from contents import no_errors
from same_bytes import follow, make, run
from same_bytes_motion import split
from same_bytes_shapes import (
    Steps,
    add_array,
    brick,
    cloud,
    globe,
    image,
    lattice,
    lines,
    quadric,
    scattered,
    strip,
    two_balls,
)
from same_bytes_targets import CORNERS, KERNELS, births_and_deaths
from vtkmodules.vtkCommonCore import vtkInformation, vtkInformationVector
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkCommonMath import vtkMatrix4x4


def decorated(way):
    positions = [(x + way, y, z) for x, y, z in scattered(30)]
    data = cloud(positions, name=list(range(30)), heat=[way + i / 32 for i in range(30)])
    add_array(data.GetPointData(), "push", positions, numpy.float32)
    return data


def moving_particles(**properties):
    target = Steps({float(i): decorated(0.1 * i) for i in range(3)})
    return make(target, arrays={1: "name"}, KernelRadius=0.4, **properties)


@run("outputs")
def curvature_and_velocity(contents):
    surface = split(ComputeCurvature=1, ComputeVelocity=1)
    follow(contents, surface, 0.0, 0.3, 1.0)


@run("outputs")
def without_normals(contents):
    follow(contents, split(ComputeNormals=0), 0.4)


@run("outputs")
def arrays_of_the_particles(contents):
    follow(contents, moving_particles(PassTargetArrays=1), 0.0, 0.6, 2.0)


@run("outputs")
def tangential_velocity_of_the_way(contents):
    follow(contents, moving_particles(ComputeVelocity=1, TangentialVelocity=1), 0.0, 0.6, 2.0)


@run("outputs")
def tangential_velocity_of_an_array(contents):
    surface = moving_particles(ComputeVelocity=1, TangentialVelocity=1, ComputeCurvature=1)
    surface.SetInputArrayToProcess(5, 0, 0, 0, "push")
    follow(contents, surface, 0.0, 0.6, 2.0)


@run("outputs")
def potential_image(contents):
    surface = split(OutputPotential=1)
    for time in (0.0, 0.3, 1.0):
        follow(contents, surface, time)
        contents.image(surface.GetPotential())


@run("outputs")
def potential_image_in_default_bounds(contents):
    surface = make(cloud(scattered(30)), KernelRadius=0.4)
    surface.Update(1)
    contents.image(surface.GetPotential())
    contents.image(surface.GetOutputDataObject(1))


@run("outputs")
def pieces(contents):
    """The first piece contains the whole skin; each piece of the image is a part of it."""
    surface = split()
    surface.UpdateTimeStep(0.4)
    keys, requests = surface.GetExecutive(), vtkInformationVector()
    for port in range(2):
        requests.Append(vtkInformation())
        requests.GetInformationObject(port).Set(keys.UPDATE_TIME_STEP(), 0.4)
    for piece in range(3):
        for port in range(2):
            request = requests.GetInformationObject(port)
            request.Set(keys.UPDATE_PIECE_NUMBER(), piece)
            request.Set(keys.UPDATE_NUMBER_OF_PIECES(), 3)
            request.Set(keys.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
            surface.Update(port, requests)
        contents.skin(surface.GetOutput(), may_be_empty=piece > 0)
        assert (surface.GetOutput().GetNumberOfPoints() == 0) == (piece > 0)
        contents.image(surface.GetPotential())


@run("outputs")
def skin_function(contents):
    surface = split()
    for time in (0.0, 1.0):
        surface.UpdateTimeStep(time)
        contents.function(surface.GetSkinFunction(), lattice())


@run("functions")
def skeleton_potential_of_points(contents):
    for kernel in KERNELS:
        potential = vtkSkeletonPotential()
        potential.SetInput(cloud(scattered(25), size=[0.2 + i / 99 for i in range(25)]))
        potential.SetRadiusArrayName("size")
        potential.SetKernel(kernel)
        potential.SetThreshold(0.3)
        contents.function(potential, lattice())


@run("functions")
def skeleton_potential_of_lines(contents):
    for kernel in KERNELS:
        potential = vtkSkeletonPotential()
        weights = [1, 1.5, -0.25, 1.25]
        potential.SetInput(lines(CORNERS, (0, 1, 2), (1, 3), weight=weights))
        potential.SetStrengthArrayName("weight")
        potential.SetRadius(0.6)
        potential.SetKernel(kernel)
        contents.function(potential, lattice())


@run("functions")
def grid_potential_of_meshes(contents):
    for mesh, thickness, reach in ((brick(), 0, -1), (brick(), 0, 0.3), (strip(), 0.4, -1)):
        potential = vtkGridPotential()
        potential.SetInput(mesh)
        potential.SetVoxelSize(0.08)
        potential.SetReach(reach)
        potential.SetMeshThickness(thickness)
        potential.SetIsoValue(0.05)
        with no_errors(potential):  # the warning of open edges is not printed
            contents.function(potential, lattice())


@run("functions")
def grid_potential_of_an_image(contents):
    potential = vtkGridPotential()
    potential.SetInput(image(lambda x, y, z: x, G=quadric(1, 2, 0.7, 0)))
    potential.SetScalarArrayName("G")
    potential.SetIsoValue(0.36)
    contents.function(potential, lattice())
    potential.InvertInsideOn()
    contents.function(potential, lattice())


@run("states")
def state_is_taken_up_by_another_filter(contents):
    first = split(VolumeControl=1)
    first.UpdateTimeStep(0.6)
    with contents.file("state.vdb", contents.vdb) as path:
        assert first.SaveState(path)
        other = split(VolumeControl=1)
        with no_errors(other):
            assert other.LoadState(path)
        follow(contents, other, 0.8, 0.6, 1.0)


@run("states")
def state_of_particles(contents):
    def particles():
        return make(births_and_deaths(), arrays={1: "name"}, KernelRadius=0.35)

    first = particles()
    first.UpdateTimeStep(1.3)  # the saved state is that of time 1
    with contents.file("state.vdb", contents.vdb) as path:
        assert first.SaveState(path)
        other = particles()
        with no_errors(other):
            assert other.LoadState(path)
        follow(contents, other, 1.0, 1.3, 2.0)


def write_vdb(contents, source, **properties):
    with contents.file("a.vdb", contents.vdb) as path:
        writer = vtkActiveVDBWriter()
        if isinstance(source, vtkDataObject):
            writer.SetInputData(source)
        else:
            writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(path)
        for name, value in properties.items():
            getattr(writer, "Set" + name)(value)
        with no_errors(writer):
            assert writer.Write()


@run("files")
def vdb_of_a_skin(contents):
    surface = moving_particles(ComputeVelocity=1, ComputeCurvature=1, PassTargetArrays=1)
    surface.UpdateTimeStep(1.0)
    switches = dict.fromkeys(("WriteState", "WriteDensity", "WriteVelocity", "WritePointArrays"), 1)
    write_vdb(contents, surface, Units="m", **switches)


@run("files")
def vdb_of_half_floats(contents):
    surface = split()
    surface.UpdateTimeStep(0.33)
    for compression in range(4):
        write_vdb(contents, surface, HalfFloat=1, WriteDensity=1, Compression=compression)


@run("meshes by OpenVDB")
def vdb_of_a_mesh(contents):
    write_vdb(contents, globe(0.6), VoxelSize=0.08, WriteDensity=1)


@run("files")
def vdb_of_images(contents):
    for grid_class in range(3):
        write_vdb(contents, image(quadric(1, 2, 1), H=quadric(3, 1, 2)), GridClass=grid_class)
    write_vdb(contents, image(quadric(1, 2, 1), H=quadric(3, 1, 2)), WritePointArrays=1)


@run("files")
def vdb_of_the_potential_image(contents):
    surface = make(two_balls(), OutputPotential=1)
    surface.UpdateTimeStep(0.0)
    with contents.file("a.vdb", contents.vdb) as path:
        writer = vtkActiveVDBWriter()
        writer.SetInputConnection(surface.GetOutputPort(1))
        writer.SetFileName(path)
        with no_errors(writer):
            assert writer.Write()


def picture(width=24, height=17):
    data = vtkImageData()
    data.SetDimensions(width, height, 1)
    count = numpy.arange(width * height, dtype=numpy.float64)
    arrays = data.GetPointData()
    colors = numpy.stack([count % n / n for n in (7, 11, 13, 5)], 1)
    add_array(arrays, "RGBA", colors, numpy.float32)
    add_array(arrays, "N", numpy.stack([count % n / n - 0.5 for n in (3, 17, 6)], 1))
    add_array(arrays, "forward", numpy.stack([count % 9, count % 4 / 3], 1), numpy.float32)
    add_array(arrays, "Z", count * count / 64)
    add_array(arrays, "id", count, numpy.uint32)
    add_array(arrays, "paint", numpy.stack([count * n % 256 for n in (1, 3, 7)], 1), numpy.uint8)
    return data


def write_exr(contents, change):
    with contents.file("a.exr", contents.exr) as path:
        writer = vtkActiveEXRWriter()
        writer.SetInputData(picture())
        writer.SetFileName(path)
        change(writer)
        with no_errors(writer):
            writer.Write()
        assert writer.GetErrorCode() == 0


@run("files")
def exr_of_layers(contents):
    for compression in range(4):  # all lossless ones
        write_exr(contents, lambda writer, packed=compression: writer.SetCompression(packed))


@run("files")
def exr_with_attributes(contents):
    def change(writer):
        writer.SetTimeCode("01:02:03:04")
        writer.SetFramesPerSecond(25)
        writer.SetDisplaySize(30, 20)
        writer.SetPixelAspectRatio(1.5)
        writer.SetColorEncodingToSRGB()
        writer.AssignPixelType("N", writer.HALF)
        writer.AddChannel("forward", 1, "motion.v")
        writer.AddAttribute("owner", "the tests")
        writer.AddAttribute("number", 0.1)
        matrix = vtkMatrix4x4()
        matrix.SetElement(0, 3, 2.5)
        writer.SetWorldToCamera(matrix)
        writer.SetWorldToNDC(matrix)

    write_exr(contents, change)
