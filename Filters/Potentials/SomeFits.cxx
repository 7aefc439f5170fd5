#include "SomeFits.h"

#include "NearCells.h"
#include "ParallelTasks.h"
#include "ParticleCrowd.h"
#include "ParticleLengths.h"
#include "PortableMath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

// As far as a hollow beside a particle is sought, in its Outward.
constexpr double FarthestHollow = 1.5;

// The longest half-axis of an ellipsoid, in its radius, which two others make that are so many
// times shorter.
double GetLongestAxis(double anisotropy)
{
  return CubeRoot(anisotropy * anisotropy);
}

// How far fits, and what they are made of, depend on others.
struct Distances
{
  Distances(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
    : LargestRadius(FindLargestRadius(particles))
    , Neighbourhood(GetNeighbourhoodPerRadius(options.Model) * this->LargestRadius)
  {
    // A little more, for what rounding does.
    constexpr double margin = 1.001;
    const double own = GetOwnRadius(options, this->LargestRadius);
    const double place = (1.0 + OffsetOfBody) * own;
    this->CellSize = margin * (this->Neighbourhood + place);
    if (options.Model == ParticleModel::Anisotropic)
    {
      const double influence =
        GetFarthestInfluence(options, this->LargestRadius, this->LargestRadius);
      this->CellsOfShapes =
        static_cast<int>(std::ceil(margin * (place + influence) / this->CellSize));
    }
  }

  double LargestRadius;
  double Neighbourhood; // and the place where the surface should be is within a cell
  double CellSize;
  int CellsOfShapes = 0; // from such a place to what its value depends on; 0: places alone
};

// Particles that are wanted, and which others are around them.
class Surroundings
{
public:
  Surroundings(const Distances& distances, const std::vector<SkeletonVertex>& particles,
    const std::vector<std::size_t>& wanted)
    : Particles(particles)
    , Needs(particles.size(), FitNeed::Nothing)
  {
    NearCells cells(distances.CellSize);
    for (const std::size_t i : wanted)
    {
      this->Needs[i] = FitNeed::Fit;
      cells.Add(particles[i].Position);
    }
    this->Widen(cells, 1, FitNeed::Bulk);
    if (distances.CellsOfShapes > 0)
    {
      this->Widen(cells, distances.CellsOfShapes, FitNeed::Shape);
    }
    this->Widen(cells, 1, FitNeed::Place);
  }

  std::vector<std::size_t> List(FitNeed need) const
  {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < this->Needs.size(); ++i)
    {
      if (this->Needs[i] <= need)
      {
        numbers.push_back(i);
      }
    }
    return numbers;
  }

  FitNeed Get(std::size_t i) const { return this->Needs[i]; }

private:
  void Widen(NearCells& cells, int count, FitNeed need)
  {
    cells.Widen(count);
    RunEach(this->Needs.size(),
      [&](std::size_t i)
      {
        if (this->Needs[i] == FitNeed::Nothing && cells.Has(this->Particles[i].Position))
        {
          this->Needs[i] = need;
        }
      });
  }

  const std::vector<SkeletonVertex>& Particles;
  std::vector<FitNeed> Needs;
};

// Of those that are wanted, by ascending number, that are not among the known ones.
std::vector<std::size_t> ListMissing(const std::vector<std::size_t>& wanted, const SomeFits& known)
{
  std::vector<std::size_t> missing;
  std::size_t k = 0;
  for (const std::size_t i : wanted)
  {
    while (k < known.Numbers.size() && known.Numbers[k] < i)
    {
      ++k;
    }
    if (k == known.Numbers.size() || known.Numbers[k] != i || !known.AreWhole[k])
    {
      missing.push_back(i);
    }
  }
  return missing;
}

void Add(const SomeFits& from, std::size_t k, SomeFits& to)
{
  to.Numbers.push_back(from.Numbers[k]);
  to.AreWhole.push_back(from.AreWhole[k]);
  to.Fits.push_back(from.Fits[k]);
}

