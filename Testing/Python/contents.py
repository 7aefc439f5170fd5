"""Contents of data objects and files as one hash: names, types and raw bytes in a fixed order.

Omitted are values that may differ for the same content: MTimes, compression, random ids, and the
version of this package.
"""

import hashlib
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy
from active_implicit_surfaces import vtkActiveEXRReader, vtkActiveVDBReader
from listener import Listener
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

# Metadata of .vdb files and attributes of .exr files that name versions or methods of compression.
OF_THE_WRITER = ("creator", "software", "file_", "compression", "compressionLevel", "zipLevel")


@contextmanager
def no_errors(*algorithms):
    """Turns errors of the algorithms, which VTK only prints, into exceptions."""
    listeners = [Listener(algorithm) for algorithm in algorithms]
    try:
        yield
    finally:
        for listener in listeners:
            listener.stop()
    errors = [error for listener in listeners for error in listener.errors]
    if errors:
        raise RuntimeError(errors[0])


class Contents:
    """Receives data objects one after another; hash() is the hash of all of them.

    A table without rows is an error, and so is a skin or an image without content unless
    may_be_empty is set: a hash of nothing proves nothing.
    """

    def __init__(self):
        self.sum = hashlib.sha256()

    def hash(self):
        return self.sum.hexdigest()

    def text(self, *words):
        self.sum.update(("\0".join(map(str, words)) + "\n").encode())

    def numbers(self, name, numbers):
        numbers = numpy.ascontiguousarray(numbers)
        self.text(name, numbers.dtype.str, *numbers.shape)
        self.sum.update(numbers.tobytes())

    def array(self, array):
        """The type is numpy's, because VTK has several names for integers of 64 bits."""
        count = array.GetNumberOfComponents()
        self.text(array.GetName(), count)
        self.text(*(array.GetComponentName(i) for i in range(count)))
        if array.GetDataTypeAsString() == "string":
            self.text(*(array.GetValue(i) for i in range(array.GetNumberOfValues())))
        else:
            self.numbers("values", vtk_to_numpy(array))

    def arrays(self, data, left_out=()):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetAbstractArray(i)
            if array.GetName() not in left_out:
                self.array(array)

    def all_data(self, data):
        for kind in (vtkDataObject.POINT, vtkDataObject.CELL, vtkDataObject.FIELD):
            self.text("attributes", kind)
            self.arrays(data.GetAttributesAsFieldData(kind), OF_THE_WRITER)
        active = (data.GetPointData().GetScalars(), data.GetPointData().GetNormals())
        # Compares with None: an array without values is false in VTK 9.7.
        self.text(*(None if array is None else array.GetName() for array in active))
        key = vtkDataObject.DATA_TIME_STEP()
        if data.GetInformation().Has(key):
            self.numbers("time", [data.GetInformation().Get(key)])

    def skin(self, data, may_be_empty=False):
        """A vtkPolyData of polygons."""
        if not may_be_empty:
            assert data.GetNumberOfPoints() > 0 and data.GetNumberOfPolys() > 0, "no skin"
        assert data.GetNumberOfCells() == data.GetNumberOfPolys()
        self.points(data)
        polys = data.GetPolys()
        for name, ids in (
            ("offsets", polys.GetOffsetsArray()),
            ("connectivity", polys.GetConnectivityArray()),
        ):
            self.numbers(name, vtk_to_numpy(ids).astype(numpy.int64))

    def points(self, data):
        if data.GetPoints():
            self.array(data.GetPoints().GetData())
        self.all_data(data)

    def image(self, image, may_be_empty=False):
        if not may_be_empty:
            assert image.GetPointData().GetNumberOfArrays() > 0, "no array"
            assert image.GetNumberOfPoints() > 0, "no points"
        self.numbers("extent", numpy.array(image.GetExtent(), numpy.int64))
        self.numbers("origin", image.GetOrigin())
        self.numbers("spacing", image.GetSpacing())
        turned = image.GetDirectionMatrix()
        self.numbers("direction", [turned.GetElement(i, j) for i in range(3) for j in range(3)])
        self.all_data(image)

    def table(self, table):
        assert table.GetNumberOfRows() > 0, "no rows"
        self.arrays(table.GetRowData())

    def outputs(self, surface, may_be_empty=False):
        self.skin(surface.GetOutput(), may_be_empty)
        self.table(surface.GetHistory())

    def function(self, function, lattice):
        values = [function.FunctionValue(*point) for point in lattice]
        assert min(values) < 0.0 < max(values), "the same side everywhere"
        self.numbers("values", values)
        slopes = numpy.zeros((len(lattice), 3))
        for slope, point in zip(slopes, lattice):
            slope[:] = function.FunctionGradient(*point)
        self.numbers("slopes", slopes)

    def vdb(self, path):
        reader = vtkActiveVDBReader()
        reader.SetFileName(str(path))
        with no_errors(reader):
            reader.UpdateInformation()
            assert reader.GetNumberOfGrids() > 0, "no grids"
            self.metadata(reader.GetAllMetadata())
            for i in range(reader.GetNumberOfGrids()):
                self.vdb_grid(reader, i)

    def vdb_grid(self, reader, i):
        name = reader.GetGridName(i)
        self.text(name, reader.GetGridType(i), reader.GetGridClass(i), reader.GetGridIsHalfFloat(i))
        self.text(reader.GetGridActiveVoxels(i))
        self.metadata(reader.GetAllGridMetadata(i))
        box = [0] * 6
        reader.GetGridBox(i, box)
        self.text(*box)
        reader.SetGridName(name)
        reader.Update()
        self.image(reader.GetImageOutput())

    def metadata(self, text):
        self.text(*sorted(line for line in text.splitlines() if not line.startswith(OF_THE_WRITER)))

    def exr(self, path):
        reader = vtkActiveEXRReader()
        reader.SetFileName(str(path))
        with no_errors(reader):
            reader.Update()
        for i in range(reader.GetNumberOfChannels()):
            self.text(reader.GetChannelName(i), reader.GetChannelType(i))
        self.image(reader.GetOutput())

    @contextmanager
    def file(self, name, decode):
        """Yields the path of a file to write, then passes the file to `decode`, the method vdb
        or exr."""
        with TemporaryDirectory() as folder:
            path = Path(folder) / name
            yield str(path)
            decode(path)
