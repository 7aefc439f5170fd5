#include "Targets/ChangedRegion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace activesurface
{

namespace
{

constexpr int MostCells = 64; // along an axis

// Returns the number of cells along an axis, 1 to 64. Cells have half the mean width of the boxes,
// so that each box marks only a few. The widths are summed as integers: the result does not depend
// on the order of the boxes.
int FindSide(const std::vector<ChangedRegion::Box>& boxes, int axis, double extent)
{
  constexpr double parts = 1 << 20; // of the extent
  std::int64_t widths = 0;
  for (const ChangedRegion::Box& box : boxes)
  {
    const double share = (box[2 * axis + 1] - box[2 * axis]) / extent;
    widths += std::llround(parts * (share < 1.0 ? share : 1.0)); // also 1 for NaN
  }
  const double side =
    2.0 * parts * double(boxes.size()) / double(std::max<std::int64_t>(widths, 1));
  return side >= 1.0 ? static_cast<int>(std::min(side, double(MostCells))) : 1;
}

ChangedRegion::Box Join(const ChangedRegion::Box& a, const ChangedRegion::Box& b)
{
  ChangedRegion::Box both;
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::min(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::max(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

// Calls function(cell) for the cells in the range until it returns true. Returns true if it did.
template <class Function>
bool FindCell(const std::array<int, 6>& range, const std::array<int, 3>& side, Function&& function)
{
  for (int x = range[0]; x <= range[1]; ++x)
  {
    for (int y = range[2]; y <= range[3]; ++y)
    {
      for (int z = range[4]; z <= range[5]; ++z)
      {
        if (function((x * side[1] + y) * side[2] + z))
        {
          return true;
        }
      }
    }
  }
  return false;
}

}

void ChangedRegion::SetEverywhere()
{
  this->IsEverywhere = true;
}

void ChangedRegion::Set(const std::vector<Box>& boxes)
{
  this->IsEverywhere = false;
  this->Side = {};
  if (boxes.empty())
  {
    return;
  }
  this->Bounds = boxes[0];
  for (const Box& box : boxes)
  {
    this->Bounds = Join(this->Bounds, box);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Side[axis] = FindSide(boxes, axis, this->Bounds[2 * axis + 1] - this->Bounds[2 * axis]);
  }
  this->Cells.assign(this->Side[0] * this->Side[1] * this->Side[2], 0);
  for (const Box& box : boxes)
  {
    FindCell(this->FindCells(box.data()), this->Side,
      [this](int cell)
      {
        this->Cells[cell] = 1;
        return false;
      });
  }
}

std::array<int, 6> ChangedRegion::FindCells(const double bounds[6]) const
{
  std::array<int, 6> range;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->Bounds[2 * axis], extent = this->Bounds[2 * axis + 1] - low;
    for (int end = 0; end < 2; ++end)
    {
      const double share = extent > 0.0 ? (bounds[2 * axis + end] - low) / extent : 0.0;
      const double cell = std::floor(share * this->Side[axis]);
      range[2 * axis + end] =
        static_cast<int>(std::min(std::max(cell, 0.0), double(this->Side[axis] - 1)));
    }
  }
  return range;
}

bool ChangedRegion::Touches(const double bounds[6]) const
{
  if (this->IsEverywhere || this->Side[0] == 0)
  {
    return this->IsEverywhere;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(bounds[2 * axis] <= this->Bounds[2 * axis + 1] &&
          this->Bounds[2 * axis] <= bounds[2 * axis + 1]))
    {
      return false;
    }
  }
  return FindCell(
    this->FindCells(bounds), this->Side, [this](int cell) { return this->Cells[cell] != 0; });
}

}
