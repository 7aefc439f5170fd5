"""Skins of a scene of fluid_scenes.py, written for each frame and shown as a film strip."""

import json
import time

from active_implicit_surfaces import vtkActiveImplicitSurface
from film_strip import ball_actor, output_folder, skin_actor, write_film_strip
from fluid_scenes import RATE, load_scene
from particle_series import ParticleSeries, make_particles
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def coat_scene(name, description, pictured, width=2000, solids=(), floor=0, **options):
    """Makes the scene, its skins <name>_0000.vtp ... with a .series, and the picture <name>.png.

    `solids` are further actors in the picture."""
    folder = output_folder(description)
    scene = load_scene(name, folder / "scenes", **options)
    radius = 0.5 * scene.spacing
    series, surface = ParticleSeries(scene.frames, RATE), vtkActiveImplicitSurface()
    surface.SetInputConnection(series.GetOutputPort())
    surface.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "id")
    surface.SetParticleSpacing(scene.spacing)

    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()  # VTK 9.1 reads this mode with any libexpat
    writer.SetInputConnection(surface.GetOutputPort())
    balls, skins, files, seconds = [], [], [], 0.0
    for step, frame in enumerate(scene.frames):
        start = time.perf_counter()
        surface.UpdateTimeStep(step / RATE)
        seconds += time.perf_counter() - start
        files.append({"name": f"{name}_{step:04}.vtp", "time": step / RATE})
        writer.SetFileName(str(folder / files[-1]["name"]))
        writer.Write()
        if step in pictured:
            balls.append([ball_actor(make_particles(*frame), radius), *solids])
            skins.append([skin_actor(surface.GetOutput()), *solids])
    text = json.dumps({"file-series-version": "1.0", "files": files})
    (folder / f"{name}.vtp.series").write_text(text)  # for ParaView
    picture = folder / f"{name}.png"
    write_film_strip(picture, balls, skins, view=(0.4, 0.5, 1), width=width, floor=floor)
    print(f"{len(files) / seconds:.1f} frames/s; wrote {folder / name}.vtp.series and {picture}")
