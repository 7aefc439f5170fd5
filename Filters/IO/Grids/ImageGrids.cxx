#include "Grids/ImageGrids.h"

#include "Base/OpenVDB.h"
#include "Grids/ArrayValues.h"
#include "Surface/SkinDistance.h"

#include "vtkImageData.h"
#include "vtkMatrix3x3.h"

#include <openvdb/tools/Dense.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace activesurface
{

namespace
{

openvdb::CoordBBox GetBox(vtkImageData* image)
{
  int extent[6];
  image->GetExtent(extent);
  return { { extent[0], extent[2], extent[4] }, { extent[1], extent[3], extent[5] } };
}

template <class Value>
openvdb::GridBase::Ptr Copy(vtkImageData* image, vtkDataArray* array, const Value& background)
{
  using Tree = typename openvdb::FloatTree::ValueConverter<Value>::Type;
  const vtkIdType count = image->GetNumberOfPoints();
  std::vector<Value> values(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    values[i] = GetValue<Value>(array, i);
  }
  const openvdb::tools::Dense<Value, openvdb::tools::LayoutXYZ> dense(GetBox(image), values.data());
  auto grid = openvdb::Grid<Tree>::create(background);
  openvdb::tools::copyFromDense(dense, *grid, openvdb::zeroVal<Value>());
  // copyFromDense treats NaN as background, so these values are set here.
  auto accessor = grid->getAccessor();
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (values[i] != values[i])
    {
      accessor.setValue(dense.offsetToCoord(i), values[i]);
    }
  }
  return grid;
}

// Makes a level set whose values beyond the band are inactive. NaN is kept.
openvdb::GridBase::Ptr CopyLevelSet(vtkImageData* image, vtkDataArray* array)
{
  const double* spacing = image->GetSpacing();
  constexpr double rounding = 1e-6;
  const bool isCubic = std::fabs(spacing[1] - spacing[0]) <= rounding * spacing[0] &&
    std::fabs(spacing[2] - spacing[0]) <= rounding * spacing[0];
  if (array->GetNumberOfComponents() != 1 || !isCubic)
  {
    throw std::invalid_argument("GridClass LEVEL_SET needs an image of one component and equal, "
                                "positive spacing along all axes; choose another GridClass.");
  }
  const auto background = static_cast<float>(HalfWidth * spacing[0]);
  auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(Copy<float>(image, array, background));
  for (auto value = grid->beginValueOn(); value; ++value)
  {
    if (std::fabs(*value) >= background)
    {
      value.setValue(std::copysign(background, *value));
      value.setValueOff();
    }
  }
  openvdb::tools::pruneLevelSet(grid->tree());
  return grid;
}

openvdb::math::Transform::Ptr MakeImageTransform(vtkImageData* image)
{
  const double* origin = image->GetOrigin();
  const double* spacing = image->GetSpacing();
  openvdb::Mat4d matrix = openvdb::Mat4d::identity();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int d = 0; d < 3; ++d)
    {
      matrix(axis, d) = image->GetDirectionMatrix()->GetElement(d, axis) * spacing[axis];
    }
    matrix(3, axis) = origin[axis];
  }
  const double* const first = matrix.asPointer();
  if (!std::all_of(first, first + 16, [](double x) { return std::isfinite(x); }))
  {
    throw std::invalid_argument("The image cannot be placed in a .vdb file: its origin, spacing or "
                                "direction matrix is not finite; correct it.");
  }
  try
  {
    return openvdb::math::Transform::createLinearTransform(matrix);
  }
  catch (const openvdb::Exception&)
  {
    throw std::invalid_argument(
      "The image cannot be placed in a .vdb file: a spacing is 0, the direction matrix has no "
      "inverse, or the volume of a voxel is below about 3e-15; correct the spacing or the matrix, "
      "or scale the scene up.");
  }
}

}

openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind)
{
  if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument(std::string("The point array \"") +
      (array->GetName() ? array->GetName() : "") +
      "\" of the image does not have one value for each point; remove the array.");
  }
  openvdb::GridBase::Ptr grid;
  if (kind == openvdb::GRID_LEVEL_SET)
  {
    grid = CopyLevelSet(image, array);
  }
  else
  {
    DispatchValues(array, [&](auto zero) { grid = Copy<decltype(zero)>(image, array, zero); });
  }
  grid->setGridClass(kind);
  grid->setName(array->GetName() ? array->GetName() : "density");
  grid->setTransform(MakeImageTransform(image));
  return grid;
}

}
