#include "Grids/ImageReading.h"

#include "AttachedGrid.h"
#include "Grids/GridChoice.h"
#include "Grids/ImageArrays.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"

#include <memory>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

openvdb::FloatGrid::ConstPtr AsLevelSet(const openvdb::GridBase::Ptr& grid)
{
  if (grid->getGridClass() != openvdb::GRID_LEVEL_SET)
  {
    return nullptr;
  }
  const auto wide = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid);
  return wide ? std::make_shared<openvdb::FloatGrid>(*wide)
              : openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
}

void Place(const ImagePlace& place, vtkImageData* image)
{
  image->SetExtent(const_cast<int*>(place.Extent));
  image->SetOrigin(place.Origin);
  image->SetSpacing(place.Spacing);
  image->SetDirectionMatrix(place.Direction);
}

void CheckSize(const ImagePlace& place, const ImageRequest& request)
{
  if (request.IsDense && place.CountPoints() > static_cast<double>(request.MaximumNumberOfPoints))
  {
    std::ostringstream text;
    text << "The dense image would have " << place.CountPoints() << " points, more than "
         << "MaximumNumberOfPoints; choose a smaller Region, a DownsamplingFactor, or OutputDense "
         << "off, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

void ActivateFirstArray(vtkPointData* arrays)
{
  vtkDataArray* first = arrays->GetArray(0);
  if (first && first->GetNumberOfComponents() == 3)
  {
    arrays->SetVectors(first);
  }
  else if (first)
  {
    arrays->SetScalars(first);
  }
}

}

void ReadImage(const VDBSeries& series, const ImageRequest& request, vtkImageData* image)
{
  const openvdb::math::Transform& transform = *series.GetChosen().front().Transform;
  const int factor = request.DownsamplingFactor;
  const ImagePlace place = MakeImagePlace(transform, request.Box, factor);
  CheckSize(place, request);
  openvdb::BBoxd part;
  if (request.IsPart)
  {
    openvdb::CoordBBox box = request.Box;
    box.expand(factor);
    part = transform.indexToWorld(box);
  }
  Place(place, image);
  for (const VDBGrid& chosen : series.GetChosen())
  {
    const openvdb::GridBase::Ptr grid =
      ReadVDBGrid(series.GetFileName(), chosen, request.IsPart ? &part : nullptr);
    if (request.IsDense && image->GetNumberOfPoints() > 0)
    {
      const auto array = MakeImageArray(*grid, place.Extent, factor);
      array->SetName(chosen.Name.c_str());
      image->GetPointData()->AddArray(array);
    }
    if (&chosen == &series.GetChosen().front())
    {
      Attach(image->GetInformation(), AsLevelSet(grid));
    }
  }
  ActivateFirstArray(image->GetPointData());
}

}
