// Which rank a particle is at home on, where ranks share what is found for particles: the rank that
// finds it, and keeps it.
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
  // The particles are the same on all ranks. A block is as wide as two balls around usual
  // particles, which are so many of their radii.
  ParticleHomes(
    Agreement& ranks, const std::vector<SkeletonVertex>& particles, double ballPerRadius);

  Agreement& GetRanks() const { return this->Ranks; }

  // Of a particle.
  int FindHome(const double x[3]) const;
  bool IsAtHome(const double x[3]) const { return this->FindHome(x) == this->Own; }

  // The numbers of the particles at home, ascending.
  const std::vector<std::size_t>& GetNumbers() const { return this->Numbers; }

  // The other ranks where particles in a box (xmin xmax ymin ymax zmin zmax) around one may be at
  // home, ascending.
  std::vector<std::size_t> ListOtherHomes(const double x[3], const double bounds[6]) const;

  // The numbers of those particles at home and of those whose balls, larger by a margin, may hold
  // one of these; ascending.
  std::vector<std::size_t> ListNear(
    const std::vector<SkeletonVertex>& particles, double ballPerRadius, double margin) const;

private:
  using Block = BlockTable::Block;

  Block FindBlock(const double x[3]) const;
  void ShareBlocks(const std::vector<std::size_t>& counts);
  void FindInnerAndFar();
  // Whether a box is in a block and those around it.
  bool IsAround(const Block& block, const double bounds[6]) const;
  // Whether a particle is at home, or the box around it touches particles that are.
  bool IsNear(const double x[3], const double bounds[6]) const;
  // Calls visit(rank) for the blocks in a box until it returns true; for all ranks if there are
  // very many of them.
  template <class Visitor>
  void VisitBlocks(const double bounds[6], Visitor visit) const;

  Agreement& Ranks;
  const int Own;
  const int Count;
  const double InverseWidth;
  BlockTable Blocks;
  std::vector<int> Homes; // of the blocks
  std::vector<std::size_t> Numbers;

  // Of the blocks: whether it and all around it are at home here, or none of them.
  std::vector<char> AreInner;
  std::vector<char> AreFar;
};

}

#endif
