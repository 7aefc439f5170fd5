"""Flicker of a living skin compared with the surface of each frame by itself; prints a table.

The scene is a static pool of particles with random displacements, new in each frame, of standard
deviation 0.1 of the kernel radius along each axis.
A viewer should see a level that does not move. Flicker is the rms of the second difference in time
of the surface's height over fixed columns [spacings], for
- frame by frame: the iso-surface of each frame's particles, vtkFlyingEdges3D over
  vtkSkeletonPotential;
- the living skin, vtkActiveImplicitSurface with ParticleModel SUM and without Transport, for
  several Attractions [1/frame], Tensions [square of the particles' spacing / frame] and CFLs;
- splashsurf, if the Python package pysplashsurf is there, with its weighted smoothing.

"lag" is the delay behind a pool that rises steadily without jitter, in frames: the cost of a low
Attraction. "level" is the mean height less that of the frame-by-frame surface, in spacings: the
cost of a high Tension, as the pool's rim recedes.

Run: python3 flicker.py, with active_implicit_surfaces on PYTHONPATH. Takes about a minute.
"""

import sys
from pathlib import Path

import numpy
from active_implicit_surfaces import vtkActiveImplicitSurface, vtkSkeletonPotential
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray,
    vtkDataObject,
    vtkPolyData,
    vtkStaticCellLocator,
)
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkImagingHybrid import vtkSampleFunction

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "Examples" / "Python"))
from particle_series import ParticleSeries, make_particles  # noqa: E402

FRAMES = 40
FIRST = 10  # frame from which the start no longer matters
SPACING = 0.1
RADIUS = 2 * SPACING
JITTER = 0.1 * RADIUS
THRESHOLD = 2.5  # about half of the sum within the pool
VOXEL = 0.4 * SPACING
ACROSS, DEEP = 14, 4
BOUNDS = [-0.2, 1.5, -0.2, 1.5, -0.3, 1.0]
RISE = 0.1 * SPACING  # per frame, for the lag

# Attraction, Tension, CFL.
SKINS = (
    (0.35, 0.05, 0.1),
    (0.25, 0, 0.1),
    (0.35, 0, 0.1),
    (0.5, 0, 0.1),
    (0.5, 0, 1),
    (0.5, 0.05, 0.25),
    (0.5, 1, 1),
    (1, 0, 0.1),
    (1, 1, 1),
    (2, 0, 0.1),
)


def rest():
    places = [
        (i + 0.5 * (k % 2), j + 0.5 * (k % 2), k)
        for k in range(DEEP)
        for j in range(ACROSS)
        for i in range(ACROSS)
    ]
    return SPACING * numpy.array(places, dtype=float)


def jittering(frame):
    return rest() + numpy.random.default_rng(frame).normal(0, JITTER, rest().shape)


def rising(frame):
    return rest() + [0, 0, RISE * frame]


def frame_of(places):
    return places, None, numpy.arange(len(places))


def heights(surface):
    """Heights of the surface over a square of columns, away from the pool's sides."""
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    columns = numpy.linspace(0.4, 0.9, 16)
    top, bottom = BOUNDS[5], 0.1
    hit, t, part = [0.0] * 3, mutable(0.0), mutable(0)
    result = []
    for x in columns:
        for y in columns:
            locator.IntersectWithLine((x, y, top), (x, y, bottom), 0.0, t, hit, [0.0] * 3, part)
            result.append(hit[2])
    return result


def skin(places, attraction, tension, cfl):
    pool = ParticleSeries([frame_of(places(frame)) for frame in range(FRAMES)], rate=1)
    surface = vtkActiveImplicitSurface()
    surface.SetInputConnection(pool.GetOutputPort())
    surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
    surface.SetParticleModelToSum()
    surface.SetTransport(0)
    surface.TensionWeightingOff()
    surface.SetTargetNoise(0)
    surface.SetKernelRadius(RADIUS)
    surface.SetParticleThreshold(THRESHOLD)
    surface.SetModelBounds(BOUNDS)
    surface.SetVoxelSize(VOXEL)
    surface.SetAttraction(attraction)
    surface.SetCFL(cfl)
    surface.SetTension(tension * SPACING**2)
    for frame in range(FRAMES):
        surface.UpdateTimeStep(frame)
        yield surface.GetOutput()


def frame_by_frame(places):
    for frame in range(FRAMES):
        potential = vtkSkeletonPotential()
        potential.SetInput(make_particles(*frame_of(places(frame))))
        potential.SetRadius(RADIUS)
        potential.SetThreshold(THRESHOLD)
        samples = vtkSampleFunction()
        samples.SetImplicitFunction(potential)
        samples.SetModelBounds(BOUNDS)
        samples.SetSampleDimensions(
            [round((b - a) / VOXEL) + 1 for a, b in zip(BOUNDS[::2], BOUNDS[1::2])]
        )
        samples.ComputeNormalsOff()
        contour = vtkFlyingEdges3D()
        contour.SetInputConnection(samples.GetOutputPort())
        contour.SetValue(0, 0.0)
        contour.Update()
        yield contour.GetOutput()


def splashsurf(places):
    import pysplashsurf

    for frame in range(FRAMES):
        mesh, _ = pysplashsurf.reconstruction_pipeline(
            places(frame),
            particle_radius=0.5 * SPACING,
            smoothing_length=2.0,  # in particle radii, as the next one
            cube_size=VOXEL / (0.5 * SPACING),
            iso_surface_threshold=0.6,
            mesh_smoothing_weights=True,
            mesh_smoothing_iters=25,
        )
        surface, points, triangles = vtkPolyData(), vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(numpy.asarray(mesh.mesh.vertices), deep=True))
        corners = numpy.asarray(mesh.mesh.triangles).astype(numpy.int64)
        triangles.SetData(3, numpy_to_vtkIdTypeArray(corners.ravel(), deep=True))
        surface.SetPoints(points)
        surface.SetPolys(triangles)
        yield surface


def history(surfaces):
    return numpy.array([heights(surface) for surface in surfaces])[FIRST:]


def flicker(rows):
    return numpy.sqrt((numpy.diff(rows, n=2, axis=0) ** 2).mean()) / SPACING


def main():
    def line(name, rows, lag):
        value, level = flicker(rows), (rows.mean() - reference.mean()) / SPACING
        ratio = flicker(reference) / value
        print(f"{name:52} {value:8.4f} {ratio:6.1f} {lag:6} {level:7.3f}", flush=True)

    reference = history(frame_by_frame(jittering))
    steady = history(frame_by_frame(rising))
    print(f"{'':52} {'flicker':>8} {'less':>6} {'lag':>6} {'level':>7}")
    line("frame by frame", reference, "0")
    for motion in SKINS:
        lags = (steady - history(skin(rising, *motion)))[-1] / RISE
        name = "living skin, Attraction {}, Tension {}, CFL {}".format(*motion)
        line(name, history(skin(jittering, *motion)), f"{lags.mean():.2f}")
    try:
        line("splashsurf", history(splashsurf(jittering)), "0")
    except ImportError:
        print("splashsurf: left out, as pysplashsurf is not installed")


if __name__ == "__main__":
    main()