// Those of the neighbourhood of what is missing.
SomeFits FindMissing(const FitOptions& options, const std::vector<SkeletonVertex>& particles,
  const Distances& distances, const std::vector<std::size_t>& missing)
{
  const Surroundings around(distances, particles, missing);
  const std::vector<std::size_t> near = around.List(FitNeed::Place);
  std::vector<SkeletonVertex> members;
  FitPart part;
  part.LargestRadius = distances.LargestRadius;
  part.LargestOfStrengths = FindLargestRadiusOfStrengths(particles);
  for (const std::size_t i : near)
  {
    members.push_back(particles[i]);
    part.Needs.push_back(around.Get(i));
  }
  const ParticleFits fits = FitParticles(options, members, &part);
  SomeFits found;
  for (std::size_t k = 0; k < near.size(); ++k)
  {
    if (part.Needs[k] <= FitNeed::Bulk)
    {
      found.Numbers.push_back(near[k]);
      found.AreWhole.push_back(part.Needs[k] == FitNeed::Fit ? 1 : 0);
      found.Fits.push_back(fits[k]);
    }
  }
  return found;
}

// Both ascending; of the same particle the one that is whole.
SomeFits Merge(const SomeFits& a, const SomeFits& b)
{
  SomeFits all;
  std::size_t i = 0, k = 0;
  while (i < a.Numbers.size() || k < b.Numbers.size())
  {
    const bool isInA =
      i < a.Numbers.size() && (k == b.Numbers.size() || a.Numbers[i] <= b.Numbers[k]);
    const bool isInB =
      k < b.Numbers.size() && (i == a.Numbers.size() || b.Numbers[k] <= a.Numbers[i]);
    const bool takesA = isInA && (!isInB || a.AreWhole[i]);
    takesA ? Add(a, i, all) : Add(b, k, all);
    i += isInA ? 1 : 0;
    k += isInB ? 1 : 0;
  }
  return all;
}

// What is no longer wanted, nor near.
void Reduce(const Distances& distances, const std::vector<SkeletonVertex>& particles,
  const std::vector<std::size_t>& wanted, SomeFits& fits)
{
  NearCells cells(distances.CellSize);
  for (const std::size_t i : wanted)
  {
    cells.Add(particles[i].Position);
  }
  cells.Widen(1);
  SomeFits kept;
  for (std::size_t k = 0; k < fits.Numbers.size(); ++k)
  {
    if (cells.Has(particles[fits.Numbers[k]].Position))
    {
      Add(fits, k, kept);
    }
  }
  fits = std::move(kept);
}

}

bool AreCrowded(const FitOptions& options, const std::vector<SkeletonVertex>& particles)
{
  const bool isCrowd = IsCrowdOnRanks(options, particles);
  CheckCrowd(isCrowd, options, particles.size());
  return isCrowd;
}

void FindSomeFits(const FitOptions& options, const std::vector<SkeletonVertex>& particles,
  const std::vector<std::size_t>& wanted, SomeFits& known)
{
  const Distances distances(options, particles);
  const std::vector<std::size_t> missing = ListMissing(wanted, known);
  if (!missing.empty())
  {
    known = Merge(known, FindMissing(options, particles, distances, missing));
  }
  if (!known.Numbers.empty())
  {
    Reduce(distances, particles, wanted, known);
  }
}

double GetFarthestInfluence(const FitOptions& options, double reach, double largestReach)
{
  const double hollow = FarthestHollow * 2.0 * GetOwnRadius(options, reach);
  if (options.Model != ParticleModel::Anisotropic)
  {
    return std::max(reach, hollow);
  }
  const double offset = GetNeighbourhoodPerRadius(options.Model) * largestReach;
  return std::max(offset + reach * GetLongestAxis(options.Anisotropy), hollow);
}

}
