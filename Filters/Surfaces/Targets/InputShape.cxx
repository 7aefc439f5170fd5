#include "Targets/InputShape.h"

#include <typeinfo>

namespace activesurface
{

InputShape::~InputShape() = default;

bool InputShape::IsOfKindOf(const InputShape& other) const
{
  return typeid(*this) == typeid(other);
}

void InputShape::MoveTo(const std::array<double, 3>& origin)
{
  if (origin != this->Origin)
  {
    const double offset[3] = { this->Origin[0] - origin[0], this->Origin[1] - origin[1],
      this->Origin[2] - origin[2] };
    this->MoveBy(offset);
    this->Origin = origin;
  }
}

void InputShape::MoveBy(const double[3]) {}

bool InputShape::IsEmptyAs(const InputShape&) const
{
  return false;
}

std::string InputShape::Prepare(const TargetOptions&, const Warnings&)
{
  return "";
}

std::string InputShape::DescribeThinParts(const TargetOptions&) const
{
  return "";
}

void InputShape::AddBounds(const TargetOptions&, vtkBoundingBox&, vtkBoundingBox&) const {}

bool InputShape::HasArrays(const ParticleArrays&) const
{
  return true;
}

}
