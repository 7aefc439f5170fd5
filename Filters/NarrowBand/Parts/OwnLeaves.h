/**
 * Places by the leaves in which they are.
 */
#ifndef OwnLeaves_h
#define OwnLeaves_h

#include "Leaves/LeafOwners.h"
#include "Target.h"

namespace activesurface
{

/** The places of the leaves that a rank has, and of those that it may get. */
class OwnLeaves final : public OwnPlaces
{
public:
  /** The owners are the caller's. */
  OwnLeaves(const LeafOwners& owners, double voxelSize)
    : Owners(owners)
    , VoxelSize(voxelSize)
  {
  }

  int GetRank() const override { return this->Owners.GetRank(); }
  /** More than there are in a large box, at which it does not look closely. */
  void FindRanks(const double bounds[6], std::vector<int>& ranks) const override;
  bool Has(const double x[3]) const override;

private:
  const LeafOwners& Owners;
  const double VoxelSize;
};

}

#endif
