#include "RanksAround.h"

#include "Domain.h"

#include <numeric>

namespace activesurface
{

namespace
{

/** Beyond this margin [nodes] all ranks count as near: so large a box holds too many leaves. */
constexpr int MostMargin = 96;

}

RanksAround::RanksAround(const Domain& domain, int margin)
  : Space(domain)
  , Margin(margin)
{
}

const std::vector<int>& RanksAround::Find(const NodeIndex& cell)
{
  if (!this->Ranks.empty() && AreSame(cell, this->Last))
  {
    return this->Ranks[this->LastNumber];
  }
  this->Last = cell;
  this->LastNumber = static_cast<std::size_t>(this->Numbers.Add(cell));
  if (this->LastNumber == this->Ranks.size())
  {
    constexpr int side = 16;
    NodeIndex low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = side * cell[axis] - this->Margin;
      high[axis] = side * cell[axis] + side - 1 + this->Margin;
    }
    this->Ranks.emplace_back();
    if (this->Margin > MostMargin)
    {
      this->Ranks.back().resize(static_cast<std::size_t>(this->Space.GetRanks().GetSize()));
      std::iota(this->Ranks.back().begin(), this->Ranks.back().end(), 0);
    }
    else
    {
      this->Space.ListOwners(low, high, this->Ranks.back());
    }
  }
  return this->Ranks[this->LastNumber];
}

}
