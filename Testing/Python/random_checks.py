"""Tries a random case (random_cases.py). After each request the skin is valid and each error is
a message. At the end a new filter gives the same bytes."""

import math
import re
import tempfile
from contextlib import contextmanager
from pathlib import Path

from active_implicit_surfaces import vtkActiveImplicitSurface
from contents import Contents
from listener import Listener, sentence_of
from random_cases import BASE
from random_shapes import Source, make_shape
from same_bytes import POINTS, connect
from skin_checks import check_parts, check_skin, points_of, triangles_of
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

PORTS = {"target": 0, "initial": 1}


class Case:
    def __init__(self, case):
        self.shapes = {role: case[role] for role in ("target", "initial", "obstacle")}
        self.properties = {**BASE, **case["properties"]}
        self.made = {}
        self.surface, self.listener = self.make(self.made)
        self.guards = [self.properties["MaximumNumberOfActiveVoxels"]]
        self.time = None
        self.counts = {"requests": 0, "skins": 0, "refused": 0, "stopped": 0, "failed": 0}

    def new_surface(self):
        return vtkActiveImplicitSurface()

    def part_of(self, role, shape, arrays):
        """Returns the part of a shape in this process."""
        return shape

    def is_struck(self):
        """Returns true if the next failure or abort happens in this process."""
        return True

    def is_first(self):
        """Returns true if this process writes the files that others read."""
        return True

    def is_so_on_any(self, is_so):
        """Returns true if the condition holds in any of the processes."""
        return is_so

    def wait(self):
        """Waits for the other processes."""

    @contextmanager
    def folder(self):
        """Folder shared by all processes."""
        with tempfile.TemporaryDirectory() as folder:
            yield Path(folder)

    def make(self, made):
        surface = self.new_surface()
        listener = Listener(surface)
        for name, value in self.properties.items():
            getattr(surface, "Set" + name)(value)
        for role in self.shapes:
            self.put_shape(surface, made, role)
        return surface, listener

    def put_shape(self, surface, made, role):
        shape, arrays = make_shape(role, self.shapes[role])
        made[role] = self.part_of(role, shape, arrays)
        if role == "obstacle":
            surface.SetObstacleFunction(made[role])
            return
        port = PORTS[role]
        set_function = (surface.SetTargetFunction, surface.SetInitialFunction)[port]
        set_function(None)
        surface.RemoveAllInputConnections(port)
        connect(surface, port, set_function, made[role])
        if isinstance(made[role], Source):
            made["listener"] = Listener(made[role])
        for number, name in arrays.items():
            surface.SetInputArrayToProcess(number, port, 0, POINTS, name)

    def do(self, name, *arguments):
        getattr(self, "do_" + name.replace(" ", "_"))(*arguments)

    def do_time(self, time):
        self.request(time)

    def do_potential(self, time):
        """Updates only the image of the potential, at a time of its own. History and skin function
        then have the image's time, while the skin keeps its time: Modified() ends this state."""
        self.listener.forget()
        self.surface.UpdateInformation()
        key = Pipeline.UPDATE_TIME_STEP()
        self.surface.GetOutputInformation(1).Set(key, time)
        self.surface.Update(1)
        self.check_messages()
        values = self.surface.GetPotential().GetPointData().GetScalars()
        if values:
            assert all(map(math.isfinite, vtk_to_numpy(values))), "the potential is not finite"
        self.surface.Modified()

    def do_piece(self, time, piece, pieces):
        """Checks that pieces other than the first are empty."""
        self.update(time, piece, pieces)
        self.check_messages()
        if not self.listener.errors:
            self.check_time(time)
        if piece > 0:
            assert self.surface.GetOutput().GetNumberOfPoints() == 0, "another piece has points"

    def update(self, time, piece=0, pieces=1):
        self.listener.forget()
        self.surface.UpdateTimeStep(time, piece, pieces, 0)

    def do_put(self, name, value):
        self.properties[name] = value
        getattr(self.surface, "Set" + name)(value)
        self.guards.append(self.properties["MaximumNumberOfActiveVoxels"])

    def do_initial(self, shape):
        self.shapes["initial"] = shape
        self.put_shape(self.surface, self.made, "initial")

    def do_obstacle(self, shape):
        self.shapes["obstacle"] = shape
        self.put_shape(self.surface, self.made, "obstacle")

    def do_save_and_load(self):
        self.update(self.time or 0.0)
        with self.folder() as folder:
            file = str(folder / "state.vdb")
            self.listener.forget()
            if self.surface.SaveState(file):
                assert self.surface.LoadState(file), "what was saved cannot be loaded"
            self.check_messages()
        self.update(self.time or 0.0)

    def do_abort(self, count, time):
        left = [count]
        is_struck = self.is_struck()

        def on_progress(surface, event):
            left[0] -= 1
            if left[0] == 0 and is_struck:
                surface.AbortExecuteOn()

        observer = self.surface.AddObserver("ProgressEvent", on_progress)
        self.update(time)
        self.surface.RemoveObserver(observer)
        self.surface.AbortExecuteOff()
        self.check_messages()
        self.counts["stopped"] += self.is_so_on_any(is_struck and left[0] <= 0)

    def do_fail(self, time):
        """Makes the input fail, if the request executes the input."""
        source = self.made["target"]
        if isinstance(source, Source):
            source.fails = self.is_struck()
            self.update(time)
            source.fails = False
            self.check_messages()
            self.counts["failed"] += self.surface.GetOutput().GetNumberOfPoints() == 0

    def do_refuse(self, name, value, time):
        self.do_put(name, float(value) if isinstance(value, str) else value)
        self.request(time)
        left = {**BASE, **self.properties}
        left[name] = BASE.get(name, getattr(vtkActiveImplicitSurface(), "Get" + name)())
        self.do_put(name, left[name])

    def do_no_target(self, time):
        self.surface.SetTargetFunction(None)
        self.surface.RemoveAllInputConnections(0)
        self.update(time)
        self.check_is_refused()
        self.put_shape(self.surface, self.made, "target")

    def do_no_file(self, time):
        self.listener.forget()
        assert not self.surface.LoadState("/absent/state.vdb")
        self.check_messages(1)

    def do_no_folder(self, time):
        self.listener.forget()
        assert not self.surface.SaveState("/absent/state.vdb")
        self.check_messages(1)

    def do_damage(self, time):
        with self.folder() as folder:
            file = folder / "state.vdb"
            is_saved = self.surface.SaveState(str(file))
            if self.is_first():
                file.write_bytes(file.read_bytes()[:-7] if is_saved else b"no state")
            self.wait()
            self.listener.forget()
            assert not self.surface.LoadState(str(file))
            self.check_messages(1)

    def set_back(self, scene):
        """Restores the initial properties and shapes of a scene."""
        defaults = vtkActiveImplicitSurface()
        wanted = {**BASE, **scene["properties"]}
        for name in self.properties:
            self.do_put(name, wanted.get(name, getattr(defaults, "Get" + name)()))
        self.do_initial(scene.get("initial"))
        self.do_obstacle(scene.get("obstacle"))

    def request(self, time):
        self.time = time
        self.counts["requests"] += 1
        self.update(time)
        self.check_messages()
        if self.listener.errors:
            self.check_is_refused()
            return
        self.check_time(time)
        self.check_outputs()

    def check_outputs(self):
        check_skin(self.surface, self.find_voxel())
        self.check_limits()
        self.check_last_row()
        self.counts["skins"] += self.surface.GetOutput().GetNumberOfPoints() > 0

    def find_voxel(self):
        return self.properties["VoxelSize"] or self.properties.get("ParticleSpacing", 0.0) / 2

    def check_messages(self, least=0):
        listener = self.listener
        assert least <= len(listener.errors) <= 1, f"{len(listener.errors)} errors"
        for text in (*listener.errors, *listener.warnings):
            said = sentence_of(text)
            assert re.match(r"[A-Z].*[.?)]$", said, re.S), f"not a sentence: {said!r}"
            assert "memory" not in said, said

    def check_is_refused(self):
        self.counts["refused"] += 1
        self.check_messages(1)
        assert self.surface.GetOutput().GetNumberOfPoints() == 0, "an error, and a skin"
        assert self.surface.GetHistory().GetNumberOfRows() == 0, "an error, and a history"

    def check_time(self, time):
        """Checks the skin's time: the requested time, limited to the range of the steps. If a step
        is nearer than 1e-6 of an interval, the skin has the time of this step."""
        information = self.surface.GetOutput().GetInformation()
        key = self.surface.GetOutput().DATA_TIME_STEP()
        steps = self.surface.GetOutputInformation(0).Get(Pipeline.TIME_STEPS())
        if not steps:
            assert not information.Has(key), "a time of what has none"
            return
        wanted = min(max(time, steps[0]), steps[-1])
        near = [
            step
            for interval in zip(steps, steps[1:])
            if interval[0] <= wanted <= interval[1]
            for step in interval
            if abs(step - wanted) <= 1e-6 * (interval[1] - interval[0])
        ]
        expected = near[0] if near else wanted
        told = information.Get(key)
        assert told == expected, f"DATA_TIME_STEP is {told}, asked {time}, steps {steps}"

    def check_limits(self):
        """Checks that active voxels never exceeded the limits during the motion."""
        voxels = vtk_to_numpy(self.surface.GetHistory().GetColumnByName("ActiveVoxels"))
        assert voxels.max() <= max(self.guards), f"{voxels.max()} active voxels"

    def check_last_row(self):
        """Checks the last row against this skin, unless their times are different."""
        history, skin = self.surface.GetHistory(), self.surface.GetOutput()
        information = skin.GetInformation()
        last = history.GetValueByName(history.GetNumberOfRows() - 1, "Time").ToDouble()
        if information.Has(skin.DATA_TIME_STEP()) and last != information.Get(
            skin.DATA_TIME_STEP()
        ):
            return
        check_parts(history, points_of(skin), triangles_of(skin))

    def result(self):
        if self.listener.errors:
            return sentence_of(self.listener.errors[0])
        contents = Contents()
        contents.outputs(self.surface, may_be_empty=True)
        return contents.hash()

    def fresh(self):
        """Result of a new filter that requests only the last time, with another number of
        threads."""
        other = Case({**self.shapes, "properties": self.properties})
        other.surface.SetNumberOfThreads(self.surface.GetNumberOfThreads() % 3 + 1)
        other.request(self.time)
        return other.result()

    def check_fresh(self):
        own, fresh = self.result(), self.fresh()
        # After the limit was reduced, a fresh filter fails, but this one keeps its skin.
        if "MaximumNumberOfActiveVoxels" not in own + fresh:
            assert own == fresh, f"a fresh filter gives {fresh}, this one {own}"


def check(case):
    tried = Case(case)
    for operation in case["operations"]:
        tried.do(*operation)
    tried.check_fresh()
    return tried.counts
