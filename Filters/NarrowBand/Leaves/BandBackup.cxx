#include "Leaves/BandBackup.h"

#include "Leaves/LeafExchange.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace activesurface
{

void BandBackup::Save(const LeafTable& table)
{
  this->Tree.reset();
  this->Size = table.Size();
  this->Values.MakeRoom(table);
  table.ForEach([&](std::size_t i) { std::copy_n(table[i].Value, 512, this->Values.Of(i)); });
}

void BandBackup::Forget()
{
  this->Tree.reset();
  this->Size = 0;
}

void BandBackup::KeepAsTree(const LeafTable& table, const PotentialTree& tree)
{
  if (this->Tree)
  {
    return;
  }
  openvdb::FloatTree::Ptr copy;
  RunTogether(table, [&] { copy = std::make_shared<openvdb::FloatTree>(tree); });
  if (this->Size > 0)
  {
    this->WriteInto(*copy, table);
  }
  this->Tree = copy;
}

openvdb::FloatTree::Ptr BandBackup::Restore(
  const LeafTable& table, const openvdb::FloatTree::Ptr& tree) const
{
  if (this->Tree || this->Size == 0)
  {
    return this->Tree;
  }
  this->WriteInto(*tree, table);
  return tree;
}

/** tree: with the leaves of the table. */
void BandBackup::WriteInto(PotentialTree& tree, const LeafTable& table) const
{
  std::vector<float*> values(this->Size);
  for (std::size_t i = 0; i < this->Size; ++i)
  {
    values[i] = tree.probeLeaf(table[i].Origin)->buffer().data();
  }
  table.ForEach(
    [&](std::size_t i)
    {
      if (i < this->Size)
      {
        std::copy_n(this->Values.Of(i), 512, values[i]);
      }
    });
  LeafList saved(this->Size);
  std::iota(saved.begin(), saved.end(), 0);
  TellAll(table, saved, [&values](std::size_t i, auto& pass) { pass(values[i], 512); });
  this->RemoveAdded(tree, table, values);
}

/** A leaf that was a tile had no surface at its faces: it is on the side of what is beside it. */
void BandBackup::RemoveAdded(
  PotentialTree& tree, const LeafTable& table, const std::vector<float*>& values) const
{
  std::vector<float> sides(table.Size(), 0.f);
  bool more = true;
  const auto sideOf = [&](std::size_t i, int axis, int sign)
  {
    const std::int32_t next = table[i].Neighbour[FaceNumber(axis, sign)];
    const int node = sign > 0 ? 0 : 7 * Stride(axis); // on the face between them
    return next < 0                                 ? table.BackgroundOf(next)
      : static_cast<std::size_t>(next) < this->Size ? values[next][node]
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
