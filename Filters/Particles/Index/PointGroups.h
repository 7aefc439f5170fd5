// Groups of up to eight points of one cell, so that one search serves a group.

#ifndef PointGroups_h
#define PointGroups_h

#include "Base/NodeTarget.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace activesurface
{

class PointGroups
{
public:
  static constexpr std::size_t Capacity = 256; // points
  static constexpr std::size_t Most = 8;       // in a group

  // Sorts up to Capacity points by their cells. findCell(index, cell) returns false if a point
  // belongs to no group.
  template <class FindCell>
  PointGroups(std::size_t count, FindCell&& findCell)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      Item& item = this->Items[this->Count];
      item.Point = i;
      this->Count += findCell(i, item.Cell) ? 1 : 0;
    }
    std::sort(this->Items, this->Items + this->Count);
  }

  // Calls visit(cell, members, count) for each group; members: indices of points.
  template <class Visit>
  void ForEach(Visit&& visit) const
  {
    std::size_t members[Most];
    for (std::size_t first = 0; first < this->Count;)
    {
      const NodeIndex& cell = this->Items[first].Cell;
      std::size_t count = 0;
      while (count < Most && first + count < this->Count &&
        AreSame(this->Items[first + count].Cell, cell))
      {
        members[count] = this->Items[first + count].Point;
        ++count;
      }
      visit(cell, members, static_cast<int>(count));
      first += count;
    }
  }

private:
  struct Item
  {
    NodeIndex Cell;
    std::size_t Point;

    bool operator<(const Item& other) const
    {
      return std::tie(this->Cell, this->Point) < std::tie(other.Cell, other.Point);
    }
  };

  std::size_t Count = 0;
  Item Items[Capacity];
};

}

#endif
