// Which rank a particle is at home on, where ranks share particles: the rank that keeps it, and
// finds what it is among its neighbours.
//
// Space is cut into blocks. Those with particles are put in Morton order (a cube, then the next),
// and each rank has a range of them, with about as many particles. All ranks know all blocks.

#ifndef ParticleHomes_h
#define ParticleHomes_h

#include "BlockTable.h"
#include "Skeleton.h"
#include "vtkActivePotentialsModule.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class Agreement;

class VTKACTIVEPOTENTIALS_EXPORT ParticleHomes
{
public:
  // particles: those that this rank has so far. A block is as wide as two balls around usual
  // particles, which are so many of their radii. Rounds of ranks.
  ParticleHomes(
    Agreement& ranks, const std::vector<SkeletonVertex>& particles, double ballPerRadius);

  // Of a particle of any rank.
  int FindHome(const double x[3]) const;
  bool IsAtHome(const double x[3]) const { return this->FindHome(x) == this->Own; }

  // The other ranks where particles in a box (xmin xmax ymin ymax zmin zmax) around one may be at
  // home, ascending.
  std::vector<std::size_t> ListOtherHomes(const double x[3], const double bounds[6]) const;

private:
  using Block = BlockTable::Block;

  Block FindBlock(const double x[3]) const;
  // Returns how many particles of all ranks are in each of them.
  std::vector<std::size_t> GatherBlocks(
    Agreement& ranks, const std::vector<SkeletonVertex>& particles);
  void ShareBlocks(const std::vector<std::size_t>& counts);
  void FindInner();
  // Whether a box is in a block and those around it.
  bool IsAround(const Block& block, const double bounds[6]) const;
  // Calls visit(rank) for the blocks in a box; for all ranks if there are very many of them.
  template <class Visitor>
  void VisitBlocks(const double bounds[6], Visitor visit) const;

  const int Own;
  const int Count;
  const double InverseWidth;
  BlockTable Blocks;
  std::vector<int> Homes; // of the blocks

  std::vector<char> AreInner; // of the blocks: whether it and all around it are at home here
};

}

#endif
