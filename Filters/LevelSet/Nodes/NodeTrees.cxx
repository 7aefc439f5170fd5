// Trees before and after a frame of the node scheme; each may be partitioned among ranks.

#include "Base/OpenVDB.h"
#include "Nodes/NodeStep.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace activesurface
{

namespace
{

/** Returns true if a leaf has values between -NodeLimit and NodeLimit, or values of both signs. */
bool IsNearSurface(const float* values)
{
  return std::any_of(values, values + 512,
    [values](float value)
    { return std::fabs(value) < NodeLimit || (value < 0.f) != (values[0] < 0.f); });
}

}

/** Fetches the old leaves that this rank reads and other ranks own. */
void NodeStep::FetchOld(const NodeFrame& frame, const NodeTarget& target)
{
  this->Motions.clear();
  if (!frame.Old.Space || !(frame.End > frame.Begin))
  {
    return;
  }
  this->Motions.resize(this->Leaves.Size());
  this->Leaves.ForEach(
    [&](std::size_t i) { target.FindMotion(this->Leaves[i], this->Motions[i]); });
  std::vector<NodeIndex> wanted;
  for (std::size_t i = 0; i < this->Leaves.GetOwn(); ++i)
  {
    ListOldLeaves(this->Leaves[i], this->Motions[i], wanted);
  }
  frame.Old.Fetch(wanted);
}

openvdb::FloatTree::Ptr NodeStep::MakeTree(const NodeFrame& frame, const Motion& motion) const
{
  std::vector<std::unique_ptr<PotentialLeaf>> made(this->Leaves.Size());
  this->Leaves.ForAll(
    [&](std::size_t i)
    {
      const float* values = this->Potential.Of(i);
      if (IsNearSurface(values))
      {
        const NodeIndex& origin = this->Leaves[i].Origin;
        made[i] = std::make_unique<PotentialLeaf>(
          openvdb::Coord(origin[0], origin[1], origin[2]), Far, true);
        std::copy_n(values, 512, made[i]->buffer().data());
      }
    });
  auto tree = std::make_shared<openvdb::FloatTree>(Far);
  for (std::unique_ptr<PotentialLeaf>& leaf : made)
  {
    if (leaf)
    {
      tree->addLeaf(leaf.release());
    }
  }
  if (frame.Space)
  {
    this->AddSides(frame, motion, *tree);
  }
  else
  {
    openvdb::tools::signedFloodFillWithValues(*tree, Far, -Far);
  }
  return tree;
}

/** Adds tiles inside the surface. Flood fill cannot find these tiles, because leaves of other ranks
 * are missing. */
void NodeStep::AddSides(
  const NodeFrame& frame, const Motion& motion, openvdb::FloatTree& tree) const
{
  const auto addInside = [&tree](const NodeIndex& origin)
  { tree.addTile(1, openvdb::Coord(origin[0], origin[1], origin[2]), -Far, false); };
  for (const NodeIndex& origin : this->Near.InsideLeaves)
  {
    if (this->Leaves.Find(origin) < 0 && !this->IsSolid(origin, frame, motion))
    {
      addInside(origin);
    }
  }
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    const float* values = this->Potential.Of(i);
    if (values[0] < 0.f && !IsNearSurface(values))
    {
      addInside(this->Leaves[i].Origin);
    }
  }
}

}
