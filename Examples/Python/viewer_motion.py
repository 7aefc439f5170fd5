"""The skins that viewer.py shows: a whole motion, and a coarse preview of a frame."""

import active_implicit_surfaces as active
from active_implicit_surfaces.particle_files import open_particles
from active_implicit_surfaces.presets import estimate_spacing
from active_implicit_surfaces.series import TemporalSource

# By property: least, greatest and first value of its slider, and the slider's unit.
SLIDERS = {
    "particle_spacing": (0.5, 2.0, 1.0, lambda v: v["estimated_spacing"]),
    "kernel_radius": (1.5, 4.0, 2.25, lambda v: v["particle_spacing"]),
    "voxel_size": (0.5, 4.0, 1.0, lambda v: 0.5 * v["particle_spacing"]),
    "attraction": (0.25, 12.0, 6.0, lambda v: 1.0 / v["interval"]),
    "transport": (0.0, 1.0, 1.0, lambda v: 1.0),
    "tension": (0.0, 4.0, 0.0, lambda v: v["attraction"] * (0.5 * v["particle_spacing"]) ** 2),
}
COARSE, RUN_UP = 2.0, 3  # of a preview: factor of the voxels, and frames before the one shown


class Motion:
    """Skins of a series of files for the values of the sliders. `skins` holds the finished ones."""

    def __init__(self, files):
        self.files = open_particles(files)
        self.times, count = self.files.times, len(self.files)
        if count < 2:
            raise ValueError("The viewer needs a series of at least two frames.")
        self._data = {
            "estimated_spacing": self._estimate_spacing(),
            "interval": (self.times[-1] - self.times[0]) / (count - 1),
        }
        self.sliders = {name: first for name, (_, _, first, _) in SLIDERS.items()}
        self.restart()

    def restart(self):
        """Restarts at the first frame."""
        self.skins, self._has_stopped = [], False
        self._run = active.frames(self._source(0, len(self.times)), **self._options())
        self._coming = iter(self._run)

    def stop(self):
        """Stops the motion: no more skins are made until the next restart."""
        self._has_stopped = True

    def is_whole(self):
        """Returns True if there are no more skins to make."""
        return self._has_stopped or len(self.skins) == len(self.times)

    def advance(self):
        """Makes the skin of the next frame."""
        self.skins.append(next(self._coming).skin)

    def preview(self, step):
        """Returns a quick approximation of a frame's skin: coarse, and from a motion that begins
        RUN_UP frames before the frame, or at the first frame."""
        first = max(0, step - RUN_UP)
        options = {**self._options(), "voxel_size": COARSE * self.values()["voxel_size"]}
        # The motion of the particles at `step` needs the next frame too.
        run = iter(active.frames(self._source(first, step + 2), **options))
        for _ in range(first, step):
            next(run)
        return next(run).skin

    def values(self):
        """Returns the properties of the sliders in the units of the data."""
        found = dict(self._data)
        for name, (_, _, _, one) in SLIDERS.items():
            found[name] = self.sliders[name] * one(found)
        return {name: found[name] for name in SLIDERS}

    def volumes(self):
        """Returns the pairs (time, volume) of the finished skins."""
        if not self.skins:
            return []
        table = self._run.surface.GetHistory()
        times, volumes = (table.GetColumnByName(name) for name in ("Time", "Volume"))
        return [(times.GetValue(i), volumes.GetValue(i)) for i in range(table.GetNumberOfRows())]

    def _estimate_spacing(self):
        """Returns the estimated spacing of the first frame that has at least two particles."""
        found = (estimate_spacing(self.files.load(step)) for step in range(len(self.times)))
        spacing = next((one for one in found if one > 0), 0.0)
        if spacing == 0:
            raise ValueError("The viewer needs particles, and no frame has two of them.")
        return spacing

    def _source(self, first, last):
        return TemporalSource(lambda i: self.files.load(first + i), self.times[first:last])

    def _options(self):
        """Returns the changed properties, and always the sliders' spacing and voxel size.
        The filter chooses the other properties."""
        changed = {name for name, slider in SLIDERS.items() if self.sliders[name] != slider[2]}
        wanted = changed | {"particle_spacing", "voxel_size"}
        return {name: value for name, value in self.values().items() if name in wanted}
