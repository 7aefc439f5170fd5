#include "Targets/InputShape.h"

#include <typeinfo>

namespace activesurface
{

InputShape::~InputShape() = default;

bool InputShape::IsOfKindOf(const InputShape& other) const
{
  return typeid(*this) == typeid(other);
}

bool InputShape::IsEmptyAs(const InputShape&) const
{
  return false;
}

std::string InputShape::Prepare(ShapePreparation&)
{
  return "";
}

std::string InputShape::DescribeThinParts(const ShapeOptions&) const
{
  return "";
}

void InputShape::AddBounds(const ShapeOptions&, vtkBoundingBox&, vtkBoundingBox&) const {}

bool InputShape::HasArrays(const ParticleArrays&) const
{
  return true;
}

}
