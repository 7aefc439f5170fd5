#include "Grids/ImageArrays.h"

#include "vtkDataArray.h"
#include "vtkType.h"

#include <tbb/parallel_for.h>

#include <stdexcept>
#include <type_traits>

namespace activesurface
{

namespace
{

template <class Element>
constexpr int GetVTKType()
{
  return std::is_same<Element, float>::value ? VTK_FLOAT
    : std::is_same<Element, double>::value   ? VTK_DOUBLE
    : sizeof(Element) == 1                   ? VTK_UNSIGNED_CHAR
    : sizeof(Element) == 4                   ? VTK_INT
                                             : VTK_TYPE_INT64;
}

template <class Grid>
vtkSmartPointer<vtkDataArray> Fill(const Grid& grid, const int extent[6], int factor)
{
  using Value = typename Grid::ValueType;
  using Element = typename openvdb::VecTraits<Value>::ElementType;
  // bool is stored as unsigned char: any byte of a file becomes 0 or 1.
  using Stored = std::conditional_t<std::is_same<Value, bool>::value, unsigned char, Value>;
  constexpr int components = openvdb::VecTraits<Value>::Size;
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(GetVTKType<Element>()));
  array->SetNumberOfComponents(components);
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

}

vtkSmartPointer<vtkDataArray> MakeImageArray(
  const openvdb::GridBase& grid, const int extent[6], int factor)
{
  using namespace openvdb;
  auto array = Dispatch<FloatGrid, DoubleGrid, Int32Grid, Int64Grid, BoolGrid, MaskGrid, Vec3SGrid,
    Vec3DGrid, Vec3IGrid>(grid, extent, factor);
  array->SetName(grid.getName().c_str());
  return array;
}

}
