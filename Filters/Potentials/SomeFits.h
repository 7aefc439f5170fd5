// The fits of some particles among many: found with no more of the others than matter to them, the
// same as if all were found.

#ifndef SomeFits_h
#define SomeFits_h

#include "ParticleFit.h"
#include "Skeleton.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

struct SomeFits
{
  std::vector<std::size_t> Numbers; // of the particles, ascending
  std::vector<char> AreWhole;       // 0: one of the neighbours, of which the Bulk alone is known
  ParticleFits Fits;                // of each
};

// Whether there are so many particles in one place that fits would take hours: they are as of none
// then, ParticleFit(). Ranks of the options find it out together. Throws std::invalid_argument
// unless crowds are spared.
VTKACTIVEPOTENTIALS_EXPORT bool AreCrowded(
  const FitOptions& options, const std::vector<SkeletonVertex>& particles);

// Adds the fits of the particles that are wanted (ascending numbers) to those that are known, and
// leaves out those that are neither wanted nor neighbours of one that is. Not for crowds. Throws as
// BallCells do.
VTKACTIVEPOTENTIALS_EXPORT void FindSomeFits(const FitOptions& options,
  const std::vector<SkeletonVertex>& particles, const std::vector<std::size_t>& wanted,
  SomeFits& known);

// How far from a particle with a reach anything is on which its fit has an influence, at most.
// largestReach: of all particles.
VTKACTIVEPOTENTIALS_EXPORT double GetFarthestInfluence(
  const FitOptions& options, double reach, double largestReach);

}

#endif
