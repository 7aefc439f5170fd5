#include "ParticleCrowd.h"

#include "NearCells.h"
#include "ParallelTasks.h"
#include "ParticleLengths.h"
#include "SharedResults.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

// Of fewer particles each may have all as neighbours; else so many on the average, a hundred times
// what is usual, are refused.
constexpr std::size_t FewParticles = 30000;
constexpr std::size_t MostNeighbours = 20000;
// That is found out by a sample, which is spread over the list.
constexpr std::size_t ParticlesOfSample = 256;
constexpr std::size_t MostInSample = MostNeighbours * ParticlesOfSample;

const double* GetSample(const std::vector<SkeletonVertex>& particles, std::size_t i)
{
  return particles[i * particles.size() / ParticlesOfSample].Position;
}

// Some of the sample's; no more are counted than are too many.
std::size_t CountNeighbours(const NeighbourSums& neighbours,
  const std::vector<SkeletonVertex>& particles, std::size_t first, std::size_t end)
{
  std::size_t count = 0;
  for (std::size_t i = first; i < end && count <= MostInSample; ++i)
  {
    count += neighbours.CountNear(GetSample(particles, i));
  }
  return count;
}

// The same, looking for them among the particles nearby alone.
std::size_t CountNeighboursOf(const FitOptions& options,
  const std::vector<SkeletonVertex>& particles, std::size_t first, std::size_t end)
{
  const double largest = FindLargestRadius(particles);
  const double factor = GetNeighbourhoodPerRadius(options.Model);
  NearCells cells(factor * largest);
  for (std::size_t i = first; i < end; ++i)
  {
    cells.Add(GetSample(particles, i));
  }
  cells.Widen(2);
  std::vector<char> isNear(particles.size());
  RunEach(
    isNear.size(), [&](std::size_t i) { isNear[i] = cells.Has(particles[i].Position) ? 1 : 0; });
  std::vector<SkeletonVertex> near;
  for (std::size_t i = 0; i < isNear.size(); ++i)
  {
    if (isNear[i])
    {
      near.push_back(particles[i]);
    }
  }
  return CountNeighbours(NeighbourSums(near, factor, largest), particles, first, end);
}

}

bool IsCrowd(const NeighbourSums& neighbours, const std::vector<SkeletonVertex>& particles)
{
  return particles.size() > FewParticles &&
    CountNeighbours(neighbours, particles, 0, ParticlesOfSample) > MostInSample;
}

bool IsCrowdOnRanks(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
{
  if (particles.size() <= FewParticles)
  {
    return false;
  }
  const int ranks = options.Ranks ? options.Ranks->GetSize() : 1;
  std::vector<std::size_t> counts(static_cast<std::size_t>(ranks));
  const auto firstOf = [&](std::size_t rank) { return ParticlesOfSample * rank / counts.size(); };
  ShareResults(
    options.Ranks, counts.size(),
    [&](std::size_t first, std::size_t end)
    {
      for (std::size_t rank = first; rank < end; ++rank)
      {
        counts[rank] = CountNeighboursOf(options, particles, firstOf(rank), firstOf(rank + 1));
      }
    },
    [&](std::size_t rank, auto& pass) { pass(&counts[rank], 1); });
  std::size_t all = 0;
  for (const std::size_t count : counts)
  {
    all += count;
  }
  return all > MostInSample;
}

void CheckCrowd(bool isCrowd, const FitOptions& options, std::size_t particles)
{
  if (isCrowd && !options.SparesCrowds)
  {
    throw std::invalid_argument("The " + std::to_string(particles) + " particles have more than " +
      std::to_string(MostNeighbours) +
      " neighbours in reach on the average, where some 200 are usual; check whether many are "
      "in the same place, and whether ParticleSpacing and ParticleRadius (or the array of "
      "radii) are in the particles' own units, or set ParticleModel to SUM.");
  }
}

}
