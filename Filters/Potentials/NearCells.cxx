#include "NearCells.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

// Beyond the farthest cells places count as near one another.
BlockTable::Block NearCells::GetCell(const double x[3]) const
{
  constexpr double farthest = 1e15;
  BlockTable::Block cell{ {}, 0 };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double at = std::min(std::max(-farthest, x[axis] * this->InverseSize), farthest);
    cell.At[axis] = static_cast<BlockTable::Coordinate>(std::floor(at));
  }
  return cell;
}

void NearCells::Widen(int cells)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t count = this->Cells.Size();
    for (std::size_t i = 0; i < count; ++i)
    {
      BlockTable::Block cell = this->Cells[i];
      cell.At[axis] -= cells;
      for (int n = 0; n <= 2 * cells; ++n, ++cell.At[axis])
      {
        this->Cells.Add(cell);
      }
    }
  }
}

}
