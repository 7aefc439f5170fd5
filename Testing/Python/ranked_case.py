"""A random case (random_checks.py) on ranks of MPI. All ranks do the operations; failures and
aborts happen on one rank. A new filter in one process gives the same bytes."""

import tempfile
from contextlib import contextmanager
from pathlib import Path
from unittest import TestCase

from active_implicit_surfaces import vtkActiveImplicitSurface
from listener import sentence_of
from random_checks import Case
from random_shapes import PARTICLES, Source, rows_of
from ranks import Pipeline, at_random, in_blocks, outputs_of
from ranks_checks import assert_same_outputs
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

NAMES_OF_PARTICLES = {kind.__name__ for kind in PARTICLES}


def dealt(points, owners, step, piece, pieces):
    """The particles of a piece."""
    rows = owners(step, points.GetNumberOfPoints(), pieces) == piece
    return rows_of(points, rows.nonzero()[0].tolist())


class DealtSource(Source):
    def __init__(self, steps, owners):
        super().__init__(steps)
        self.owners = owners

    def RequestInformation(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
        return super().RequestInformation(request, inputs, outputs)

    def RequestData(self, request, inputs, outputs):
        information = outputs.GetInformationObject(0)
        done = super().RequestData(request, inputs, outputs)
        if done:
            output = vtkPolyData.GetData(outputs)
            piece = information.Get(Pipeline.UPDATE_PIECE_NUMBER())
            pieces = information.Get(Pipeline.UPDATE_NUMBER_OF_PIECES())
            time = output.GetInformation().Get(output.DATA_TIME_STEP())
            output.ShallowCopy(dealt(output, self.owners, time, piece, pieces))
            output.GetInformation().Set(output.DATA_TIME_STEP(), time)
        return done


class CaseAlone(Case):
    """A case in one process, within a program on ranks."""

    def new_surface(self):
        surface = vtkActiveImplicitSurface()
        surface.SetController(None)
        return surface


class RankedCase(Case):
    """A case on all ranks; `random` draws the same numbers on each rank."""

    def __init__(self, case, ranks, random):
        self.ranks = ranks
        self.random = random
        super().__init__(case)

    def part_of(self, role, shape, arrays):
        """Returns the rank's part of a shape; particles without ids keep their order, by blocks."""
        rank, size = self.ranks.rank, self.ranks.size
        owners = at_random if 1 in arrays else in_blocks
        are_particles = role == "target" and self.shapes[role][0] in NAMES_OF_PARTICLES
        if are_particles and isinstance(shape, Source) and shape.OutputType == "vtkPolyData":
            return DealtSource(shape.steps, owners)
        if are_particles and isinstance(shape, vtkPolyData):
            return dealt(shape, owners, 0, rank, size)
        if rank == 0 or not isinstance(shape, (vtkDataObject, Source)):
            return shape
        if isinstance(shape, vtkDataObject):
            return shape.NewInstance()
        return Source({time: data.NewInstance() for time, data in shape.steps.items()})

    def is_struck(self):
        return self.random.randrange(self.ranks.size) == self.ranks.rank

    def is_first(self):
        return self.ranks.rank == 0

    def is_so_on_any(self, is_so):
        return self.ranks.allreduce(int(is_so)) > 0

    def wait(self):
        self.ranks.barrier()

    @contextmanager
    def folder(self):
        own = tempfile.TemporaryDirectory() if self.is_first() else None
        yield Path(self.ranks.bcast(own and own.name))
        self.wait()
        if own:
            own.cleanup()

    def do(self, name, *arguments):
        threads = [self.random.randint(1, 2) for _ in range(self.ranks.size)]
        self.surface.SetNumberOfThreads(threads[self.ranks.rank])
        self.surface.Modified()  # on all, or those without a change would not come
        super().do(name, *arguments)

    def do_piece(self, time, piece, pieces):
        """Updates the piece of this rank in place of `piece`, as ParaView does."""
        self.time = time
        self.update(time, self.ranks.rank, self.ranks.size)
        self.check_messages()

    def do_abort(self, count, time):
        super().do_abort(count, time)
        self.surface.Modified()  # on all ranks, as on the one that has stopped

    def check_outputs(self):
        """Checks that apply to a part of a skin."""
        if self.is_first():
            self.check_limits()
        self.counts["skins"] += self.is_so_on_any(self.surface.GetOutput().GetNumberOfPoints() > 0)

    def check_fresh(self):
        own = (outputs_of(self.surface), self.listener.errors)
        every = self.ranks.gather(own)
        failure = self.find_difference(every) if self.is_first() else None
        failure = self.ranks.bcast(failure)
        assert not failure, failure

    def find_difference(self, every):
        fresh = CaseAlone({**self.shapes, "properties": self.properties})
        fresh.request(self.time)
        errors = [sentence_of(errors[0]) if errors else "" for _, errors in every]
        expected = [sentence_of(error) for error in fresh.listener.errors] or [""]
        # After the limit was reduced, a fresh filter fails, but the ranks keep their skin.
        if "MaximumNumberOfActiveVoxels" in "".join((*errors, *expected)):
            return ""
        if any(error != expected[0] for error in errors):
            return f"a fresh filter says {expected[0]!r}, the ranks {errors}"
        try:
            kept = [outputs for outputs, _ in every]
            assert_same_outputs(TestCase(), kept, [outputs_of(fresh.surface)], "a fresh filter")
        except AssertionError as difference:
            return str(difference)
        return ""
