#include "Grids/ImageReading.h"

#include "Grids/ArrayValues.h"
#include "Input/AttachedGrid.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <tbb/parallel_for.h>

#include <memory>
#include <sstream>
#include <stdexcept>
#include <type_traits>

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

template <class Grid>
vtkSmartPointer<vtkDataArray> Fill(const Grid& grid, const int extent[6], int factor)
{
  using Value = typename Grid::ValueType;
  using Traits = openvdb::VecTraits<Value>;
  using Stored = std::conditional_t<Traits::IsVec, Value, StoredNumber<Value>>;
  auto array = MakeArrayOf<typename Traits::ElementType>();
  array->SetNumberOfComponents(Traits::Size);
  const vtkIdType row = vtkIdType(extent[1]) - extent[0] + 1;
  const vtkIdType plane = row * (vtkIdType(extent[3]) - extent[2] + 1);
  array->SetNumberOfTuples(plane * (vtkIdType(extent[5]) - extent[4] + 1));
  auto values = static_cast<Stored*>(array->GetVoidPointer(0));
  tbb::parallel_for(extent[4], extent[5] + 1,
    [&](int z)
    {
      auto reader = grid.getConstUnsafeAccessor();
      Stored* value = values + (vtkIdType(z) - extent[4]) * plane;
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        for (int x = extent[0]; x <= extent[1]; ++x)
        {
          *value++ = reader.getValue(openvdb::Coord(x * factor, y * factor, z * factor));
        }
      }
    });
  return array;
}

// Calls Fill with the grid's actual type, if it is one of these types.
template <class Grid, class... Others>
vtkSmartPointer<vtkDataArray> Dispatch(
  const openvdb::GridBase& grid, const int extent[6], int factor)
{
  if (grid.isType<Grid>())
  {
    return Fill(static_cast<const Grid&>(grid), extent, factor);
  }
  if constexpr (sizeof...(Others) > 0)
  {
    return Dispatch<Others...>(grid, extent, factor);
  }
  throw std::invalid_argument(
    "The grid \"" + grid.getName() + "\" of type " + grid.type() + " cannot become an image.");
}

// Returns the values of every `factor`th voxel in an extent. Throws std::invalid_argument for grids
// of other types than numbers and vectors.
vtkSmartPointer<vtkDataArray> MakeImageArray(
  const openvdb::GridBase& grid, const int extent[6], int factor)
{
  using namespace openvdb;
  return Dispatch<FloatGrid, DoubleGrid, Int32Grid, Int64Grid, BoolGrid, MaskGrid, Vec3SGrid,
    Vec3DGrid, Vec3IGrid>(grid, extent, factor);
}

}

void ReadImage(const ChosenGrids& chosen, const ImageRequest& request, vtkImageData* image)
{
  const openvdb::math::Transform& transform = *chosen.Grids.front().Transform;
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
  for (const VDBGrid& facts : chosen.Grids)
  {
    const openvdb::GridBase::Ptr grid =
      ReadVDBGrid(chosen.FileName, facts, request.IsPart ? &part : nullptr);
    if (request.IsDense && image->GetNumberOfPoints() > 0)
    {
      const auto array = MakeImageArray(*grid, place.Extent, factor);
      array->SetName(facts.Name.c_str());
      image->GetPointData()->AddArray(array);
    }
    if (&facts == &chosen.Grids.front())
    {
      Attach(image->GetInformation(), AsLevelSet(grid));
    }
  }
  ActivateFirstArray(image->GetPointData());
}

}
