"""A small ball grows into a larger ball; prints the height of the surface at five times.

Run: python3 follow_sphere.py
"""

import film_strip
from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.vtkCommonDataModel import vtkSphere

small, large = vtkSphere(), vtkSphere()
small.SetRadius(0.3)
large.SetRadius(0.9)
surface = vtkActiveImplicitSurface()
surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
surface.SetInitialFunction(small)
surface.SetTargetFunction(large)
surface.SetAttraction(4)
for time in (0.0, 0.2, 0.4, 0.6, 0.8):
    surface.UpdateTimeStep(time)
    print(f"at {time} its height is {2 * surface.GetOutput().GetBounds()[3]:.3f}")

folder = film_strip.output_folder(__doc__)
frames = []
for time in (0.0, 0.2, 0.4, 0.6, 0.8):  # earlier times restart, with the same result
    surface.UpdateTimeStep(time)
    frames.append([film_strip.skin_actor(surface.GetOutput())])
film_strip.write_film_strip(folder / "follow_sphere.png", frames, floor=-0.95)
print(f"wrote {folder / 'follow_sphere.png'}")
