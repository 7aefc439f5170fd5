"""Frames of particles as a VTK source with time steps."""

from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline


def make_particles(positions, velocities=None, ids=None):
    """Returns points, with the arrays Velocity and id if these are given."""
    particles, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=True))
    particles.SetPoints(points)
    for name, values in (("Velocity", velocities), ("id", ids)):
        if values is not None:
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            particles.GetPointData().AddArray(array)
    return particles


class ParticleSeries(VTKPythonAlgorithmBase):
    """Source of frames (positions, velocities, ids) at the times 0, 1/rate, 2/rate ..."""

    def __init__(self, frames, rate=25):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self.frames, self.rate = frames, rate

    def RequestInformation(self, request, inputs, outputs):
        times = [step / self.rate for step in range(len(self.frames))]
        info = outputs.GetInformationObject(0)
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), times, len(times))
        info.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [0, times[-1]], 2)
        return 1

    def RequestData(self, request, inputs, outputs):
        time = outputs.GetInformationObject(0).Get(
            vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        )
        frame = self.frames[round((time or 0.0) * self.rate)]
        vtkPolyData.GetData(outputs, 0).ShallowCopy(make_particles(*frame))
        return 1
