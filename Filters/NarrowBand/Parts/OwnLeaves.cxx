#include "Parts/OwnLeaves.h"

#include "MortonOrder.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** The edges of a leaf, on which samples are, end so far beside it [voxels]. */
constexpr double Margin = 1.0;

/** A box is cut into parts of one owner each, so often at most. */
constexpr int MostCuts = 256;

/** The leaf that holds a place; far away, and where it is not a number, the last one. */
int OriginAt(double voxel)
{
  constexpr double most = 1 << 30;
  return 8 * static_cast<int>(std::floor(std::min(std::max(voxel, -most), most) / 8.0));
}

/** Which ranks own leaves between two corners of a box. */
class OwnersInBox
{
public:
  OwnersInBox(const LeafOwners& owners, std::vector<int>& found)
    : Owners(owners)
    , Found(found)
  {
  }

  /** Leaves between the corners are between them in their order, too. */
  void Add(const openvdb::Coord& first, const openvdb::Coord& last)
  {
    const int low = this->Owners.FindOwner(first), high = this->Owners.FindOwner(last);
    if (low == high || this->Cuts == MostCuts)
    {
      this->AddRanks(low, high);
      return;
    }
    ++this->Cuts;
    const int axis = FindDecidingAxis(first.data(), last.data());
    openvdb::Coord before = last, after = first;
    after[axis] = FindMortonCut(first[axis], last[axis]);
    before[axis] = after[axis] - 8;
    this->Add(first, before);
    this->Add(after, last);
  }

private:
  /** Those that are not there yet. */
  void AddRanks(int first, int last)
  {
    for (int rank = first; rank <= last; ++rank)
    {
      if (std::find(this->Found.begin(), this->Found.end(), rank) == this->Found.end())
      {
        this->Found.push_back(rank);
      }
    }
  }

  const LeafOwners& Owners;
  std::vector<int>& Found;
  int Cuts = 0;
};

}

bool OwnLeaves::Has(const double x[3]) const
{
  openvdb::Coord origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = OriginAt(x[axis] / this->VoxelSize);
  }
  return this->Owners.FindOwner(origin) == this->Owners.GetRank();
}

void OwnLeaves::FindRanks(const double bounds[6], std::vector<int>& ranks) const
{
  openvdb::Coord first, last;
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = OriginAt(bounds[2 * axis] / this->VoxelSize - Margin);
    last[axis] = OriginAt(bounds[2 * axis + 1] / this->VoxelSize + Margin);
  }
  ranks.clear();
  OwnersInBox(this->Owners, ranks).Add(first, last);
}

}
