#include "Implicit/BandBackup.h"

#include "Leaves/LeafExchange.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace activesurface
{

void BandBackup::Save(const LeafTable& table)
{
  this->Size = table.Size();
  this->Values.MakeRoom(this->Size);
  table.ForEach([&](std::size_t i) { std::copy_n(table[i].Value, 512, this->Values.Of(i)); });
}

void BandBackup::Restore(LeafTable& table, PotentialTree& tree) const
{
  table.ForEach(
    [&](std::size_t i)
    {
      if (i < this->Size)
      {
        std::copy_n(this->Values.Of(i), 512, table[i].Value);
      }
    });
  LeafList saved(std::min(this->Size, table.Size()));
  std::iota(saved.begin(), saved.end(), 0);
  TellAll(table, saved, [&table](std::size_t i, auto& pass) { pass(table[i].Value, 512); });
  this->RemoveAdded(table, tree);
}

/** A leaf that was a tile had no surface at its faces: it is on the side of what is beside it. */
void BandBackup::RemoveAdded(const LeafTable& table, PotentialTree& tree) const
{
  std::vector<float> sides(table.Size(), 0.f);
  bool more = true;
  const auto sideOf = [&](std::size_t i, int axis, int sign)
  {
    const std::int32_t next = table[i].Neighbour[FaceNumber(axis, sign)];
    const int node = sign > 0 ? 0 : 7 * Stride(axis); // on the face between them
    return next < 0                                 ? table.BackgroundOf(next)
      : static_cast<std::size_t>(next) < this->Size ? table[next].Value[node]
                                                    : sides[next];
  };
  while (more)
  {
    more = false;
    for (std::size_t i = this->Size; i < table.Size(); ++i)
    {
      for (int face = 0; face < 6 && sides[i] == 0.f; ++face)
      {
        const float side = sideOf(i, face / 2, face % 2 ? 1 : -1);
        sides[i] = side < 0.f ? -Far : side > 0.f ? Far : 0.f;
        more = more || sides[i] != 0.f;
      }
    }
  }
  for (std::size_t i = this->Size; i < table.Size(); ++i)
  {
    tree.addTile(1, table[i].Origin, sides[i] < 0.f ? -Far : Far, false);
  }
}

}
