// Conversion of values between VTK arrays and OpenVDB.

#ifndef ArrayValues_h
#define ArrayValues_h

#include "Base/OpenVDB.h"
#include "vtkDataArray.h"
#include "vtkSmartPointer.h"
#include "vtkTypeTraits.h"

#include <openvdb/Types.h>

#include <stdexcept>
#include <string>
#include <type_traits>

namespace activesurface
{

template <class Value>
Value GetValue(vtkDataArray* array, vtkIdType tuple)
{
  using Traits = openvdb::VecTraits<Value>;
  using Element = typename Traits::ElementType;
  if constexpr (Traits::IsVec)
  {
    Value value;
    for (int i = 0; i < Traits::Size; ++i)
    {
      value[i] = static_cast<Element>(array->GetComponent(tuple, i));
    }
    return value;
  }
  else if constexpr (sizeof(Element) == sizeof(vtkTypeInt64) && std::is_integral<Element>::value)
  {
    return array->GetVariantValue(tuple).ToTypeInt64(); // has more digits than a double
  }
  else
  {
    return static_cast<Value>(array->GetComponent(tuple, 0));
  }
}

// Value type of the VTK array that stores numbers of a grid.
template <class Number>
using StoredNumber = std::conditional_t<std::is_same<Number, bool>::value, unsigned char,
  std::conditional_t<std::is_same<Number, openvdb::Int64>::value, vtkTypeInt64, Number>>;

template <class Number>
vtkSmartPointer<vtkDataArray> MakeArrayOf()
{
  return vtk::TakeSmartPointer(
    vtkDataArray::CreateDataArray(vtkTypeTraits<StoredNumber<Number>>::VTKTypeID()));
}

// Chooses the value type of a grid that stores the array, and calls function(zero) with a zero of
// this type. Integers become 32 or 64 bits; vectors of integers beyond int32 become double. Throws
// std::invalid_argument unless the array has one or three components.
template <class Function>
void DispatchValues(vtkDataArray* array, Function&& function)
{
  const int components = array->GetNumberOfComponents();
  const int type = array->GetDataType();
  if (components != 1 && components != 3)
  {
    throw std::invalid_argument(std::string("The point array \"") +
      (array->GetName() ? array->GetName() : "") + "\" has " + std::to_string(components) +
      " components, but a grid has one or three. Remove or split the array or, unless the array is "
      "the scalars of an image, turn WritePointArrays off (in active-surface skin, leave out "
      "--pass-target-arrays).");
  }
  const bool isWide = array->GetDataTypeSize() > 4 || type == VTK_UNSIGNED_INT;
  if (type == VTK_FLOAT)
  {
    components == 1 ? function(0.f) : function(openvdb::Vec3s(0.f));
  }
  else if (type == VTK_DOUBLE)
  {
    components == 1 ? function(0.0) : function(openvdb::Vec3d(0.0));
  }
  else if (components == 3)
  {
    isWide ? function(openvdb::Vec3d(0.0)) : function(openvdb::Vec3i(0));
  }
  else
  {
    isWide ? function(openvdb::Int64(0)) : function(openvdb::Int32(0));
  }
}

}

#endif
