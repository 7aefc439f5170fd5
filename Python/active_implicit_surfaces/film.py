"""Films of skins: numbered pictures (.png, .exr with layers), .mp4 through ffmpeg, .ogv."""

from __future__ import annotations

import importlib
import shutil
import subprocess
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from .display import find_display
from .file_names import names_of, replacing, suffix_of
from .messages import quiet
from .runner import Sink
from .scene import Scene
from .times import rate_of

FILM_SUFFIXES = (".mp4", ".ogv", ".png", ".exr")


def check_film(path: Path) -> None:
    """Raises an error if a film cannot be written.

    - ValueError: the format is unknown.
    - OSError: VTK needs a display, but there is none; or the program ffmpeg is missing (.mp4).
    - ImportError: VTK or this build lacks a module that `render` needs (.exr).
    """
    suffix = suffix_of(path)
    if suffix not in FILM_SUFFIXES:
        raise ValueError(f"{path}: films are written as {', '.join(FILM_SUFFIXES)}.")
    if suffix == ".mp4" and shutil.which("ffmpeg") is None:
        raise OSError(
            f"{path} needs the program ffmpeg, which is not on PATH; install it (Debian: ffmpeg), "
            f"or write {path.with_suffix('')}.####.png."
        )
    if suffix == ".exr":
        importlib.import_module(".render", __package__)  # ImportError if this VTK lacks it
    find_display()


class Film(Sink):
    """Writes a film or numbered pictures of a series of skins.

    - path (Path): film.mp4, film.ogv, picture.####.png or picture.####.exr.
    - times (list of float): times of the pictures [time].
    - numbers (list of int): frame numbers, for the names of pictures.
    - fps (float, optional): frames per second [1/time]; an .ogv has a whole number. Default: the
      mean frame rate of `times` if the rate is 1 to 240, else 25.
    - time_scale (float): factor of the intervals of `times`, for the motion in an .exr. Default: 1.
    """

    def __init__(
        self,
        path: Path,
        scene: Scene,
        times: list[float],
        numbers: list[int],
        fps: float | None = None,
        time_scale: float = 1.0,
    ) -> None:
        self.path, self.scene, self.times = path, scene, times
        self.time_scale = time_scale
        self.fps = fps or rate_of(times)
        self.names = names_of(path, numbers)
        self._stream: Any = None
        self._ending = ExitStack()

    def __enter__(self) -> Film:
        kinds = {".mp4": _Ffmpeg, ".ogv": _Ogg}
        kind = kinds.get(suffix_of(self.path))
        if kind is not None:
            temporary = self._ending.enter_context(replacing(self.path))
            self._stream = kind(self.path, temporary, self.scene.size, self.fps)
            self._ending.push(lambda error, *_: self._stream.close(error is None))
        return self

    def __exit__(self, *error: Any) -> None:
        self._ending.__exit__(*error)

    def add(self, step: int, skin: Any) -> None:
        """Renders the skin of a step, and writes the picture."""
        self.scene.show(skin)
        if self._stream is not None:
            self._stream.write(self.scene.picture())
        elif suffix_of(self.path) == ".png":
            _write_png(self.names[step], self.scene.picture())
        else:
            self._write_exr(self.names[step], step)

    def _write_exr(self, path: Path, step: int) -> None:
        from . import render, vtkActiveEXRWriter

        # Interval to the next frame; for the last frame, the interval before it.
        way = self.times[min(step, len(self.times) - 2) :][:2]
        writer = vtkActiveEXRWriter()
        writer.SetFramesPerSecond(self.fps)
        with replacing(path) as temporary:
            render.write_exr(
                self.scene.window,
                temporary,
                frame_duration=self.time_scale * (way[-1] - way[0] or 1.0 / self.fps),
                writer=writer,
                apart=self.scene.apart,
            )


def _write_png(path: Path, image: Any) -> None:
    from vtkmodules.vtkIOImage import vtkPNGWriter

    writer = vtkPNGWriter()
    writer.SetInputData(image)
    with replacing(path) as temporary, quiet():
        writer.SetFileName(str(temporary))
        writer.Write()
        if writer.GetErrorCode() or not temporary.exists():
            raise OSError(f"{path} cannot be written; check the folder and its free space.")


class _Ffmpeg:
    """Pipes raw pictures into the program ffmpeg."""

    def __init__(self, path: Path, temporary: Path, size: tuple[int, int], fps: float) -> None:
        self.path = path
        source = f"-f rawvideo -pix_fmt rgb24 -s {size[0]}x{size[1]} -r {fps:g} -i -"
        coded = "-vf vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2 -c:v libx264 -crf 18 -pix_fmt yuv420p"
        command = f"ffmpeg -y -loglevel error {source} {coded} -movflags +faststart".split()
        self.process = subprocess.Popen(
            [*command, str(temporary)], stdin=subprocess.PIPE, stderr=subprocess.PIPE
        )

    def write(self, image: Any) -> None:
        assert self.process.stdin is not None
        try:
            pixels = vtk_to_numpy(image.GetPointData().GetScalars())
            self.process.stdin.write(numpy.ascontiguousarray(pixels[:, :3]).tobytes())
        except BrokenPipeError:
            pass  # close() reports the reason

    def close(self, is_whole: bool) -> None:
        try:
            _, said = self.process.communicate()
        except BrokenPipeError:
            said = b""
        if self.process.returncode and is_whole:
            words = " ".join(said.decode(errors="replace").split())
            raise OSError(f"{self.path} cannot be written: ffmpeg says: {words or 'nothing'}.")


class _Ogg:
    """Ogg Theora film, written by VTK."""

    def __init__(self, path: Path, temporary: Path, size: tuple[int, int], fps: float) -> None:
        try:
            from vtkmodules.vtkIOOggTheora import vtkOggTheoraWriter
        except ImportError as error:
            raise OSError(f"{path}: this VTK cannot write .ogv; write .mp4 or pictures.") from error
        self.path, self.writer, self.started = path, vtkOggTheoraWriter(), False
        self.temporary = temporary
        self.writer.SetFileName(str(temporary))
        self.writer.SetRate(max(1, round(fps)))
        self.writer.SetQuality(2)

    def write(self, image: Any) -> None:
        self.writer.SetInputData(image)
        if not self.started:
            self.writer.Start()
            self.started = True
        self.writer.Write()

    def close(self, is_whole: bool) -> None:
        if self.started:
            self.writer.End()
        failed = not self.started or self.writer.GetErrorCode() or not _is_whole(self.temporary)
        if is_whole and failed:
            raise OSError(f"{self.path} cannot be written; check the folder and its free space.")


def _is_whole(path: Path) -> bool:
    """Returns True if an .ogv consists of pages (RFC 3533), of which the last ends the film.

    VTK's writer does not report a full disk.
    """
    flags = 0
    with path.open("rb") as file:
        while len(head := file.read(27)) == 27 and head[:4] == b"OggS":
            flags, lengths = head[5], file.read(head[26])
            if len(lengths) < head[26] or len(file.read(sum(lengths))) < sum(lengths):
                return False
    return not head and bool(flags & 4)
