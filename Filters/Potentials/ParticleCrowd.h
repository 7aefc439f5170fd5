// Crowds: so many particles in one place that each visits each, which takes hours.

#ifndef ParticleCrowd_h
#define ParticleCrowd_h

#include "FitOptions.h"
#include "Skeleton.h"
#include "Skeleton/NeighbourSums.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// neighbours: of the particles, among themselves.
bool IsCrowd(const NeighbourSums& neighbours, const std::vector<SkeletonVertex>& particles);

// The same where ranks look at the same particles together.
bool IsCrowdOnRanks(const FitOptions& options, const std::vector<SkeletonVertex>& particles);

// Throws std::invalid_argument, unless crowds are spared.
void CheckCrowd(bool isCrowd, const FitOptions& options, std::size_t particles);

}

#endif
