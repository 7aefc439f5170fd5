#include "Skeleton/NeighbourSums.h"

#include <algorithm>

namespace activesurface
{

NeighbourSums::NeighbourSums(const std::vector<SkeletonVertex>& particles, double factor)
  : Particles(particles)
{
  this->InverseReach2.reserve(particles.size());
  for (const SkeletonVertex& particle : particles)
  {
    const double reach = factor * particle.Radius;
    this->Near.AddBall(particle.Position, reach);
    this->InverseReach2.push_back(1.0 / (reach * reach));
  }
  this->Near.Build();
}

template <class Visitor>
void NeighbourSums::Visit(const double x[3], Visitor visit) const
{
  SkeletonCells::Place place;
  std::copy_n(x, 3, place.Low);
  std::copy_n(x, 3, place.High);
  VisitHits(this->Near.GetCells(), place,
    [&](const SkeletonCells::Index* hits, std::size_t count)
    {
      for (std::size_t hit = 0; hit < count; ++hit)
      {
        const SkeletonVertex& particle = this->Particles[hits[hit]];
        const double offset[3] = { particle.Position[0] - x[0], particle.Position[1] - x[1],
          particle.Position[2] - x[2] };
        const double u = 1.0 -
          (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]) *
            this->InverseReach2[hits[hit]];
        if (u > 0.0 && particle.Strength > 0.0)
        {
          visit(hits[hit], particle.Strength * (u * u), offset);
        }
      }
    });
}

std::size_t NeighbourSums::CountNear(const double x[3]) const
{
  SkeletonCells::Place place;
  std::copy_n(x, 3, place.Low);
  std::copy_n(x, 3, place.High);
  std::size_t near = 0;
  VisitHits(this->Near.GetCells(), place,
    [&near](const SkeletonCells::Index*, std::size_t count) { near += count; });
  return near;
}

NeighbourMoments NeighbourSums::FindMoments(const double x[3]) const
{
  constexpr double nearPerReach = 0.55;
  NeighbourMoments sums;
  this->Visit(x,
    [this, &sums](SkeletonCells::Index particle, double weight, const double offset[3])
    {
      const double d2 = offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2];
      const double u = 1.0 - d2 * this->InverseReach2[particle] / (nearPerReach * nearPerReach);
      sums.Near += u > 0.0 ? this->Particles[particle].Strength * (u * u) : 0.0;
      sums.Weight += weight;
      for (int axis = 0; axis < 3; ++axis)
      {
        sums.First[axis] += weight * offset[axis];
      }
      constexpr int axes[6][2] = { { 0, 0 }, { 0, 1 }, { 0, 2 }, { 1, 1 }, { 1, 2 }, { 2, 2 } };
      for (int i = 0; i < 6; ++i)
      {
        sums.Second[i] += weight * offset[axes[i][0]] * offset[axes[i][1]];
      }
    });
  return sums;
}

NeighbourSums::Shares NeighbourSums::FindShares(
  const double x[3], const std::vector<Shares>& ofParticles) const
{
  Shares sums;
  this->Visit(x,
    [&](SkeletonCells::Index particle, double weight, const double*)
    {
      const double share = weight * ofParticles[particle].Share;
      sums.Share += share;
      sums.Value += share * ofParticles[particle].Value;
    });
  return sums;
}

}
