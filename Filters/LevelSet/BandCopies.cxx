// Copies of a band: another band, or bytes.

#include "BandState.h"
#include "Base/OpenVDB.h"
#include "Base/Walls.h"
#include "Leaves/LeafTable.h"
#include "NarrowBand.h"
#include "State/PackedBand.h"
#include "State/StateGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <openvdb/tools/SignedFloodFill.h>
#include <string>
#include <tbb/parallel_for.h>
#include <vector>

namespace activesurface
{

namespace
{

using openvdb::Coord;
using openvdb::CoordBBox;

/** Number of nodes with values on either side of a wall. */
constexpr int Band = 3;

/** Adds leaves inside the surface near one side of the walls. wall: coordinate of the side
 * [voxels]. */
void AddLeavesAt(openvdb::FloatTree& tree, const CoordBBox& leaves, int axis, double wall)
{
  const double low = leaves.min()[axis], high = leaves.max()[axis];
  if (!(wall > low - Band && wall < high + Band))
  {
    return;
  }
  CoordBBox slab = leaves;
  slab.min()[axis] = static_cast<int>(std::floor(wall)) - Band;
  slab.max()[axis] = static_cast<int>(std::ceil(wall)) + Band;
  for (const Coord& number : CoordBBox(slab.min() >> 3, slab.max() >> 3))
  {
    const Coord origin = number << 3;
    if (!tree.probeConstLeaf(origin) && tree.getValue(origin) < 0.f)
    {
      tree.addLeaf(new PotentialLeaf(origin, -Far, true));
    }
  }
}

void CutLeaf(PotentialLeaf& leaf, const Walls& walls, double voxelSize)
{
  const Coord& origin = leaf.origin();
  for (int n = 0; n < 512; ++n)
  {
    const double place[3] = { voxelSize * (origin[0] + (n >> 6)),
      voxelSize * (origin[1] + (n >> 3 & 7)), voxelSize * (origin[2] + (n & 7)) };
    const auto depth = static_cast<float>(
      std::max(DistanceToWalls(walls, place) / voxelSize, -static_cast<double>(Far)));
    leaf.setValueOn(n, std::min(std::max(leaf.getValue(n), depth), Far));
  }
}

CoordBBox BoxOf(const Walls& walls, double voxelSize, const CoordBBox& leaves)
{
  CoordBBox box = leaves;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::ceil(walls.Bounds[2 * axis] / voxelSize) - Band;
    const double high = std::floor(walls.Bounds[2 * axis + 1] / voxelSize) + Band;
    box.min()[axis] = static_cast<int>(std::max(low, double(leaves.min()[axis])));
    box.max()[axis] = static_cast<int>(std::min(high, double(leaves.max()[axis])));
  }
  return box;
}

openvdb::FloatTree::Ptr CutAtWalls(
  const openvdb::FloatTree& whole, const Walls& walls, double voxelSize)
{
  auto tree = std::make_shared<openvdb::FloatTree>(whole);
  CoordBBox leaves;
  if (!tree->evalLeafBoundingBox(leaves))
  {
    return tree;
  }
  for (int side = 0; side < 6; ++side)
  {
    AddLeavesAt(*tree, leaves, side / 2, walls.Bounds[side] / voxelSize);
  }
  std::vector<PotentialLeaf*> all;
  tree->getNodes(all);
  tbb::parallel_for(
    std::size_t{ 0 }, all.size(), [&](std::size_t i) { CutLeaf(*all[i], walls, voxelSize); });
  tree->clip(BoxOf(walls, voxelSize, leaves));
  openvdb::tools::signedFloodFillWithValues(*tree, Far, -Far);
  return tree;
}

/** The StateNumbers, except Background, in their order. */
using PackedNumbers = std::array<double, 7>;

}

void NarrowBand::CopyNumbersTo(NarrowBand& copy) const
{
  BandState& members = *copy.State;
  members.SetNumbers(this->State->GetNumbers());
  members.Threads = this->State->Threads;
  members.Maximum = this->State->Maximum;
  members.Work = this->State->Work;
  members.SetPart(this->State->Part);
}

std::unique_ptr<NarrowBand> NarrowBand::Clone() const
{
  auto copy = std::make_unique<NarrowBand>(this->State->VoxelSize);
  this->CopyNumbersTo(*copy);
  copy->Run(
    [&] {
      copy->State->AdoptTree(std::make_shared<openvdb::FloatTree>(this->State->Potential->tree()));
    });
  return copy;
}

std::unique_ptr<NarrowBand> NarrowBand::MakePartWithin(const Walls& walls) const
{
  auto part = std::make_unique<NarrowBand>(this->State->VoxelSize);
  this->CopyNumbersTo(*part);
  BandState& members = *part->State;
  members.SetPart(nullptr); // periodic boxes are not partitioned
  members.HasGhosts = false;
  part->Run(
    [&] { members.Restore(CutAtWalls(this->State->Potential->tree(), walls, members.VoxelSize)); });
  return part;
}

void NarrowBand::AddGhosts()
{
  this->Run([&] { this->State->AddGhosts(); });
}

bool NarrowBand::HasGhosts() const
{
  return this->State->HasGhosts;
}

std::string NarrowBand::Pack() const
{
  const StateNumbers n = this->State->GetNumbers();
  const PackedNumbers packed = { n.VoxelSize, n.Time, n.StartArea, n.StartVolume, n.BoxSize,
    n.Paper ? 1.0 : 0.0, n.HasGhosts ? 1.0 : 0.0 };
  std::string bytes(reinterpret_cast<const char*>(packed.data()), sizeof packed);
  const BandState& members = *this->State;
  if (members.Part)
  {
    PackPart(members.Leaves, n.HasGhosts, members.Potential->tree(), bytes);
  }
  else
  {
    PackBand(members.Leaves, n.HasGhosts, bytes);
  }
  return bytes;
}

std::unique_ptr<NarrowBand> NarrowBand::Unpack(
  const std::string& bytes, const std::shared_ptr<const BandPart>& part)
{
  PackedNumbers packed;
  if (bytes.size() < sizeof packed)
  {
    RefuseState();
  }
  std::memcpy(packed.data(), bytes.data(), sizeof packed);
  const StateNumbers numbers = { packed[0], packed[1], packed[2], packed[3], packed[4],
    packed[5] != 0.0, packed[6] != 0.0, 0.f };
  auto band = std::make_unique<NarrowBand>(numbers.VoxelSize);
  BandState& members = *band->State;
  members.SetNumbers(numbers);
  members.SetPart(part);
  const auto unpack = [&, rest = bytes.substr(sizeof packed)]
  {
    return part ? UnpackPart(rest, members.GetBackground())
                : UnpackBand({ rest }, members.GetBackground());
  };
  band->Run([&] { members.Restore(unpack()); });
  return band;
}

}
