"""Use of the package for a type checker: Testing/lint runs mypy --strict on it."""

import active_implicit_surfaces as active
import numpy

points = numpy.zeros((4, 3))


def count(skin: object) -> int:
    return id(skin)


one = active.skin(points, particle_spacing=0.1, preset="viscous")
for frame in active.frames([points, points], fps=25, arrays={"ids": "id"}):
    seconds: float = frame.time
    count(frame.skin)
way = active.morph(one, one, duration=2, frames=5, progress=lambda done, of: None)
lengths: list[float] = [time for time, _ in way]
live = active.LiveSurface(particle_spacing=0.1)
count(live.advance(points, 0.04))
last: float | None = live.time
series = active.ParticleSeries([points, points], fps=25)
source = active.ParticleSeries(lambda time: points + time, times=[0.0, 1.0])
surface = active.vtkActiveImplicitSurface()
version: str = active.__version__
