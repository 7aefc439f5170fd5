#include "SurfaceOutput.h"

#include "NarrowBand.h"
#include "PotentialImage.h"
#include "Skin.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

namespace activesurface
{

void FillSkin(const NarrowBand& band, bool normals, vtkPolyData* skin)
{
  const Skin triangles(band);
  const auto points = static_cast<vtkIdType>(triangles.GetNumberOfPoints());
  const auto count = static_cast<vtkIdType>(triangles.GetNumberOfTriangles());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(points);
  vtkNew<vtkFloatArray> directions;
  directions->SetName("Normals");
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(normals ? points : 0);
  vtkNew<vtkTypeInt64Array> corners;
  corners->SetNumberOfValues(3 * count);
  triangles.Write(coordinates->GetPointer(0), normals ? directions->GetPointer(0) : nullptr,
    reinterpret_cast<std::int64_t*>(corners->GetPointer(0)));

  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(count + 1);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, 3 * i);
  }
  vtkNew<vtkPoints> vertices;
  vertices->SetData(coordinates);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, corners);
  skin->SetPoints(vertices);
  skin->SetPolys(cells);
  if (normals)
  {
    skin->GetPointData()->SetNormals(directions);
  }
}

void FillPotential(const NarrowBand& band, const int extent[6], vtkImageData* potential)
{
  const double spacing = band.GetVoxelSize();
  potential->SetExtent(const_cast<int*>(extent));
  potential->SetOrigin(0.0, 0.0, 0.0);
  potential->SetSpacing(spacing, spacing, spacing);
  vtkNew<vtkFloatArray> distances;
  distances->SetName("Potential");
  distances->SetNumberOfTuples(potential->GetNumberOfPoints());
  WriteDistances(band, extent, distances->GetPointer(0));
  potential->GetPointData()->SetScalars(distances);
}

}
